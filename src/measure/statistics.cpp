#include "delmesh/measure/statistics.hpp"

#include "base/parallel.hpp"
#include "base/prefetch.hpp"
#include "exact/filter.hpp"
#include "measure/angle.hpp"
#include "mesh/bounding_box.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <numeric>
#include <optional>

namespace delmesh {
namespace {

using measure::PlaneDirection;

constexpr std::size_t faces_per_block = 1 << 14;
/// Points are asked for so many faces ahead: on meshes in random order the loop waits for memory.
constexpr std::size_t faces_ahead = 12;

/// The two thresholds as squared cosines: cos^2 = numerator / 4, on the side of `sign`.
struct Threshold {
    double numerator;
    Sign sign;
};
constexpr Threshold small_angle{3, Sign::positive};  // below 30 degrees: cos > 0 and 4 cos^2 > 3
constexpr Threshold large_angle{1, Sign::negative};  // above 120 degrees: cos < 0 and 4 cos^2 > 1

/// True if the angle at u of the triangle (u, p, q) is beyond the threshold, in rational numbers.
bool is_beyond_exactly(const Threshold& threshold, const Vec3& u, const Vec3& p, const Vec3& q) {
    using Rational = boost::multiprecision::cpp_rational;
    Rational ab = 0, aa = 0, bb = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Rational a = Rational(p[axis]) - Rational(u[axis]);
        const Rational b = Rational(q[axis]) - Rational(u[axis]);
        ab += a * b;
        aa += a * a;
        bb += b * b;
    }
    return ab.sign() == static_cast<int>(threshold.sign) && 4 * ab * ab > Rational(threshold.numerator) * aa * bb;
}

/// Says if the angle is beyond the threshold; nothing if rounding leaves that open. `dot` = a.b, `squares` = |a|^2
/// |b|^2 for the rounded differences a and b. Errors in units of |a|^2 |b|^2 and of the unit roundoff: 44 of 4 dot^2,
/// 36 of the product, 4 of the difference.
std::optional<bool> is_beyond(const Threshold& threshold, double dot, double squares) {
    const double excess = 4 * dot * dot - threshold.numerator * squares;
    const double bound = 100 * exact::unit_roundoff * squares;
    if (excess < -bound) return false;
    if (excess > bound) return (dot > 0) == (threshold.sign == Sign::positive);
    return std::nullopt;
}

/// True if the first angle is smaller, both in [0, pi].
bool is_smaller(PlaneDirection a, PlaneDirection b) {
    const double turn = a.cosine * b.sine - a.sine * b.cosine;
    return turn > 0 || (turn == 0 && a.cosine > 0 && b.cosine < 0);
}

/// The angle statistics of a run of faces.
class AngleRun {
public:
    std::size_t small = 0;
    std::size_t large = 0;
    std::size_t faces = 0;

    void add(const Mesh& mesh, std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const VertexId* corner = &mesh.corners()[3 * f];
            if (f + faces_ahead < end)
                for (std::size_t i = 0; i < 3; ++i) prefetch(&mesh.point(corner[3 * faces_ahead + i]));
            add_face(mesh.point(corner[0]), mesh.point(corner[1]), mesh.point(corner[2]));
        }
    }

    void append(const AngleRun& next) {
        if (next.faces == 0) return;
        const bool first = faces == 0;
        if (first || is_smaller(next.smallest_, smallest_)) smallest_ = next.smallest_;
        if (first || is_smaller(largest_, next.largest_)) largest_ = next.largest_;
        small += next.small;
        large += next.large;
        faces += next.faces;
    }

    [[nodiscard]] AngleStatistics result() const {
        if (faces == 0) return {};
        const double angles = 3 * static_cast<double>(faces);
        return {smallest_.radians() * measure::degrees_per_radian, largest_.radians() * measure::degrees_per_radian,
                100 * static_cast<double>(small) / angles, 100 * static_cast<double>(large) / angles};
    }

private:
    void add_face(const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 ab = b - a;
        const Vec3 bc = c - b;
        const Vec3 ca = a - c;
        const double bc2 = squared_norm(bc);
        const double ca2 = squared_norm(ca);
        const double ab2 = squared_norm(ab);
        const double low = std::min(bc2, std::min(ca2, ab2));
        const double high = std::max(bc2, std::max(ca2, ab2));
        if (!(low > exact::smallest_square && high < exact::largest_square)) return add_extreme_face(a, b, c);
        const double at_a = -dot(ab, ca);
        const double at_b = -dot(bc, ab);
        const double at_c = -dot(ca, bc);
        count(at_a, ab2 * ca2, a, b, c);
        count(at_b, bc2 * ab2, b, c, a);
        count(at_c, ca2 * bc2, c, a, b);
        // The smallest angle faces the shortest edge. The two shorter edges give the area with the least rounding.
        const double smallest = bc2 == low ? at_a : ca2 == low ? at_b : at_c;
        const double largest = bc2 == high ? at_a : ca2 == high ? at_b : at_c;
        const Vec3 normal = bc2 == high ? cross(ca, ab) : ca2 == high ? cross(ab, bc) : cross(bc, ca);
        const double twice_area = std::sqrt(squared_norm(normal));
        extend({smallest, twice_area}, {largest, twice_area});
    }

    /// Any scale: each edge is brought to length one or so by its own power of two.
    void add_extreme_face(const Vec3& a, const Vec3& b, const Vec3& c) {
        if (a == b || b == c || c == a) return add_collapsed_face(a == b && b == c);
        PlaneDirection smallest = add_extreme_corner(a, b, c);
        PlaneDirection largest = smallest;
        for (const PlaneDirection angle : {add_extreme_corner(b, c, a), add_extreme_corner(c, a, b)}) {
            if (is_smaller(angle, smallest)) smallest = angle;
            if (is_smaller(largest, angle)) largest = angle;
        }
        extend(smallest, largest);
    }

    PlaneDirection add_extreme_corner(const Vec3& u, const Vec3& p, const Vec3& q) {
        const Vec3 a = measure::normalised(measure::direction(u, p));
        const Vec3 b = measure::normalised(measure::direction(u, q));
        const PlaneDirection angle = measure::angle_between(a, b);
        count(angle.cosine, squared_norm(a) * squared_norm(b), u, p, q);
        return angle;
    }

    void add_collapsed_face(bool to_a_point) {
        small += to_a_point ? 2 : 1;
        large += to_a_point ? 1 : 0;
        extend({1, 0}, to_a_point ? PlaneDirection{-1, 0} : PlaneDirection{0, 1});
    }

    void count(double dot, double squares, const Vec3& u, const Vec3& p, const Vec3& q) {
        const auto is_small = is_beyond(small_angle, dot, squares);
        if (is_small ? *is_small : is_beyond_exactly(small_angle, u, p, q)) ++small;
        const auto is_large = is_beyond(large_angle, dot, squares);
        if (is_large ? *is_large : is_beyond_exactly(large_angle, u, p, q)) ++large;
    }

    void extend(PlaneDirection smallest, PlaneDirection largest) {
        if (faces == 0 || is_smaller(smallest, smallest_)) smallest_ = smallest;
        if (faces == 0 || is_smaller(largest_, largest)) largest_ = largest;
        ++faces;
    }

    PlaneDirection smallest_;
    PlaneDirection largest_;
};

/// Counts the sets that remain when faces join their vertices.
class Components {
public:
    explicit Components(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0U); }

    /// The smaller root wins: paths stay short enough with halving, and scans of ordered meshes are nearly free.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }
    [[nodiscard]] bool is_root(std::uint32_t v) const { return parent_[v] == v; }

private:
    std::uint32_t root(std::uint32_t v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    std::vector<std::uint32_t> parent_;
};

}  // namespace

MeshSize measure_size(const Mesh& mesh) {
    MeshSize size;
    size.vertices = mesh.vertex_count();
    size.faces = mesh.face_count();
    Components components(mesh.vertex_count());
    const auto corners = mesh.corners();
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
        const HalfedgeId id(h);
        if (mesh.names_edge(id)) ++size.edges;
        if (mesh.is_boundary(id)) ++size.boundary_edges;
        if (h % 3 != 2) components.join(corners[h].value(), corners[h + 1].value());
    }
    std::size_t used = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const VertexId id(v);
        if (!mesh.halfedge(id).valid()) continue;
        ++used;
        if (components.is_root(id.value())) ++size.components;
    }
    size.euler = static_cast<long long>(used) - static_cast<long long>(size.edges) + static_cast<long long>(size.faces);
    return size;
}

AngleStatistics measure_angles(const Mesh& mesh, const Context* context) {
    report_progress(context, "angles", 0);
    std::vector<AngleRun> runs(mesh.face_count() / faces_per_block + 1);
    const auto run = [&](std::size_t begin, std::size_t end) {
        if (!is_cancelled(context)) runs[begin / faces_per_block].add(mesh, begin, end);
    };
    parallel_blocks(mesh.face_count(), context, run, faces_per_block);
    AngleRun whole;
    for (const AngleRun& part : runs) whole.append(part);
    report_progress(context, "angles", 1);
    return whole.result();
}

double bounding_diagonal(const Mesh& mesh) {
    const Box box = bounding_box(mesh);
    return box.is_empty() ? 0 : norm(box.high - box.low);
}

}  // namespace delmesh
