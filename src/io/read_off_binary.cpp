#include "io/read_off.hpp"

#include "io/endian.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace delmesh::io {

namespace {

/// 32-bit integers and floats. Geomview writes big-endian with the number of colour components behind each face; PMP
/// writes little-endian without it. Nothing in the file says which, so the first dialect that fits is taken.
template <std::endian order, bool face_colours>
class BinaryOff {
public:
    BinaryOff(std::string_view data, const OffKind& kind) : data_(data), kind_(kind) {}

    /// True if the data are a mesh in this dialect; else `problem()` and `position()` say why not. In the dialect that
    /// is documented, more may follow.
    bool read(SoupBuilder& builder) {
        const std::uint32_t dimension = kind_.any_dimension ? integer() : 3;
        points_ = integer();
        const std::uint32_t faces = integer();
        integer();  // the number of edges is not used
        if (!ok() || !read_points(dimension, builder.soup.points) || !read_faces(faces, builder)) return false;
        const bool documented = order == std::endian::big && face_colours;
        return documented || position_ == data_.size() || fail("expected the end of the file, found more data");
    }

    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] std::size_t position() const { return position_; }
    [[nodiscard]] ErrorCode code() const { return code_; }

private:
    [[nodiscard]] bool ok() const { return problem_.empty(); }

    bool fail(std::string problem, ErrorCode code = ErrorCode::file_format) {
        if (ok()) {
            problem_ = std::move(problem);
            code_ = code;
        }
        return false;
    }

    /// True if `count` records of `size` bytes follow.
    bool has(std::uint64_t count, std::uint64_t size, const char* what) {
        const std::uint64_t left = (data_.size() - position_) / size;
        return count <= left ||
               fail(fmt::format("expected {} {}, found the end of the file after {}", count, what, left));
    }

    std::uint32_t integer() {
        if (!has(1, 4, "number")) return 0;
        position_ += 4;
        return load<std::uint32_t, order>(data_.data() + position_ - 4);
    }

    bool read_points(std::uint32_t dimension, std::vector<Vec3>& points) {
        if (dimension == 0) return fail("expected vertices of one dimension or more, found 0");
        if (points_ == most_points)
            return fail(fmt::format("expected fewer than {} vertices, found {}", most_points, points_),
                        ErrorCode::too_large);
        const std::uint64_t used = std::uint64_t{dimension} + kind_.homogeneous;
        const std::uint64_t numbers = used + 3u * kind_.normals + 4u * kind_.colours + 2u * kind_.texture;
        if (!has(points_, 4 * numbers, "vertices")) return false;
        points.reserve(points_);
        for (std::uint32_t v = 0; v < points_; ++v, position_ += 4 * numbers) {
            Vec3 point;
            for (std::uint32_t i = 0; i < std::min(dimension, 3u); ++i) point[static_cast<int>(i)] = number(i);
            if (kind_.homogeneous) {
                const double by = number(used - 1);
                if (by == 0) return fail("expected a homogeneous coordinate other than 0, found 0");
                point = {point.x / by, point.y / by, point.z / by};
            }
            points.push_back(point);
        }
        return true;
    }

    [[nodiscard]] double number(std::uint64_t index) const {
        return load<float, order>(data_.data() + position_ + 4 * index);
    }

    bool read_faces(std::uint32_t faces, SoupBuilder& builder) {
        if (!has(faces, face_colours ? 8 : 4, "faces")) return false;
        for (std::uint32_t f = 0; f < faces; ++f) {
            const std::uint32_t corners = integer();
            if (!has(corners, 4, "corners of a face")) return false;
            for (std::uint32_t i = 0; i < corners; ++i) {
                const std::uint32_t vertex = integer();
                if (vertex >= points_) {
                    position_ -= 4;
                    return fail(
                        fmt::format("expected a vertex index below {} in face {}, found {}", points_, f, vertex),
                        ErrorCode::index_out_of_range);
                }
                builder.add_corner(vertex);
            }
            builder.end_face();
            if (face_colours && !skip_colour()) return false;
        }
        return ok();
    }

    bool skip_colour() {
        const std::uint32_t components = integer();
        if (components > 4) return fail(fmt::format("expected 0 to 4 colour components, found {}", components));
        if (!has(components, 4, "colour components")) return false;
        position_ += 4 * std::size_t{components};
        return ok();
    }

    std::string_view data_;
    const OffKind& kind_;
    std::size_t position_ = 0;
    std::uint32_t points_ = 0;
    std::string problem_;
    ErrorCode code_ = ErrorCode::file_format;
};

struct Attempt {
    bool fits = false;
    PolygonSoup soup;
    std::string problem;
    std::size_t position = 0;
    ErrorCode code = ErrorCode::file_format;
};

template <std::endian order, bool face_colours>
Attempt attempt(std::string_view data, const OffKind& kind) {
    BinaryOff<order, face_colours> reader(data, kind);
    SoupBuilder builder;
    const bool fits = reader.read(builder);
    builder.leave_out_face();
    return {fits, std::move(builder.soup), reader.problem(), reader.position(), reader.code()};
}

}  // namespace

void read_off_binary(Input& input, const OffKind& kind, SoupBuilder& builder) {
    const std::uint64_t base = input.offset();
    input.ensure(std::numeric_limits<std::size_t>::max());
    using enum std::endian;
    const std::array attempts{attempt<big, true>, attempt<little, false>, attempt<big, false>, attempt<little, true>};
    Attempt furthest;
    for (const auto& read : attempts) {
        Attempt result = read(input.view(), kind);
        if (result.fits || furthest.problem.empty() || result.position > furthest.position)
            furthest = std::move(result);
        if (furthest.fits) break;
    }
    builder.soup = std::move(furthest.soup);
    builder.end_triangles();
    // A quotient of floats need not be a float.
    builder.soup.stored = kind.homogeneous ? Precision::float64 : Precision::float32;
    if (furthest.fits) return;
    input.fail_at(base + furthest.position, furthest.problem, furthest.code);
}

}  // namespace delmesh::io
