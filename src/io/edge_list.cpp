#include "delmesh/io/edge_list.hpp"

#include "io/byte_source.hpp"
#include "io/text_scanner.hpp"

#include <limits>

namespace delmesh {
namespace {

std::uint32_t read_vertex(io::TextScanner& scanner) {
    if (scanner.line_is_done()) scanner.fail_expected("two vertex numbers");
    const std::int64_t vertex = scanner.integer("a vertex number");
    if (vertex < 0 || vertex >= std::numeric_limits<std::uint32_t>::max())
        scanner.fail("expected vertex numbers from 0, found " + std::to_string(vertex));
    return static_cast<std::uint32_t>(vertex);
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> read_edge_list(const std::filesystem::path& path) {
    io::FileSource source(path);
    io::Input input(source, path.string());
    io::TextScanner scanner(input, {'#', false});
    std::vector<std::array<std::uint32_t, 2>> edges;
    while (scanner.next_line()) {
        if (scanner.line_is_done()) continue;
        const std::uint32_t a = read_vertex(scanner);
        const std::uint32_t b = read_vertex(scanner);
        if (!scanner.line_is_done()) scanner.fail_expected("the end of the line");
        edges.push_back({a, b});
    }
    return edges;
}

}  // namespace delmesh
