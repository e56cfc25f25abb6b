#include "delmesh/io/format.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace delmesh {

namespace {

struct NamedFormat {
    Format format;
    std::string_view name;
};

constexpr std::array formats{NamedFormat{Format::ply, "ply"},     NamedFormat{Format::obj, "obj"},
                             NamedFormat{Format::off, "off"},     NamedFormat{Format::stl, "stl"},
                             NamedFormat{Format::gltf, "gltf"},   NamedFormat{Format::gltf, "glb"},
                             NamedFormat{Format::three_mf, "3mf"}};

constexpr char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string_view name(Format format) {
    const auto* found = std::ranges::find(formats, format, &NamedFormat::format);
    return found == formats.end() ? std::string_view("unknown") : found->name;
}

bool can_write(Format format) {
    return format != Format::gltf && format != Format::three_mf;
}

std::optional<Format> format_from_name(std::string_view text) {
    if (text.starts_with('.')) text.remove_prefix(1);
    for (const NamedFormat& candidate : formats) {
        if (std::ranges::equal(text, candidate.name, {}, lower)) return candidate.format;
    }
    return std::nullopt;
}

std::optional<Format> format_from_path(const std::filesystem::path& path) {
    return format_from_name(path.extension().string());
}

}  // namespace delmesh
