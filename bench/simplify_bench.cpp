// `simplify` on one core, with the quality of what comes out beside the time.

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/measure/distance.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/simplify/quadric_program.hpp"
#include "delmesh/simplify/simplify.hpp"
#include "support/random.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace delmesh;

const Mesh& surface(std::size_t faces) {
    static std::size_t made = 0;
    static Mesh mesh;
    if (made != faces) mesh = Mesh(make_sample("noisy-surface", faces));
    made = faces;
    return mesh;
}

/// Arguments: faces, parts per thousand of the vertices to keep.
void reduce(benchmark::State& state, const SimplifyOptions& base) {
    const Mesh& mesh = surface(static_cast<std::size_t>(state.range(0)));
    const Context one({}, 1);
    SimplifyOptions options = base;
    options.ratio = static_cast<double>(state.range(1)) / 1000;
    Mesh coarse;
    SimplifyReport report;
    for (auto _ : state) {
        state.PauseTiming();
        coarse = mesh;
        state.ResumeTiming();
        report = simplify(coarse, options, &one);
    }
    const DistanceReport distance = measure_distance(mesh, coarse, {.samples_per_face = 1}, &one);
    state.counters["vertices"] = static_cast<double>(coarse.vertex_count());
    state.counters["hausdorff_percent"] = distance.hausdorff.percent;
    state.counters["mean_percent"] = distance.mean.percent;
    state.counters["us_per_collapse"] =
        benchmark::Counter(static_cast<double>(report.collapses) * 1e-6,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void best(benchmark::State& state) {
    reduce(state, {});
}
void best_without_refit(benchmark::State& state) {
    SimplifyOptions options;
    options.refit = false;
    reduce(state, options);
}
void paper(benchmark::State& state) {
    SimplifyOptions options;
    options.placement = Placement::paper;
    reduce(state, options);
}

/// The inner problem: a quadric over so many half-spaces around a point.
void quadric_program(benchmark::State& state) {
    constexpr std::size_t cases = 256;
    test::Random random(1);
    std::vector<QuadricFactors> factors;
    std::vector<std::vector<HalfSpace>> half_spaces(cases);
    for (std::size_t i = 0; i < cases; ++i) {
        Quadric quadric;
        for (int plane = 0; plane < 8; ++plane) quadric.add_plane(random.vec(1), random.real(-1, 1), 1);
        quadric.add_point({}, 1e-3);
        factors.push_back(*factorise(quadric));
        for (long k = 0; k < state.range(0); ++k) half_spaces[i].push_back({random.vec(1), random.real(-0.5, 0)});
    }
    std::vector<HalfSpace> copy;
    std::size_t i = 0;
    for (auto _ : state) {
        copy = half_spaces[i];
        benchmark::DoNotOptimize(minimise(factors[i], copy));
        i = (i + 1) % cases;
    }
}

void sizes(benchmark::internal::Benchmark* run) {
    run->Args({97'000, 100})->Args({97'000, 10})->Unit(benchmark::kMillisecond)->Iterations(3);
}

BENCHMARK(best)->Apply(sizes);
BENCHMARK(best)->Args({1'100'000, 100})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(best_without_refit)->Apply(sizes);
BENCHMARK(paper)->Apply(sizes);
BENCHMARK(quadric_program)->Arg(8)->Arg(16)->Arg(32);

}  // namespace
