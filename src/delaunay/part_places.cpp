#include "delmesh/delaunay/part_places.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delmesh/mesh/rounding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace delmesh {
namespace {

constexpr int most_steps = 3;

struct HashOfPlace {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t hash = 0;
        for (const int axis : {0, 1, 2}) {
            // Adding zero makes +0 of -0.
            hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis] + 0.0)) * 0x9e3779b97f4a7c15;
            hash ^= hash >> 29;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// All but no step at all, the shortest first.
std::vector<Vec3> all_steps() {
    std::vector<Vec3> steps;
    for (int i = -most_steps; i <= most_steps; ++i)
        for (int j = -most_steps; j <= most_steps; ++j)
            for (int k = -most_steps; k <= most_steps; ++k)
                if (i != 0 || j != 0 || k != 0) steps.push_back(Vec3{double(i), double(j), double(k)});
    std::stable_sort(steps.begin(), steps.end(),
                     [](const Vec3& a, const Vec3& b) { return squared_norm(a) < squared_norm(b); });
    return steps;
}

/// The step of single precision at the largest coordinate: smaller ones would be lost in sums.
double float_step(const Vec3& p) {
    const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return largest > 0 ? std::scalbn(1, std::max(std::ilogb(largest), -126) - 23) : 0;
}

class PlaceParter {
public:
    explicit PlaceParter(Mesh& mesh) : mesh_(mesh) { owners_.reserve(mesh.vertex_count()); }

    Parting run() {
        std::vector<VertexId> second;
        for (std::size_t i = 0; i < mesh_.vertex_count(); ++i) {
            const VertexId v(i);
            if (mesh_.halfedge(v).valid() && !owners_.try_emplace(mesh_.point(v), v).second) second.push_back(v);
        }
        if (!second.empty()) steps_ = all_steps();
        for (const VertexId v : second) part(v);
        return std::move(result_);
    }

private:
    /// Parts v from the one that its place belongs to.
    void part(VertexId v) {
        VertexId& owner = owners_.at(mesh_.point(v));
        if (move_away(v)) return;
        if (move_away(owner)) {
            owner = v;
        } else {
            result_.left.push_back({owner, v});
        }
    }

    bool move_away(VertexId v) {
        const Vec3 from = mesh_.point(v);
        const double step = float_step(from);
        for (const Vec3& steps : steps_) {
            const Vec3 to = round_to_float(from + step * steps);
            if (!is_finite(to) || owners_.contains(to)) continue;
            mesh_.set_point(v, to);
            if (!is_delaunay_around(v)) continue;
            owners_.emplace(to, v);
            ++result_.moved;
            result_.furthest = std::max(result_.furthest, norm(to - from));
            return true;
        }
        mesh_.set_point(v, from);
        return false;
    }

    [[nodiscard]] bool is_delaunay_around(VertexId v) const {
        const HalfedgeId first = mesh_.halfedge(v);
        for (HalfedgeId h = first; h.valid();) {
            if (is_cap(mesh_, Mesh::face(h))) return false;
            for (const HalfedgeId side : {h, Mesh::next(h), Mesh::prev(h)})
                if (is_non_delaunay(mesh_, side)) return false;
            h = mesh_.next_around(h);
            if (h == first) break;
        }
        return true;
    }

    Mesh& mesh_;
    std::unordered_map<Vec3, VertexId, HashOfPlace> owners_;
    std::vector<Vec3> steps_;
    Parting result_;
};

}  // namespace

Parting part_places(Mesh& mesh) {
    return PlaceParter(mesh).run();
}

}  // namespace delmesh
