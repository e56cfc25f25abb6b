#include "delaunay/flip.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/flip_queue.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delaunay/splitter.hpp"

#include <algorithm>

namespace delmesh {
namespace {

/// Rounds of splitting what can not be flipped, each followed by flipping. Every round ends, so all of them do.
constexpr int most_rounds = 100;

class Flipping {
public:
    Flipping(MarkedMesh& marked, bool split_physical, const RemeshOptions& options, const Context* context,
             RemeshReport& report)
        : marked_(marked),
          mesh_(marked.mesh()),
          split_physical_(split_physical),
          options_(options),
          context_(context),
          report_(report),
          queue_(options.order),
          splitter_(marked, options, report, touched_) {}

    void run() {
        fill_queue();
        work_off();
        for (int round = 0; round < most_rounds && !splitter_.stopped(); ++round) {
            const std::vector<HalfedgeId> stuck = collect_stuck();
            if (round == 0) count_exposed(stuck);
            if (stuck.empty() || options_.finish == FlipFinish::literal) return;
            for (const HalfedgeId h : stuck) split_stuck(h);
            work_off();
        }
    }

private:
    void fill_queue() {
        for (const HalfedgeId h : find_non_delaunay(mesh_, context_))
            if (is_wanted(h)) queue_.push({h, urgency_of(h)});
    }

    [[nodiscard]] bool is_wanted(HalfedgeId h) const { return split_physical_ || marked_.is_planar(h); }
    [[nodiscard]] Urgency urgency_of(HalfedgeId h) const { return queue_.uses_urgency() ? urgency(mesh_, h) : 0; }

    void push(HalfedgeId side) {
        if (!is_wanted(side) || !is_non_delaunay(mesh_, side)) return;
        const HalfedgeId h = Mesh::halfedge(mesh_.edge(side));
        queue_.push({h, urgency_of(h)});
    }

    void push_touched() {
        for (const HalfedgeId h : touched_) push(h);
        touched_.clear();
    }

    void work_off() {
        while (!queue_.empty() && !splitter_.stopped()) {
            const auto [h, urgency] = queue_.pop();
            ask_ahead();
            if (++popped_ % 4096 == 0) take_breath(h);
            if (!is_wanted(h) || !is_non_delaunay(mesh_, h) || urgency != urgency_of(h)) continue;
            treat(h);
            push_touched();
        }
    }

    /// The next edges lie anywhere in the mesh: what they need is asked from memory in three steps, while others are
    /// worked off.
    void ask_ahead() const {
        const VertexId* corners = mesh_.corners().data();
        for (std::size_t place = 3; place < 7; ++place) {
            const HalfedgeId h = queue_.upcoming(place);
            if (!h.valid()) break;
            __builtin_prefetch(corners + h.index());
            mesh_.prefetch_twin(h);
        }
        for (std::size_t place = 1; place < 3; ++place) {
            const HalfedgeId h = queue_.upcoming(place);
            if (!h.valid()) break;
            const HalfedgeId t = mesh_.twin(h);
            if (t.valid()) __builtin_prefetch(corners + t.index());
            for (const VertexId v : {mesh_.origin(h), mesh_.target(h), mesh_.apex(h)})
                __builtin_prefetch(&mesh_.point(v));
        }
        const HalfedgeId h = queue_.upcoming(0);
        if (!h.valid() || mesh_.is_boundary(h)) return;
        const HalfedgeId t = mesh_.twin(h);
        __builtin_prefetch(&mesh_.point(mesh_.apex(t)));
        for (const HalfedgeId side : {Mesh::next(h), Mesh::prev(h), Mesh::next(t), Mesh::prev(t)}) {
            const HalfedgeId beyond = mesh_.twin(side);
            if (beyond.valid()) __builtin_prefetch(corners + beyond.index());
        }
    }

    void treat(HalfedgeId h) {
        if (!marked_.is_planar(h)) {
            splitter_.split_at_shell(h);
        } else if (!marked_.is_flippable(h)) {
            stuck_.push_back(h);
        } else if (const int folds = count_folds(h); folds > 0 && options_.no_foldover) {
            stuck_.push_back(h);
        } else {
            report_.foldovers += static_cast<std::size_t>(folds);
            flip_edge(h);
        }
    }

    void flip_edge(HalfedgeId h) {
        const HalfedgeId t = mesh_.twin(h);
        marked_.flip_planar(h);
        ++report_.flips;
        for (const HalfedgeId outer : {h, Mesh::next(h), t, Mesh::next(t)}) push(outer);
    }

    /// How many of the two new faces would face away from the old surface. The sum of the two faces' area vectors is
    /// the same before and after a flip; it stands for the normal.
    [[nodiscard]] int count_folds(HalfedgeId h) const {
        const Vec3& p = mesh_.point(mesh_.origin(h));
        const Vec3& q = mesh_.point(mesh_.target(h));
        const Vec3& u = mesh_.point(mesh_.apex(h));
        const Vec3& v = mesh_.point(mesh_.apex(mesh_.twin(h)));
        const Vec3 first = cross(v - p, u - p);
        const Vec3 second = cross(u - q, v - q);
        const Vec3 sum = first + second;
        return (dot(first, sum) < 0 ? 1 : 0) + (dot(second, sum) < 0 ? 1 : 0);
    }

    /// The edges that are still not Delaunay, each once. One that has become flippable goes back to the queue first.
    [[nodiscard]] std::vector<HalfedgeId> collect_stuck() {
        for (;;) {
            std::vector<HalfedgeId> left;
            for (HalfedgeId& h : stuck_) h = Mesh::halfedge(mesh_.edge(h));
            sort_unique(stuck_);
            for (const HalfedgeId h : stuck_) {
                if (!is_non_delaunay(mesh_, h)) continue;
                if (may_flip(h)) {
                    push(h);
                } else {
                    left.push_back(h);
                }
            }
            stuck_ = left;
            if (queue_.empty() || splitter_.stopped()) break;
            work_off();
        }
        std::vector<HalfedgeId> found = std::move(stuck_);
        stuck_.clear();
        add_boundary(found);
        return found;
    }

    [[nodiscard]] bool may_flip(HalfedgeId h) const {
        return marked_.is_planar(h) && marked_.is_flippable(h) && !(options_.no_foldover && count_folds(h) > 0);
    }

    /// Boundary edges that are not split as they come up.
    void add_boundary(std::vector<HalfedgeId>& found) const {
        if (split_physical_) return;
        for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i)
            if (mesh_.is_boundary(HalfedgeId(i)) && is_non_delaunay(mesh_, HalfedgeId(i))) found.emplace_back(i);
    }

    void split_stuck(HalfedgeId h) {
        if (splitter_.stopped() || !is_non_delaunay(mesh_, h)) return;
        if (may_flip(h)) {
            push(h);
            return;
        }
        splitter_.split_at_shell(h);
        push_touched();
    }

    /// How many faces of the flip tetrahedra of unflippable edges belong to the mesh, as in section 4.3 of the paper.
    void count_exposed(const std::vector<HalfedgeId>& stuck) {
        for (const HalfedgeId h : stuck) {
            const HalfedgeId t = mesh_.twin(h);
            if (!t.valid() || marked_.is_flippable(h)) continue;
            const VertexId u = mesh_.apex(h);
            const VertexId v = mesh_.apex(t);
            const std::size_t more =
                (is_face(mesh_.origin(h), u, v) ? 1u : 0u) + (is_face(mesh_.target(h), u, v) ? 1u : 0u);
            ++report_.exposed[more];
        }
    }

    [[nodiscard]] bool is_face(VertexId a, VertexId b, VertexId c) const {
        for (const HalfedgeId h : {mesh_.find_halfedge(a, b), mesh_.find_halfedge(b, a)})
            if (h.valid() && mesh_.apex(h) == c) return true;
        return false;
    }

    void take_breath(HalfedgeId h) {
        const double done = static_cast<double>(report_.flips + report_.splits);
        furthest_ = std::max(furthest_, done / (done + static_cast<double>(queue_.size()) + 1));
        report_progress(context_, "flip", furthest_);
        if (is_cancelled(context_)) splitter_.stop(StopReason::cancelled, h);
    }

    MarkedMesh& marked_;
    const Mesh& mesh_;
    bool split_physical_;
    const RemeshOptions& options_;
    const Context* context_;
    RemeshReport& report_;
    FlipQueue queue_;
    std::vector<HalfedgeId> stuck_;    ///< not Delaunay, and could not be flipped when it came up
    std::vector<HalfedgeId> touched_;  ///< by the last split
    std::size_t popped_ = 0;
    double furthest_ = 0;
    Splitter splitter_;
};

}  // namespace

void flip_edges(MarkedMesh& marked, bool split_physical, const RemeshOptions& options, const Context* context,
                RemeshReport& report) {
    Flipping(marked, split_physical, options, context, report).run();
}

}  // namespace delmesh
