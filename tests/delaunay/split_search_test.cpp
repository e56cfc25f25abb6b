// The search ends where little comes of it, later if it is patient.

#include "delaunay/split_search.hpp"

#include "delaunay/prepared_model.hpp"
#include "delaunay/refine.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace delmesh {
namespace {

struct Outcome {
    std::uint64_t work = 0;
    std::size_t points = 0;
};

Outcome improve(std::uint64_t patience) {
    constexpr std::uint64_t plenty = 1'000'000'000;
    test::PreparedModel prepared(Mesh(make_sample("noisy-surface", 300)));
    RemeshReport report;
    const RefineStart start = flip_planar_edges(prepared.marked, {}, nullptr, report);
    std::vector<std::uint32_t> bad;
    for (const EdgeId e : start.bad) bad.push_back(prepared.model.edge_of(Mesh::halfedge(e)));
    SplitSearch search(prepared.model, 1);
    search.construct(bad, plenty);
    const std::uint64_t before = prepared.model.work();
    search.be_patient(patience);
    search.improve(plenty);
    EXPECT_TRUE(search.open().empty());
    return {prepared.model.work() - before, prepared.model.point_count()};
}

TEST(SplitSearch, GoesOnForLongerIfItIsPatient) {
    const Outcome hasty = improve(1);
    const Outcome patient = improve(8);
    EXPECT_GT(patient.work, 3 * hasty.work);
    EXPECT_LT(patient.work, 20 * hasty.work);  // and yet it ends
    EXPECT_LE(patient.points, hasty.points);
}

}  // namespace
}  // namespace delmesh
