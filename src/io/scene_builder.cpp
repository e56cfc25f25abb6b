#include "io/scene_builder.hpp"

#include "delmesh/base/error.hpp"
#include "io/soup_builder.hpp"

#include <fmt/format.h>
#include <utility>

namespace delmesh::io {

SceneBuilder::SceneBuilder(std::string name, std::uint64_t file_bytes) : name_(std::move(name)) {
    set_file_bytes(file_bytes);
}

void SceneBuilder::set_file_bytes(std::uint64_t file_bytes) {
    allowed_ = (std::uint64_t{1} << 22) + 64 * file_bytes;
}

void SceneBuilder::expect(std::uint64_t elements) {
    if (elements > left())
        throw Error(ErrorCode::file_format, name_ +
                                                ": expected a scene in proportion to its file, found one that repeats "
                                                "its meshes too often: save them one by one");
    taken_ += elements;
}

void SceneBuilder::add_mesh(std::span<const Vec3> points, std::span<const std::uint32_t> corners,
                            const Transform& transform) {
    const std::size_t base = soup_.points.size();
    if (base + points.size() >= most_points)
        throw Error(ErrorCode::too_large,
                    fmt::format("{}: expected fewer than {} points, found more", name_, most_points));
    const bool identity = transform.is_identity();
    for (const Vec3& p : points) soup_.points.push_back(identity ? p : transform(p));
    const bool mirrors = transform.mirrors();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        for (const std::size_t corner : {i, i + (mirrors ? 2 : 1), i + (mirrors ? 1 : 2)})
            soup_.corners.push_back(static_cast<std::uint32_t>(base + corners[corner]));
}

}  // namespace delmesh::io
