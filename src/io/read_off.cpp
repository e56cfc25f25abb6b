#include "io/read_off.hpp"

#include "io/readers.hpp"
#include "io/text_scanner.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace delmesh::io {

std::optional<OffKind> parse_off_keyword(std::string_view word) {
    OffKind kind;
    const auto take = [&word](std::string_view prefix) {
        const bool found = word.starts_with(prefix);
        if (found) word.remove_prefix(prefix.size());
        return found;
    };
    kind.texture = take("ST");
    kind.colours = take("C");
    kind.normals = take("N");
    kind.homogeneous = take("4");
    kind.any_dimension = take("n");
    if (word != "OFF") return std::nullopt;
    return kind;
}

namespace {

/// A vertex, and a face, begins on a line of its own; numbers may go on over several lines, and what is left on the
/// last of them (normals, colours) is not looked at.
class OffReader {
public:
    OffReader(Input& input, SoupBuilder& builder) : input_(input), scanner_(input, {'#', false}), builder_(builder) {}

    void read() {
        if (read_keyword()) {
            scanner_.release();
            read_off_binary(input_, kind_, builder_);
        } else {
            read_counts();
            read_vertices();
            read_faces();
        }
    }

private:
    /// The keyword may be missing. True if binary data follow.
    bool read_keyword() {
        scanner_.need_word("'OFF'");
        TextScanner ahead = scanner_;
        const auto kind = parse_off_keyword(ahead.word());
        if (!kind) return false;
        kind_ = *kind;
        scanner_ = ahead;
        return ahead.word() == "BINARY";
    }

    void read_counts() {
        if (kind_.any_dimension) dimension_ = read_count("the dimension of the vertices");
        if (dimension_ == 0) scanner_.fail("expected vertices of one dimension or more, found 0");
        points_ = read_count("the number of vertices");
        faces_ = read_count("the number of faces");
        if (points_ >= most_points) {
            scanner_.fail_at(scanner_.line(),
                             fmt::format("expected fewer than {} vertices, found {}", most_points, points_),
                             ErrorCode::too_large);
        }
        skip_edge_count();
    }

    /// It stands on the same line, on a line of its own, or nowhere.
    void skip_edge_count() {
        if (!scanner_.line_is_done()) return;
        while (scanner_.line_is_done()) {
            if (!scanner_.next_line()) return;
        }
        TextScanner ahead = scanner_;
        ahead.word();
        line_is_new_ = !ahead.line_is_done();
    }

    void read_vertices() {
        std::vector<Vec3>& points = builder_.soup.points;
        points.reserve(input_.plausible(points_, 2));
        for (std::uint64_t v = 0; v < points_; ++v) {
            begin_record("vertex", v, points_);
            if (!builder_.salvage.attempt([&] { points.push_back(read_point()); })) builder_.add_missing_point();
        }
    }

    Vec3 read_point() {
        Vec3 point;
        for (std::uint64_t i = 0; i < dimension_; ++i) {
            const double coordinate = read_number();
            if (i < 3) point[static_cast<int>(i)] = coordinate;
        }
        return kind_.homogeneous ? divide(point, read_number()) : point;
    }

    Vec3 divide(const Vec3& point, double by) {
        if (by == 0) scanner_.fail("expected a homogeneous coordinate other than 0, found 0");
        return {point.x / by, point.y / by, point.z / by};
    }

    void read_faces() {
        builder_.soup.corners.reserve(input_.plausible(3 * faces_, 2));
        for (std::uint64_t f = 0; f < faces_; ++f) {
            begin_record("face", f, faces_);
            if (!builder_.salvage.attempt([this] { read_face(); })) builder_.leave_out_face();
        }
    }

    void read_face() {
        for (std::uint64_t n = read_count("the number of vertices of a face"); n > 0; --n)
            builder_.add_corner(read_index());
        builder_.end_face();
    }

    void begin_record(std::string_view what, std::uint64_t index, std::uint64_t count) {
        if (line_is_new_) {
            line_is_new_ = false;
            return;
        }
        do {
            if (!scanner_.next_line()) {
                scanner_.fail(fmt::format("expected {} {} of {}, found the end of the file", what, index, count));
            }
        } while (scanner_.line_is_done());
    }

    double read_number() {
        scanner_.need_word("a coordinate");
        return scanner_.number("a coordinate");
    }

    std::uint64_t read_count(std::string_view what) {
        scanner_.need_word(what);
        const TextScanner at_word = scanner_;
        const std::int64_t count = scanner_.integer(what);
        if (count < 0) at_word.fail_expected(what);
        return static_cast<std::uint64_t>(count);
    }

    std::uint32_t read_index() {
        scanner_.need_word("a vertex index");
        const std::int64_t vertex = scanner_.integer("a vertex index");
        if (vertex < 0 || vertex >= static_cast<std::int64_t>(points_)) {
            scanner_.fail_at(scanner_.line(),
                             fmt::format("expected a vertex index below {}, found {}", points_, vertex),
                             ErrorCode::index_out_of_range);
        }
        return static_cast<std::uint32_t>(vertex);
    }

    Input& input_;
    TextScanner scanner_;
    SoupBuilder& builder_;
    OffKind kind_;
    std::uint64_t dimension_ = 3;
    std::uint64_t points_ = 0;
    std::uint64_t faces_ = 0;
    bool line_is_new_ = false;
};

}  // namespace

void read_off(Input& input, SoupBuilder& builder) {
    OffReader(input, builder).read();
}

}  // namespace delmesh::io
