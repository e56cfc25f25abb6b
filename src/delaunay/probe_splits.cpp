#include "delaunay/probe_splits.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/split_point.hpp"
#include "delaunay/unit_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace delmesh {
namespace {

/// More edges than these are for the search.
constexpr std::size_t most_points = 3;
/// In faces copied or looked at; each try costs as much as some thousand faces more, for its exact signs.
constexpr double most_work = 6e6;
constexpr double try_work = 4000;
/// Meshes that allow fewer tries than these are not worth beginning with.
constexpr double least_tries = 500;
constexpr int finest = 60;
constexpr int finest_around = 52;
constexpr int last_ulps = 16;
constexpr int even_places = 16;

/// As a squared sine: the same bits everywhere.
double smallest_angle(const Mesh& mesh, const UnitFrame& frame) {
    double least = 1;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        const Vec3 a = frame(mesh.point(mesh.origin(h)));
        const Vec3 u = frame(mesh.point(mesh.target(h))) - a;
        const Vec3 v = frame(mesh.point(mesh.apex(h))) - a;
        const Vec3 n = cross(u, v);
        std::array<double, 3> lengths{dot(u, u), dot(v, v), dot(v - u, v - u)};
        std::sort(lengths.begin(), lengths.end());
        const double sine2 = dot(n, n) / (lengths[1] * lengths[2]);
        if (sine2 < least) least = sine2;
    }
    return least;
}

class Probe {
public:
    Probe(const MarkedMesh& marked, const RemeshOptions& options, const RefineStart& start, const Context* context)
        : marked_(marked),
          options_(options),
          start_(start),
          context_(context),
          frame_(unit_frame(marked.mesh())),
          price_(try_work + static_cast<double>(marked.mesh().face_count())) {}

    std::vector<SplitPoint> run(std::size_t below) {
        const std::size_t least = start_.bad.size();
        if (least == 0 || least > most_points || least_tries * price_ > most_work) return {};
        for (std::size_t points = least; points < below && points <= most_points && best_.empty(); ++points) {
            // Few places for all points but the first one; then many for all, while there is time.
            for (const bool many : {false, true}) {
                if (best_.empty() && !is_over()) extend({}, points, many);
                if (points == 1) break;
            }
        }
        return std::move(best_);
    }

private:
    [[nodiscard]] bool is_over() const { return work_ > most_work || is_cancelled(context_); }

    /// Carries out a plan on a copy, and goes on where edges are not Delaunay after that.
    void extend(const std::vector<SplitPoint>& plan, std::size_t points_left, bool many) {
        work_ += price_;
        Mesh mesh = marked_.mesh();
        MarkedMesh marked(mesh, marked_);
        RemeshReport report;
        const std::vector<HalfedgeId> bad = carry_out(marked, options_, context_, report, start_, plan);
        if (report.stop != StopReason::done || marked.split_count() != plan.size()) return;
        if (bad.empty()) return keep_if_better(plan, mesh);
        if (points_left == 0 || edge_count(mesh, bad) > points_left || marked.is_planar(bad.front())) return;
        const EdgePart part = part_of_input_edge(marked, bad.front());
        std::vector<double> places = anchors(mesh, bad.front(), part);
        if (plan.empty() || many) add_ladders(part, places);
        for (const double t : places) {
            if (is_over()) return;
            if (!(std::min(part.from, part.to) < t && t < std::max(part.from, part.to))) continue;
            extend(with(plan, {part.a, part.b, t}), points_left - 1, many);
        }
    }

    static std::size_t edge_count(const Mesh& mesh, const std::vector<HalfedgeId>& bad) {
        std::vector<EdgeId> edges;
        edges.reserve(bad.size());
        for (const HalfedgeId h : bad) edges.push_back(mesh.edge(h));
        sort_unique(edges);
        return edges.size();
    }

    static std::vector<SplitPoint> with(std::vector<SplitPoint> plan, const SplitPoint& point) {
        const auto before = [](const SplitPoint& p, const SplitPoint& q) {
            return p.a != q.a ? p.a < q.a : p.b != q.b ? p.b < q.b : p.t < q.t;
        };
        plan.insert(std::upper_bound(plan.begin(), plan.end(), point, before), point);
        return plan;
    }

    /// Where what sees a part lies above it, and where it is as far from an end of the edge.
    [[nodiscard]] std::vector<double> anchors(const Mesh& mesh, HalfedgeId h, const EdgePart& part) const {
        const Vec3 a = frame_(mesh.point(part.a));
        const Vec3 along = frame_(mesh.point(part.b)) - a;
        const double length2 = dot(along, along);
        std::vector<double> places;
        for (const HalfedgeId side : {h, mesh.twin(h)}) {
            if (!side.valid()) continue;
            const Vec3 apex = frame_(mesh.point(mesh.apex(side))) - a;
            const double foot = dot(apex, along) / length2;
            const Vec3 back = apex - along;
            const double from_a = std::sqrt(dot(apex, apex) / length2);
            const double from_b = 1 - std::sqrt(dot(back, back) / length2);
            places.insert(places.end(), {foot, from_a, from_b, 0.5 * (foot + from_a), 0.5 * (foot + from_b)});
        }
        return places;
    }

    /// Coarse ones first.
    static void add_ladders(const EdgePart& part, std::vector<double>& places) {
        const double low = std::min(part.from, part.to);
        const double high = std::max(part.from, part.to);
        std::vector<double> around;
        for (std::size_t i = 0; i < places.size(); i += 5) around.push_back(places[i]);
        for (int i = 1; i < even_places; ++i) places.push_back(low + (high - low) * i / even_places);
        for (int k = 1; k <= finest; ++k) {
            const double distance = std::ldexp(high - low, -k);
            places.push_back(low + distance);
            places.push_back(high - distance);
            if (k > finest_around) continue;
            for (const double foot : around) places.insert(places.end(), {foot - distance, foot + distance});
        }
        for (int i = 1; i <= last_ulps; ++i) places.push_back(high - std::ldexp(i, -53));
    }

    void keep_if_better(const std::vector<SplitPoint>& plan, const Mesh& mesh) {
        work_ += static_cast<double>(mesh.face_count());
        const double angle = smallest_angle(mesh, frame_);
        if (!best_.empty() && !(angle > best_angle_)) return;
        best_angle_ = angle;
        best_ = plan;
    }

    const MarkedMesh& marked_;
    const RemeshOptions& options_;
    const RefineStart& start_;
    const Context* context_;
    UnitFrame frame_;
    double price_;
    double work_ = 0;
    std::vector<SplitPoint> best_;
    double best_angle_ = 0;
};

}  // namespace

std::vector<SplitPoint> probe_splits(const MarkedMesh& marked, const RemeshOptions& options, const RefineStart& start,
                                     std::size_t below, const Context* context) {
    return Probe(marked, options, start, context).run(below);
}

}  // namespace delmesh
