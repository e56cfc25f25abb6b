#pragma once
// A piece of a triangle of one surface, and how far any of its points can be from the other.

#include "delmesh/base/vec3.hpp"
#include "measure/face_tree.hpp"

#include <array>
#include <cstdint>

namespace delmesh::measure {

struct Piece {
    std::array<Vec3, 3> corner;
    /// No point of the piece is farther from the other surface.
    double upper = 0;
    /// The triangle of the other surface that is nearest to the middle, and the one nearest to the corner that is
    /// farthest from that one.
    std::uint32_t nearest = 0;
    std::uint32_t rival = 0;
    std::uint8_t worst = 0;     ///< that corner
    std::uint8_t cuts = 0;      ///< since the last bisection
    std::uint16_t depth = 0;    ///< number of splits that made the piece
    std::uint8_t backward = 0;  ///< 0: a piece of A, 1: of B
    std::uint64_t number = 0;   ///< in the order in which they were made
};

/// Up to three parts that cover a piece.
struct Parts {
    std::array<Piece, 3> part;
    std::size_t count = 0;

    void add(const Piece& parent, const Vec3& a, const Vec3& b, const Vec3& c);
};

/// Lowers `piece.upper` as far as a few distances to `to` allow; no further than to `enough`, which is as good as zero.
/// Returns a proved lower bound of the distance of some point of the piece if it is above `lower`, else `lower`.
[[nodiscard]] double evaluate(Piece& piece, const FaceTree& to, double lower, double enough);

/// Splits along the line where the nearest triangle changes, if that seems near; else halves the longest side.
[[nodiscard]] Parts split(const Piece& piece, const FaceTree& to);

}  // namespace delmesh::measure
