#include "delmesh/base/ids.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <type_traits>
#include <unordered_set>

namespace delmesh {
namespace {

template <class A, class B>
concept Comparable = requires(A a, B b) {
    a == b;
};

// What must not compile: ids of different kinds neither mix nor arise from plain integers unasked.
static_assert(!Comparable<VertexId, FaceId>);
static_assert(!Comparable<VertexId, int>);
static_assert(!std::is_constructible_v<VertexId, FaceId>);
static_assert(!std::is_convertible_v<VertexId, HalfedgeId>);
static_assert(!std::is_convertible_v<int, VertexId>);
static_assert(!std::is_convertible_v<VertexId, std::uint32_t>);
static_assert(Comparable<EdgeId, EdgeId>);
static_assert(sizeof(VertexId) == 4 && std::is_trivially_copyable_v<VertexId>);

TEST(Ids, DefaultIsNone) {
    EXPECT_FALSE(VertexId().valid());
    EXPECT_TRUE(VertexId(0).valid());
    EXPECT_EQ(VertexId().value(), VertexId::none_value);
    EXPECT_LT(VertexId(std::size_t{4294967294U}), VertexId()) << "none comes after every id";
}

TEST(Ids, CompareAndHashByValue) {
    EXPECT_EQ(FaceId(7), FaceId(std::size_t{7}));
    EXPECT_LT(FaceId(7), FaceId(8));
    EXPECT_EQ(FaceId(7).index(), 7U);
    const std::unordered_set<EdgeId> edges{EdgeId(1), EdgeId(2), EdgeId(1)};
    EXPECT_EQ(edges.size(), 2U);
}

}  // namespace
}  // namespace delmesh
