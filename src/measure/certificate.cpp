// Walks the half-edges in order. The filter is inlined; only what it can not decide goes to the exact predicates.

#include "delmesh/measure/certificate.hpp"

#include "base/parallel.hpp"
#include "base/prefetch.hpp"
#include "delmesh/exact/predicates.hpp"
#include "exact/filter.hpp"
#include "measure/angle.hpp"

#include <utility>

namespace delmesh {
namespace {

using measure::PlaneDirection;

constexpr std::size_t faces_per_block = 1 << 14;
constexpr std::size_t max_offenders = 16;

/// The certificate of a run of faces and of the edges they name.
class FaceRun {
public:
    explicit FaceRun(const Mesh& mesh) : mesh_(mesh) {}

    Certificate check(std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            if (f + corners_ahead < end) fetch_corners(f + corners_ahead);
            if (f + apexes_ahead < end) fetch_apexes(f + apexes_ahead);
            check_face(FaceId(f));
        }
        if (part_.worst_edge) part_.worst_excess_deg = worst_.radians() * measure::degrees_per_radian;
        part_.complete = true;
        return std::move(part_);
    }

private:
    // On meshes in random order a check waits for memory: ask for it some faces ahead. An apex is known only by way of
    // its face, so that comes first.
    static constexpr std::size_t corners_ahead = 16;
    static constexpr std::size_t apexes_ahead = 8;

    DELMESH_ALWAYS_INLINE void fetch_corners(std::size_t f) const {
        for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
            prefetch(&mesh_.point(mesh_.origin(HalfedgeId(h))));
            const HalfedgeId t = mesh_.twin(HalfedgeId(h));
            if (t.valid() && t.index() > h) prefetch(&mesh_.corners()[t.index()]);
        }
    }
    DELMESH_ALWAYS_INLINE void fetch_apexes(std::size_t f) const {
        for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
            const HalfedgeId t = mesh_.twin(HalfedgeId(h));
            if (t.valid() && t.index() > h) prefetch(&mesh_.point(mesh_.apex(t)));
        }
    }

    void check_face(FaceId f) {
        const HalfedgeId h = Mesh::halfedge(f);
        const HalfedgeId h1(h.value() + 1);
        const HalfedgeId h2(h.value() + 2);
        const Vec3& a = mesh_.point(mesh_.origin(h));
        const Vec3& b = mesh_.point(mesh_.origin(h1));
        const Vec3& c = mesh_.point(mesh_.origin(h2));
        const Vec3 ab = b - a;
        const Vec3 bc = c - b;
        const Vec3 ca = a - c;
        if (!exact::are_clearly_independent(ab, bc) && are_collinear(a, b, c)) ++part_.degenerate_faces;
        // Differences are exact up to sign: p - u = -(u - p), and the filter's formula is even in each pair.
        check_edge(h, a, b, c, ca, bc);
        check_edge(h1, b, c, a, ab, ca);
        check_edge(h2, c, a, b, bc, ab);
    }

    /// The edge pq with apex u; up = p - u and qu = u - q.
    void check_edge(HalfedgeId h, const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& up, const Vec3& qu) {
        const HalfedgeId t = mesh_.twin(h);
        if (!t.valid()) {
            check_boundary(h, p, q, u);
        } else if (h < t) {
            const Vec3& v = mesh_.point(mesh_.apex(t));
            const auto filtered = exact::delaunay_estimate(up, -qu, p - v, q - v).sign();
            const Sign sign = filtered ? *filtered : decide(p, q, u, v);
            if (sign == Sign::negative) note_interior(h, p, q, u, v);
        }
    }

    Sign decide(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
        if (u == p || u == q || v == p || v == q) return Sign::zero;  // an angle without a limit
        Tier tier = Tier::filter;
        const Sign sign = delaunay_sign(p, q, u, v, &tier);
        if (tier != Tier::filter) ++part_.exact_edges;
        return sign;
    }

    void check_boundary(HalfedgeId h, const Vec3& p, const Vec3& q, const Vec3& u) {
        Tier tier = Tier::filter;
        const Sign sign = right_angle_sign(p, q, u, &tier);
        if (tier != Tier::filter) ++part_.exact_edges;
        if (sign != Sign::negative) return;
        ++part_.obtuse_boundary_edges;
        const PlaneDirection angle = measure::angle_at(u, p, q);
        note_offender(h, {angle.sine, -angle.cosine});  // the angle less pi/2
    }

    void note_interior(HalfedgeId h, const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
        ++part_.non_delaunay_edges;
        const PlaneDirection sum = measure::angle_at(u, p, q) * measure::angle_at(v, p, q);
        note_offender(h, {-sum.cosine, -sum.sine});  // the sum less pi
    }

    /// Excesses lie in (0, pi]: the larger one is counter-clockwise of the other. No arc tangent for each edge.
    void note_offender(HalfedgeId h, PlaneDirection excess) {
        if (part_.offenders.size() < max_offenders) part_.offenders.push_back(EdgeId(h.value()));
        excess.sine = std::max(excess.sine, 0.0);  // rounding may make an excess of 1e-17 negative
        const double turn = worst_.cosine * excess.sine - worst_.sine * excess.cosine;
        const bool larger = turn > 0 || (turn == 0 && excess.cosine < 0 && worst_.cosine > 0);
        if (part_.worst_edge && !larger) return;
        worst_ = excess;
        part_.worst_edge = EdgeId(h.value());
    }

    const Mesh& mesh_;
    Certificate part_;
    PlaneDirection worst_;
};

/// Adds the certificate of the faces that follow.
void append(Certificate& whole, const Certificate& part) {
    whole.complete = whole.complete && part.complete;
    whole.non_delaunay_edges += part.non_delaunay_edges;
    whole.obtuse_boundary_edges += part.obtuse_boundary_edges;
    whole.degenerate_faces += part.degenerate_faces;
    whole.exact_edges += part.exact_edges;
    if (part.worst_edge && (!whole.worst_edge || part.worst_excess_deg > whole.worst_excess_deg)) {
        whole.worst_edge = part.worst_edge;
        whole.worst_excess_deg = part.worst_excess_deg;
    }
    for (const EdgeId e : part.offenders)
        if (whole.offenders.size() < max_offenders) whole.offenders.push_back(e);
}

}  // namespace

Certificate certify(const Mesh& mesh, const Context* context) {
    report_progress(context, "certify", 0);
    std::vector<Certificate> parts(mesh.face_count() / faces_per_block + 1);
    for (Certificate& part : parts) part.complete = true;
    const auto run = [&](std::size_t begin, std::size_t end) {
        Certificate& part = parts[begin / faces_per_block];
        part = is_cancelled(context) ? Certificate() : FaceRun(mesh).check(begin, end);
    };
    parallel_blocks(mesh.face_count(), context, run, faces_per_block);
    Certificate whole;
    whole.complete = true;
    for (const Certificate& part : parts) append(whole, part);
    whole.certified = whole.complete && whole.non_delaunay_edges == 0 && whole.obtuse_boundary_edges == 0 &&
                      whole.degenerate_faces == 0;
    report_progress(context, "certify", 1);
    return whole;
}

}  // namespace delmesh
