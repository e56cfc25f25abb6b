#include "delaunay/thread_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr std::size_t many_sides = 8;

class Places {
public:
    Places(const SplitModel& model, const Stretch& within, std::vector<double>& places)
        : model_(model),
          layout_(model.layout()),
          within_(within),
          places_(places) {}

    void align(const Side& own) {
        const Facet& facet = layout_.facet(own.facet);
        if (facet.side_count > many_sides) return;
        for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s)
            if (layout_.edge_at(s) != own.edge) align_with(own, layout_.side(s));
    }

    void continue_thread(std::uint32_t s) {
        const Contact seen = model_.nearest(s, within_.from, within_.to);
        take(seen.at.x);
        if (seen.edge == SplitModel::none) return;
        const Side own = layout_.side(s);
        const auto& sides = layout_.edge(seen.edge).side;
        const std::size_t k = layout_.side_within(seen.edge, own.facet);
        const std::uint32_t far = sides[1 - k];
        if (far == SplitModel::none) return;
        const Side near = layout_.side(sides[k]);
        const Point2 from = nearest_beyond(seen.edge, seen.along, far);
        // The frames of the two sides of an edge mirror each other.
        const Point2 up = (1 / dot(near.y_row, near.y_row)) * near.y_row;
        const Point2 d = own.turn((seen.along - from.x) * near.along + from.y * up);
        if (d.y < 0) take(seen.at.x - seen.at.y * d.x / d.y);
    }

private:
    void take(double t) {
        if (t > within_.from && t < within_.to) places_.push_back(t);
    }

    void align_with(const Side& own, const Side& other) {
        const std::size_t n = model_.point_count(other.edge);
        if (n == 0) return;
        const Point2 u = (1 / std::sqrt(dot(own.along, own.along))) * own.along;
        const Point2 v = (1 / std::sqrt(dot(other.along, other.along))) * other.along;
        const Point2 w = dot(u, v) < 0 ? u - v : u + v;
        const double inverse = 1 / dot(own.along, w);
        const Facet& facet = layout_.facet(own.facet);
        Point2 third{};
        if (facet.single)
            for (std::uint32_t s = facet.first_side; s < facet.first_side + 3; ++s)
                if (layout_.edge_at(s) != own.edge && layout_.edge_at(s) != other.edge) third = layout_.side(s).y_row;
        const double third_inverse = 1 / dot(own.along, third);
        for (const Part& part : model_.parts(other.edge).first(n)) {
            const Point2 p = other.at(part.end) - own.start;
            take(dot(p, w) * inverse);
            if (facet.single) take(dot(p, third) * third_inverse);
        }
    }

    /// What the two parts at a point of an edge see on a side of it: the nearer one, in the frame of that side.
    [[nodiscard]] Point2 nearest_beyond(std::uint32_t e, double at, std::uint32_t side) const {
        const std::size_t i = model_.part_at(e, at);
        const auto parts = model_.parts(e);
        Point2 nearest;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = i; k < std::min(i + 2, parts.size()); ++k) {
            const Point2 q = model_.nearest(side, model_.part_start(e, k), parts[k].end).at;
            const double distance2 = (q.x - at) * (q.x - at) + q.y * q.y;
            if (distance2 >= least) continue;
            least = distance2;
            nearest = q;
        }
        return nearest;
    }

    const SplitModel& model_;
    const FacetLayout& layout_;
    Stretch within_;
    std::vector<double>& places_;
};

}  // namespace

void add_aligned_places(const SplitModel& model, std::uint32_t e, const Stretch& within, std::vector<double>& places) {
    for (const std::uint32_t s : model.layout().edge(e).side)
        if (s != SplitModel::none) Places(model, within, places).align(model.layout().side(s));
    std::sort(places.begin(), places.end());
}

void add_thread_places(const SplitModel& model, std::uint32_t e, const Stretch& within, std::vector<double>& places) {
    for (const std::uint32_t s : model.layout().edge(e).side)
        if (s != SplitModel::none) Places(model, within, places).continue_thread(s);
    std::sort(places.begin(), places.end());
}

}  // namespace delmesh
