#pragma once
// Splits edges of a marked mesh, as far as the options and the arithmetic allow.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <span>
#include <vector>

namespace delmesh {

/// Every edge whose opposite angles a split has changed is appended to `touched`. When a split is not allowed or not
/// possible, the report gets the reason and the edge, and `stopped()` is true from then on.
class Splitter {
public:
    Splitter(MarkedMesh& marked, const RemeshOptions& options, RemeshReport& report, std::vector<HalfedgeId>& touched)
        : marked_(marked),
          mesh_(marked.mesh()),
          options_(options),
          report_(report),
          touched_(touched) {}

    /// Splits at SV(e), see split_point.hpp.
    void split_at_shell(HalfedgeId h);
    /// Splits in the middle: for a planar edge whose opposing edge exists elsewhere, as where a surface touches itself.
    void halve(HalfedgeId h);
    /// Splits the edge between u and v, a part of the input edge of `where`. Returns the new vertex; none where
    /// rounding does not allow it.
    VertexId split_between(VertexId u, VertexId v, const SplitPoint& where);
    void stop(StopReason reason, HalfedgeId at);
    [[nodiscard]] bool stopped() const { return stopped_; }

private:
    [[nodiscard]] bool lies_inside(HalfedgeId h, const Vec3& s) const;
    void split(HalfedgeId h, const SplitPoint& where, const Vec3& point);
    void part_doubled_faces(HalfedgeId h);

    MarkedMesh& marked_;
    const Mesh& mesh_;
    const RemeshOptions& options_;
    RemeshReport& report_;
    std::vector<HalfedgeId>& touched_;
    bool stopped_ = false;
};

}  // namespace delmesh
