#include "delaunay/slice_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr int axis_rounds = 30;
/// Edges that lean more are cut by planes only.
constexpr double least_slope = 0.1;
/// How far spheres reach, as a share of the shortest edge.
constexpr double near = 0.25;
/// Of a cotangent, in angles of the fan.
constexpr double least_slack = 0.2;

}  // namespace

double SliceLevels::Levels::at(double t) const {
    if (t < near_from) return from + t / near_from * (first - from);
    if (t > 1 - near_to) return to + (1 - t) / near_to * (last - to);
    return first + (t - near_from) / (1 - near_from - near_to) * (last - first);
}

double SliceLevels::Levels::place_of(double level) const {
    const bool up = to > from;
    if (up ? level < first : level > first) return near_from * (level - from) / (first - from);
    if (up ? level > last : level < last) return 1 - near_to * (level - to) / (last - to);
    return near_from + (1 - near_from - near_to) * (level - first) / (last - first);
}

/// At a scale at which squares neither overflow nor vanish.
Vec3 SliceLevels::point(VertexId v) const {
    const Vec3& p = model_.layout().marked().mesh().point(v);
    return {std::ldexp(p.x, -exponent_), std::ldexp(p.y, -exponent_), std::ldexp(p.z, -exponent_)};
}

void SliceLevels::find_axis(std::span<const std::uint32_t> edges) {
    levels_.clear();
    ends_.clear();
    end_of_.fill(IdMap());
    const Mesh& mesh = model_.layout().marked().mesh();
    const auto along = [&](std::uint32_t e) {
        const HalfedgeId h = model_.layout().edge(e).halfedge;
        return mesh.point(mesh.target(h)) - mesh.point(mesh.origin(h));
    };
    double largest = 0;
    for (const std::uint32_t e : edges) {
        const Vec3 d = along(e);
        largest = std::max({largest, std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    }
    (void)std::frexp(largest, &exponent_);
    std::array<Vec3, 3> sum{};
    double longest = 0;
    for (const std::uint32_t e : edges) {
        const Vec3 far = along(e);
        const Vec3 d{std::ldexp(far.x, -exponent_), std::ldexp(far.y, -exponent_), std::ldexp(far.z, -exponent_)};
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

// --- corners ---

void SliceLevels::add_ray(VertexId v, VertexId other, HalfedgeId h) {
    const MarkedMesh& marked = model_.layout().marked();
    if (marked.is_planar(h)) return;
    const Vec3 d = point(other) - point(v);
    const double rise = dot(axis_, d);
    const double length = norm(d);
    const double slope = std::fabs(rise) / length;
    const int direction = !(slope > least_slope) ? 0 : rise > 0 ? 1 : -1;
    rays_.push_back({marked.mesh().edge(h).value(), v < other ? 0u : 1u, direction, d * (1 / std::fabs(rise)), slope,
                     length, marked.mesh().is_boundary(h)});
}

/// True if planes leave an edge of the fan not Delaunay, or hardly Delaunay. What an edge at the rim of the fan sees
/// beyond lets it be, if the surface does not end there.
bool SliceLevels::fails(std::span<const Ray> fan, bool is_closed) {
    const std::size_t n = fan.size();
    for (std::size_t i = 0; i < n; ++i) {
        const bool has_before = is_closed || i > 0;
        const bool has_after = is_closed || i + 1 < n;
        if (!(has_before && has_after) && !fan[i].is_boundary) continue;
        double cot = 0;
        double sine = 0;
        const auto look = [&](const Vec3& from) {
            const Vec3& p = fan[i].at_unit;
            const double area = norm(cross(from, p));
            cot += dot(from, from - p) / area;
            sine += area / (norm(from) * norm(p));
        };
        if (has_before) look(fan[i > 0 ? i - 1 : n - 1].at_unit);
        if (has_after) look(fan[i + 1 < n ? i + 1 : 0].at_unit);
        if (cot < least_slack * sine) return true;
    }
    return false;
}

/// Neighbours that all rise, or all fall.
void SliceLevels::add_fan(std::span<const Ray> fan, bool is_closed) {
    double rise = 0;
    double length = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Ray& ray : fan) {
        rise += ray.slope * ray.length;
        length += ray.length;
        shortest = std::min(shortest, ray.slope * ray.length);
    }
    const double slope = fails(fan, is_closed) ? rise / length : 0;
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const std::size_t others = dents_fans_ && !is_closed ? i * (fan.size() - 1 - i) : 0;
        end_of_[fan[i].end].insert(fan[i].edge, static_cast<std::uint32_t>(ends_.size()));
        ends_.push_back({near * shortest, slope, static_cast<double>(others)});
    }
}

/// Finds the fans about v.
void SliceLevels::look_around(VertexId v) {
    const Mesh& mesh = model_.layout().marked().mesh();
    rays_.clear();
    const HalfedgeId start = mesh.halfedge(v);
    HalfedgeId h = start;
    do {
        add_ray(v, mesh.target(h), h);
        const HalfedgeId next = mesh.next_around(h);
        if (!next.valid()) add_ray(v, mesh.origin(Mesh::prev(h)), Mesh::prev(h));
        h = next;
    } while (h.valid() && h != start);
    if (h.valid()) {
        // A closed fan: it begins where the direction changes.
        const auto differ = [](const Ray& a, const Ray& b) { return a.direction != b.direction; };
        const auto change = std::adjacent_find(rays_.begin(), rays_.end(), differ);
        if (change != rays_.end()) std::rotate(rays_.begin(), change + 1, rays_.end());
    }
    for (std::size_t begin = 0, end = 0; begin < rays_.size(); begin = end) {
        while (end < rays_.size() && rays_[end].direction == rays_[begin].direction) ++end;
        add_fan(std::span(rays_).subspan(begin, end - begin), h.valid() && end - begin == rays_.size());
    }
}

SliceLevels::End SliceLevels::end_at(VertexId v, HalfedgeId h) {
    const Mesh& mesh = model_.layout().marked().mesh();
    const std::uint32_t edge = mesh.edge(h).value();
    const IdMap& known = end_of_[v < mesh.origin(h) || v < mesh.target(h) ? 0 : 1];
    if (known.find(edge) == IdMap::none) look_around(v);
    return ends_[known.find(edge)];
}

// --- levels ---

const SliceLevels::Levels& SliceLevels::levels(std::uint32_t e) {
    if (levels_.size() <= e) levels_.resize(model_.layout().edge_count() + 1);
    if (levels_[e].rounding >= 0) return levels_[e];
    const Mesh& mesh = model_.layout().marked().mesh();
    const HalfedgeId h = model_.layout().edge(e).halfedge;
    const VertexId from = std::min(mesh.origin(h), mesh.target(h));
    const VertexId to = std::max(mesh.origin(h), mesh.target(h));
    const Vec3 p = point(from);
    const Vec3 q = point(to);
    const double low = dot(axis_, p);
    const double high = dot(axis_, q);
    const double length = norm(q - p);
    double farthest = 0;
    for (const int i : {0, 1, 2}) farthest = std::max({farthest, std::fabs(p[i]), std::fabs(q[i])});
    const double rounded = rounding_ * farthest;
    const double slope = (high - low) / length;
    Levels it{low, low, high, high, 0, 0, rounded / length};
    if (std::fabs(slope) > least_slope) {
        const double sign = slope > 0 ? 1 : -1;
        const auto bend = [&](const End& end, double s, double& at_end, double& at_near, double& share) {
            const double steep = end.slope > 0 ? s * end.slope : s * std::fabs(slope);
            at_near = at_end + steep * (end.radius + end.dent * rounded);
            at_end += steep * end.dent * rounded;
            share = end.radius / length;
        };
        bend(end_at(from, h), sign, it.from, it.first, it.near_from);
        bend(end_at(to, h), -sign, it.to, it.last, it.near_to);
    }
    return levels_[e] = it;
}

double SliceLevels::level_of(std::uint32_t side, const Contact& seen) {
    if (seen.edge != SplitModel::none) return levels(seen.edge).at(seen.along);
    const FacetLayout& layout = model_.layout();
    const Mesh& mesh = layout.marked().mesh();
    const Facet facet = layout.facet(layout.facet_at(side));
    const Side frame = layout.side(side);
    double least = std::numeric_limits<double>::infinity();
    VertexId corner;
    for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
        const Side other = layout.side(i);
        const HalfedgeId h = layout.edge(other.edge).halfedge;
        for (const double t : {0.0, 1.0}) {
            const Point2 d = frame.to_frame(other.at(t)) - seen.at;
            if (dot(d, d) >= least) continue;
            least = dot(d, d);
            corner = t == 0 ? std::min(mesh.origin(h), mesh.target(h)) : std::max(mesh.origin(h), mesh.target(h));
        }
    }
    return dot(axis_, point(corner));
}

}  // namespace delmesh
