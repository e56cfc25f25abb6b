#include "delaunay/facet_layout.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/non_delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace delmesh {
namespace {

constexpr std::uint32_t many_sides = 16;

/// An orthonormal frame of the plane of a triangle, with its longest side along x.
struct Plane {
    Vec3 origin;
    Vec3 x;
    Vec3 y;
    double scale = 0;  ///< makes the longest side 1

    [[nodiscard]] Point2 operator()(const Vec3& p) const {
        const Vec3 d = scale * (p - origin);
        return {dot(x, d), dot(y, d)};
    }
};

Plane plane_of(const std::array<Vec3, 3>& corners) {
    int longest = 0;
    double length = 0;
    for (int i = 0; i < 3; ++i) {
        const double candidate = norm(corners[(i + 1) % 3] - corners[i]);
        if (candidate <= length) continue;
        longest = i;
        length = candidate;
    }
    Plane plane;
    plane.origin = corners[longest];
    plane.scale = 1 / length;
    plane.x = plane.scale * (corners[(longest + 1) % 3] - plane.origin);
    plane.x = (1 / norm(plane.x)) * plane.x;
    const Vec3 d = plane.scale * (corners[(longest + 2) % 3] - plane.origin);
    plane.y = d - dot(plane.x, d) * plane.x;
    // Twice, as needles lose most digits the first time.
    for (int i = 0; i < 2; ++i) {
        plane.y = plane.y - dot(plane.x, plane.y) * plane.x;
        plane.y = (1 / norm(plane.y)) * plane.y;
    }
    return plane;
}

double largest_coordinate(const Mesh& mesh) {
    double largest = 0;
    for (const Vec3& p : mesh.points())
        for (int axis = 0; axis < 3; ++axis) largest = std::fmax(largest, std::fabs(p[axis]));
    return largest;
}

}  // namespace

FacetLayout::FacetLayout(const MarkedMesh& marked)
    : marked_(marked),
      mesh_(marked.mesh()),
      facet_of_face_(mesh_.face_count()),
      edge_of_halfedge_(mesh_.halfedge_count()) {
    const double largest = largest_coordinate(mesh_);
    if (!(largest > 0)) return;
    // A power of two, in two factors since one may overflow, brings all coordinates below 1.
    const int exponent = -std::ilogb(largest) - 1;
    scale_ = std::ldexp(1.0, exponent / 2);
    second_scale_ = std::ldexp(1.0, exponent - exponent / 2);
}

FacetLayout::FacetLayout(const MarkedMesh& marked, const FacetLayout& other)
    : marked_(marked),
      mesh_(marked.mesh()),
      scale_(other.scale_),
      second_scale_(other.second_scale_),
      facet_of_face_(mesh_.face_count()),
      edge_of_halfedge_(mesh_.halfedge_count()) {}

Vec3 FacetLayout::scaled(VertexId v) const {
    return second_scale_ * (scale_ * mesh_.point(v));
}

/// No memory holds so many.
void FacetLayout::check_size(std::size_t count) {
    if (count > mask) throw std::length_error("FacetLayout");
}

std::uint32_t FacetLayout::name_edge(HalfedgeId h) {
    const HalfedgeId name(mesh_.edge(h).value());
    const std::uint32_t known = edge_of_halfedge_.find(name.value());
    if (known != none) return known;
    check_size(edges_.size());
    const auto e = static_cast<std::uint32_t>(edges_.size());
    edge_of_halfedge_.insert(name.value(), e);
    Edge edge;
    edge.halfedge = name;
    edge.is_delaunay = knows_bad_ ? !is_bad_[name.index()] : !is_non_delaunay(mesh_, name);
    edges_.push_back(edge);
    return e;
}

std::uint32_t FacetLayout::edge_of(HalfedgeId h) {
    const std::uint32_t e = name_edge(h);
    complete(e);
    return e;
}

void FacetLayout::complete(std::uint32_t edge) {
    const HalfedgeId h = edges_[edge].halfedge;
    facet_of(Mesh::face(h));
    if (!mesh_.is_boundary(h)) facet_of(Mesh::face(mesh_.twin(h)));
}

void FacetLayout::know_bad(std::span<const EdgeId> bad) {
    is_bad_.assign(mesh_.halfedge_count(), false);
    for (const EdgeId e : bad) is_bad_[e.index()] = true;
    knows_bad_ = true;
}

void FacetLayout::expect(std::size_t facets) {
    facets_.reserve(std::min(facets_.size() + facets, mesh_.face_count()));
    records_.reserve(std::min(records_.size() + 3 * facets, mesh_.halfedge_count()));
    corners_.reserve(std::min(corners_.size() + 3 * facets, mesh_.halfedge_count()));
    edges_.reserve(std::min(edges_.size() + 2 * facets, mesh_.halfedge_count()));
    facet_of_face_.expect(std::min(facets_.size() + facets, mesh_.face_count()));
    edge_of_halfedge_.expect(std::min(edges_.size() + 3 * facets / 2, mesh_.halfedge_count()));
}

std::uint32_t FacetLayout::facet_of(FaceId f) {
    const std::uint32_t known = facet_of_face_.find(f.value());
    if (known != none) return known;
    check_size(facets_.size());
    const auto id = static_cast<std::uint32_t>(facets_.size());
    gather(f, id);
    Facet facet;
    facet.first_side = static_cast<std::uint32_t>(records_.size());
    facet.single = faces_.size() == 1;
    const auto first_triangle = static_cast<std::uint32_t>(triangles_.size());
    if (facet.single) {
        std::array<Vec3, 3> corners;
        for (int i = 0; i < 3; ++i) corners[i] = scaled(mesh_.origin(HalfedgeId(3 * f.value() + i)));
        const Plane plane = plane_of(corners);
        SideRecord record;
        record.facet = id & mask;
        record.place = static_cast<std::uint32_t>(corners_.size());
        for (const Vec3& corner : corners) corners_.push_back(plane(corner));
        for (std::uint32_t i = 0; i < 3; ++i) add_side(HalfedgeId(3 * f.value() + i), record);
    } else {
        lay_corners();
        for (const FaceId g : faces_) add_triangle(g, id, first_triangle);
    }
    facet.side_count = (static_cast<std::uint32_t>(records_.size()) - facet.first_side) & mask;
    if (!facet.single && facet.side_count >= many_sides) {
        facet.kept = static_cast<std::uint32_t>(sides_.size());
        for (std::uint32_t s = facet.first_side; s < records_.size(); ++s) sides_.push_back(make_side(records_[s]));
    }
    facets_.push_back(facet);
    return id;
}

void FacetLayout::gather(FaceId f, std::uint32_t facet) {
    faces_.assign(1, f);
    facet_of_face_.insert(f.value(), facet);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const HalfedgeId h(3 * faces_[i].value() + k);
            if (!marked_.is_planar(h)) continue;
            const FaceId g = Mesh::face(mesh_.twin(h));
            if (facet_of_face_.find(g.value()) != none) continue;
            facet_of_face_.insert(g.value(), facet);
            faces_.push_back(g);
        }
    }
    std::sort(faces_.begin(), faces_.end());
}

void FacetLayout::lay_corners() {
    double largest = -1;
    Plane plane;
    local_corners_.clear();
    for (const FaceId f : faces_) {
        std::array<Vec3, 3> corners;
        for (int i = 0; i < 3; ++i) {
            const VertexId v = mesh_.origin(HalfedgeId(3 * f.value() + i));
            corners[i] = scaled(v);
            local_corners_.emplace_back(v, 0u);
        }
        const double area = norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
        if (!(area > largest)) continue;
        largest = area;
        plane = plane_of(corners);
    }
    sort_unique(local_corners_);
    for (auto& [v, index] : local_corners_) {
        index = static_cast<std::uint32_t>(corners_.size());
        corners_.push_back(plane(scaled(v)));
    }
}

std::uint32_t FacetLayout::corner_of(VertexId v) const {
    return std::lower_bound(local_corners_.begin(), local_corners_.end(), std::pair(v, 0u))->second;
}

void FacetLayout::add_triangle(FaceId f, std::uint32_t facet, std::uint32_t first_triangle) {
    SideRecord record;
    record.facet = facet & mask;
    record.place = static_cast<std::uint32_t>(triangles_.size());
    record.single = false;
    FacetTriangle& triangle = triangles_.emplace_back();
    for (std::uint32_t i = 0; i < 3; ++i) {
        const HalfedgeId h(3 * f.value() + i);
        triangle.corner[i] = corner_of(mesh_.origin(h));
        triangle.is_side[i] = !marked_.is_planar(h);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
        const HalfedgeId h(3 * f.value() + i);
        if (triangle.is_side[i]) {
            triangle.beyond[i] = static_cast<std::uint32_t>(records_.size());
            add_side(h, record);
        } else {
            const auto place = std::lower_bound(faces_.begin(), faces_.end(), Mesh::face(mesh_.twin(h)));
            triangle.beyond[i] = first_triangle + static_cast<std::uint32_t>(place - faces_.begin());
        }
    }
}

void FacetLayout::add_side(HalfedgeId h, SideRecord record) {
    const bool forward = mesh_.origin(h) < mesh_.target(h);
    record.corner = (h.value() + 2) % 3 & 3;
    record.forward = forward;
    record.edge = name_edge(h) & mask;
    const auto s = static_cast<std::uint32_t>(records_.size());
    records_.push_back(record);
    const Side made = make_side(record);
    const bool usable = std::isfinite(1 / dot(made.along, made.along)) && std::isfinite(made.apex.x) && made.apex.y > 0;
    Edge& edge = edges_[record.edge];
    edge.side[forward ? 0 : 1] = s;
    edge.is_usable = edge.is_usable && usable;
}

}  // namespace delmesh
