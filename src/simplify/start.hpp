#pragma once
// What comes before the first collapse: a mesh that is Delaunay.

#include "delmesh/simplify/simplify.hpp"
#include "simplify/tuning.hpp"

#include <cstddef>

namespace delmesh {

struct StartLimits {
    std::size_t vertices = 0;  ///< of the finest level
    bool may_thin = false;     ///< collapses without the Delaunay conditions, where remeshing stops short otherwise
};

/// How a mesh is to be remeshed: where most of a large one is noise, with twice the angle, if the options allow that.
[[nodiscard]] RemeshOptions start_options(const Mesh& mesh, const SimplifyOptions& options);

/// Remeshes the mesh if it is not Delaunay, thinned out and with wider angles if need be. Fills of the report what
/// concerns that. Returns whether the mesh is Delaunay then; if not, it is as it was, or as far as remeshing came.
bool make_start_delaunay(Mesh& mesh, RemeshOptions how, const Tuning& tuning, const StartLimits& limits,
                         SimplifyReport& report, const Context* context);

}  // namespace delmesh
