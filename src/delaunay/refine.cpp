#include "delaunay/refine.hpp"

#include "base/parallel.hpp"
#include "delaunay/edge_sign.hpp"
#include "delaunay/split_point.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

class Refinement {
public:
    Refinement(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report)
        : marked_(marked),
          mesh_(marked.mesh()),
          options_(options),
          context_(context),
          report_(report) {}

    void run() {
        find_suspects();
        flip_suspects();
        count_lower_bound();
        make_room();
        while (!stopped_ && next_split_ < splits_.size()) {
            treat(splits_[next_split_++]);
            flip_suspects();
            forget_done_splits();
        }
    }

private:
    void stop(StopReason reason, HalfedgeId at) {
        stopped_ = true;
        report_.stop = reason;
        if (at.valid()) report_.witness = mesh_.edge(at);
    }

    /// All edges that are not Delaunay now, in the order of their ids (the list is worked off from its end).
    void find_suspects() {
        std::vector<std::uint8_t> bad(mesh_.halfedge_count(), 0);
        parallel_blocks(bad.size(), context_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const HalfedgeId h(i);
                if (mesh_.names_edge(h)) bad[i] = is_non_delaunay(mesh_, h) ? 1 : 0;
            }
        });
        for (std::size_t i = bad.size(); i-- > 0;)
            if (bad[i] != 0) suspects_.emplace_back(i);
    }

    /// Flips until only edges that can not be flipped are left; these go to the queue of splits.
    void flip_suspects() {
        while (!suspects_.empty()) {
            const HalfedgeId h = suspects_.back();
            suspects_.pop_back();
            if (!is_non_delaunay(mesh_, h)) continue;
            if (marked_.is_planar(h) && can_flip(mesh_, h)) {
                flip_edge(h);
            } else {
                splits_.push_back(h);
            }
        }
    }

    void flip_edge(HalfedgeId h) {
        const HalfedgeId t = mesh_.twin(h);
        marked_.flip_planar(h);
        ++report_.flips;
        for (const HalfedgeId outer : {h, Mesh::next(h), t, Mesh::next(t)}) suspects_.push_back(outer);
    }

    /// Once planar edges have been flipped, each physical edge left over must be split at least once by any method that
    /// keeps the surface: vertices added elsewhere can only make the angles opposite to it larger.
    void count_lower_bound() {
        std::vector<EdgeId> bad;
        for (const HalfedgeId h : splits_)
            if (!marked_.is_planar(h) && is_non_delaunay(mesh_, h)) bad.push_back(mesh_.edge(h));
        std::sort(bad.begin(), bad.end());
        report_.lower_bound = static_cast<std::size_t>(std::unique(bad.begin(), bad.end()) - bad.begin());
    }

    void make_room() { marked_.reserve_splits(6 * report_.lower_bound); }

    /// One edge of the queue, which may have become Delaunay, flippable or another edge in the meantime.
    void treat(HalfedgeId h) {
        if (++treated_ % 1024 == 0) take_breath(h);
        if (stopped_ || !is_non_delaunay(mesh_, h)) return;
        if (!marked_.is_planar(h)) {
            split_physical(h);
        } else if (can_flip(mesh_, h)) {
            flip_edge(h);
        } else {
            split_planar(h);
        }
    }

    void take_breath(HalfedgeId h) {
        const double left = static_cast<double>(splits_.size() - next_split_);
        const double done = static_cast<double>(report_.splits);
        furthest_ = std::max(furthest_, done / (done + left + 1));
        report_progress(context_, "remesh", furthest_);
        if (is_cancelled(context_)) stop(StopReason::cancelled, h);
    }

    void split_physical(HalfedgeId h) {
        const EdgePart part = part_of_input_edge(marked_, h);
        const double t = shell_parameter(marked_, h, part, options_.shell_unit_abs);
        const Vec3 point = point_between(mesh_.point(part.a), mesh_.point(part.b), t, options_.precision);
        if (!can_split(mesh_, h)) {
            part_doubled_faces(h);
        } else {
            split(h, {part.a, part.b, t}, point, std::min(part.from, part.to) < t && t < std::max(part.from, part.to));
        }
    }

    /// A planar edge whose opposing edge exists elsewhere, as can happen where a surface touches itself: halved.
    void split_planar(HalfedgeId h) {
        if (!can_split(mesh_, h)) return part_doubled_faces(h);
        const VertexId p = std::min(mesh_.origin(h), mesh_.target(h));
        const VertexId q = std::max(mesh_.origin(h), mesh_.target(h));
        split(h, {p, q, 0.5}, point_between(mesh_.point(p), mesh_.point(q), 0.5, options_.precision), true);
    }

    /// Two faces over the same three vertices: a vertex on their edge would be joined to their common apex twice. A
    /// vertex on another of their edges parts them first.
    void part_doubled_faces(HalfedgeId h) {
        for (const HalfedgeId side : {Mesh::next(h), Mesh::prev(h)}) {
            if (!can_split(mesh_, side)) continue;
            if (marked_.is_planar(side)) {
                split_planar(side);
            } else {
                split_physical(side);
            }
            suspects_.push_back(h);
            return;
        }
        stop(StopReason::unresolved, h);
    }

    void split(HalfedgeId h, const SplitPoint& where, const Vec3& point, bool inside) {
        if (options_.max_vertices != 0 && mesh_.vertex_count() >= options_.max_vertices)
            return stop(StopReason::max_vertices, h);
        if (!inside || !lies_between(point, mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h))))
            return stop(StopReason::unresolved, h);
        const HalfedgeId t = mesh_.twin(h);
        const HalfedgeId first(mesh_.halfedge_count());
        marked_.split(h, where, point);
        ++report_.splits;
        for (const HalfedgeId side : {h, Mesh::next(h), Mesh::prev(h), first, Mesh::next(first)})
            suspects_.push_back(side);
        if (!t.valid()) return;
        const HalfedgeId second(first.value() + 3);
        for (const HalfedgeId side : {Mesh::next(t), Mesh::prev(t), Mesh::prev(second)}) suspects_.push_back(side);
    }

    /// In the box of p and q but neither of them: rounding has not moved the point past an end.
    static bool lies_between(const Vec3& s, const Vec3& p, const Vec3& q) {
        if (s == p || s == q) return false;
        for (int axis = 0; axis < 3; ++axis)
            if (s[axis] < std::min(p[axis], q[axis]) || s[axis] > std::max(p[axis], q[axis])) return false;
        return true;
    }

    void forget_done_splits() {
        if (next_split_ < 65536 || next_split_ < splits_.size() / 2) return;
        splits_.erase(splits_.begin(), splits_.begin() + static_cast<std::ptrdiff_t>(next_split_));
        next_split_ = 0;
    }

    MarkedMesh& marked_;
    const Mesh& mesh_;
    const RemeshOptions& options_;
    const Context* context_;
    RemeshReport& report_;
    std::vector<HalfedgeId> suspects_;  ///< worked off last in, first out
    std::vector<HalfedgeId> splits_;    ///< worked off first in, first out, from next_split_
    std::size_t next_split_ = 0;
    std::size_t treated_ = 0;
    double furthest_ = 0;
    bool stopped_ = false;
};

}  // namespace

void refine(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    Refinement(marked, options, context, report).run();
}

}  // namespace delmesh
