#pragma once
// What is known of vertices that were merged into others.

#include "delmesh/measure/statistics.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace delmesh::test {

/// `now` says which vertex of the coarse mesh each one of the fine mesh was merged into: not far away, and all are
/// used.
inline void expect_merged_nearby(const Mesh& fine, const Mesh& coarse, const std::vector<VertexId>& now) {
    ASSERT_EQ(now.size(), fine.vertex_count());
    const double diagonal = bounding_diagonal(fine);
    std::vector<bool> used(coarse.vertex_count());
    for (std::size_t v = 0; v < now.size(); ++v) {
        ASSERT_TRUE(now[v].valid());
        used[now[v].index()] = true;
        EXPECT_LT(norm(coarse.point(now[v]) - fine.point(VertexId(v))), 0.25 * diagonal);
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "each vertex has come from somewhere";
}

}  // namespace delmesh::test
