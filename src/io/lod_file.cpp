#include "delmesh/io/lod_file.hpp"

#include "io/input.hpp"
#include "io/output_file.hpp"

#include <string_view>
#include <vector>

namespace delmesh {

ProgressiveMesh read_lod(const std::filesystem::path& path) {
    io::FileSource source(path);
    io::Input input(source, path.string());
    std::vector<std::byte> bytes;
    while (input.ensure(1) > 0) {
        const auto view = std::as_bytes(std::span(input.view()));
        bytes.insert(bytes.end(), view.begin(), view.end());
        input.skip(view.size());
    }
    return decode(bytes, input.name());
}

void write_lod(const std::filesystem::path& path, const ProgressiveMesh& progressive) {
    const std::vector<std::byte> bytes = encode(progressive);
    io::OutputFile file(path);
    file.text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    file.commit();
}

}  // namespace delmesh
