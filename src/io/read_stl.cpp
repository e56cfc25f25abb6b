#include "io/endian.hpp"
#include "io/point_index.hpp"
#include "io/readers.hpp"
#include "io/soup_builder.hpp"
#include "io/text_scanner.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace delmesh::io {

namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t facet_bytes = 50;

Vec3 load_point(const char* from) {
    constexpr auto order = std::endian::little;
    return {load<float, order>(from), load<float, order>(from + 4), load<float, order>(from + 8)};
}

std::uint64_t read_facet_count(Input& input, Salvage& salvage) {
    if (input.ensure(header_bytes + 4) < header_bytes + 4) {
        input.fail_at(
            input.offset() + input.available(),
            "expected 80 bytes of header and the number of facets of a binary STL file, found the end of the file");
    }
    input.skip(header_bytes);
    const std::uint64_t count = load<std::uint32_t, std::endian::little>(input.begin());
    const auto left = input.remaining();
    const std::uint64_t held = left ? std::min(count, (*left - 4) / facet_bytes) : count;
    salvage.attempt([&] {
        if (held == count) return;
        input.fail(
            fmt::format("expected the number of facets that follow, found {}, but the file holds {}", count, held));
    });
    input.skip(4);
    return held;
}

/// 50 bytes a facet: normal, three points, two bytes that some writers use for colours.
void read_binary(Input& input, SoupBuilder& builder) {
    const std::uint64_t count = read_facet_count(input, builder.salvage);
    PolygonSoup& soup = builder.soup;
    soup.stored = Precision::float32;
    soup.corners.reserve(3 * input.plausible(count, facet_bytes));
    PointIndex index(soup.points, input.plausible(count, facet_bytes) / 2 + 2);  // as in a closed surface
    std::vector<Vec3> corners;
    for (std::uint64_t done = 0; done < count;) {
        constexpr std::uint64_t batch = 16;
        const std::uint64_t available = input.ensure(facet_bytes) / facet_bytes;
        const std::uint64_t here = std::min({available, count - done, batch});
        if (here == 0) {
            input.fail_at(input.offset() + input.available(),
                          fmt::format("expected facet {} of {}, found the end of the file", done, count));
        }
        if (soup.points.size() + 3 * here >= most_points) {
            input.fail_at(input.offset(), fmt::format("expected fewer than {} points, found more", most_points),
                          ErrorCode::too_large);
        }
        corners.clear();
        for (const char* facet = input.begin(); corners.size() < 3 * here; facet += facet_bytes) {
            for (const std::size_t at : {12, 24, 36}) corners.push_back(load_point(facet + at));
        }
        index.add(corners, soup.corners);
        builder.end_triangles();
        input.skip(here * facet_bytes);
        done += here;
    }
}

bool is_word(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, {}, [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
}

/// solid NAME { facet normal N N N  outer loop { vertex X Y Z } endloop endfacet } endsolid NAME, any number of times.
class AsciiStlReader {
public:
    AsciiStlReader(Input& input, SoupBuilder& builder)
        : scanner_(input, {}),
          builder_(builder),
          index_(builder_.soup.points) {}

    void read() {
        bool in_solid = false;
        bool lost = false;  // in the rest of a facet that could not be read
        while (find_word()) {
            const TextScanner at_word = scanner_;
            const std::string_view word = scanner_.word();
            if (is_word(word, "facet") && in_solid) {
                lost = !builder_.salvage.attempt([this] { read_facet(); });
                if (lost) builder_.leave_out_face();
                continue;
            }
            const bool ends = is_word(word, "endsolid");
            if (ends || is_word(word, "solid") || is_word(word, "color")) {
                in_solid = !ends;
                lost = false;
            } else if (!lost) {
                lost = !builder_.salvage.attempt(
                    [&] { at_word.fail_expected(in_solid ? "'facet' or 'endsolid'" : "'solid'"); });
            }
            scanner_.skip_line();  // a name
        }
        if (in_solid) scanner_.fail_expected("'facet' or 'endsolid'");
    }

private:
    bool find_word() {
        while (scanner_.line_is_done()) {
            if (!scanner_.next_line()) return false;
        }
        return true;
    }

    /// The normal is not used: it follows from the vertices, and is often wrong.
    void read_facet() {
        TextScanner ahead = scanner_;
        for (; !ahead.line_is_done() && !is_word(ahead.word(), "outer"); scanner_ = ahead) {
        }
        need("outer", "'outer loop'");
        need("loop", "'outer loop'");
        for (;;) {
            scanner_.need_word("'vertex' or 'endloop'");
            const TextScanner at_word = scanner_;
            const std::string_view word = scanner_.word();
            if (is_word(word, "endloop")) break;
            if (!is_word(word, "vertex")) at_word.fail_expected("'vertex' or 'endloop'");
            read_vertex();
        }
        if (builder_.open_corners() < 3) {
            scanner_.fail(fmt::format("expected a facet of three vertices, found {}", builder_.open_corners()));
        }
        need("endfacet", "'endfacet'");
        builder_.end_face();
    }

    void read_vertex() {
        Vec3 point;
        for (const int axis : {0, 1, 2}) point[axis] = scanner_.number("a coordinate");
        if (builder_.soup.points.size() == most_points - 1) {
            scanner_.fail_at(scanner_.line(), fmt::format("expected fewer than {} points, found more", most_points),
                             ErrorCode::too_large);
        }
        builder_.add_corner(index_.add(point));
    }

    void need(std::string_view keyword, std::string_view expected) {
        scanner_.need_word(expected);
        const TextScanner at_word = scanner_;
        if (!is_word(scanner_.word(), keyword)) at_word.fail_expected(expected);
    }

    TextScanner scanner_;
    SoupBuilder& builder_;
    PointIndex index_;
};

}  // namespace

void read_stl(Input& input, SoupBuilder& builder) {
    if (is_binary_stl(input)) return read_binary(input, builder);
    AsciiStlReader(input, builder).read();
}

}  // namespace delmesh::io
