#include "simplify/star.hpp"

#include "exact/inline.hpp"

#include <cmath>

namespace delmesh {
namespace {

/// Cotangents this far below zero still make a proposal, so that co-circular points are left to the exact check.
constexpr double rounding_allowance = 1e-12;
/// The least cosine between the normals of a face before and after.
constexpr double least_turn_cosine = 0.1;

class Gatherer {
public:
    Gatherer(const Mesh& mesh, Star& star) : mesh_(mesh), star_(star) {}

    /// Adds the faces at `centre` from the one of `at` on, until `stop` or the boundary. Returns the last half-edge.
    HalfedgeId walk(HalfedgeId at, HalfedgeId stop, const Vec3& centre) {
        HalfedgeId last;
        while (at.valid() && at != stop) {
            add_corner(at, centre);
            last = at;
            at = mesh_.next_around(at);
        }
        return last;
    }

    void add_end(VertexId vertex) {
        Star::Corner& corner = star_.ring.emplace_back();
        corner.vertex = vertex;
        corner.point = local(vertex);
    }

private:
    [[nodiscard]] Vec3 local(VertexId v) const { return star_.frame.to_local(mesh_.point(v)); }

    void add_corner(HalfedgeId at, const Vec3& centre) {
        Star::Corner& corner = star_.ring.emplace_back();
        corner.vertex = mesh_.target(at);
        corner.face = Mesh::face(at);
        corner.across = Mesh::next(at);
        corner.point = corner.vertex == next_ ? next_point_ : local(corner.vertex);
        next_ = mesh_.apex(at);
        next_point_ = local(next_);
        corner.old_normal = cross(corner.point - centre, next_point_ - centre);
    }

    VertexId next_;  ///< the end of the face before
    Vec3 next_point_;
    const Mesh& mesh_;
    Star& star_;
};

/// The neighbours of one end are distinct by themselves; across the two ends they must be so as well.
bool are_distinct(const std::vector<Star::Corner>& ring, std::size_t first, std::size_t second) {
    for (std::size_t i = first; i < second; ++i)
        for (std::size_t j = 0; j < ring.size(); ++j)
            if (ring[i].vertex == ring[j].vertex && i != j) return false;
    return true;
}

bool gather_open(const Mesh& mesh, HalfedgeId h, Star& star, const Vec3& u_point, const Vec3& v_point) {
    Gatherer gatherer(mesh, star);
    const HalfedgeId t = mesh.twin(h);
    std::size_t first = 0;
    std::size_t second = 0;
    if (t.valid()) {
        gatherer.walk(mesh.halfedge(mesh.origin(h)), Mesh::next(t), u_point);
        first = star.ring.size();
        gatherer.walk(mesh.twin(Mesh::prev(t)), Mesh::next(h), v_point);
        second = star.ring.size();
    } else {
        gatherer.walk(mesh.halfedge(mesh.target(h)), Mesh::next(h), v_point);
        second = star.ring.size();
    }
    const HalfedgeId last = gatherer.walk(mesh.twin(Mesh::prev(h)), HalfedgeId(), u_point);
    gatherer.add_end(last.valid() ? mesh.apex(last) : mesh.apex(h));
    return star.ring.size() >= 2 && are_distinct(star.ring, first, second);
}

bool gather_closed(const Mesh& mesh, HalfedgeId h, Star& star) {
    const HalfedgeId t = mesh.twin(h);
    Gatherer gatherer(mesh, star);
    gatherer.walk(mesh.twin(Mesh::prev(h)), Mesh::next(t), star.u_point);
    const std::size_t second = star.ring.size();
    gatherer.walk(mesh.twin(Mesh::prev(t)), Mesh::next(h), star.v_point);
    return star.ring.size() >= 3 && are_distinct(star.ring, 0, second);
}

Vec3 face_normal(const Star& star, const Vec3& a) {
    return cross(star.v_point - star.u_point, a - star.u_point);
}

}  // namespace

bool gather(const Mesh& mesh, HalfedgeId h, double scale, Star& star) {
    const HalfedgeId t = mesh.twin(h);
    star.u = mesh.origin(h);
    star.v = mesh.target(h);
    star.ring.clear();  // nothing of the last edge is left where this one has no star
    const bool u_open = mesh.is_boundary(star.u);
    const bool v_open = mesh.is_boundary(star.v);
    if (t.valid() && u_open && v_open) return false;
    star.frame = {scale, 1 / scale, mesh.point(star.u)};
    star.u_point = {};
    star.v_point = star.frame.to_local(mesh.point(star.v));
    star.closed = !u_open && !v_open;
    star.has_outers = false;
    star.dying_count = 0;
    star.dying_face[0] = Mesh::face(h);
    star.dying[star.dying_count++] = face_normal(star, star.frame.to_local(mesh.point(mesh.apex(h))));
    if (t.valid()) star.dying_face[1] = Mesh::face(t);
    if (t.valid()) star.dying[star.dying_count++] = -face_normal(star, star.frame.to_local(mesh.point(mesh.apex(t))));
    if (star.closed) return gather_closed(mesh, h, star);
    if (t.valid() && v_open) return gather_open(mesh, t, star, star.v_point, star.u_point);
    return gather_open(mesh, h, star, star.u_point, star.v_point);
}

void gather(const Mesh& mesh, VertexId v, double scale, Star& star) {
    star.u = star.v = v;
    star.frame = {scale, 1 / scale, mesh.point(v)};
    star.u_point = star.v_point = {};
    star.closed = !mesh.is_boundary(v);
    star.has_outers = false;
    star.ring.clear();
    star.dying_count = 0;
    Gatherer gatherer(mesh, star);
    const HalfedgeId start = mesh.halfedge(v);
    if (!star.closed) {
        gatherer.add_end(mesh.apex(gatherer.walk(start, HalfedgeId(), {})));
        return;
    }
    gatherer.walk(mesh.next_around(start), start, {});
    gatherer.walk(start, mesh.next_around(start), {});
}

namespace {

/// Cotangents of the angles of the face (w, a, b), and whether it keeps its side.
struct FaceAngles {
    double at_w, at_a, at_b;
    bool turned;
};

FaceAngles face_angles(const Star::Corner& corner, const Vec3& a, const Vec3& b) {
    const Vec3 side = b - a;
    const Vec3 n = cross(a, b);
    const double area = std::sqrt(squared_norm(n));
    const double inverse = 1 / area;
    const double turn = dot(n, corner.old_normal);
    const double old2 = squared_norm(corner.old_normal);
    const bool kept = turn > 0 && turn * turn > least_turn_cosine * least_turn_cosine * old2 * area * area;
    return {dot(a, b) * inverse, -dot(a, side) * inverse, dot(b, side) * inverse, !kept};
}

/// Of the faces and edges at w.
Blocker find_inner_blocker(Star& star, const Vec3& w, std::size_t& first) {
    const std::size_t faces = star.face_count();
    if (first >= faces) first = 0;
    const auto angles = [&](std::size_t i) {
        const FaceAngles found = face_angles(star.ring[i], star.ring[i].point - w, star.ring[star.after(i)].point - w);
        star.ring[i].cot_at_w = found.at_w;
        return found;
    };
    // Face i holds the angle at ring[i], opposite to the spoke to ring[i+1], and the other way round.
    FaceAngles start = angles(first);
    FaceAngles previous = start;
    std::size_t i = first;
    for (std::size_t step = 0;; ++step) {
        if (previous.turned) return first = i, Blocker::fold;
        const bool at_end = !star.closed && i + 1 == faces;
        if (!star.closed && i == 0 && !(previous.at_b >= -rounding_allowance)) return first = i, Blocker::incident;
        if (at_end && !(previous.at_a >= -rounding_allowance)) return first = i, Blocker::incident;
        if (step + 1 == faces) {
            if (!star.closed && first == 0) return Blocker::none;
            return previous.at_a + start.at_b >= -rounding_allowance ? Blocker::none : (first = i, Blocker::incident);
        }
        const std::size_t next = at_end ? 0 : star.after(i);
        const FaceAngles current = angles(next);
        // The spoke to ring[next] lies between face i and face `next`.
        if (!at_end && !(previous.at_a + current.at_b >= -rounding_allowance)) return first = i, Blocker::incident;
        previous = current;
        i = next;
    }
}

}  // namespace

void find_outers(const Mesh& mesh, Star& star) {
    if (star.has_outers) return;
    star.has_outers = true;
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        Star::Corner& corner = star.ring[i];
        const HalfedgeId outside = mesh.twin(corner.across);
        if (!outside.valid()) continue;
        corner.outer = mesh.apex(outside);
        const Vec3 o = corner.outer_point = star.frame.to_local(mesh.point(corner.outer));
        const Vec3 a = corner.point - o;
        const Vec3 b = star.ring[star.after(i)].point - o;
        corner.outer_cot = dot(a, b) / std::sqrt(squared_norm(cross(a, b)));
    }
}

Blocker find_blocker(const Mesh& mesh, Star& star, const Vec3& w, std::size_t& first) {
    const Blocker blocker = find_inner_blocker(star, w, first);
    if (blocker != Blocker::none) return blocker;
    find_outers(mesh, star);
    for (std::size_t i = 0; i < star.face_count(); ++i)
        if (!(star.ring[i].cot_at_w + star.ring[i].outer_cot >= -rounding_allowance))
            return first = i, Blocker::subtending;
    return Blocker::none;
}

bool turns_over(const Star& star, const Vec3& w) {
    for (std::size_t i = 0; i < star.face_count(); ++i)
        if (face_angles(star.ring[i], star.ring[i].point - w, star.ring[star.after(i)].point - w).turned) return true;
    return false;
}

bool keeps_area(const Mesh& mesh, const Star& star, const Vec3& w) {
    for (std::size_t i = 0; i < star.face_count(); ++i)
        if (exact::are_collinear_inline(mesh.point(star.ring[i].vertex), mesh.point(star.ring[star.after(i)].vertex),
                                        w))
            return false;
    return true;
}

bool keeps_delaunay(const Mesh& mesh, const Star& star, const Vec3& w) {
    if (!keeps_area(mesh, star, w)) return false;
    const std::size_t faces = star.face_count();
    const std::size_t size = star.ring.size();
    const auto point = [&](std::size_t i) -> const Vec3& { return mesh.point(star.ring[i].vertex); };
    // Two faces back to back see w in each other.
    const auto opposite = [&](VertexId v) -> const Vec3& { return v == star.u || v == star.v ? w : mesh.point(v); };
    for (std::size_t i = 0; i < faces; ++i) {
        const Vec3& p = point(i);
        const Vec3& q = point(star.after(i));
        const VertexId outer = star.ring[i].outer;
        const Sign sign = outer.valid() ? exact::delaunay_sign_inline(p, q, w, opposite(outer))
                                        : exact::right_angle_sign_inline(p, q, w);
        if (sign == Sign::negative) return false;
    }
    for (std::size_t i = 0; i < size; ++i) {
        const bool first = !star.closed && i == 0;
        const bool last = !star.closed && i + 1 == size;
        const Vec3& before = point(i == 0 ? size - 1 : i - 1);
        const Vec3& after = point(star.after(i));
        const Sign sign = first  ? exact::right_angle_sign_inline(w, point(i), after)
                          : last ? exact::right_angle_sign_inline(w, point(i), before)
                                 : exact::delaunay_sign_inline(w, point(i), before, after);
        if (sign == Sign::negative) return false;
    }
    return true;
}

}  // namespace delmesh
