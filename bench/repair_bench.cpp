// What a repair costs, per face, on one core.

#include "delmesh/repair/repair.hpp"

#include "delmesh/mesh/shapes.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <numeric>

namespace delmesh {
namespace {

/// Every corner has a vertex of its own, as in an STL file.
PolygonSoup apart(const PolygonSoup& soup) {
    PolygonSoup result;
    result.points.reserve(soup.corners.size());
    for (const std::uint32_t v : soup.corners) result.points.push_back(soup.points[v]);
    result.corners.resize(soup.corners.size());
    std::iota(result.corners.begin(), result.corners.end(), 0U);
    return result;
}

/// Triangles between random points: several to each edge, and no surface anywhere.
PolygonSoup random_faces(std::size_t faces) {
    PolygonSoup soup;
    std::uint64_t state = 1;
    const auto below = [&state](std::uint32_t n) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return static_cast<std::uint32_t>((state >> 33) % n);
    };
    const std::uint32_t points = faces < 100'000 ? 100 : 1000;
    for (std::uint32_t i = 0; i < points; ++i)
        soup.points.push_back({1.0 * below(1000), 1.0 * below(1000), 1.0 * below(1000)});
    for (std::size_t f = 0; f < faces; ++f) soup.add_face(std::array{below(points), below(points), below(points)});
    return soup;
}

PolygonSoup make(int kind, std::int64_t faces) {
    const auto count = static_cast<std::size_t>(faces);
    switch (kind) {
        case 0:
            return make_sample("noisy-surface", count);
        case 1:
        case 2:
            return apart(make_sample("noisy-surface", count));
        default:
            return random_faces(count);
    }
}

/// 0 a clean mesh, 1 a soup of triangles, 2 the same with a tolerance, 3 random triangles that meet everywhere.
void bench_repair(benchmark::State& state) {
    const PolygonSoup soup = make(static_cast<int>(state.range(0)), state.range(1));
    const RepairOptions options{.weld_tolerance_rel = state.range(0) == 2 ? 1e-7 : 0};
    for (auto _ : state) benchmark::DoNotOptimize(diagnose(soup, options).changed);
    state.counters["per_face"] =
        benchmark::Counter(static_cast<double>(soup.face_count()) * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(bench_repair)
    ->ArgNames({"kind", "faces"})
    ->ArgsProduct({{0, 1, 2, 3}, {10'000, 1'000'000}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace delmesh
