#include "io/ply_header.hpp"

#include "io/soup_builder.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

namespace delmesh::io {

namespace {

struct NamedType {
    std::string_view name;
    PlyType type;
};

constexpr std::array type_names{
    NamedType{"char", PlyType::int8},      NamedType{"int8", PlyType::int8},
    NamedType{"uchar", PlyType::uint8},    NamedType{"uint8", PlyType::uint8},
    NamedType{"short", PlyType::int16},    NamedType{"int16", PlyType::int16},
    NamedType{"ushort", PlyType::uint16},  NamedType{"uint16", PlyType::uint16},
    NamedType{"int", PlyType::int32},      NamedType{"int32", PlyType::int32},
    NamedType{"uint", PlyType::uint32},    NamedType{"uint32", PlyType::uint32},
    NamedType{"int64", PlyType::int64},    NamedType{"uint64", PlyType::uint64},
    NamedType{"float", PlyType::float32},  NamedType{"float32", PlyType::float32},
    NamedType{"double", PlyType::float64}, NamedType{"float64", PlyType::float64},
};

PlyType read_type(TextScanner& scanner, bool integer_only = false) {
    const TextScanner at_word = scanner;
    const std::string_view word = scanner.word();
    const auto* found = std::ranges::find(type_names, word, &NamedType::name);
    if (found == type_names.end() || (integer_only && !is_integer(found->type))) {
        at_word.fail_expected(integer_only ? "an integer type" : "a type");
    }
    return found->type;
}

std::string read_name(TextScanner& scanner) {
    std::string name(scanner.word());
    if (name.empty()) scanner.fail_expected("a name");
    return name;
}

PlyEncoding read_encoding(TextScanner& scanner) {
    const TextScanner at_word = scanner;
    const std::string_view word = scanner.word();
    const std::string_view version = scanner.word();
    if (version != "1.0") at_word.fail("expected format version 1.0, found " + quote(version));
    if (word == "ascii") return PlyEncoding::ascii;
    if (word == "binary_little_endian") return PlyEncoding::little_endian;
    if (word == "binary_big_endian") return PlyEncoding::big_endian;
    at_word.fail_expected("ascii, binary_little_endian or binary_big_endian");
}

PlyElement read_element(TextScanner& scanner) {
    PlyElement element;
    element.name = read_name(scanner);
    const TextScanner at_count = scanner;
    const std::int64_t count = scanner.integer("a count");
    if (count < 0) at_count.fail_expected("a count");
    element.count = static_cast<std::uint64_t>(count);
    return element;
}

PlyProperty read_property(TextScanner& scanner) {
    PlyProperty property;
    TextScanner ahead = scanner;
    property.is_list = ahead.word() == "list";
    if (property.is_list) {
        scanner = ahead;
        property.count_type = read_type(scanner, true);
    }
    property.type = read_type(scanner);
    property.name = read_name(scanner);
    return property;
}

/// "vertex_indices" or "vertex_index"; where neither is there, the only list of integers.
std::size_t find_index_list(const PlyElement& element) {
    const std::size_t none = element.properties.size();
    std::size_t only = none;
    std::size_t lists = 0;
    for (std::size_t i = 0; i < none; ++i) {
        const PlyProperty& property = element.properties[i];
        if (!property.is_list || !is_integer(property.type)) continue;
        if (property.name == "vertex_indices" || property.name == "vertex_index") return i;
        only = i;
        ++lists;
    }
    return lists == 1 ? only : none;
}

void check_vertices(const TextScanner& scanner, const PlyElement& element) {
    for (const char* axis : {"x", "y", "z"}) {
        const std::size_t i = element.find(axis);
        if (i == element.properties.size() || element.properties[i].is_list) {
            scanner.fail(fmt::format("expected the vertices to have the properties x, y and z, found no {}", axis));
        }
    }
    if (element.count >= most_points) {
        scanner.fail_at(scanner.line(),
                        fmt::format("expected fewer than {} vertices, found {}", most_points, element.count),
                        ErrorCode::too_large);
    }
}

void understand(const TextScanner& scanner, PlyHeader& header) {
    bool has_vertices = false;
    for (const PlyElement& element : header.elements) {
        std::size_t list = element.properties.size();
        if (PlyHeader::is_vertex(element)) {
            if (has_vertices) scanner.fail("expected one vertex element, found two");
            has_vertices = true;
            check_vertices(scanner, element);
            header.points = element.count;
        } else if (PlyHeader::is_face(element) || PlyHeader::is_strips(element)) {
            list = find_index_list(element);
            if (list == element.properties.size() && element.count > 0) {
                scanner.fail("expected a list of integers 'vertex_indices' in element " + quote(element.name) +
                             ", found none");
            }
        }
        header.index_list.push_back(list);
    }
    if (!has_vertices) scanner.fail("expected an element 'vertex' in the header, found none");
}

}  // namespace

std::size_t size_of(PlyType type) {
    constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

bool fits_float(PlyType type) {
    return type == PlyType::float32 || (is_integer(type) && size_of(type) <= 2);
}

std::string PlyElement::shown_name() const {
    constexpr std::size_t longest = 40;
    return printable(std::string_view(name).substr(0, longest));
}

std::size_t PlyElement::find(std::string_view property) const {
    return static_cast<std::size_t>(std::ranges::find(properties, property, &PlyProperty::name) - properties.begin());
}

std::size_t PlyElement::least_size(bool ascii) const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties) {
        size += ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
    }
    return size;
}

bool PlyElement::has_lists() const {
    return std::ranges::any_of(properties, &PlyProperty::is_list);
}

PlyHeader read_ply_header(TextScanner& scanner) {
    PlyHeader header;
    bool has_format = false;
    if (!scanner.next_line() || scanner.word() != "ply") scanner.fail("expected 'ply' at the start of the file");
    for (;;) {
        if (!scanner.next_line()) scanner.fail_expected("'end_header'");
        const TextScanner at_keyword = scanner;
        const std::string_view keyword = scanner.word();
        if (keyword == "format") {
            header.encoding = read_encoding(scanner);
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(read_element(scanner));
        } else if (keyword == "property") {
            if (header.elements.empty()) at_keyword.fail("expected an element before its properties");
            header.elements.back().properties.push_back(read_property(scanner));
        } else if (keyword == "end_header") {
            break;
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            at_keyword.fail_expected("a keyword of a PLY header");
        }
    }
    if (!has_format) scanner.fail("expected a line 'format ...' in the header, found none");
    understand(scanner, header);
    return header;
}

}  // namespace delmesh::io
