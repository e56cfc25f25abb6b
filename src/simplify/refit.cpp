#include "simplify/refit.hpp"

#include "simplify/triangle_point.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {

Refitter::Refitter(const Mesh& mesh, std::size_t count, double scale) : scale_(scale) {
    const auto add = [&](const Vec3& point, const Vec3& normal, VertexId near) {
        points_.push_back(point);
        normals_.push_back(normal);
        vertex_.push_back(near.value());
    };
    const auto normal_of = [&](HalfedgeId h) {
        const Frame frame{scale, 1 / scale, mesh.point(mesh.origin(h))};
        return cross(frame.to_local(mesh.point(mesh.target(h))), frame.to_local(mesh.point(mesh.apex(h))));
    };
    for (std::size_t i = 0; i < std::min(count, mesh.vertex_count()); ++i) {
        Vec3 normal;
        each_outgoing(mesh, VertexId(i), [&](HalfedgeId h) { normal = normal + normal_of(h); });
        if (mesh.halfedge(VertexId(i)).valid()) add(mesh.point(VertexId(i)), normal * (1.0 / 12), VertexId(i));
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        const Vec3 third = (mesh.point(mesh.origin(h)) * (1.0 / 3) + mesh.point(mesh.target(h)) * (1.0 / 3)) +
                           mesh.point(mesh.apex(h)) * (1.0 / 3);
        add(third, normal_of(h) * 0.75, mesh.origin(h));
    }
}

/// Every k-th point, standing for the area of k.
void Refitter::choose(std::size_t most) {
    const std::size_t stride = std::max<std::size_t>(1, (points_.size() + most - 1) / most);
    samples_.clear();
    for (std::size_t i = 0; i < points_.size(); i += stride) {
        Sample sample;
        sample.point = points_[i];
        sample.weight = std::sqrt(squared_norm(normals_[i]));
        if (!(sample.weight > 0)) continue;
        sample.normal = normals_[i] * (1 / sample.weight);
        sample.near = VertexId(vertex_[i]);
        samples_.push_back(sample);
    }
}

/// The nearest point of the surface, found by walking downhill from where the sample was last.
void Refitter::project(const Mesh& mesh, Sample& sample) const {
    constexpr int most_steps = 16;
    const Frame frame{scale_, 1 / scale_, sample.point};
    double best = -1;
    VertexId at = sample.near;
    for (int step = 0; step < most_steps; ++step) {
        const double before = best;
        each_outgoing(mesh, at, [&](HalfedgeId h) {
            const TrianglePoint p =
                nearest_on_triangle({}, frame.to_local(mesh.point(at)), frame.to_local(mesh.point(mesh.target(h))),
                                    frame.to_local(mesh.point(mesh.apex(h))));
            if (best >= 0 && !(p.distance2 < best)) return;
            best = p.distance2;
            sample.face = h;
            sample.weights = p.weights;
        });
        if (before >= 0 && !(best < before)) break;
        const auto largest = std::max_element(sample.weights.begin(), sample.weights.end()) - sample.weights.begin();
        const VertexId next = largest == 0   ? mesh.origin(sample.face)
                              : largest == 1 ? mesh.target(sample.face)
                                             : mesh.apex(sample.face);
        if (next == at) break;
        at = next;
    }
    sample.near = at;
    sample.distance2 = best;
}

void Refitter::sort_by_face(const Mesh& mesh) {
    face_start_.assign(mesh.face_count() + 1, 0);
    for (const Sample& s : samples_) ++face_start_[Mesh::face(s.face).index() + 1];
    for (std::size_t f = 0; f < mesh.face_count(); ++f) face_start_[f + 1] += face_start_[f];
    by_face_.resize(samples_.size());
    std::vector<std::uint32_t> next(face_start_.begin(), face_start_.end() - 1);
    for (std::size_t i = 0; i < samples_.size(); ++i)
        by_face_[next[Mesh::face(samples_[i].face).index()]++] = static_cast<std::uint32_t>(i);
}

/// The squared distances of the samples around v, as far as they depend on the place of v, to first order.
bool Refitter::build_cost(const Mesh& mesh, VertexId v, const RefitTuning& tuning, EdgeCost& cost) {
    around_.clear();
    local_.clear();
    own_.clear();
    cost = {};
    std::size_t own_face = 0;
    each_outgoing(mesh, v, [&](HalfedgeId h) {
        const Vec3 b = star_.frame.to_local(mesh.point(mesh.target(h)));
        const Vec3 c = star_.frame.to_local(mesh.point(mesh.apex(h)));
        Vec3 normal = cross(b, c);
        const double length = std::sqrt(squared_norm(normal));
        if (!(length > 0)) return;
        normal = normal * (1 / length);
        while (star_.ring[own_face].vertex != mesh.target(h)) own_face = star_.after(own_face);
        const std::size_t f = Mesh::face(h).index();
        for (std::uint32_t k = face_start_[f]; k < face_start_[f + 1]; ++k) {
            const Sample& s = samples_[by_face_[k]];
            const Vec3 local = star_.frame.to_local(s.point);
            around_.push_back(by_face_[k]);
            own_.push_back(own_face);
            local_.push_back(local);
            // The weights start at s.face; h is a half-edge of the same face.
            const std::size_t turn = (3 + h.value() % 3 - s.face.value() % 3) % 3;
            const double own = s.weights[turn];
            const Vec3 on_face = b * s.weights[(turn + 1) % 3] + c * s.weights[(turn + 2) % 3];
            cost.steered.add_plane(normal * own, dot(normal, local - on_face), s.weight);
        }
    });
    cost.trace = cost.steered.trace();
    if (!(cost.trace > 0)) return false;
    cost.steered.add_point({}, tuning.regular * cost.trace);
    return true;
}

/// The true sum of squared distances of the samples around to the star with its centre at `centre`: each to its own
/// face and the two beside it.
double Refitter::error_around(const Vec3& centre) const {
    double sum = 0;
    double weight = 0;
    const std::size_t faces = star_.face_count();
    for (std::size_t k = 0; k < around_.size(); ++k) {
        double best = -1;
        for (std::size_t i :
             {own_[k] == 0 ? faces - 1 : own_[k] - 1, own_[k], own_[k] + 1 == faces ? 0 : own_[k] + 1}) {
            const TrianglePoint p =
                nearest_on_triangle(local_[k], centre, star_.ring[i].point, star_.ring[star_.after(i)].point);
            if (best < 0 || p.distance2 < best) best = p.distance2;
        }
        sum += samples_[around_[k]].weight * best;
        weight += samples_[around_[k]].weight;
    }
    // The other direction: a few points of the star must not stick out between the samples.
    double heights = height_over_samples(centre);
    for (std::size_t i = 0; i < star_.face_count(); ++i)
        heights += height_over_samples((centre + star_.ring[i].point + star_.ring[star_.after(i)].point) * (1.0 / 3));
    return sum + weight * heights / static_cast<double>(1 + star_.face_count());
}

/// The squared height of x over the tangent plane of the nearest sample.
double Refitter::height_over_samples(const Vec3& x) const {
    double best = -1;
    double height = 0;
    for (std::size_t k = 0; k < around_.size(); ++k) {
        const Vec3 off = x - local_[k];
        const double distance2 = squared_norm(off);
        if (best >= 0 && !(distance2 < best)) continue;
        best = distance2;
        height = dot(off, samples_[around_[k]].normal);
    }
    return height * height;
}

bool Refitter::refit_vertex(Mesh& mesh, VertexId v, Placer& placer, const RefitTuning& tuning,
                            const std::function<Vec3(const Vec3&)>& settle,
                            const std::function<void(VertexId, const Vec3&)>& moved) {
    gather(mesh, v, scale_, star_);
    EdgeCost cost;
    if (!build_cost(mesh, v, tuning, cost)) return false;
    const auto place = placer.improve(star_, cost, Vec3{});
    if (!place || place->cost > (1 - tuning.least_gain) * cost.steered({})) return false;
    const Vec3 w = settle(star_.frame.to_mesh(place->point));
    if (w == mesh.point(v) || !keeps_delaunay(mesh, star_, w)) return false;
    if (!(error_around(star_.frame.to_local(w)) < (1 - tuning.least_gain) * error_around({}))) return false;
    moved(v, w);
    mesh.set_point(v, w);
    return true;
}

std::size_t Refitter::run(Mesh& mesh, std::span<const VertexId> merged_into, Placer& placer, const RefitTuning& tuning,
                          const std::function<Vec3(const Vec3&)>& settle,
                          const std::function<void(VertexId, const Vec3&)>& moved, const Context* context) {
    std::size_t live = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) live += mesh.halfedge(VertexId(v)).valid() ? 1 : 0;
    choose(static_cast<std::size_t>(tuning.samples + tuning.density * static_cast<double>(live)));
    for (Sample& s : samples_)
        while (merged_into[s.near.index()] != s.near) s.near = merged_into[s.near.index()];
    std::size_t moves = 0;
    for (int round = 0; round < tuning.rounds && !is_cancelled(context); ++round) {
        for (Sample& s : samples_) project(mesh, s);
        sort_by_face(mesh);
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            const VertexId id(v);
            if (!mesh.halfedge(id).valid() || mesh.is_boundary(id)) continue;
            moves += refit_vertex(mesh, id, placer, tuning, settle, moved) ? 1 : 0;
        }
    }
    return moves;
}

}  // namespace delmesh
