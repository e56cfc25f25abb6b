#pragma once
// One function for each format that is written.

#include "delmesh/io/write.hpp"
#include "io/output_file.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>

namespace delmesh::io {

/// The points and faces of a mesh or a soup, as they lie in memory.
class Surface {
public:
    explicit Surface(const Mesh& mesh) : points(mesh.points()), ids_(mesh.corners()) {}
    explicit Surface(const PolygonSoup& soup)
        : points(soup.points),
          lines(soup.lines),
          corners_(soup.corners),
          starts_(soup.starts) {}

    [[nodiscard]] std::size_t face_count() const {
        return starts_.empty() ? (ids_.size() + corners_.size()) / 3 : starts_.size() - 1;
    }
    [[nodiscard]] bool is_triangles() const { return starts_.empty(); }
    /// The first corner of a face; those of the next face begin where its own end.
    [[nodiscard]] std::size_t start(std::size_t face) const { return starts_.empty() ? 3 * face : starts_[face]; }
    [[nodiscard]] std::uint32_t corner(std::size_t i) const { return ids_.empty() ? corners_[i] : ids_[i].value(); }
    [[nodiscard]] std::size_t corner_count() const { return ids_.size() + corners_.size(); }

    std::span<const Vec3> points;
    std::span<const std::array<std::uint32_t, 2>> lines;

private:
    std::span<const VertexId> ids_;
    std::span<const std::uint32_t> corners_;
    std::span<const std::size_t> starts_;
};

void write_ply(OutputFile& file, const Surface& surface, const WriteOptions& options);
void write_obj(OutputFile& file, const Surface& surface);
void write_off(OutputFile& file, const Surface& surface);
/// Triangles only.
void write_stl(OutputFile& file, const Surface& surface, bool ascii);

/// Room for one number and a separator.
inline constexpr std::size_t number_room = 32;

/// The shortest text that is read back as this double. Floats are written this way too: the shortest text of a float
/// is another number to a reader that has doubles.
inline char* put(char* to, double value) {
    return std::to_chars(to, to + number_room, value).ptr;
}
inline char* put(char* to, std::uint64_t value) {
    return std::to_chars(to, to + number_room, value).ptr;
}
inline char* put(char* to, char c) {
    *to = c;
    return to + 1;
}
/// Three numbers with blanks between.
inline char* put(char* to, const Vec3& p) {
    to = put(put(to, p.x), ' ');
    to = put(put(to, p.y), ' ');
    return put(to, p.z);
}

}  // namespace delmesh::io
