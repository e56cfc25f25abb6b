#include "delmesh/mesh/polygon_soup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace delmesh {

void PolygonSoup::add_face(std::span<const std::uint32_t> polygon) {
    if (starts.empty() && polygon.size() != 3) {
        starts.resize(corners.size() / 3 + 1);
        for (std::size_t f = 0; f < starts.size(); ++f) starts[f] = 3 * f;
    }
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    if (!starts.empty()) starts.push_back(corners.size());
}

namespace {

constexpr std::size_t most_clipped = 1000;

using Triangle = std::array<std::uint32_t, 3>;  // places in the polygon

/// The cosine of the smallest angle, so that less is better; 1 for a triangle without area.
double worst_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto cosine = [](const Vec3& u, const Vec3& v) {
        const double lengths = std::sqrt(squared_norm(u)) * std::sqrt(squared_norm(v));
        return lengths > 0 ? dot(u, v) / lengths : 1.0;
    };
    return std::max({cosine(b - a, c - a), cosine(c - b, a - b), cosine(a - c, b - c)});
}

/// Brings coordinates to sizes near 1 by a power of two, about the first of them, so that products of them neither
/// overflow nor vanish. False if one is not finite.
bool normalise(std::span<Vec3> points) {
    const auto largest = [&points] {
        double size = 0;
        for (const Vec3& p : points) size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        return size;
    };
    const auto scale = [&points](double size) {
        if (size == 0) return;
        const int exponent = -std::ilogb(size);
        for (Vec3& p : points) p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
    };
    for (const Vec3& p : points) {
        if (!is_finite(p)) return false;
    }
    scale(largest());
    const Vec3 first = points.front();
    for (Vec3& p : points) p = p - first;
    scale(largest());
    return true;
}

/// The area vector of a closed polygon, twice (Newell).
Vec3 newell_normal(std::span<const Vec3> points) {
    Vec3 normal;
    for (std::size_t i = 0; i < points.size(); ++i) normal = normal + cross(points[i], points[(i + 1) % points.size()]);
    return normal;
}

/// True if all triangles of the fan about the first corner face the same way as the polygon, so that they tile it.
bool is_fan_sound(std::span<const Vec3> points) {
    const Vec3 normal = newell_normal(points);
    for (std::size_t i = 2; i < points.size(); ++i)
        if (!(dot(cross(points[i - 1] - points[0], points[i] - points[0]), normal) > 0)) return false;
    return true;
}

void cut_fan(std::size_t n, std::vector<Triangle>& triangles) {
    triangles.clear();
    for (std::uint32_t i = 2; i < n; ++i) triangles.push_back({0, i - 1, i});
}

/// Cuts a polygon in its mean plane, always at the ear with the largest smallest angle.
class EarClipper {
public:
    /// False if the polygon can not be cut; `triangles` is then of no use.
    bool cut(std::span<const Vec3> points, std::vector<Triangle>& triangles) {
        project(points);
        const auto n = static_cast<std::uint32_t>(points.size());
        next_.resize(n);
        previous_.resize(n);
        quality_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) quality_[i] = rate(points, i);
        triangles.clear();
        std::uint32_t any = 0;
        for (std::uint32_t left = n; left > 3; --left) {
            const std::uint32_t ear = best_ear(any);
            if (quality_[ear] >= not_an_ear) return false;
            triangles.push_back({previous_[ear], ear, next_[ear]});
            const std::uint32_t before = previous_[ear];
            const std::uint32_t after = next_[ear];
            next_[before] = after;
            previous_[after] = before;
            quality_[before] = rate(points, before);
            quality_[after] = rate(points, after);
            any = before;
        }
        triangles.push_back({previous_[any], any, next_[any]});
        return turn(previous_[any], any, next_[any]) >= 0;
    }

private:
    static constexpr double not_an_ear = 2;

    /// Drops the axis along which the polygon's normal is largest; keeps it turning counter-clockwise.
    void project(std::span<const Vec3> points) {
        const Vec3 normal = newell_normal(points);
        int axis = 0;
        for (const int other : {1, 2}) {
            if (std::fabs(normal[other]) > std::fabs(normal[axis])) axis = other;
        }
        const double sign = normal[axis] < 0 ? -1 : 1;
        flat_.resize(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            flat_[i] = {sign * points[i][(axis + 1) % 3], points[i][(axis + 2) % 3]};
        }
    }

    [[nodiscard]] double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return (flat_[b][0] - flat_[a][0]) * (flat_[c][1] - flat_[a][1]) -
               (flat_[b][1] - flat_[a][1]) * (flat_[c][0] - flat_[a][0]);
    }

    /// The worst cosine of the triangle at corner `b` if it is an ear.
    [[nodiscard]] double rate(std::span<const Vec3> points, std::uint32_t b) const {
        const std::uint32_t a = previous_[b];
        const std::uint32_t c = next_[b];
        if (!(turn(a, b, c) > 0)) return not_an_ear;
        for (std::uint32_t i = next_[c]; i != a; i = next_[i]) {
            // A point that coincides with a corner is where a hole is joined to the outline.
            if (flat_[i] == flat_[a] || flat_[i] == flat_[b] || flat_[i] == flat_[c]) continue;
            if (turn(a, b, i) >= 0 && turn(b, c, i) >= 0 && turn(c, a, i) >= 0) return not_an_ear;
        }
        return worst_cosine(points[a], points[b], points[c]);
    }

    [[nodiscard]] std::uint32_t best_ear(std::uint32_t start) const {
        std::uint32_t best = start;
        for (std::uint32_t i = next_[start]; i != start; i = next_[i]) {
            if (quality_[i] < quality_[best] || (quality_[i] == quality_[best] && i < best)) best = i;
        }
        return best;
    }

    std::vector<std::array<double, 2>> flat_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<double> quality_;
};

/// Cuts one polygon after another.
class Triangulator {
public:
    explicit Triangulator(std::span<const Vec3> points) : points_(points) {}

    /// The triangles of a polygon with more than three corners, as places in it.
    const std::vector<Triangle>& cut(std::span<const std::uint32_t> polygon) {
        const std::size_t n = polygon.size();
        const bool is_fan = !take_points(polygon) || !normalise(local_) || is_fan_sound(local_) || n > most_clipped;
        if (is_fan || !clipper_.cut(local_, triangles_)) cut_fan(n, triangles_);
        return triangles_;
    }

private:
    /// False if the polygon names a point that is not there: it is the mesh builder that complains about that.
    bool take_points(std::span<const std::uint32_t> polygon) {
        local_.clear();
        for (const std::uint32_t vertex : polygon) {
            if (vertex >= points_.size()) return false;
            local_.push_back(points_[vertex]);
        }
        return true;
    }

    std::span<const Vec3> points_;
    std::vector<Vec3> local_;
    std::vector<Triangle> triangles_;
    EarClipper clipper_;
};

}  // namespace

void triangulate(PolygonSoup& soup) {
    if (soup.is_triangles()) return;
    std::size_t triangles = 0;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const std::size_t n = soup.face(f).size();
        if (n >= 3) triangles += n - 2;
    }
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * triangles);
    Triangulator triangulator(soup.points);
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const std::span<const std::uint32_t> polygon = soup.face(f);
        if (polygon.size() == 3) {
            corners.insert(corners.end(), polygon.begin(), polygon.end());
        } else if (polygon.size() > 3) {
            for (const Triangle& t : triangulator.cut(polygon)) {
                for (const std::uint32_t place : t) corners.push_back(polygon[place]);
            }
        }
    }
    soup.corners = std::move(corners);
    soup.starts.clear();
    soup.starts.shrink_to_fit();
}

}  // namespace delmesh
