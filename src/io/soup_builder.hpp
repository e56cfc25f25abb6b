#pragma once
// Puts a soup together corner by corner: nothing beyond the corners is kept as long as all faces are triangles.

#include "delmesh/mesh/polygon_soup.hpp"
#include "io/salvage.hpp"

#include <cstddef>
#include <cstdint>

namespace delmesh::io {

class SoupBuilder {
public:
    explicit SoupBuilder(FileDamage* damage = nullptr) : salvage(damage) {}

    PolygonSoup soup;
    Salvage salvage;

    void add_corner(std::uint32_t vertex) { soup.corners.push_back(vertex); }
    /// Ends the face that the corners added since the last face make; it may have any number of them, even none.
    void end_face() {
        const std::size_t corners = soup.corners.size() - face_begin_;
        if (corners != 3 || !soup.starts.empty()) add_start();
        face_begin_ = soup.corners.size();
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        soup.corners.push_back(a);
        soup.corners.push_back(b);
        soup.corners.push_back(c);
        end_face();
    }
    /// Stands for a vertex that can not be read.
    void add_missing_point();
    /// Drops the corners added since the last face.
    void leave_out_face() { soup.corners.resize(face_begin_); }
    /// Tells that the soup has got whole triangles without any of these functions.
    void end_triangles() { face_begin_ = soup.corners.size(); }
    /// Drops faces and lines that name points which are not there.
    void leave_out_dangling();
    /// The corners of the face that is being made.
    [[nodiscard]] std::size_t open_corners() const { return soup.corners.size() - face_begin_; }

private:
    void add_start();

    std::size_t face_begin_ = 0;
};

/// Ids are 32 bits wide and one value means "none".
inline constexpr std::uint64_t most_points = 0xffffffffu;

}  // namespace delmesh::io
