#include "mesh/edge_groups.hpp"

#include "delmesh/base/ids.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace delmesh {
namespace {

using Ends = std::array<std::uint32_t, 2>;

struct RandomEdges {
    static constexpr std::uint32_t vertices = 37;
    std::vector<Ends> ends;  ///< of each half-edge, the lower one first
    std::map<Ends, std::vector<HalfedgeId>> expected;

    explicit RandomEdges(std::uint64_t seed) {
        test::Random random(seed);
        for (std::uint32_t h = 0; h < 300; ++h) {
            const auto a = static_cast<std::uint32_t>(random.below(vertices));
            const auto b = static_cast<std::uint32_t>(random.below(vertices));
            ends.push_back({std::min(a, b), std::max(a, b)});
            expected[ends.back()].emplace_back(h);
        }
    }
    [[nodiscard]] EdgeGroups<HalfedgeId> groups() const {
        return {vertices, ends.size(), [&](HalfedgeId h) { return ends[h.index()][0]; }};
    }
    [[nodiscard]] auto high() const {
        return [&](HalfedgeId h) { return ends[h.index()][1]; };
    }
};

TEST(EdgeGroups, AreVisitedInTheOrderOfTheirEnds) {
    const RandomEdges edges(1);
    auto next = edges.expected.begin();
    edges.groups().visit(edges.high(), [&](std::span<const HalfedgeId> halfedges) {
        ASSERT_NE(next, edges.expected.end());
        EXPECT_EQ(std::vector(halfedges.begin(), halfedges.end()), next->second);
        ++next;
    });
    EXPECT_EQ(next, edges.expected.end());
}

TEST(EdgeGroups, AreLeftOutWhereNotWanted) {
    const RandomEdges edges(2);
    std::size_t found = 0;
    edges.groups().visit(
        edges.high(),
        [&](std::span<const HalfedgeId> halfedges) {
            EXPECT_EQ(edges.ends[halfedges[0].index()][0] % 2, 1U);
            found += halfedges.size();
        },
        [](std::uint32_t v) { return v % 2 == 1; });
    const auto is_odd = [](const Ends& e) { return e[0] % 2 == 1; };
    EXPECT_EQ(found, static_cast<std::size_t>(std::count_if(edges.ends.begin(), edges.ends.end(), is_odd)));
}

TEST(EdgeGroups, LetTheLastVisitOverwriteTheLinks) {
    const RandomEdges edges(3);
    EdgeGroups<HalfedgeId> groups = edges.groups();
    std::vector<HalfedgeId>& links = groups.links();
    std::size_t visited = 0;
    groups.visit(edges.high(), [&](std::span<const HalfedgeId> halfedges) {
        ++visited;
        for (const HalfedgeId h : halfedges) links[h.index()] = halfedges[0];
    });
    EXPECT_EQ(visited, edges.expected.size());
    for (std::size_t h = 0; h < edges.ends.size(); ++h) EXPECT_EQ(links[h], edges.expected.at(edges.ends[h])[0]);
}

}  // namespace
}  // namespace delmesh
