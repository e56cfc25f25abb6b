#pragma once
// Samples of a surface as it is, in the least room that they can be made from again.

#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace delmesh {

/// Of the first `count` vertices of a mesh and the middles of its faces, about `most`, evenly by index: vertices first.
class SampleSource {
public:
    SampleSource(const Mesh& mesh, std::size_t count, double scale, std::size_t most);

    /// The part of the surface that a sample stands for.
    struct Facing {
        std::array<float, 3> normal{};
        float weight = 0;  ///< area, local unit
    };

    [[nodiscard]] std::size_t size() const { return at_vertices_.size() + on_faces_.size(); }
    /// One of so many is taken.
    [[nodiscard]] std::size_t stride() const { return stride_; }
    [[nodiscard]] Vec3 point(std::size_t i) const;
    [[nodiscard]] Facing facing(std::size_t i) const;
    /// A vertex close to it.
    [[nodiscard]] VertexId near(std::size_t i) const;
    /// The face that it lies on. Only while the mesh is what it was.
    [[nodiscard]] FaceId face(const Mesh& mesh, std::size_t i) const;

private:
    struct AtVertex {
        VertexId vertex;
        Facing facing;
    };
    using Corners = std::array<VertexId, 3>;
    [[nodiscard]] const Corners& corners(std::size_t i) const { return on_faces_[i - at_vertices_.size()]; }
    [[nodiscard]] Vec3 place(VertexId v) const;
    void keep_places(const Mesh& mesh);

    double scale_;
    std::size_t stride_ = 1;
    std::vector<std::array<float, 3>> short_;  ///< places of the first vertices, as far as single precision holds them
    std::vector<Vec3> long_;                   ///< those of the others
    std::vector<AtVertex> at_vertices_;
    std::vector<Corners> on_faces_;
};

}  // namespace delmesh
