#pragma once
// Moves the vertices of a decimated mesh closer to samples of the original surface, edge by edge Delaunay as before.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "simplify/placement.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"

#include <functional>
#include <vector>

namespace delmesh {

struct RefitTuning {
    int rounds = 3;
    double regular = 1e-4;     ///< pull to the place before, relative to the trace
    double least_gain = 0.01;  ///< a move must lower the error by this part
};

class Refitter {
public:
    /// `settle` rounds a place to what can be stored; `moved` is told of each vertex before it moves.
    Refitter(Mesh& mesh, SurfaceSamples& samples, Placer& placer, double scale, std::function<Vec3(const Vec3&)> settle,
             std::function<void(VertexId, const Vec3&)> moved);

    /// A move never enlarges the largest error around beyond `allowed2` (squared, local unit), nor beyond what it was.
    /// Returns the number of moves.
    std::size_t run(const RefitTuning& tuning, double allowed2, const Context* context);
    /// Only vertices that are named, and from there on what the moves affect.
    std::size_t run(const RefitTuning& tuning, double allowed2, std::vector<bool> changed, const Context* context);

private:
    bool refit_vertex(VertexId v, const RefitTuning& tuning, double allowed2);

    Mesh& mesh_;
    SurfaceSamples& samples_;
    Placer& placer_;
    double scale_;
    std::function<Vec3(const Vec3&)> settle_;
    std::function<void(VertexId, const Vec3&)> moved_;
    Star star_;
};

}  // namespace delmesh
