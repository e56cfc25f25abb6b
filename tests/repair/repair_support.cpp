#include "repair/repair_support.hpp"

#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace delmesh::test {

PolygonSoup triangles(std::vector<Vec3> points, std::initializer_list<Triangle> faces) {
    PolygonSoup soup;
    soup.points = std::move(points);
    for (const Triangle& f : faces) soup.add_face(f);
    return soup;
}

void append(PolygonSoup& soup, const PolygonSoup& other) {
    const auto offset = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
    for (const std::uint32_t v : other.corners) soup.corners.push_back(v + offset);
}

PolygonSoup make_cube(Vec3 low, double side) {
    PolygonSoup soup;
    for (int i = 0; i < 8; ++i)
        soup.points.push_back(
            {low.x + (i % 2) * side, low.y + (i / 2 % 2) * side, low.z + static_cast<double>(i / 4) * side});
    const std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& s : sides) {
        soup.add_face(Triangle{s[0], s[1], s[2]});
        soup.add_face(Triangle{s[0], s[2], s[3]});
    }
    return soup;
}

void turn_face(PolygonSoup& soup, std::size_t f) {
    std::swap(soup.corners[3 * f + 1], soup.corners[3 * f + 2]);
}

void turn_all_faces(PolygonSoup& soup) {
    for (std::size_t f = 0; f < soup.face_count(); ++f) turn_face(soup, f);
}

PolygonSoup take_apart(const PolygonSoup& soup) {
    PolygonSoup result;
    for (const std::uint32_t v : soup.corners) {
        result.corners.push_back(static_cast<std::uint32_t>(result.points.size()));
        result.points.push_back(soup.points[v]);
    }
    return result;
}

PolygonSoup merge_places(const PolygonSoup& soup) {
    std::map<std::array<double, 3>, std::uint32_t> first;
    PolygonSoup result = soup;
    for (std::uint32_t& v : result.corners) {
        const Vec3& p = soup.points[v];
        v = first.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
    return result;
}

PolygonSoup make_band(std::uint32_t n, std::uint32_t m, bool moebius) {
    const double pi = 3.14159265358979323846;
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j <= m; ++j) {
            const double angle = 2 * pi * i / n;
            const double across = 2.0 * j / m - 1;
            const double tilt = moebius ? angle / 2 : 0;
            const double radius = 4 + across * std::cos(tilt);
            soup.points.push_back(
                {radius * std::cos(angle), radius * std::sin(angle), across * std::sin(tilt) + (moebius ? 0 : across)});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i < n ? i * (m + 1) + j : moebius ? m - j : j; };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < m; ++j) {
            soup.add_face(Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.add_face(Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return soup;
}

PolygonSoup make_klein_bottle(std::uint32_t n, std::uint32_t m) {
    const double pi = 3.14159265358979323846;
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < m; ++j) {
            // The figure-eight immersion; the offset keeps vertices off the line where it passes through itself.
            const double u = 2 * pi * i / n;
            const double v = 2 * pi * (j + 0.5) / m;
            const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
            soup.points.push_back(
                {r * std::cos(u), r * std::sin(u), std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        j %= m;
        return i < n ? i * m + j : m - 1 - j;
    };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < m; ++j) {
            soup.add_face(Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.add_face(Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return soup;
}

namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const PolygonSoup& soup, std::size_t f) {
    const auto face = soup.face(f);
    return {soup.points[face[0]], soup.points[face[1]], soup.points[face[2]]};
}

bool is_usable(const PolygonSoup& soup, std::size_t f) {
    const auto face = soup.face(f);
    return face.size() == 3 && std::all_of(face.begin(), face.end(), [&](std::uint32_t v) {
               return v < soup.points.size() && is_finite(soup.points[v]);
           });
}

/// In a unit that depends on `scale`: a power of two that brings coordinates to sizes near 1.
double area(const Corners& c, int scale) {
    const auto edge = [&](const Vec3& a, const Vec3& b) {
        const auto part = [&](int axis) { return std::scalbn(a[axis], scale) - std::scalbn(b[axis], scale); };
        return Vec3{part(0), part(1), part(2)};
    };
    return norm(cross(edge(c[1], c[0]), edge(c[2], c[0]))) / 2;
}

int scale_of(const PolygonSoup& soup) {
    double largest = 0;
    for (const Vec3& p : soup.points)
        for (int axis = 0; axis < 3; ++axis)
            if (std::isfinite(p[axis])) largest = std::max(largest, std::fabs(p[axis]));
    return largest > 0 ? -std::ilogb(largest) : 0;
}

/// On the line through a and b, between them or at one of them.
bool is_between(const Vec3& p, const Vec3& a, const Vec3& b) {
    if (!are_collinear(a, b, p)) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) return false;
    return true;
}

bool is_on_rim(const Vec3& p, const Corners& c) {
    return is_between(p, c[0], c[1]) || is_between(p, c[1], c[2]) || is_between(p, c[2], c[0]);
}

std::array<std::array<double, 3>, 3> sorted_places(const Corners& c) {
    std::array<std::array<double, 3>, 3> key;
    for (std::size_t i = 0; i < 3; ++i) key[i] = {c[i].x + 0.0, c[i].y + 0.0, c[i].z + 0.0};
    std::sort(key.begin(), key.end());
    return key;
}

void expect_manifold(const PolygonSoup& soup) {
    ASSERT_TRUE(soup.is_triangles());
    ASSERT_NO_THROW({
        const Mesh mesh(soup);
        EXPECT_EQ(validate(mesh), "");
    });
    EXPECT_EQ(examine(soup).fault, "");
    std::vector<char> used(soup.points.size(), 0);
    for (const std::uint32_t v : soup.corners) used[v] = 1;
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const Corners c = corners_of(soup, f);
        EXPECT_FALSE(are_collinear(c[0], c[1], c[2])) << "face " << f;
    }
}

/// For points in the plane of the triangle, exact.
bool contains(const Corners& c, const Vec3& p) {
    const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
    if (orientation(c[0], c[1], c[2], p) != Sign::zero) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (orientation(c[i], c[(i + 1) % 3], c[i] + normal, p) == Sign::positive) return false;
    return true;
}

/// Some points of the triangle, exact where the coordinates are small integers.
std::array<Vec3, 4> sample(const Corners& c) {
    const auto at = [&](double u, double v) { return c[0] * (1 - u - v) + c[1] * u + c[2] * v; };
    return {at(0.25, 0.25), at(0.125, 0.75), at(0.8125, 0.0625), at(0.375, 0.5)};
}

bool is_covered(const Vec3& p, const PolygonSoup& soup) {
    for (std::size_t f = 0; f < soup.face_count(); ++f)
        if (contains(corners_of(soup, f), p)) return true;
    return false;
}

/// Only where no tolerance is given and the input consists of triangles.
void expect_same_surface(const PolygonSoup& input, const Repaired& out) {
    const int scale = scale_of(input);
    std::map<std::array<std::array<double, 3>, 3>, double> covered;  // by place: several faces may be at one
    for (std::size_t f = 0; f < out.soup.face_count(); ++f) {
        const std::size_t from = out.report.face_origin[f].index();
        ASSERT_LT(from, input.face_count());
        const Corners whole = corners_of(input, from);
        const Corners part = corners_of(out.soup, f);
        for (const Vec3& p : part) ASSERT_TRUE(is_on_rim(p, whole)) << "face " << f << " of " << from;
        covered[sorted_places(whole)] += area(part, scale);
    }
    for (std::size_t f = 0; f < input.face_count(); ++f) {
        if (!is_usable(input, f)) continue;
        const Corners c = corners_of(input, f);
        if (are_collinear(c[0], c[1], c[2])) continue;
        if (out.report.count(Defect::zero_area) > 0) {
            // A part of a face may be at the place of another face; rounded samples tell nothing.
            for (const Vec3& p : sample(c)) EXPECT_TRUE(!contains(c, p) || is_covered(p, out.soup)) << "face " << f;
            continue;
        }
        const double layers = covered[sorted_places(c)] / area(c, scale);
        EXPECT_TRUE(std::fabs(layers - 1) < 1e-9 || std::fabs(layers - 2) < 1e-9) << "face " << f << ": " << layers;
    }
    for (std::size_t v = 0; v < out.soup.points.size(); ++v)
        EXPECT_EQ(out.soup.points[v], input.points[out.report.vertex_origin[v].index()]);
}

}  // namespace

Repaired repair_and_check(const PolygonSoup& input, const RepairOptions& options) {
    Repaired out{input, {}};
    out.report = repair(out.soup, options);
    EXPECT_EQ(out.report.changed, !same_bits(out.soup, input));
    EXPECT_EQ(out.report.changed, !out.report.findings.empty());
    EXPECT_EQ(out.report.vertex_origin.size(), out.soup.points.size());
    EXPECT_EQ(out.report.face_origin.size(), out.soup.face_count());
    if (out.report.changed || input.is_triangles()) expect_manifold(out.soup);
    if (input.is_triangles() && options.weld_tolerance_rel == 0) expect_same_surface(input, out);

    PolygonSoup again = out.soup;
    const RepairReport second = repair(again, options);
    EXPECT_FALSE(second.changed) << (second.findings.empty() ? "" : sentence(second.findings.front()));
    EXPECT_TRUE(same_bits(again, out.soup));
    return out;
}

std::size_t count_boundary_edges(const PolygonSoup& soup) {
    return examine(soup).boundary_edges;
}

std::size_t count_components(const PolygonSoup& soup) {
    return examine(soup).components;
}

bool same_bits(const PolygonSoup& a, const PolygonSoup& b) {
    const auto same_point = [](const Vec3& p, const Vec3& q) {
        for (int axis = 0; axis < 3; ++axis)
            if (std::bit_cast<std::uint64_t>(p[axis]) != std::bit_cast<std::uint64_t>(q[axis])) return false;
        return true;
    };
    return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same_point) &&
           a.corners == b.corners && a.starts == b.starts && a.lines == b.lines && a.stored == b.stored;
}

}  // namespace delmesh::test
