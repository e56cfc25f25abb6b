#pragma once
// The end of a level, judged by samples of the original: which vertices to do without, and where more are worth it.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "simplify/placement.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"
#include "simplify/trial.hpp"
#include "simplify/tuning.hpp"
#include "simplify/weights.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace delmesh {

/// Every change keeps the mesh Delaunay and its topology, and lets no sample get farther away than `allowed2` (squared,
/// local unit), or than the farthest around was. Vertices on the boundary stay.
class Polisher {
public:
    /// `weights` must be up to date, and is kept so.
    Polisher(Mesh& mesh, SurfaceSamples& samples, Placer& placer, VertexWeights& weights, const Tuning& tuning,
             double scale, const std::function<Vec3(const Vec3&)>& settle);

    /// Collapses so many edges, those first that add least to the sum over the samples. Returns how many it could.
    std::size_t reduce(std::size_t count, double allowed2, const Context* context);
    /// Takes vertices from where they hardly matter to where the error is, so that the sum falls. The numbers of
    /// vertices and faces stay, not their ids. Tries `most` changes of each kind at most. Returns the number of
    /// exchanges.
    std::size_t exchange(std::size_t most, double allowed2, const Context* context);
    /// v has been moved by somebody else.
    void touch(VertexId v);
    /// As `SimplifyReport::quadric_error` of what was merged, but squared, local unit.
    [[nodiscard]] double worst_error2() const { return worst_error2_; }
    /// The vertices around which the last call of one of those has changed something.
    [[nodiscard]] const std::vector<bool>& changed() const { return changed_; }

private:
    struct Chance {
        double value = 0;
        HalfedgeId edge;
    };
    [[nodiscard]] bool is_inside(HalfedgeId h) const;
    void refresh(std::span<const FaceId> faces);
    void mark(std::span<const FaceId> faces);
    [[nodiscard]] bool is_hopeless(HalfedgeId h) const;
    bool try_collapse(HalfedgeId h, const TrialLimits& limits);
    void keep_collapse();
    bool exchange_at(HalfedgeId h, double allowed2);
    void rank_errors(std::size_t most);
    void rank_collapses(std::size_t most);
    /// Of no interest is what costs more than the dearest of the first `wanted`.
    void measure_collapses(TrialLimits limits, std::size_t wanted);

    Mesh& mesh_;
    SurfaceSamples& samples_;
    Placer& placer_;
    VertexWeights& weights_;
    const Tuning& tuning_;
    double scale_;
    Trial insertion_, collapse_;
    Star star_;
    VertexId kept_, gone_;    ///< by the collapse that is tried ...
    Vec3 kept_at_, gone_at_;  ///< ... and where they were
    double worst_error2_ = 0;
    std::vector<Chance> errors_;     ///< by the samples' sum over both faces, largest first
    std::vector<Chance> collapses_;  ///< by what they add to the sum, smallest first
    std::size_t next_collapse_ = 0;
    std::vector<bool> changed_;
    std::vector<bool> hopeless_;  ///< per half-edge: its collapse was too dear when it was measured last ...
    std::vector<bool> touched_;   ///< ... and per vertex: something has changed since
};

}  // namespace delmesh
