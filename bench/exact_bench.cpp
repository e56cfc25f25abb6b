// Nanoseconds per exact sign, for each family of inputs; the counters say which share each tier decided.

#include "delmesh/exact/predicates.hpp"

#include "exact/families.hpp"
#include "exact/inline.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace delmesh;
using namespace delmesh::families;

template <class Family>
std::vector<Quad> make(Family family) {
    Random random(2007);
    std::vector<Quad> quads;
    for (int i = 0; i < 4096; ++i) quads.push_back(family(random));
    return quads;
}

template <class Predicate>
void run(benchmark::State& state, const std::vector<Quad>& quads, Predicate predicate) {
    std::size_t tiers[3] = {};
    for (const Quad& quad : quads) {
        Tier tier{};
        benchmark::DoNotOptimize(predicate(quad, &tier));
        ++tiers[static_cast<std::size_t>(tier)];
    }
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(predicate(quads[i], nullptr));
        i = (i + 1) % quads.size();
    }
    const double share = 100.0 / static_cast<double>(quads.size());
    state.counters["filter%"] = static_cast<double>(tiers[0]) * share;
    state.counters["fixed%"] = static_cast<double>(tiers[1]) * share;
    state.counters["big%"] = static_cast<double>(tiers[2]) * share;
}

/// Diagonals with legs (3,4,0) and (-4,3,0), as in a rotated integer lattice.
Quad integer_square(Random& random) {
    const double x = random.below(1000), y = random.below(1000), z = random.below(1000);
    return {{x, y, z}, {x - 1, y + 7, z}, {x + 3, y + 4, z}, {x - 4, y + 3, z}};
}

const auto grid_cell = [](Random& random) { return sloping_grid_cell(random, true); };
const auto tilted_cell = [](Random& random) { return sloping_grid_cell(random); };
const auto unit_circle = [](Random& random) { return circle(random); };
const auto far_circle = [](Random& random) { return circle(random, 1e6); };
const auto tiny_circle = [](Random& random) { return scaled(circle(random), -200); };
/// Generic quads, pressed flat to 1:10,000.
const auto shallow_needle = [](Random& random) {
    return mapped(generic(random), [](Vec3 a) { return Vec3{a.x, a.y, a.z * 1e-4}; });
};

const auto delaunay = [](const Quad& q, Tier* tier) { return delaunay_sign(q.p, q.q, q.u, q.v, tier); };
const auto right_angle = [](const Quad& q, Tier* tier) { return right_angle_sign(q.p, q.q, q.u, tier); };
const auto coplanar = [](const Quad& q, Tier* tier) { return orientation(q.p, q.q, q.u, q.v, tier); };
const auto collinear = [](const Quad& q, Tier* tier) { return are_collinear(q.p, q.q, q.u, tier); };
const auto planar = [](const Quad& q, Tier* tier) { return is_planar_edge(q.p, q.q, q.u, q.v, tier); };
const auto fold = [](const Quad& q, Tier* tier) { return dihedral_sign(q.p, q.q, q.u, q.v, 0.98, tier); };

const auto delaunay_inline = [](const Quad& q, Tier* tier) {
    return exact::delaunay_sign_inline(q.p, q.q, q.u, q.v, tier);
};
const auto planar_inline = [](const Quad& q, Tier* tier) {
    return exact::is_planar_edge_inline(q.p, q.q, q.u, q.v, tier);
};

#define DELMESH_EXACT_BENCH(predicate, family) BENCHMARK_CAPTURE(run, predicate##_##family, make(family), predicate)

DELMESH_EXACT_BENCH(delaunay, generic);
DELMESH_EXACT_BENCH(delaunay, shallow_needle);
DELMESH_EXACT_BENCH(delaunay, grid_cell);
DELMESH_EXACT_BENCH(delaunay, tilted_cell);
DELMESH_EXACT_BENCH(delaunay, integer_square);
DELMESH_EXACT_BENCH(delaunay, unit_circle);
DELMESH_EXACT_BENCH(delaunay, folded_circle);
DELMESH_EXACT_BENCH(delaunay, far_circle);
DELMESH_EXACT_BENCH(delaunay, tiny_circle);
DELMESH_EXACT_BENCH(delaunay, needle);
DELMESH_EXACT_BENCH(delaunay, cap);
DELMESH_EXACT_BENCH(delaunay, mixed_scales);
DELMESH_EXACT_BENCH(delaunay, any_bits);

#define DELMESH_EXACT_BENCH_SOME(predicate)         \
    DELMESH_EXACT_BENCH(predicate, generic);        \
    DELMESH_EXACT_BENCH(predicate, grid_cell);      \
    DELMESH_EXACT_BENCH(predicate, tilted_cell);    \
    DELMESH_EXACT_BENCH(predicate, integer_square); \
    DELMESH_EXACT_BENCH(predicate, unit_circle);    \
    DELMESH_EXACT_BENCH(predicate, cap);            \
    DELMESH_EXACT_BENCH(predicate, mixed_scales)

DELMESH_EXACT_BENCH_SOME(delaunay_inline);
DELMESH_EXACT_BENCH_SOME(right_angle);
DELMESH_EXACT_BENCH_SOME(coplanar);
DELMESH_EXACT_BENCH_SOME(collinear);
DELMESH_EXACT_BENCH_SOME(planar);
DELMESH_EXACT_BENCH_SOME(planar_inline);
DELMESH_EXACT_BENCH_SOME(fold);

}  // namespace
