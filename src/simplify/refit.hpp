#pragma once
// Moves the vertices of a decimated mesh closer to samples of the original surface, edge by edge Delaunay as before.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "simplify/placement.hpp"
#include "simplify/star.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delmesh {

struct RefitTuning {
    int rounds = 3;
    double regular = 1e-3;     ///< pull to the place before, relative to the trace
    double density = 12;       ///< so many samples for each vertex ...
    double samples = 30000;    ///< ... and so many more are used, as far as there are
    double least_gain = 0.01;  ///< a move must lower the error by this part
};

class Refitter {
public:
    /// Samples the first `count` vertices of the mesh as it is now.
    Refitter(const Mesh& mesh, std::size_t count, double scale);

    /// `merged_into[v]` is where v went (v itself for a live vertex). `settle` rounds a place to what can be stored;
    /// `moved` is told of each vertex before it moves. Returns the number of moves.
    std::size_t run(Mesh& mesh, std::span<const VertexId> merged_into, Placer& placer, const RefitTuning& tuning,
                    const std::function<Vec3(const Vec3&)>& settle,
                    const std::function<void(VertexId, const Vec3&)>& moved, const Context* context);

private:
    struct Sample {
        Vec3 point;
        Vec3 normal;
        double weight = 0;
        VertexId near;    ///< a corner of `face`
        HalfedgeId face;  ///< the half-edge `weights` starts at
        std::array<double, 3> weights{};
        double distance2 = 0;
    };

    void choose(std::size_t most);
    void project(const Mesh& mesh, Sample& sample) const;
    void sort_by_face(const Mesh& mesh);
    bool refit_vertex(Mesh& mesh, VertexId v, Placer& placer, const RefitTuning& tuning,
                      const std::function<Vec3(const Vec3&)>& settle,
                      const std::function<void(VertexId, const Vec3&)>& moved);
    [[nodiscard]] bool build_cost(const Mesh& mesh, VertexId v, const RefitTuning& tuning, EdgeCost& cost);
    [[nodiscard]] double error_around(const Vec3& centre) const;
    [[nodiscard]] double height_over_samples(const Vec3& x) const;

    double scale_;
    std::vector<Vec3> points_;
    std::vector<Vec3> normals_;          ///< of the surface there, as long as the area each stands for
    std::vector<std::uint32_t> vertex_;  ///< of each point, or one near it
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> chosen_;
    std::vector<std::uint32_t> face_start_;
    std::vector<std::uint32_t> by_face_;
    std::vector<std::uint32_t> around_;  ///< the samples of the faces at the vertex in hand
    std::vector<Vec3> local_;            ///< their points
    std::vector<std::size_t> own_;       ///< the faces of the star they belong to
    Star star_;
};

}  // namespace delmesh
