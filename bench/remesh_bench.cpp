// Phases of `delmesh remesh` between reading and writing, on one core, in nanoseconds per input face.

#include "delaunay/classify.hpp"
#include "delaunay/features.hpp"
#include "delaunay/flip.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace delmesh;

const PolygonSoup& surface(std::size_t faces) {
    static std::size_t made = 0;
    static PolygonSoup soup;
    if (made != faces) soup = make_sample("noisy-surface", faces);
    made = faces;
    return soup;
}

void per_face(benchmark::State& state, std::size_t faces) {
    state.counters["ns_per_face"] = benchmark::Counter(
        static_cast<double>(faces) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void build(benchmark::State& state) {
    const PolygonSoup& soup = surface(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        state.PauseTiming();
        PolygonSoup copy = soup;
        state.ResumeTiming();
        benchmark::DoNotOptimize(Mesh(std::move(copy)));
    }
    per_face(state, soup.face_count());
}

void remesh(benchmark::State& state, RemeshMode mode, SplitPlacement placement = SplitPlacement::shells) {
    const Mesh mesh(surface(static_cast<std::size_t>(state.range(0))));
    const Context one({}, 1);
    RemeshOptions options;
    options.mode = mode;
    options.placement = placement;
    RemeshReport report;
    for (auto _ : state) {
        state.PauseTiming();
        Mesh copy = mesh;
        state.ResumeTiming();
        report = make_delaunay(copy, options, &one);
    }
    per_face(state, mesh.face_count());
    state.counters["flips"] = static_cast<double>(report.flips);
    state.counters["splits"] = static_cast<double>(report.splits);
}

void preserve(benchmark::State& state) {
    remesh(state, RemeshMode::preserve);
}
void preserve_fewest(benchmark::State& state) {
    remesh(state, RemeshMode::preserve, SplitPlacement::fewest);
}
void flip(benchmark::State& state) {
    remesh(state, RemeshMode::flip);
}
void feature(benchmark::State& state) {
    remesh(state, RemeshMode::feature);
}

/// Flipping alone, with its queue, on a mesh that is built and marked; what Algorithm 2 does in its loop.
void flip_phase(benchmark::State& state, FlipOrder order) {
    const Mesh mesh(surface(static_cast<std::size_t>(state.range(0))));
    const std::vector<Mark> marks = mark_features(mesh, 180, {}, nullptr);
    const Context one({}, 1);
    RemeshOptions options;
    options.mode = RemeshMode::flip;
    options.order = order;
    for (auto _ : state) {
        state.PauseTiming();
        Mesh copy = mesh;
        MarkedMesh marked(copy, marks, {});
        RemeshReport report;
        state.ResumeTiming();
        flip_edges(marked, false, options, &one, report);
    }
    per_face(state, mesh.face_count());
}

void flip_phase_worst(benchmark::State& state) {
    flip_phase(state, FlipOrder::worst);
}
void flip_phase_lifo(benchmark::State& state) {
    flip_phase(state, FlipOrder::lifo);
}

/// The floor: one look at every edge.
void first_pass(benchmark::State& state) {
    const Mesh mesh(surface(static_cast<std::size_t>(state.range(0))));
    const Context one({}, 1);
    for (auto _ : state) benchmark::DoNotOptimize(find_non_delaunay(mesh, &one));
    per_face(state, mesh.face_count());
}

void sizes(benchmark::internal::Benchmark* run) {
    for (const long faces : {10'000, 100'000, 1'100'000}) run->Arg(faces);
    run->Unit(benchmark::kMillisecond);
}

BENCHMARK(build)->Apply(sizes);
BENCHMARK(first_pass)->Apply(sizes);
BENCHMARK(flip_phase_worst)->Apply(sizes);
BENCHMARK(flip_phase_lifo)->Apply(sizes);
BENCHMARK(flip)->Apply(sizes);
BENCHMARK(feature)->Apply(sizes);
BENCHMARK(preserve)->Apply(sizes);
BENCHMARK(preserve_fewest)->Apply(sizes);

}  // namespace
