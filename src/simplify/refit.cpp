#include "simplify/refit.hpp"

#include "simplify/sample_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// Samples no farther than this (squared, local unit) are left as they are.
constexpr double negligible2 = 1e-16;

}  // namespace

Refitter::Refitter(Mesh& mesh, SurfaceSamples& samples, Placer& placer, double scale,
                   std::function<Vec3(const Vec3&)> settle, std::function<void(VertexId, const Vec3&)> moved)
    : mesh_(mesh),
      samples_(samples),
      placer_(placer),
      scale_(scale),
      settle_(std::move(settle)),
      moved_(std::move(moved)) {}

bool Refitter::refit_vertex(VertexId v, const RefitTuning& tuning, double allowed2) {
    gather(mesh_, v, scale_, star_);
    samples_.gather(star_);
    EdgeCost cost;
    if (!(samples_.present().forward > negligible2) || !fit_to_samples(star_, samples_, {}, tuning.regular, cost))
        return false;
    const auto place = placer_.improve(star_, cost, Vec3{});
    if (!place || place->cost > (1 - tuning.least_gain) * cost.steered({})) return false;
    const Vec3 w = settle_(star_.frame.to_mesh(place->point));
    if (w == mesh_.point(v) || !keeps_delaunay(mesh_, star_, w)) return false;
    const Vec3 there = star_.frame.to_local(w);
    const SampleError before = samples_.present();
    SampleError after = samples_.measure_forward(star_, there);
    if (!(after.sum < (1 - tuning.least_gain) * before.sum)) return false;
    // Looking back takes as long as looking forward, so that is done last, and for the place before where it matters.
    after.backward = samples_.measure_backward(star_, there);
    if (after.worst() > std::max(before.forward, allowed2) &&
        after.worst() > std::max(before.forward, samples_.measure_backward(star_, {})))
        return false;
    moved_(v, w);
    mesh_.set_point(v, w);
    samples_.commit(star_);
    return true;
}

std::size_t Refitter::run(const RefitTuning& tuning, double allowed2, const Context* context) {
    return run(tuning, allowed2, std::vector<bool>(mesh_.vertex_count(), true), context);
}

std::size_t Refitter::run(const RefitTuning& tuning, double allowed2, std::vector<bool> changed,
                          const Context* context) {
    std::size_t moves = 0;
    // What failed fails again as long as nothing around it has moved.
    for (int round = 0; round < tuning.rounds && !is_cancelled(context); ++round) {
        for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
            const VertexId id(v);
            if (!changed[v] || !mesh_.halfedge(id).valid() || mesh_.is_boundary(id)) continue;
            changed[v] = false;
            if (!refit_vertex(id, tuning, allowed2)) continue;
            ++moves;
            changed[v] = true;
            for (const Star::Corner& corner : star_.ring) {
                changed[corner.vertex.index()] = true;
                if (corner.outer.valid()) changed[corner.outer.index()] = true;
            }
        }
    }
    return moves;
}

}  // namespace delmesh
