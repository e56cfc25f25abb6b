// What it costs to certify and to measure, per edge or face, on one core.

#include "delmesh/measure/certificate.hpp"
#include "delmesh/measure/distance.hpp"
#include "delmesh/measure/statistics.hpp"
#include "measure/face_tree.hpp"
#include "measure/meshes.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace delmesh {
namespace {

Context one_thread({}, 1);

/// Face and vertex order as from a hash table: the worst case for the cache.
PolygonSoup shuffled(PolygonSoup soup) {
    test::Random random(7);
    std::vector<std::uint32_t> place(soup.points.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.bits() % i]);
    std::vector<Vec3> points(soup.points.size());
    for (std::size_t i = 0; i < place.size(); ++i) points[place[i]] = soup.points[i];
    soup.points = std::move(points);
    for (std::uint32_t& v : soup.corners) v = place[v];
    for (std::size_t i = soup.face_count(); i > 1; --i) {
        const std::size_t j = random.bits() % i;
        std::swap_ranges(&soup.corners[3 * (i - 1)], &soup.corners[3 * (i - 1)] + 3, &soup.corners[3 * j]);
    }
    return soup;
}

Mesh make(int kind, std::int64_t faces) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(faces) / 2));
    switch (kind) {
        case 0:
            return Mesh(testing::torus_soup(n, n, 0.2 / n));
        case 1:
            return Mesh(shuffled(testing::torus_soup(n, n, 0.2 / n)));
        case 2:
            return Mesh(testing::grid_soup(n));
        case 3:
            return Mesh(testing::turned(testing::grid_soup(n)));
        default:
            return Mesh(testing::turned(testing::grid_soup(n, 0.1)));
    }
}

void name_rates(benchmark::State& state, const char* unit, double count) {
    state.counters[unit] = benchmark::Counter(
        count * static_cast<double>(state.iterations()),
        static_cast<benchmark::Counter::Flags>(benchmark::Counter::kIsRate | benchmark::Counter::kInvert));
}

void bench_certify(benchmark::State& state) {
    const Mesh mesh = make(static_cast<int>(state.range(0)), state.range(1));
    Certificate c;
    for (auto _ : state) benchmark::DoNotOptimize(c = certify(mesh, &one_thread));
    const auto edges = static_cast<double>(mesh.count_edges());
    name_rates(state, "per_edge", edges);
    state.counters["exact_%"] = 100 * static_cast<double>(c.exact_edges) / edges;
    state.counters["violations_%"] = 100 * static_cast<double>(c.non_delaunay_edges) / edges;
}

void bench_angles(benchmark::State& state) {
    const Mesh mesh = make(static_cast<int>(state.range(0)), state.range(1));
    for (auto _ : state) benchmark::DoNotOptimize(measure_angles(mesh, &one_thread));
    name_rates(state, "per_face", static_cast<double>(mesh.face_count()));
}

void bench_size(benchmark::State& state) {
    const Mesh mesh = make(static_cast<int>(state.range(0)), state.range(1));
    for (auto _ : state) benchmark::DoNotOptimize(measure_size(mesh));
    name_rates(state, "per_face", static_cast<double>(mesh.face_count()));
}

/// Two noisy tori of so many faces each; `samples` inside the faces, each way, and as many as there
/// are on vertices and edges; search trees included.
void bench_distance(benchmark::State& state) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(state.range(0)) / 2));
    const PolygonSoup a = testing::torus_soup(n, n, 0.2 / n, 1), b = testing::torus_soup(n, n, 0.2 / n, 2);
    DistanceOptions options;
    options.samples_per_face = 1e-3;
    options.min_samples = static_cast<std::size_t>(state.range(1));
    options.bound_rel = state.range(2) == 0 ? 0 : 1e-6;
    DistanceReport r;
    for (auto _ : state) benchmark::DoNotOptimize(r = measure_distance(a, b, options, &one_thread));
    name_rates(state, "per_sample", static_cast<double>(r.samples));
    state.counters["samples"] = static_cast<double>(r.samples);
    state.counters["pieces"] = r.enclosure ? static_cast<double>(r.enclosure->pieces) : 0;
}

void bench_tree(benchmark::State& state) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(state.range(0)) / 2));
    const PolygonSoup a = testing::torus_soup(n, n, 0.2 / n, 1);
    for (auto _ : state) benchmark::DoNotOptimize(measure::FaceTree(a.points, a.corners, &one_thread));
    name_rates(state, "per_face", static_cast<double>(a.face_count()));
}

/// 0 noisy torus, 1 the same shuffled, 2 integer grid, 3 the same turned, 4 turned grid of step 0.1 (co-circular but
/// for rounding).
void kinds(benchmark::internal::Benchmark* b) {
    b->ArgNames({"kind", "faces"})->ArgsProduct({{0, 1, 2, 3, 4}, {10'000, 1'000'000}})->Unit(benchmark::kMillisecond);
}

BENCHMARK(bench_certify)->Apply(kinds);
BENCHMARK(bench_angles)->Apply(kinds);
BENCHMARK(bench_size)->Apply(kinds);
BENCHMARK(bench_tree)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(bench_distance)
    ->ArgNames({"faces", "samples", "bound"})
    ->ArgsProduct({{10'000, 1'000'000}, {1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace delmesh
