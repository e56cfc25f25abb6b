#include "io/readers.hpp"
#include "io/soup_builder.hpp"
#include "io/text_scanner.hpp"

#include <fmt/format.h>

namespace delmesh::io {

namespace {

/// Vertices, faces and lines; everything else (normals, textures, groups, materials, curves) is passed over.
class ObjReader {
public:
    ObjReader(Input& input, SoupBuilder& builder) : scanner_(input, {'#', true}), builder_(builder) {}

    void read() {
        Salvage& salvage = builder_.salvage;
        while (scanner_.next_line()) {
            const std::string_view keyword = scanner_.word();
            if (keyword == "v") {
                if (!salvage.attempt([this] { read_vertex(); })) builder_.add_missing_point();
            } else if (keyword == "f") {
                if (!salvage.attempt([this] { read_face(); })) builder_.leave_out_face();
            } else if (keyword == "l") {
                salvage.attempt([this] { read_line(); });
            } else if (!keyword.empty()) {
                others_ = true;
            }
        }
        salvage.attempt([this] { check_forward_references(); });
        if (others_ && soup().points.empty()) scanner_.fail("expected lines 'v X Y Z' before here, found none");
    }

private:
    PolygonSoup& soup() { return builder_.soup; }

    void read_vertex() {
        Vec3 point;
        for (const int axis : {0, 1, 2}) point[axis] = scanner_.number("a coordinate");
        if (soup().points.size() == most_points - 1) {
            scanner_.fail_at(scanner_.line(), fmt::format("expected fewer than {} vertices, found more", most_points),
                             ErrorCode::too_large);
        }
        soup().points.push_back(point);
    }

    void read_face() {
        do {
            builder_.add_corner(read_reference());
        } while (!scanner_.line_is_done());
        builder_.end_face();
    }

    void read_line() {
        std::uint32_t last = read_reference();
        while (!scanner_.line_is_done()) {
            const std::uint32_t next = read_reference();
            soup().lines.push_back({last, next});
            last = next;
        }
    }

    /// v, v/t, v//n or v/t/n; of v, the index from 0.
    std::uint32_t read_reference() {
        if (scanner_.line_is_done()) scanner_.fail_expected("a vertex index");
        const std::int64_t written = scanner_.digits("a vertex index");
        for (int part = 0; part < 2 && scanner_.peek() == '/'; ++part) {
            scanner_.advance();
            if (scanner_.peek() != '/' && !scanner_.at_word_end()) scanner_.digits("an index");
        }
        if (!scanner_.at_word_end()) scanner_.fail_expected("an index");
        return resolve(written);
    }

    /// Positive indices count from 1 and may name a vertex that comes later; negative ones count back from here.
    std::uint32_t resolve(std::int64_t written) {
        const auto points = static_cast<std::int64_t>(soup().points.size());
        const std::int64_t vertex = written > 0 ? written - 1 : points + written;
        if (written == 0 || vertex < 0 || vertex >= static_cast<std::int64_t>(most_points))
            fail_index(scanner_.line(), written);
        if (vertex >= points && vertex > largest_forward_) {
            largest_forward_ = vertex;
            forward_line_ = scanner_.line();
        }
        return static_cast<std::uint32_t>(vertex);
    }

    void check_forward_references() {
        if (largest_forward_ >= static_cast<std::int64_t>(soup().points.size())) {
            fail_index(forward_line_, largest_forward_ + 1);
        }
    }

    [[noreturn]] void fail_index(std::uint64_t line, std::int64_t written) {
        const std::size_t points = soup().points.size();
        scanner_.fail_at(
            line,
            written > 0 ? fmt::format("expected a vertex index from 1 to {}, found {}", points, written)
                        : fmt::format("expected a vertex index from 1 or from -{} to -1, found {}", points, written),
            ErrorCode::index_out_of_range);
    }

    TextScanner scanner_;
    SoupBuilder& builder_;
    std::int64_t largest_forward_ = -1;
    std::uint64_t forward_line_ = 0;
    bool others_ = false;
};

}  // namespace

void read_obj(Input& input, SoupBuilder& builder) {
    ObjReader(input, builder).read();
}

}  // namespace delmesh::io
