// From a soup to a complex: drops what names nothing or is not a number, and cuts polygons into triangles.

#include "delmesh/base/error.hpp"
#include "repair/complex.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace delmesh::repairing {
namespace {

void check_structure(const PolygonSoup& soup) {
    const auto& s = soup.starts;
    const bool fits = s.empty()
                          ? soup.corners.size() % 3 == 0
                          : s.front() == 0 && s.back() == soup.corners.size() && std::is_sorted(s.begin(), s.end());
    if (!fits)
        throw Error(ErrorCode::bad_argument,
                    fmt::format("the face table of the soup does not fit its {} corners", soup.corners.size()));
    if (soup.points.size() >= none / 2 || soup.corners.size() >= none / 4)
        throw Error(ErrorCode::too_large,
                    fmt::format("{} points and {} corners are more than can be repaired (at most {} and {})",
                                soup.points.size(), soup.corners.size(), none / 2, none / 4));
}

/// Looks at one face after another and tells what is to become of it.
class Sieve {
public:
    Sieve(const PolygonSoup& soup, Log& log) : soup_(soup), log_(log), finite_(soup.points.size()) {
        for (std::size_t v = 0; v < finite_.size(); ++v) {
            finite_[v] = is_finite(soup.points[v]) ? 1 : 0;
            if (finite_[v] == 0) log.add(Defect::not_finite, v);
        }
    }

    /// The corners of face f that remain once those that repeat their predecessor are left out; fewer than three if the
    /// face is to be dropped.
    std::span<const Index> pass(std::size_t f) {
        kept_.clear();
        const std::span<const Index> face = soup_.face(f);
        if (has_bad_corner(f, face)) return {};
        for (const Index v : face)
            if (kept_.empty() || kept_.back() != v) kept_.push_back(v);
        while (kept_.size() > 1 && kept_.back() == kept_.front()) kept_.pop_back();
        const bool too_few = kept_.size() < 3 || (kept_.size() == 3 && kept_[0] == kept_[2]);
        if (too_few) kept_.clear();
        if (too_few || kept_.size() < face.size()) log_.add(Defect::repeated_vertex, f);
        return kept_;
    }

private:
    bool has_bad_corner(std::size_t f, std::span<const Index> face) {
        for (const Index v : face) {
            if (v >= finite_.size()) {
                log_.add(Defect::index_out_of_range, f);
                return true;
            }
        }
        for (const Index v : face) {
            if (finite_[v] == 0) {
                log_.add(Defect::face_not_finite, f);
                return true;
            }
        }
        return false;
    }

    const PolygonSoup& soup_;
    Log& log_;
    std::vector<char> finite_;
    std::vector<Index> kept_;
};

void sift_triangles(const PolygonSoup& soup, Sieve& sieve, Complex& complex) {
    complex.corners.reserve(soup.corners.size());
    complex.origin.reserve(soup.face_count());
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const std::span<const Index> kept = sieve.pass(f);
        if (kept.empty()) continue;
        complex.corners.insert(complex.corners.end(), kept.begin(), kept.end());
        complex.origin.emplace_back(f);
    }
}

/// A polygon of n corners becomes n - 2 triangles, in place; a triangle that then repeats a vertex (of a polygon that
/// touches itself) is left out.
void sift_polygons(const PolygonSoup& soup, Sieve& sieve, Complex& complex, Log& log) {
    PolygonSoup good;
    good.points = soup.points;
    good.starts.push_back(0);
    std::vector<Index> origin;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const std::span<const Index> kept = sieve.pass(f);
        if (kept.empty()) continue;
        good.corners.insert(good.corners.end(), kept.begin(), kept.end());
        good.starts.push_back(good.corners.size());
        origin.insert(origin.end(), kept.size() - 2, static_cast<Index>(f));
    }
    triangulate(good);
    for (std::size_t t = 0; t < origin.size(); ++t) {
        const Index* c = &good.corners[3 * t];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
            log.add(Defect::repeated_vertex, origin[t]);
            continue;
        }
        complex.corners.insert(complex.corners.end(), c, c + 3);
        complex.origin.emplace_back(origin[t]);
    }
}

}  // namespace

Complex sift(const PolygonSoup& soup, Log& log) {
    check_structure(soup);
    Complex complex(soup.points);
    Sieve sieve(soup, log);
    if (soup.is_triangles())
        sift_triangles(soup, sieve, complex);
    else
        sift_polygons(soup, sieve, complex, log);
    complex.turned.assign(complex.face_count(), false);
    complex.mended.assign(complex.face_count(), false);
    return complex;
}

}  // namespace delmesh::repairing
