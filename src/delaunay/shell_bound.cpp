#include "delaunay/shell_bound.hpp"

#include "delaunay/split_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t none = 0xffffffffu;
/// What is relied on is not even near to a tie: neither rounding here, nor that of the points, can change it, as long
/// as triangles, parts and edges are not smaller than this.
constexpr double margin = 1e-4;
constexpr double least_sine = 1e-3;
constexpr double least_part = 1e-2;    ///< of an edge
constexpr double least_length = 1e-5;  ///< of an edge, against the largest coordinate
/// On one edge. More are left out.
constexpr std::size_t most_points = 3;
constexpr std::size_t visits_per_edge = 8;

/// Where shells split an edge part depends on the part alone. And points make the angles opposite to a part only
/// larger, since the angle in a Delaunay facet is the largest one at which any of its points that sees the part does
/// see it. So a part that few of the points make bad, in the triangles of the mesh as it is, is split for certain,
/// wherever all the other points will be; and that point is certain as well, and may make other parts bad.
class ShellCount {
public:
    ShellCount(const MarkedMesh& marked, double unit)
        : marked_(marked),
          mesh_(marked.mesh()),
          unit_(unit),
          slot_(mesh_.halfedge_count(), none),
          waits_(mesh_.halfedge_count(), 0) {
        for (const Vec3& p : mesh_.points())
            largest_ = std::max({largest_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }

    bool exceeds(std::span<const EdgeId> bad, std::size_t count) {
        points_.reserve(2 * bad.size());
        for (const EdgeId e : bad) add_known(Mesh::halfedge(e));
        // Their neighbours, then those of edges that have changed, and so on.
        for (const EdgeId e : bad) wait_beside(Mesh::halfedge(e));
        const std::size_t most_visits = visits_per_edge * bad.size();
        for (std::size_t i = 0; i < queue_.size() && i < most_visits && count_ <= count; ++i) {
            const HalfedgeId h = queue_[i];
            waits_[h.index()] = 0;
            if (visit(h)) wait_beside(h);
        }
        return count_ > count;
    }

private:
    /// Of one edge, from its smaller vertex.
    struct Points {
        std::array<double, most_points> at{};
        std::size_t count = 0;
    };
    /// A triangle beside an edge: the cotangents of its angles at the ends of the edge and opposite to it, and the
    /// points of its other sides, which begin at these ends.
    struct Corner {
        double low = 0;
        double high = 0;
        double apex = infinity;
        std::array<const Points*, 2> points{};
        std::array<bool, 2> reversed{};
    };

    void wait_beside(HalfedgeId h) {
        for (const HalfedgeId side : {h, mesh_.twin(h)}) {
            if (!side.valid()) continue;
            for (const HalfedgeId other : {Mesh::next(side), Mesh::prev(side)}) {
                if (marked_.is_planar(other)) continue;
                const HalfedgeId name = Mesh::halfedge(mesh_.edge(other));
                if (std::exchange(waits_[name.index()], 1) == 0) queue_.push_back(name);
            }
        }
    }

    [[nodiscard]] const Points* points_of(HalfedgeId h) const {
        const std::uint32_t slot = slot_[Mesh::halfedge(mesh_.edge(h)).index()];
        return slot == none ? nullptr : &points_[slot];
    }

    [[nodiscard]] Corner corner_at(HalfedgeId h) const {
        Corner corner;
        const bool forward = mesh_.origin(h) < mesh_.target(h);
        const Vec3& p = mesh_.point(forward ? mesh_.origin(h) : mesh_.target(h));
        const Vec3& q = mesh_.point(forward ? mesh_.target(h) : mesh_.origin(h));
        const VertexId apex = mesh_.apex(h);
        const Vec3 side = q - p;
        const Vec3 low = mesh_.point(apex) - p;
        const Vec3 high = mesh_.point(apex) - q;
        const double area = norm(cross(side, low));
        if (!(area > least_sine * std::max({squared_norm(side), squared_norm(low), squared_norm(high)}))) return corner;
        corner.low = dot(side, low) / area;
        corner.high = -dot(side, high) / area;
        corner.apex = dot(low, high) / area;
        const HalfedgeId at_low = forward ? Mesh::prev(h) : Mesh::next(h);
        const HalfedgeId at_high = forward ? Mesh::next(h) : Mesh::prev(h);
        corner.points = {points_of(at_low), points_of(at_high)};
        const VertexId first = forward ? mesh_.origin(h) : mesh_.target(h);
        const VertexId last = forward ? mesh_.target(h) : mesh_.origin(h);
        corner.reversed = {apex < first, apex < last};
        return corner;
    }

    /// The cotangent at which the part [a,b] is seen from the point at f of a side that begins at 0, with the angle
    /// whose cotangent is `at`; `beyond` is that at the side's other end, and `far` that at 1.
    [[nodiscard]] static double cot_from(double a, double b, double f, double at, double far, double beyond) {
        return (a * b * (at + far) - (a + b) * f * at + f * f * (at + beyond)) / (f * (b - a));
    }

    [[nodiscard]] static double least_cot(const Corner& corner, double a, double b) {
        double least = cot_from(a, b, 1, corner.low, corner.high, corner.apex);
        for (const std::size_t k : {0, 1}) {
            if (corner.points[k] == nullptr) continue;
            const Points& points = *corner.points[k];
            for (std::size_t i = 0; i < points.count; ++i) {
                const double f = corner.reversed[k] ? 1 - points.at[i] : points.at[i];
                least = std::min(least, k == 0 ? cot_from(a, b, f, corner.low, corner.high, corner.apex)
                                               : cot_from(1 - b, 1 - a, f, corner.high, corner.low, corner.apex));
            }
        }
        return least;
    }

    [[nodiscard]] static bool is_bad(const std::array<Corner, 2>& corners, bool at_boundary, double a, double b) {
        const double first = least_cot(corners[0], a, b);
        const double second = at_boundary ? 0 : least_cot(corners[1], a, b);
        return first + second < -margin * (1 + std::fabs(first)) * (1 + std::fabs(second));
    }

    struct View {
        EdgePart part;  ///< the whole edge
        double length = 0;
        std::array<Corner, 2> corners;
        bool at_boundary = false;
        bool is_clear = false;
    };

    /// Not clear: what rounding makes of needles may be taken away in the end.
    [[nodiscard]] View look(HalfedgeId h) const {
        const HalfedgeId t = mesh_.twin(h);
        View view;
        view.part = {std::min(mesh_.origin(h), mesh_.target(h)), std::max(mesh_.origin(h), mesh_.target(h)), 0, 1};
        view.length = norm(mesh_.point(view.part.b) - mesh_.point(view.part.a));
        view.at_boundary = !t.valid();
        view.corners[0] = corner_at(h);
        if (t.valid()) view.corners[1] = corner_at(t);
        view.is_clear = view.length > least_length * largest_ && view.corners[0].apex != infinity &&
                        (view.at_boundary || view.corners[1].apex != infinity);
        return view;
    }

    /// The point of a part that must be split; NaN if it is too near to the ends.
    [[nodiscard]] double shell_of(const View& view, double from, double to) const {
        const double at = shell_parameter({view.part.a, view.part.b, from, to}, view.length, unit_);
        return at - from > least_part && to - at > least_part ? at : std::numeric_limits<double>::quiet_NaN();
    }

    void add_known(HalfedgeId h) {
        const View view = look(h);
        if (!view.is_clear) return;
        const double at = shell_of(view, 0, 1);
        if (!std::isnan(at)) keep(h, {{at}, 1});
    }

    void keep(HalfedgeId h, const Points& points) {
        std::uint32_t& slot = slot_[h.index()];
        if (slot == none) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.emplace_back();
        }
        count_ += points.count - points_[slot].count;
        points_[slot] = points;
    }

    /// Adds what is certain on an edge. False if that is nothing new.
    bool visit(HalfedgeId h) {
        const View view = look(h);
        if (!view.is_clear) return false;
        Points now;
        if (const Points* known = points_of(h)) now = *known;
        const std::size_t before = now.count;
        for (std::size_t i = 0; i <= now.count && now.count < most_points;) {
            const double from = i == 0 ? 0 : now.at[i - 1];
            const double to = i == now.count ? 1 : now.at[i];
            const double at = is_bad(view.corners, view.at_boundary, from, to)
                                  ? shell_of(view, from, to)
                                  : std::numeric_limits<double>::quiet_NaN();
            if (std::isnan(at)) {
                ++i;
                continue;
            }
            for (std::size_t k = now.count; k > i; --k) now.at[k] = now.at[k - 1];
            now.at[i] = at;
            ++now.count;
        }
        if (now.count == before) return false;
        keep(h, now);
        return true;
    }

    const MarkedMesh& marked_;
    const Mesh& mesh_;
    double unit_;
    double largest_ = 0;
    std::vector<std::uint32_t> slot_;  ///< per half-edge that names an edge: its points
    std::vector<std::uint8_t> waits_;
    std::vector<Points> points_;
    std::vector<HalfedgeId> queue_;
    std::size_t count_ = 0;
};

}  // namespace

bool shells_need_more_than(const MarkedMesh& marked, std::span<const EdgeId> bad, const RemeshOptions& options,
                           std::size_t count) {
    // Rounding to floats, or facets that are plane only nearly, would need larger margins. And parts of edges that have
    // been split before are not whole edges.
    if (options.precision == Precision::float32 || marked.has_flat_facets() || marked.split_count() > 0) return false;
    return ShellCount(marked, options.shell_unit_abs).exceeds(bad, count);
}

}  // namespace delmesh
