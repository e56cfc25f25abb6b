#include "simplify/sample_source.hpp"

#include "simplify/frame.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

SampleSource::Facing facing_along(const Vec3& normal) {
    SampleSource::Facing facing;
    const double length = std::sqrt(squared_norm(normal));
    if (length > 0)
        for (int axis = 0; axis < 3; ++axis) facing.normal[axis] = static_cast<float>(normal[axis] / length);
    facing.weight = static_cast<float>(length);
    return facing;
}

Vec3 normal_of(double scale, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Frame frame{scale, 1 / scale, a};
    return cross(frame.to_local(b), frame.to_local(c));
}

/// Holds single precision this place, to the last bit?
bool is_short(const Vec3& p) {
    const auto fits = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
    return fits(p.x) && fits(p.y) && fits(p.z);
}

}  // namespace

SampleSource::SampleSource(const Mesh& mesh, std::size_t count, double scale, std::size_t most) : scale_(scale) {
    const std::size_t vertices = std::min(count, mesh.vertex_count());
    const std::size_t faces = mesh.face_count();
    stride_ = std::max<std::size_t>(1, (vertices + faces) / std::max<std::size_t>(1, most));
    keep_places(mesh);
    at_vertices_.reserve(vertices / stride_ + 1);
    for (std::size_t i = 0; i < vertices; i += stride_) {
        const VertexId v(i);
        if (!mesh.halfedge(v).valid()) continue;
        Vec3 normal;
        each_outgoing(mesh, v, [&](HalfedgeId h) {
            normal = normal + normal_of(scale, mesh.point(v), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)));
        });
        at_vertices_.push_back({v, facing_along(normal * (1.0 / 12))});
    }
    on_faces_.reserve(faces / stride_ + 1);
    for (std::size_t f = 0; f < faces; f += stride_) {
        const auto at = mesh.corners().subspan(3 * f, 3);
        on_faces_.push_back({at[0], at[1], at[2]});
    }
}

void SampleSource::keep_places(const Mesh& mesh) {
    const auto points = mesh.points();
    const auto first_long = std::find_if_not(points.begin(), points.end(), is_short);
    short_.reserve(static_cast<std::size_t>(first_long - points.begin()));
    for (auto p = points.begin(); p != first_long; ++p)
        short_.push_back({static_cast<float>(p->x), static_cast<float>(p->y), static_cast<float>(p->z)});
    long_.assign(first_long, points.end());
}

Vec3 SampleSource::place(VertexId v) const {
    if (v.index() >= short_.size()) return long_[v.index() - short_.size()];
    const auto& [x, y, z] = short_[v.index()];
    return {x, y, z};
}

Vec3 SampleSource::point(std::size_t i) const {
    if (i < at_vertices_.size()) return place(at_vertices_[i].vertex);
    const auto& [a, b, c] = corners(i);
    return (place(a) * (1.0 / 3) + place(b) * (1.0 / 3)) + place(c) * (1.0 / 3);
}

SampleSource::Facing SampleSource::facing(std::size_t i) const {
    if (i < at_vertices_.size()) return at_vertices_[i].facing;
    const auto& [a, b, c] = corners(i);
    return facing_along(normal_of(scale_, place(a), place(b), place(c)) * 0.75);
}

VertexId SampleSource::near(std::size_t i) const {
    return i < at_vertices_.size() ? at_vertices_[i].vertex : corners(i)[0];
}

FaceId SampleSource::face(const Mesh& mesh, std::size_t i) const {
    if (i < at_vertices_.size()) return Mesh::face(mesh.halfedge(at_vertices_[i].vertex));
    return FaceId((i - at_vertices_.size()) * stride_);
}

}  // namespace delmesh
