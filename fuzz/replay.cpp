// Runs a fuzz target over its seeds, over changed seeds, and over the files of a folder of findings.
//     replay_NAME COUNT [FOLDER]    COUNT: of changed seeds
//     replay_NAME --write-seeds FOLDER

#include "target.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace {

void run(const std::string& input) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// splitmix64: the same numbers everywhere.
std::uint64_t random_bits() {
    static std::uint64_t state = 1;
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

std::string changed(std::string text) {
    for (std::uint64_t i = 1 + random_bits() % 6; i > 0 && !text.empty(); --i) {
        const std::size_t at = random_bits() % text.size();
        switch (random_bits() % 4) {
            case 0:
                text.insert(at, 1, static_cast<char>(random_bits()));
                break;
            case 1:
                text.erase(at, 1);
                break;
            case 2:
                text += text.substr(at, 8);
                break;
            default:
                text[at] = static_cast<char>(random_bits());
        }
    }
    return text;
}

/// In the order of their names.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

int write_seeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const std::string& seed : delmesh::fuzz::seeds())
        std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string_view(argv[1]) == "--write-seeds") return write_seeds(argv[2]);
    const int changed_seeds = argc > 1 ? std::atoi(argv[1]) : 0;
    if (changed_seeds <= 0) {
        std::fprintf(stderr, "usage: %s COUNT [FOLDER]\n", argv[0]);
        return 2;
    }
    const std::vector<std::string> seeds = delmesh::fuzz::seeds();
    std::ranges::for_each(seeds, run);
    for (int i = 0; i < changed_seeds; ++i) run(changed(seeds[static_cast<std::size_t>(i) % seeds.size()]));
    for (const auto& file : argc == 3 ? files_in(argv[2]) : std::vector<std::filesystem::path>()) {
        std::printf("%s\n", file.c_str());
        std::fflush(stdout);
        std::ifstream bytes(file, std::ios::binary);
        run(std::string(std::istreambuf_iterator<char>(bytes), {}));
    }
}
