#pragma once
// A vertex more or less in a finished level, with the flips that keep it Delaunay; judged by the samples.

#include "delmesh/mesh/mesh.hpp"
#include "mesh/edit_log.hpp"
#include "simplify/placement.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace delmesh {

/// What a change may cost.
struct TrialLimits {
    double most = 0;           ///< the sum over the samples grows by less than this
    double allowed2 = 0;       ///< no sample gets farther away (squared, local unit), or than the farthest around was
    bool fits_around = false;  ///< the vertices around are fitted as well: slower, and says better what is worth it
};

/// One change at a time; once one has succeeded, `keep` or `undo` it before the next. Two trials may be open at once
/// if the one that began last ends first.
class Trial {
public:
    Trial(Mesh& mesh, SurfaceSamples& samples, Placer& placer, double scale, std::function<Vec3(const Vec3&)> settle)
        : mesh_(mesh),
          samples_(samples),
          placer_(placer),
          scale_(scale),
          settle_(std::move(settle)),
          log_(mesh) {}

    /// Merges the edge of h, whose star that is, to w (local), flips all edges around that are not Delaunay then, and
    /// fits the merged vertex to the samples. If a limit does not hold, or there is no such way, nothing has changed.
    bool collapse(const Star& star, HalfedgeId h, const Vec3& w, const TrialLimits& limits);
    /// The same with a new vertex in the middle of the edge. `h` must not lie on the boundary.
    bool insert(HalfedgeId h, const TrialLimits& limits);

    /// By how much the last change that succeeded has changed the sum over the samples.
    [[nodiscard]] double change() const { return change_; }
    /// The faces it has changed, as far as they live.
    [[nodiscard]] std::span<const FaceId> faces() const { return living_; }
    void keep();
    void undo();
    /// Once undone: the faces that it would have changed.
    [[nodiscard]] std::span<const FaceId> faces_before() const { return original_; }

private:
    bool finish(VertexId v, const TrialLimits& limits);
    bool make_delaunay();
    void push_sides(FaceId f);
    bool judge(VertexId v, const TrialLimits& limits);
    void fit(VertexId v, double allowed2);
    void fit_around(VertexId v, double allowed2);
    void take_faces_around();
    [[nodiscard]] double worst_around(VertexId v);

    Mesh& mesh_;
    SurfaceSamples& samples_;
    Placer& placer_;
    double scale_;
    std::function<Vec3(const Vec3&)> settle_;
    EditLog log_;
    Star star_;
    std::vector<HalfedgeId> stack_;
    std::vector<FaceId> changed_, living_, original_;
    std::vector<SurfaceSamples::Place> before_, after_, beside_;
    std::vector<VertexId> ring_;
    bool has_moved_samples_ = false;
    double change_ = 0;
};

}  // namespace delmesh
