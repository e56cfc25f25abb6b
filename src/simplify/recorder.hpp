#pragma once
// Notes down the way from fine to coarse.

#include "delmesh/mesh/edits.hpp"
#include "delmesh/simplify/progressive_mesh.hpp"

#include <algorithm>
#include <vector>

namespace delmesh {

class Recorder {
public:
    /// [kept, gone] with what lies left and right of it is about to be merged into `kept`.
    void collapsed(VertexId kept, VertexId gone, VertexId left, VertexId right, const Vec3& kept_at,
                   const Vec3& gone_at) {
        notes_.push_back({{RefineStep::Kind::split, kept, left, right, kept_at, gone_at}, gone});
    }
    /// v, which was at `before`, has moved.
    void moved(VertexId v, const Vec3& before) {
        notes_.push_back({{RefineStep::Kind::move, v, {}, {}, before, {}}, {}});
    }

    /// The steps from coarse to fine, with the ids that replaying gives. `ids` are the base's, by the ids noted.
    [[nodiscard]] std::vector<RefineStep> steps(std::vector<VertexId> ids, std::size_t base_vertices) const {
        std::vector<RefineStep> out;
        out.reserve(notes_.size());
        std::size_t next = base_vertices;
        const auto renamed = [&](VertexId v) { return v.valid() ? ids[v.index()] : v; };
        for (auto note = notes_.rbegin(); note != notes_.rend(); ++note) {
            RefineStep step = note->step;
            step.vertex = renamed(step.vertex);
            step.left = renamed(step.left);
            step.right = renamed(step.right);
            if (note->gone.valid()) ids[note->gone.index()] = VertexId(next++);
            out.push_back(step);
        }
        return out;
    }

private:
    struct Note {
        RefineStep step;
        VertexId gone;
    };
    std::vector<Note> notes_;
};

}  // namespace delmesh
