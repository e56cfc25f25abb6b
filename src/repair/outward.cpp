// Closed components face outwards, or all the other way. The outermost ones decide: what lies inside a component is
// turned with it, so that a cavity stays a cavity.

#include "delmesh/exact/predicates.hpp"
#include "repair/complex.hpp"
#include "repair/direction.hpp"
#include "repair/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh::repairing {
namespace {

struct Component {
    std::span<const Index> faces;
    Index extreme = none;  ///< the vertex with the largest coordinates, in the order x, y, z
    bool inward = false;   ///< it encloses a negative volume
    bool outward = false;  ///< it encloses a positive volume
    Index parent = none;   ///< the component right around it
    Index outermost = none;
};

class OutwardTurner {
public:
    OutwardTurner(Complex& complex, const Partners& partners, Log& log)
        : complex_(complex),
          partners_(partners),
          log_(log) {}

    void run(bool always) {
        find_closed_components();
        if (std::none_of(closed_.begin(), closed_.end(), [](const Component& c) { return c.inward; })) return;
        find_parents();
        if (!always && is_consistent()) return;
        for (const Component& c : closed_) {
            if (!closed_[c.outermost].inward) continue;
            if (c.parent == none) log_.add(Defect::inside_out, complex_.origin[c.faces.front()].index());
            for (const Index f : c.faces) complex_.turn(f);
        }
    }

private:
    /// True if no face had to be turned to agree with its neighbours and no outermost component faces outwards.
    [[nodiscard]] bool is_consistent() const {
        return std::none_of(complex_.turned.begin(), complex_.turned.end(), [](bool t) { return t; }) &&
               std::none_of(closed_.begin(), closed_.end(),
                            [](const Component& c) { return c.parent == none && c.outward; });
    }

    void find_closed_components() {
        std::vector<char> seen(complex_.face_count(), 0);
        faces_.reserve(seen.size());  // so that they stay where they are
        for (Index root = 0; root < seen.size(); ++root) {
            if (seen[root] != 0) continue;
            bool closed = true;
            const std::size_t first = faces_.size();
            faces_.push_back(root);
            seen[root] = 1;
            for (std::size_t i = first; i < faces_.size(); ++i)
                for (Index h = 3 * faces_[i]; h < 3 * faces_[i] + 3; ++h) {
                    if (partners_[h] == none) {
                        closed = false;
                    } else if (seen[partners_[h] / 3] == 0) {
                        seen[partners_[h] / 3] = 1;
                        faces_.push_back(partners_[h] / 3);
                    }
                }
            if (closed)
                closed_.push_back(measure(std::span(faces_).subspan(first)));
            else
                faces_.resize(first);
        }
    }

    /// Volumes that rounding could explain count as none: a component that is flat has no inside.
    [[nodiscard]] Component measure(std::span<const Index> faces) const {
        Component c;
        c.faces = faces;
        c.extreme = complex_.corners[3 * faces[0]];
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h)
                if (before(complex_.point(c.extreme), complex_.point(complex_.from(h)))) c.extreme = complex_.from(h);
        const Vec3& centre = complex_.point(c.extreme);
        double size = 0;
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h)
                size = std::fmax(size, largest_component(difference(centre, complex_.point(complex_.from(h)))));
        // Times a power of two, in two steps as it may be larger than the largest number.
        const int exponent = -std::ilogb(size);
        const int most = std::min(exponent, std::numeric_limits<double>::max_exponent - 1);
        const double scale = std::scalbn(1.0, most);
        const double rest = std::scalbn(1.0, exponent - most);
        const auto local = [&](Index v) { return difference(centre, complex_.point(v)) * scale * rest; };
        double volume = 0;
        double magnitude = 0;
        for (const Index f : faces) {
            const Index* v = &complex_.corners[3 * f];
            const double term = dot(local(v[0]), cross(local(v[1]), local(v[2])));
            volume += term;
            magnitude += std::fabs(term);
        }
        const double noise = 0x1p-50 * static_cast<double>(faces.size() + 16) * magnitude;
        c.inward = volume < -noise;
        c.outward = volume > noise;
        return c;
    }

    static bool before(const Vec3& a, const Vec3& b) {
        if (a.x != b.x) return a.x < b.x;
        if (a.y != b.y) return a.y < b.y;
        return a.z < b.z;
    }

    /// A ray from the extreme point of a component towards larger x meets first either the component around it, from
    /// the inside, or one beside it, which has the same parent. Components that intersect get some answer.
    void find_parents() {
        std::vector<Index> component_of(complex_.face_count(), none);
        for (Index i = 0; i < closed_.size(); ++i)
            for (const Index f : closed_[i].faces) component_of[f] = i;
        const TriangleTree tree(complex_, faces_);
        std::vector<Index> order(closed_.size());
        for (Index i = 0; i < order.size(); ++i) order[i] = i;
        // Whatever a ray meets reaches farther, and has got its parent.
        std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) {
            return before(complex_.point(closed_[j].extreme), complex_.point(closed_[i].extreme));
        });
        for (const Index i : order) {
            Component& c = closed_[i];
            const auto hit = tree.shoot(complex_.point(c.extreme), [&](Index f) { return component_of[f] != i; });
            if (hit.face != none) {
                const Index other = component_of[hit.face];
                const bool leaves = hit.leaves != closed_[other].inward;
                c.parent = leaves ? other : closed_[other].parent;
            }
            c.outermost = c.parent == none ? i : closed_[c.parent].outermost;
        }
    }

    Complex& complex_;
    const Partners& partners_;
    Log& log_;
    std::vector<Index> faces_;  ///< of closed components, one after another
    std::vector<Component> closed_;
};

}  // namespace

void turn_outward(Complex& complex, const Partners& partners, bool always, Log& log) {
    OutwardTurner(complex, partners, log).run(always);
}

}  // namespace delmesh::repairing
