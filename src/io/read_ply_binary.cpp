#include "io/read_ply.hpp"

#include "io/endian.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace delmesh::io {

namespace {

/// Calls visitor(T{}) with the C++ type of a PLY type.
template <class Visitor>
decltype(auto) with_type(PlyType type, Visitor&& visit) {
    switch (type) {
        case PlyType::int8:
            return visit(std::int8_t{});
        case PlyType::uint8:
            return visit(std::uint8_t{});
        case PlyType::int16:
            return visit(std::int16_t{});
        case PlyType::uint16:
            return visit(std::uint16_t{});
        case PlyType::int32:
            return visit(std::int32_t{});
        case PlyType::uint32:
            return visit(std::uint32_t{});
        case PlyType::int64:
            return visit(std::int64_t{});
        case PlyType::uint64:
            return visit(std::uint64_t{});
        case PlyType::float32:
            return visit(float{});
        default:
            return visit(double{});
    }
}

template <std::endian order>
class BinaryBody {
public:
    BinaryBody(Input& input, const PlyHeader& header, SoupBuilder& builder)
        : input_(input),
          header_(header),
          builder_(builder) {}

    void read_vertices(const PlyElement& element) {
        std::vector<Vec3>& points = builder_.soup.points;
        points.reserve(input_.plausible(element.count, element.least_size(false)));
        const bool same_type =
            type_of(element, "x") == type_of(element, "y") && type_of(element, "x") == type_of(element, "z");
        if (element.has_lists() || !same_type) {
            read_any_vertices(element);
        } else {
            with_type(type_of(element, "x"), [&]<class T>(T) { read_plain_vertices<T>(element); });
        }
    }

    void read_faces(const PlyElement& element, std::size_t list) {
        const PlyProperty& indices = element.properties[list];
        builder_.soup.corners.reserve(input_.plausible(3 * element.count, size_of(indices.type)));
        const bool usual =
            element.properties.size() == 1 && size_of(indices.count_type) == 1 && size_of(indices.type) == 4;
        for (std::uint64_t f = 0; f < element.count;) {
            if (usual) f += read_plain_triangles(element.count - f);
            if (f == element.count) break;
            bool whole = true;
            for_record(element, f, list, [&](std::uint64_t vertex) {
                if (!is_index(element, f, vertex)) whole = false;
                builder_.add_corner(static_cast<std::uint32_t>(vertex));
            });
            whole ? builder_.end_face() : builder_.leave_out_face();
            ++f;
        }
    }

    void read_strips(const PlyElement& element, std::size_t list) {
        for (std::uint64_t s = 0; s < element.count; ++s) {
            StripBuilder strip(builder_);
            for_record(element, s, list, [&](std::uint64_t vertex) {
                if (vertex == separator) {
                    strip.restart();
                    return;
                }
                if (is_index(element, s, vertex)) {
                    strip.add(static_cast<std::uint32_t>(vertex));
                } else {
                    strip.restart();
                }
            });
        }
    }

    void skip_records(const PlyElement& element) {
        if (!element.has_lists()) {
            const std::size_t stride = element.least_size(false);
            const bool overflows = element.count > std::numeric_limits<std::uint64_t>::max() / stride;
            if (overflows || !input_.skip_far(element.count * stride)) fail_truncated(element, element.count);
            return;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for_record(element, i, element.properties.size(), [](std::uint64_t) {});
        }
    }

private:
    static PlyType type_of(const PlyElement& element, const char* property) {
        return element.properties[element.find(property)].type;
    }

    static std::size_t offset_of(const PlyElement& element, const char* property) {
        std::size_t offset = 0;
        for (std::size_t i = 0; i < element.find(property); ++i) offset += size_of(element.properties[i].type);
        return offset;
    }

    /// All records have one size, and the coordinates one type.
    template <class T>
    void read_plain_vertices(const PlyElement& element) {
        std::vector<Vec3>& points = builder_.soup.points;
        const std::size_t stride = element.least_size(false);
        const std::size_t x = offset_of(element, "x");
        const std::size_t y = offset_of(element, "y");
        const std::size_t z = offset_of(element, "z");
        for (std::uint64_t done = 0; done < element.count;) {
            const std::uint64_t here = std::min<std::uint64_t>(input_.ensure(stride) / stride, element.count - done);
            if (here == 0) fail_truncated(element, done);
            const char* record = input_.begin();
            for (std::uint64_t i = 0; i < here; ++i, record += stride) {
                points.push_back({number<T>(record + x), number<T>(record + y), number<T>(record + z)});
            }
            input_.skip(here * stride);
            done += here;
        }
    }

    void read_any_vertices(const PlyElement& element) {
        std::vector<int> axis_of(element.properties.size(), -1);
        for (const int axis : {0, 1, 2}) axis_of[element.find(std::string(1, "xyz"[axis]))] = axis;
        for (std::uint64_t v = 0; v < element.count; ++v) {
            Vec3 point;
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (axis_of[i] < 0) {
                    skip_property(element, v, property);
                    continue;
                }
                need(element, v, size_of(property.type));
                point[axis_of[i]] = with_type(property.type, [&]<class T>(T) { return number<T>(input_.begin()); });
                input_.skip(size_of(property.type));
            }
            builder_.soup.points.push_back(point);
        }
    }

    template <class T>
    static double number(const char* from) {
        return static_cast<double>(load<T, order>(from));
    }

    /// Reads triangles of the type "list uchar int" as far as they are in the window, and says how many.
    std::uint64_t read_plain_triangles(std::uint64_t most) {
        constexpr std::size_t size = 13;
        const char* const first = input_.begin();
        const char* const last = first + std::min<std::uint64_t>(input_.available() / size, most) * size;
        const char* record = first;
        for (; record != last && *record == 3; record += size) {
            const auto a = load<std::uint32_t, order>(record + 1);
            const auto b = load<std::uint32_t, order>(record + 5);
            const auto c = load<std::uint32_t, order>(record + 9);
            if (std::max({a, b, c}) >= header_.points) break;
            builder_.add_triangle(a, b, c);
        }
        input_.skip(static_cast<std::size_t>(record - first));
        return static_cast<std::uint64_t>(record - first) / size;
    }

    /// False, or an error, if there is no such vertex.
    bool is_index(const PlyElement& element, std::uint64_t record, std::uint64_t vertex) {
        if (vertex < header_.points) return true;
        return builder_.salvage.attempt([&] {
            input_.fail_at(input_.offset(),
                           fmt::format("expected a vertex index below {} in {} {}, found {}", header_.points,
                                       element.shown_name(), record, static_cast<std::int64_t>(vertex)),
                           ErrorCode::index_out_of_range);
        });
    }

    // --- records ---
    /// Goes through a record; calls visit(index) for the values of its property `list`. A negative value is given as
    /// the 64 bits it has as a signed number; the largest value of an unsigned type counts as -1.
    template <class Visitor>
    void for_record(const PlyElement& element, std::uint64_t record, std::size_t list, Visitor&& visit) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i != list) {
                skip_property(element, record, property);
                continue;
            }
            const std::uint64_t count = read_count(element, record, property);
            with_type(property.type, [&]<class T>(T) { for_values<T>(element, record, count, visit); });
        }
    }

    template <class T, class Visitor>
    void for_values(const PlyElement& element, std::uint64_t record, std::uint64_t count, Visitor&& visit) {
        if constexpr (std::is_integral_v<T>) {
            while (count > 0) {
                const std::uint64_t here = std::min<std::uint64_t>(input_.ensure(sizeof(T)) / sizeof(T), count);
                if (here == 0) fail_truncated(element, record);
                for (std::uint64_t i = 0; i < here; ++i) {
                    const T value = load<T, order>(input_.begin());
                    const bool is_separator = std::is_unsigned_v<T> && value == std::numeric_limits<T>::max();
                    visit(is_separator ? separator : static_cast<std::uint64_t>(value));
                    input_.skip(sizeof(T));
                }
                count -= here;
            }
        }
    }

    std::uint64_t read_count(const PlyElement& element, std::uint64_t record, const PlyProperty& property) {
        need(element, record, size_of(property.count_type));
        const auto count = with_type(property.count_type, [&]<class T>(T) -> std::int64_t {
            return static_cast<std::int64_t>(load<T, order>(input_.begin()));
        });
        if (count < 0) {
            input_.fail(fmt::format("expected the length of a list in {} {} of {}, found {}", element.shown_name(),
                                    record, element.count, count));
        }
        input_.skip(size_of(property.count_type));
        check_length(element, record, static_cast<std::uint64_t>(count), size_of(property.type));
        return static_cast<std::uint64_t>(count);
    }

    void check_length(const PlyElement& element, std::uint64_t record, std::uint64_t count, std::size_t size) {
        const auto left = input_.remaining();
        if (!left || count <= *left / size) return;
        input_.fail(fmt::format("expected {} values in a list of {} {} of {}, found {} before the end of the file",
                                count, element.shown_name(), record, element.count, *left / size));
    }

    void skip_property(const PlyElement& element, std::uint64_t record, const PlyProperty& property) {
        const std::uint64_t count = property.is_list ? read_count(element, record, property) : 1;
        const bool overflows = count > std::numeric_limits<std::uint64_t>::max() / size_of(property.type);
        if (overflows || !input_.skip_far(count * size_of(property.type))) fail_truncated(element, record);
    }

    void need(const PlyElement& element, std::uint64_t record, std::size_t bytes) {
        if (input_.ensure(bytes) < bytes) fail_truncated(element, record);
    }

    [[noreturn]] void fail_truncated(const PlyElement& element, std::uint64_t record) {
        input_.fail_at(input_.offset() + input_.available(),
                       fmt::format("expected {} {} of {}, found the end of the file", element.shown_name(), record,
                                   element.count));
    }

    static constexpr std::uint64_t separator = ~std::uint64_t{0};

    Input& input_;
    const PlyHeader& header_;
    SoupBuilder& builder_;
};

}  // namespace

void read_ply_binary(Input& input, const PlyHeader& header, SoupBuilder& builder) {
    if (header.encoding == PlyEncoding::big_endian) {
        BinaryBody<std::endian::big> body(input, header, builder);
        read_elements(header, body);
    } else {
        BinaryBody<std::endian::little> body(input, header, builder);
        read_elements(header, body);
    }
}

}  // namespace delmesh::io
