#pragma once
// Edits that can be taken back.

#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <vector>

namespace delmesh {

/// Makes the edits of edits.hpp, which state what they require, and remembers what they change. Memory and the time of
/// `undo`: O(elements changed).
class EditLog {
public:
    explicit EditLog(Mesh& mesh) : mesh_(mesh) { keep(); }

    /// What was done so far stays done.
    void keep();
    HalfedgeId flip(HalfedgeId h);
    void collapse(HalfedgeId h, const Vec3& point);
    VertexId split_edge(HalfedgeId h, const Vec3& point);
    void set_point(VertexId v, const Vec3& point);
    /// The mesh is again what it was at the last `keep`, bit for bit.
    void undo();
    /// The faces changed since the last `keep`, dead and new ones included; some more than once.
    [[nodiscard]] const std::vector<FaceId>& changed() const { return changed_; }

private:
    struct FaceState {
        FaceId face;
        std::array<VertexId, 3> origin;
        std::array<HalfedgeId, 3> twin;
    };
    struct VertexState {
        VertexId vertex;
        HalfedgeId out;
        Vec3 point;
    };
    void note_face(HalfedgeId h);
    void note_vertex(VertexId v);
    void note_around(VertexId v);

    Mesh& mesh_;
    std::size_t vertices_ = 0, halfedges_ = 0;
    std::vector<FaceState> faces_;
    std::vector<VertexState> points_;
    std::vector<FaceId> changed_;
};

}  // namespace delmesh
