#pragma once
// Typed 32-bit element ids: a face can not be mistaken for a vertex, and an id costs what an int costs.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace delmesh {

/// An index into an element array. Ids of different tags neither compare nor convert.
/// The default value is "none"; `valid()` tells the two apart.
template <class Tag>
class Id {
public:
    using value_type = std::uint32_t;
    static constexpr value_type none_value = std::numeric_limits<value_type>::max();

    constexpr Id() = default;
    constexpr explicit Id(value_type value) : value_(value) {}
    constexpr explicit Id(std::size_t value) : value_(static_cast<value_type>(value)) {}
    constexpr explicit Id(int value) : value_(static_cast<value_type>(value)) {}

    [[nodiscard]] constexpr value_type value() const { return value_; }
    [[nodiscard]] constexpr std::size_t index() const { return value_; }
    [[nodiscard]] constexpr bool valid() const { return value_ != none_value; }

    friend constexpr auto operator<=>(const Id&, const Id&) = default;

private:
    value_type value_ = none_value;
};

using VertexId = Id<struct VertexTag>;
using HalfedgeId = Id<struct HalfedgeTag>;
using FaceId = Id<struct FaceTag>;
/// An edge is named by the smaller of its (at most two) half-edge indices, see `Mesh::edge`.
using EdgeId = Id<struct EdgeTag>;

}  // namespace delmesh

template <class Tag>
struct std::hash<delmesh::Id<Tag>> {
    std::size_t operator()(delmesh::Id<Tag> id) const noexcept { return id.value(); }
};
