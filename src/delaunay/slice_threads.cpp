#include "delaunay/slice_threads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// Points keep this distance, as a share of their edge: what lies closer together is hard to tell apart.
constexpr double room = 1e-10;
constexpr int axis_rounds = 30;

}  // namespace

// --- which edges ---

bool SliceThreads::reach(std::uint32_t e) {
    if (reached_.size() <= e) reached_.resize(model_.layout().edge_count() + 1, false);
    if (reached_[e]) return false;
    reached_[e] = true;
    return true;
}

bool SliceThreads::is_concerned(std::uint32_t e) const {
    return model_.is_given_up(e) || model_.point_count(e) > 0 || !model_.layout().edge(e).is_delaunay;
}

void SliceThreads::visit(std::uint32_t e, bool is_rim) {
    model_.prepare(e);
    for (const std::uint32_t s : model_.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Facet facet = model_.layout().facet(model_.layout().facet_at(s));
        for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
            const std::uint32_t other = model_.layout().edge_at(i);
            if (!model_.is_movable(other) || (is_rim && !is_concerned(other)) || !reach(other)) continue;
            (is_concerned(other) ? edges_ : rim_).push_back(other);
        }
    }
}

void SliceThreads::gather(std::uint32_t e) {
    edges_.assign(1, e);
    reached_.clear();
    (void)reach(e);
    for (std::size_t done = 0; done < edges_.size() || !rim_.empty();) {
        if (done < edges_.size()) {
            visit(edges_[done++], false);
        } else {
            const std::uint32_t next = rim_.back();
            rim_.pop_back();
            visit(next, true);
        }
    }
}

// --- where ---

/// The direction of most of the edges' length. The same bits at any scale that is a power of two.
void SliceThreads::find_axis() {
    const Mesh& mesh = model_.layout().marked().mesh();
    const auto along = [&](std::uint32_t e) {
        const HalfedgeId h = model_.layout().edge(e).halfedge;
        return mesh.point(mesh.target(h)) - mesh.point(mesh.origin(h));
    };
    double largest = 0;
    for (const std::uint32_t e : edges_) {
        const Vec3 d = along(e);
        largest = std::max({largest, std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    }
    int exponent = 0;
    (void)std::frexp(largest, &exponent);
    std::array<Vec3, 3> sum{};
    double longest = 0;
    for (const std::uint32_t e : edges_) {
        const Vec3 far = along(e);
        const Vec3 d{std::ldexp(far.x, -exponent), std::ldexp(far.y, -exponent), std::ldexp(far.z, -exponent)};
        sum[0] = sum[0] + d * d.x;
        sum[1] = sum[1] + d * d.y;
        sum[2] = sum[2] + d * d.z;
        if (dot(d, d) <= longest) continue;
        longest = dot(d, d);
        axis_ = d;
    }
    for (int i = 0; i < axis_rounds; ++i) {
        const Vec3 next{dot(sum[0], axis_), dot(sum[1], axis_), dot(sum[2], axis_)};
        axis_ = next * (1 / std::sqrt(dot(next, next)));
    }
}

SliceThreads::Levels SliceThreads::levels(std::uint32_t e) const {
    const Mesh& mesh = model_.layout().marked().mesh();
    const HalfedgeId h = model_.layout().edge(e).halfedge;
    const VertexId from = std::min(mesh.origin(h), mesh.target(h));
    const VertexId to = std::max(mesh.origin(h), mesh.target(h));
    return {dot(axis_, mesh.point(from)), dot(axis_, mesh.point(to))};
}

/// Of a corner: from its own coordinates, so that all that see it agree.
double SliceThreads::level_of(std::uint32_t side, const Contact& seen) const {
    if (seen.edge != SplitModel::none) return levels(seen.edge).at(seen.along);
    const FacetLayout& layout = model_.layout();
    const Facet facet = layout.facet(layout.facet_at(side));
    const Side frame = layout.side(side);
    double least = std::numeric_limits<double>::infinity();
    double level = 0;
    for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
        const Side other = layout.side(i);
        const Levels ends = levels(other.edge);
        for (const double t : {0.0, 1.0}) {
            const Point2 d = frame.to_frame(other.at(t)) - seen.at;
            if (dot(d, d) >= least) continue;
            least = dot(d, d);
            level = t == 0 ? ends.from : ends.to;
        }
    }
    return level;
}

/// Where the plane cuts that the part sees under the larger angle; negative if neither does.
double SliceThreads::slice(std::uint32_t e, std::size_t part) const {
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    const Levels ends = levels(e);
    double least = std::numeric_limits<double>::infinity();
    double at = -1;
    for (const std::uint32_t s : model_.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Contact seen = model_.nearest(s, a, b);
        const double x = (level_of(s, seen) - ends.from) / (ends.to - ends.from);
        if (seen.cot >= least || !(x > a + room) || !(x < b - room)) continue;
        least = seen.cot;
        at = x;
    }
    return at;
}

// --- threads ---

/// Splits one bad part, and has the edge looked at again. False if no plane cuts any.
bool SliceThreads::split(std::uint32_t e, bool halves) {
    const std::size_t parts = model_.parts(e).size();
    bool is_bad = false;
    for (std::size_t part = 0; part < parts; ++part) {
        if (!model_.is_bad(e, model_.parts(e)[part])) continue;
        is_bad = true;
        double at = slice(e, part);
        if (at < 0 && halves) at = 0.5 * (model_.part_start(e, part) + model_.parts(e)[part].end);
        if (at < 0) continue;
        model_.cut(e, part, part, {&at, 1});
        model_.add_suspect(e);
        return true;
    }
    return !is_bad;
}

bool SliceThreads::solve(std::size_t steps) {
    find_axis();
    for (const std::uint32_t e : edges_) {
        model_.cut(e, 0, model_.point_count(e), {});
        model_.give_up(e, false);
        model_.add_suspect(e);
    }
    std::vector<std::uint32_t> later;
    for (std::size_t step = 0; model_.suspect_count() > 0 || !later.empty(); ++step) {
        const bool halves = model_.suspect_count() == 0;
        const std::uint32_t e = halves ? later.back() : model_.suspect(model_.suspect_count() - 1);
        if (step >= steps || limits_.is_exhausted() || !model_.is_movable(e)) return false;
        halves ? later.pop_back() : model_.drop_suspect(model_.suspect_count() - 1);
        model_.prepare(e);
        if (!split(e, halves)) later.push_back(e);
    }
    return true;
}

}  // namespace delmesh
