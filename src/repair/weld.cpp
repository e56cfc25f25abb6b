// Which vertices are at one place? With a tolerance, clusters of vertices are moved to one place first.

#include "repair/complex.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace delmesh::repairing {
namespace {

std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9U;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// A hash table of vertex numbers with open addressing; what "equal" means is up to the caller.
class VertexTable {
public:
    explicit VertexTable(std::size_t vertices) : slots_(std::bit_ceil(2 * vertices + 2), none) {}

    /// The first vertex of this hash for which `same` holds; if there is none, `v` is put in and returned.
    template <class Same>
    Index find_or_put(std::uint64_t hash, Index v, Same&& same) {
        std::size_t i = hash & (slots_.size() - 1);
        for (; slots_[i] != none; i = (i + 1) & (slots_.size() - 1))
            if (same(slots_[i])) return slots_[i];
        slots_[i] = v;
        return v;
    }

    /// Calls visitor(vertex) for every vertex that may have this hash.
    template <class Visitor>
    void visit(std::uint64_t hash, Visitor&& visitor) const {
        for (std::size_t i = hash & (slots_.size() - 1); slots_[i] != none; i = (i + 1) & (slots_.size() - 1))
            visitor(slots_[i]);
    }

private:
    std::vector<Index> slots_;
};

std::vector<char> vertices_in_use(const Complex& complex) {
    std::vector<char> used(complex.points.size(), 0);
    for (const Index v : complex.corners) used[v] = 1;
    return used;
}

/// The bits of a point, with -0 as +0.
std::uint64_t hash_point(const Vec3& p) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = mix(hash + std::bit_cast<std::uint64_t>(p[axis] + 0.0) + 1);
    return hash;
}

void find_places(Complex& complex, const std::vector<char>& used) {
    VertexTable table(complex.points.size());
    complex.places.resize(complex.points.size());
    for (Index v = 0; v < complex.points.size(); ++v) {
        complex.places[v] = v;
        if (used[v] == 0) continue;
        const Vec3& p = complex.points[v];
        complex.places[v] =
            table.find_or_put(hash_point(p), v, [&](Index other) { return complex.points[other] == p; });
    }
}

/// The bounding box of the places in use, and the power of two that brings its longest side below 1.
struct Frame {
    Vec3 low;
    int exponent = 0;
    double diagonal = 0;  ///< after scaling

    Frame(const Complex& complex, const std::vector<char>& used) {
        constexpr double inf = std::numeric_limits<double>::infinity();
        low = {inf, inf, inf};
        Vec3 high{-inf, -inf, -inf};
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (used[v] == 0) continue;
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::fmin(low[axis], complex.points[v][axis]);
                high[axis] = std::fmax(high[axis], complex.points[v][axis]);
            }
        }
        int longest = std::numeric_limits<int>::min();
        for (int axis = 0; axis < 3; ++axis)
            if (high[axis] > low[axis]) longest = std::max(longest, exponent_of_difference(high[axis], low[axis]));
        if (longest == std::numeric_limits<int>::min()) return;
        exponent = -(longest + 1);
        diagonal = norm(scaled(high));
    }

    /// Relative to the box. The difference of two large numbers may overflow; that of their halves does not.
    [[nodiscard]] Vec3 scaled(const Vec3& p) const {
        Vec3 q;
        for (int axis = 0; axis < 3; ++axis) {
            const double difference = p[axis] - low[axis];
            q[axis] = std::isfinite(difference) ? std::scalbn(difference, exponent)
                                                : std::scalbn(p[axis] / 2 - low[axis] / 2, exponent + 1);
        }
        return q;
    }

private:
    static int exponent_of_difference(double a, double b) {
        return std::isfinite(a - b) ? std::ilogb(a - b) : std::ilogb(a / 2 - b / 2) + 1;
    }
};

/// Gathers places into clusters, each of which is a ball around its first vertex: chains of near vertices do not run
/// together. Two first vertices are always farther apart than the tolerance, so that a cell of that size holds few.
class Clusters {
public:
    Clusters(Complex& complex, const Frame& frame, double tolerance_rel)
        : complex_(complex),
          frame_(frame),
          tolerance_(tolerance_rel * frame.diagonal),
          table_(complex.points.size()) {}

    /// The vertex to whose place v moves; v itself if it starts a cluster.
    Index settle(Index v) {
        const Vec3 p = frame_.scaled(complex_.points[v]);
        const Cell cell = cell_of(p);
        Index best = none;
        double best_distance = tolerance_;
        for (int i = 0; i < 27; ++i)
            table_.visit(hash_cell(cell, i), [&](Index other) {
                const double distance = norm(frame_.scaled(complex_.points[other]) - p);
                if (distance < best_distance || (distance == best_distance && other < best)) {
                    best = other;
                    best_distance = distance;
                }
            });
        if (best != none) return best;
        // `same` never holds: a vertex that starts a cluster gets a slot of its own.
        return table_.find_or_put(hash_cell(cell, 13), v, [](Index) { return false; });
    }

    [[nodiscard]] bool has_effect() const { return tolerance_ > 0; }

private:
    using Cell = std::array<std::int64_t, 3>;

    [[nodiscard]] Cell cell_of(const Vec3& p) const {
        // Cell numbers have to fit; where cells are larger than the tolerance, the distance still decides.
        const double size = std::fmax(tolerance_, 0x1p-60);
        Cell cell;
        for (int axis = 0; axis < 3; ++axis) cell[axis] = static_cast<std::int64_t>(std::floor(p[axis] / size));
        return cell;
    }
    /// The i-th of the 27 cells around one; 13 is the cell itself.
    static std::uint64_t hash_cell(const Cell& cell, int i) {
        const std::array<int, 3> step{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) hash = mix(hash + static_cast<std::uint64_t>(cell[axis] + step[axis]) + 1);
        return hash;
    }

    Complex& complex_;
    const Frame& frame_;
    double tolerance_;
    VertexTable table_;
};

void move_clusters(Complex& complex, const std::vector<char>& used, double tolerance_rel, Log& log) {
    const Frame frame(complex, used);
    Clusters clusters(complex, frame, tolerance_rel);
    if (!clusters.has_effect()) return;
    std::vector<Index> target(complex.points.size());
    for (Index v = 0; v < target.size(); ++v) {
        if (used[v] == 0) continue;
        target[v] = complex.places[v] == v ? clusters.settle(v) : target[complex.places[v]];
        if (target[v] == complex.places[v]) continue;
        if (complex.moved.empty()) {
            complex.moved.assign(complex.points.begin(), complex.points.end());
            complex.points = complex.moved;
        }
        complex.moved[v] = complex.moved[target[v]];
        complex.places[v] = target[v];
        log.add(Defect::near_vertex, v);
    }
}

}  // namespace

void weld(Complex& complex, double tolerance_rel, Log& log) {
    const std::vector<char> used = vertices_in_use(complex);
    find_places(complex, used);
    if (tolerance_rel > 0) move_clusters(complex, used, tolerance_rel, log);
}

}  // namespace delmesh::repairing
