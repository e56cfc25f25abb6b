#include "io/read_ply.hpp"

#include "delmesh/mesh/rounding.hpp"

#include <fmt/format.h>
#include <cmath>

namespace delmesh::io {

namespace {

/// One record stands on one line; one that goes on over several is accepted, and what is left on a line behind a
/// record is not looked at (there are writers whose header is wrong about the colours of faces).
class AsciiBody {
public:
    AsciiBody(TextScanner& scanner, Input& input, const PlyHeader& header, SoupBuilder& builder)
        : scanner_(scanner),
          input_(input),
          header_(header),
          builder_(builder) {}

    void read_vertices(const PlyElement& element) {
        std::vector<Vec3>& points = builder_.soup.points;
        points.reserve(input_.plausible(element.count, element.least_size(true)));
        std::vector<int> axis_of(element.properties.size(), -1);
        for (const int axis : {0, 1, 2}) axis_of[element.find(std::string(1, "xyz"[axis]))] = axis;
        for (std::uint64_t v = 0; v < element.count; ++v) {
            begin_record(element, v);
            const bool whole = builder_.salvage.attempt([&] { points.push_back(read_point(element, axis_of)); });
            if (!whole) builder_.add_missing_point();
        }
    }

    Vec3 read_point(const PlyElement& element, const std::vector<int>& axis_of) {
        Vec3 point;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (axis_of[i] >= 0) {
                point[axis_of[i]] = read_coordinate(element.properties[i].type);
            } else {
                skip_property(element.properties[i]);
            }
        }
        return point;
    }

    /// A property of 32 bits holds floats, also where it is written with more digits.
    double read_coordinate(PlyType type) {
        scanner_.need_word("a coordinate");
        const double value = scanner_.number("a coordinate");
        if (type != PlyType::float32) return value;
        constexpr double overflow = 0x1.ffffffp+127;
        if (std::isfinite(value) && std::fabs(value) >= overflow) {
            scanner_.fail(fmt::format("expected a coordinate of type float, found {}, which is too large", value));
        }
        return round_to_float(value);
    }

    void read_faces(const PlyElement& element, std::size_t list) {
        builder_.soup.corners.reserve(input_.plausible(3 * element.count, 2));
        for (std::uint64_t f = 0; f < element.count; ++f) {
            begin_record(element, f);
            if (!builder_.salvage.attempt([&] { read_face(element, list); })) builder_.leave_out_face();
        }
    }

    void read_face(const PlyElement& element, std::size_t list) {
        for_record(element, list, [&] {
            const std::int64_t vertex = read_index();
            if (vertex < 0) fail_index(vertex);
            builder_.add_corner(static_cast<std::uint32_t>(vertex));
        });
        builder_.end_face();
    }

    void read_strips(const PlyElement& element, std::size_t list) {
        for (std::uint64_t s = 0; s < element.count; ++s) {
            begin_record(element, s);
            builder_.salvage.attempt([&] { read_strip(element, list); });
        }
    }

    void read_strip(const PlyElement& element, std::size_t list) {
        StripBuilder strip(builder_);
        for_record(element, list, [&] {
            const std::int64_t vertex = read_index();
            if (vertex < 0) {
                strip.restart();
            } else {
                strip.add(static_cast<std::uint32_t>(vertex));
            }
        });
    }

    void skip_records(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            begin_record(element, i);
            for_record(element, element.properties.size(), [] {});
        }
    }

private:
    void begin_record(const PlyElement& element, std::uint64_t index) {
        do {
            if (!scanner_.next_line()) {
                scanner_.fail(fmt::format("expected {} {} of {}, found the end of the file", element.shown_name(),
                                          index, element.count));
            }
        } while (scanner_.line_is_done());
    }

    template <class ReadIndex>
    void for_record(const PlyElement& element, std::size_t list, ReadIndex&& read_one) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (i != list) {
                skip_property(element.properties[i]);
                continue;
            }
            for (std::uint64_t n = read_count(); n > 0; --n) read_one();
        }
    }

    std::uint64_t read_count() {
        scanner_.need_word("the length of a list");
        const std::int64_t count = scanner_.integer("the length of a list");
        if (count < 0) scanner_.fail(fmt::format("expected the length of a list, found {}", count));
        return static_cast<std::uint64_t>(count);
    }

    std::int64_t read_index() {
        scanner_.need_word("a vertex index");
        const std::int64_t vertex = scanner_.integer("a vertex index");
        if (vertex >= static_cast<std::int64_t>(header_.points)) fail_index(vertex);
        return vertex;
    }

    [[noreturn]] void fail_index(std::int64_t vertex) {
        scanner_.fail_at(scanner_.line(),
                         fmt::format("expected a vertex index below {}, found {}", header_.points, vertex),
                         ErrorCode::index_out_of_range);
    }

    void skip_property(const PlyProperty& property) {
        for (std::uint64_t n = property.is_list ? read_count() : 1; n > 0; --n) {
            scanner_.need_word("a value");
            scanner_.word();
        }
    }

    TextScanner& scanner_;
    Input& input_;
    const PlyHeader& header_;
    SoupBuilder& builder_;
};

}  // namespace

void read_ply_ascii(TextScanner& scanner, Input& input, const PlyHeader& header, SoupBuilder& builder) {
    AsciiBody body(scanner, input, header, builder);
    read_elements(header, body);
}

}  // namespace delmesh::io
