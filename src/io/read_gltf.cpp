#include "io/gltf_accessor.hpp"
#include "io/gltf_draco.hpp"
#include "io/gltf_file.hpp"
#include "io/point_index.hpp"
#include "io/readers.hpp"
#include "io/scene_builder.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace delmesh::io {

namespace {

/// Of a unit quaternion x, y, z, w.
Transform rotation(const std::vector<double>& q) {
    const double x = q[0];
    const double y = q[1];
    const double z = q[2];
    const double w = q[3];
    return {{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
             Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
             Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, Vec3{0, 0, 0}}};
}

/// How the corners of a primitive follow one another.
enum class Primitive { triangles, strip, fan, other };

Primitive primitive_of(std::uint64_t mode) {
    constexpr std::uint64_t first = 4;
    constexpr std::array known{Primitive::triangles, Primitive::strip, Primitive::fan};
    return mode >= first && mode < first + known.size() ? known[mode - first] : Primitive::other;
}

class GltfReader {
public:
    explicit GltfReader(GltfFile& file) : file_(file), scene_(file.name(), file.size()) {}

    PolygonSoup read() {
        scene_.soup().stored = Precision::float32;
        visited_.resize(file_.list(file_.root(), "nodes").size(), false);
        for (const std::uint64_t root : roots()) pending_.push_back({root, Transform()});
        std::ranges::reverse(pending_);
        while (!pending_.empty()) {
            const Pending next = pending_.back();
            pending_.pop_back();
            visit(next.node, next.above);
        }
        if (visited_.empty())
            for (const Json& mesh : file_.list(file_.root(), "meshes")) add_mesh(mesh, Transform());
        return std::move(scene_.soup());
    }

private:
    struct Pending {
        std::uint64_t node;
        Transform above;
    };

    /// The nodes of the scene that is to be shown; without scenes, all nodes that are nobody's child.
    std::vector<std::uint64_t> roots() {
        std::vector<std::uint64_t> result;
        if (!file_.list(file_.root(), "scenes").empty()) {
            const Json& scene = file_.element("scenes", file_.find_number(file_.root(), "scene").value_or(0));
            for (const Json& node : file_.list(scene, "nodes")) result.push_back(file_.whole_number(node, "nodes"));
            return result;
        }
        std::vector<bool> is_child(visited_.size(), false);
        for (const Json& node : file_.list(file_.root(), "nodes"))
            for (const Json& child : file_.list(node, "children")) {
                const std::uint64_t number = file_.whole_number(child, "children");
                if (number < is_child.size()) is_child[number] = true;
            }
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) result.push_back(i);
        if (result.empty() && !is_child.empty())
            file_.fail("expected a tree of glTF nodes, found only circles of them");
        return result;
    }

    void visit(std::uint64_t number, const Transform& above) {
        const Json& node = file_.element("nodes", number);
        if (visited_[number]) file_.fail(fmt::format("expected a tree of glTF nodes, found node {} twice", number));
        visited_[number] = true;
        const Transform transform = above * transform_of(node);
        if (const auto mesh = file_.find_number(node, "mesh")) add_mesh(file_.element("meshes", *mesh), transform);
        const Json::List& children = file_.list(node, "children");
        for (std::size_t i = children.size(); i-- > 0;)
            pending_.push_back({file_.whole_number(children[i], "children"), transform});
    }

    [[nodiscard]] Transform transform_of(const Json& node) const {
        Transform result;
        const std::vector<double> matrix = file_.reals(node, "matrix", 16);
        if (!matrix.empty()) {
            for (std::size_t c = 0; c < 4; ++c)
                result.columns[c] = {matrix[4 * c], matrix[4 * c + 1], matrix[4 * c + 2]};
            return result;
        }
        const std::vector<double> quaternion = file_.reals(node, "rotation", 4);
        if (!quaternion.empty()) result = rotation(quaternion);
        const std::vector<double> scale = file_.reals(node, "scale", 3);
        for (std::size_t c = 0; c < scale.size(); ++c) result.columns[c] = result.columns[c] * scale[c];
        const std::vector<double> shift = file_.reals(node, "translation", 3);
        if (!shift.empty()) result.columns[3] = {shift[0], shift[1], shift[2]};
        return result;
    }

    /// Vertices of one mesh that differ in normals or texture coordinates only are one.
    void add_mesh(const Json& mesh, const Transform& transform) {
        points_.clear();
        corners_.clear();
        PointIndex index(points_);
        for (const Json& primitive : file_.list(mesh, "primitives")) add_primitive(primitive, index);
        scene_.add_mesh(points_, corners_, transform);
    }

    void add_primitive(const Json& primitive, PointIndex& index) {
        const Primitive kind = primitive_of(file_.find_number(primitive, "mode").value_or(4));
        const Json* const attributes = primitive.find("attributes");
        if (kind == Primitive::other || attributes == nullptr) return;
        const auto position = file_.find_number(*attributes, "POSITION");
        if (!position) return;
        if (const Json* const draco = draco_of(primitive, *position))
            return add_draco(*draco, primitive, *position, index);
        const GltfPositions positions(file_, *position);
        if (const auto indices = file_.find_number(primitive, "indices")) {
            const GltfIndices numbers(file_, *indices);
            add_corners(kind, numbers.size(), index, [&](std::uint64_t i) {
                const std::uint32_t number = numbers[i];
                if (number >= positions.size())
                    file_.fail(fmt::format("expected a glTF vertex index below {}, found {}", positions.size(), number),
                               ErrorCode::index_out_of_range);
                return positions[number];
            });
        } else {
            add_corners(kind, positions.size(), index, [&](std::uint64_t i) { return positions[i]; });
        }
    }

    /// What is packed by Draco, unless its positions are there without.
    const Json* draco_of(const Json& primitive, std::uint64_t position) const {
        const Json* const extension = file_.extension(primitive, draco_extension);
        if (extension == nullptr || file_.is_required(draco_extension)) return extension;
        const Json& accessor = file_.element("accessors", position);
        return accessor.find("bufferView") == nullptr && accessor.find("sparse") == nullptr ? extension : nullptr;
    }

    void add_draco(const Json& extension, const Json& primitive, std::uint64_t position, PointIndex& index) {
        // A mesh may stand in many places.
        const auto [found, is_new] = unpacked_.try_emplace(&primitive);
        DracoMesh& mesh = found->second;
        if (is_new) mesh = decode_draco(file_, primitive, extension, scene_);
        const GltfPositions positions(file_, position, mesh.positions);
        add_corners(Primitive::triangles, mesh.corners.size(), index,
                    [&](std::uint64_t i) { return positions[mesh.corners[i]]; });
    }

    template <class PointAt>
    void add_corners(Primitive kind, std::uint64_t count, PointIndex& index, PointAt&& point_at) {
        scene_.set_file_bytes(file_.size());
        // A strip or fan has a triangle for each corner.
        scene_.expect(kind == Primitive::triangles ? count : 3 * count);
        const auto add = [&](std::uint64_t i) { corners_.push_back(index.add(point_at(i))); };
        const std::uint64_t step = kind == Primitive::triangles ? 3 : 1;
        for (std::uint64_t i = 0; i + 2 < count; i += step) {
            const std::uint64_t odd = kind == Primitive::strip ? i % 2 : 0;
            add(kind == Primitive::fan ? 0 : i);
            add(i + 1 + odd);
            add(i + 2 - odd);
        }
    }

    GltfFile& file_;
    SceneBuilder scene_;
    std::vector<Pending> pending_;
    std::vector<bool> visited_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> corners_;
    std::map<const Json*, DracoMesh> unpacked_;  ///< by primitive
};

}  // namespace

PolygonSoup read_gltf(Input& input, const std::filesystem::path& folder) {
    GltfFile file(input, folder);
    return GltfReader(file).read();
}

}  // namespace delmesh::io
