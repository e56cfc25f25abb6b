#include "delaunay/flat_facets.hpp"

#include "base/parallel.hpp"
#include "base/sort_unique.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/flat_rule.hpp"
#include "exact/double_double.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

namespace delmesh {
namespace {

using exact::DoubleDouble;
using exact::two_sum;

/// Twice what rounding can change in a height above a plane: 2^-100 of coordinates below 2.
constexpr double height_slack = 0x1p-95;

/// Facets of the mesh as lists of faces.
class FacetLists {
public:
    explicit FacetLists(const std::vector<FaceId>& facets) : begin_(facets.size() + 1, 0), faces_(facets.size()) {
        for (const FaceId f : facets) ++begin_[f.index() + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t f = 0; f < facets.size(); ++f) faces_[next[facets[f].index()]++] = FaceId(f);
    }
    [[nodiscard]] std::span<const FaceId> operator[](FaceId facet) const {
        return {faces_.data() + begin_[facet.index()], faces_.data() + begin_[facet.index() + 1]};
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<FaceId> faces_;
};

/// Heights along an axis above a plane through `origin`: x[axis] + slope_1 x[axis+1] + slope_2 x[axis+2].
struct TiltedAxis {
    int axis = 2;
    Sign side = Sign::positive;
    double slope_1 = 0;
    double slope_2 = 0;

    static std::optional<TiltedAxis> along(const Vec3& normal) {
        int axis = 0;
        for (const int other : {1, 2})
            if (std::fabs(normal[other]) > std::fabs(normal[axis])) axis = other;
        if (!(std::fabs(normal[axis]) > 0)) return std::nullopt;
        return TiltedAxis{axis, normal[axis] > 0 ? Sign::positive : Sign::negative,
                          normal[(axis + 1) % 3] / normal[axis], normal[(axis + 2) % 3] / normal[axis]};
    }

    [[nodiscard]] double height(const Vec3& p, const Vec3& origin) const {
        const auto difference = [&](int k) { return two_sum(p[k % 3], -origin[k % 3]); };
        const DoubleDouble sum = difference(axis) + DoubleDouble{slope_1, 0} * difference(axis + 1) +
                                 DoubleDouble{slope_2, 0} * difference(axis + 2);
        return sum.value();
    }
};

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    [[nodiscard]] double width() const { return (high - low) * (1 + 0x1p-50) + height_slack; }
};

class FacetGrowth {
public:
    FacetGrowth(const Mesh& mesh, const UnitFrame& frame, double width, std::vector<Mark>& marks,
                std::vector<FaceId>& facets)
        : mesh_(mesh),
          frame_(frame),
          width_(width),
          marks_(marks),
          facets_(facets) {}

    FlatFacets run(const Context* context) {
        FlatFacets result;
        find_nearly_planar(context);
        const std::vector<FaceId> seeds = find_seeds();
        if (seeds.empty()) return result;
        lists_.emplace(facets_);
        taken_.assign(mesh_.face_count(), 0);
        result.plane_of.assign(mesh_.face_count(), 0);
        for (const FaceId seed : seeds) {
            if (taken_[seed.index()] != 0 || !grow(seed)) continue;
            join(result);
        }
        facets_ = find_facets(mesh_, marks_);
        return result;
    }

private:
    // --- where to begin ---
    void find_nearly_planar(const Context* context) {
        near_.assign(mesh_.halfedge_count(), 0);
        parallel_blocks(near_.size(), context, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                near_[i] = marks_[i] == Mark::physical && mesh_.twin(HalfedgeId(i)).valid() &&
                           is_nearly_planar(mesh_, frame_, width_, HalfedgeId(i));
        });
    }

    [[nodiscard]] Vec3 doubled_area(FaceId f) const {
        const HalfedgeId h = Mesh::halfedge(f);
        const Vec3 p = frame_(mesh_.point(mesh_.origin(h)));
        return cross(frame_(mesh_.point(mesh_.target(h))) - p, frame_(mesh_.point(mesh_.apex(h))) - p);
    }

    /// Facets with a neighbour that may join them, the largest first.
    [[nodiscard]] std::vector<FaceId> find_seeds() const {
        std::vector<FaceId> seeds;
        for (std::size_t i = 0; i < near_.size(); ++i)
            if (near_[i] != 0) seeds.push_back(facets_[i / 3]);
        sort_unique(seeds);
        if (seeds.empty()) return seeds;
        std::vector<double> area(mesh_.face_count(), 0);
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) area[facets_[f].index()] += norm(doubled_area(FaceId(f)));
        std::sort(seeds.begin(), seeds.end(), [&area](FaceId a, FaceId b) {
            return area[a.index()] != area[b.index()] ? area[a.index()] > area[b.index()] : a < b;
        });
        return seeds;
    }

    // --- growing ---
    /// Fills members_ with the facets that lie in one plane with the seed. False if there is none but itself.
    bool grow(FaceId seed) {
        members_.clear();
        faces_ = fitted_faces_ = 0;
        normal_ = {};
        range_ = {};
        const HalfedgeId first = Mesh::halfedge(seed);
        origin_ = frame_(mesh_.point(mesh_.origin(first)));
        for (const FaceId f : (*lists_)[seed]) normal_ = normal_ + doubled_area(f);
        const auto axis = TiltedAxis::along(normal_);
        if (!axis) return false;
        axis_ = *axis;
        if (!fits(seed)) return false;
        accept(seed);
        border_.clear();
        push_border(seed);
        while (!border_.empty()) {
            std::vector<HalfedgeId> refused;
            spread(refused);
            // A better plane may take what the first one could not.
            if (!refit()) break;
            border_ = std::move(refused);
        }
        for (const FaceId facet : members_) taken_[facet.index()] = 0;
        if (members_.size() == 1) return false;
        for (const FaceId facet : members_) taken_[facet.index()] = 1;
        return true;
    }

    void spread(std::vector<HalfedgeId>& refused) {
        while (!border_.empty()) {
            const HalfedgeId h = border_.back();
            border_.pop_back();
            const FaceId facet = facets_[Mesh::face(mesh_.twin(h)).index()];
            if (taken_[facet.index()] != 0) continue;
            if (!fits(facet)) {
                refused.push_back(h);
                continue;
            }
            accept(facet);
            push_border(facet);
            if (faces_ >= 2 * fitted_faces_) refit();
        }
    }

    [[nodiscard]] bool looks_up(FaceId f) const {
        const HalfedgeId h = Mesh::halfedge(f);
        return side_along(axis_.axis, mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h)),
                          mesh_.point(mesh_.apex(h))) == axis_.side;
    }

    [[nodiscard]] double height(VertexId v) const { return axis_.height(frame_(mesh_.point(v)), origin_); }

    /// The range with this facet's vertices; nothing if the facet does not fit.
    [[nodiscard]] std::optional<Range> range_with(FaceId facet, Range range) const {
        for (const FaceId f : (*lists_)[facet]) {
            HalfedgeId h = Mesh::halfedge(f);
            for (int k = 0; k < 3; ++k, h = Mesh::next(h)) range.add(height(mesh_.origin(h)));
            if (!(range.width() <= width_) || !looks_up(f)) return std::nullopt;
        }
        return range;
    }

    bool fits(FaceId facet) {
        const auto range = range_with(facet, range_);
        if (range) range_ = *range;
        return range.has_value();
    }

    void accept(FaceId facet) {
        members_.push_back(facet);
        taken_[facet.index()] = 1;
        faces_ += (*lists_)[facet].size();
        if (members_.size() > 1)
            for (const FaceId f : (*lists_)[facet]) normal_ = normal_ + doubled_area(f);
        if (fitted_faces_ == 0) fitted_faces_ = faces_;
    }

    void push_border(FaceId facet) {
        for (const FaceId f : (*lists_)[facet]) {
            HalfedgeId h = Mesh::halfedge(f);
            for (int k = 0; k < 3; ++k, h = Mesh::next(h))
                if (near_[h.index()] != 0 && taken_[facets_[Mesh::face(mesh_.twin(h)).index()].index()] == 0)
                    border_.push_back(h);
        }
    }

    /// Turns the plane to the mean of its faces, where all of them still fit. False if nothing has changed since.
    bool refit() {
        if (faces_ == fitted_faces_) return false;
        fitted_faces_ = faces_;
        const TiltedAxis old = axis_;
        const auto axis = TiltedAxis::along(normal_);
        if (!axis) return false;
        axis_ = *axis;
        std::optional<Range> range = Range{};
        for (const FaceId facet : members_)
            if (range) range = range_with(facet, *range);
        if (range) {
            range_ = *range;
        } else {
            axis_ = old;
        }
        return range.has_value();
    }

    void join(FlatFacets& result) {
        result.planes.push_back({axis_.axis, axis_.side, range_.width()});
        for (const FaceId facet : members_) {
            for (const FaceId f : (*lists_)[facet]) {
                result.plane_of[f.index()] = static_cast<std::uint32_t>(result.planes.size());
                HalfedgeId h = Mesh::halfedge(f);
                for (int k = 0; k < 3; ++k, h = Mesh::next(h)) {
                    const HalfedgeId t = mesh_.twin(h);
                    if (t.valid() && result.plane_of[Mesh::face(t).index()] == result.planes.size())
                        marks_[h.index()] = marks_[t.index()] = Mark::planar;
                }
            }
        }
    }

    const Mesh& mesh_;
    const UnitFrame& frame_;
    double width_;
    std::vector<Mark>& marks_;
    std::vector<FaceId>& facets_;
    std::vector<std::uint8_t> near_;   ///< per half-edge: its two faces may lie in one flat facet
    std::vector<std::uint8_t> taken_;  ///< per facet
    std::optional<FacetLists> lists_;

    // The facet that grows.
    std::vector<FaceId> members_;
    std::vector<HalfedgeId> border_;
    std::size_t faces_ = 0;
    std::size_t fitted_faces_ = 0;
    Vec3 normal_;
    Vec3 origin_;
    TiltedAxis axis_;
    Range range_;
};

}  // namespace

FlatFacets join_flat_facets(const Mesh& mesh, const UnitFrame& frame, double width, std::vector<Mark>& marks,
                            std::vector<FaceId>& facets, const Context* context) {
    return width > 0 ? FacetGrowth(mesh, frame, width, marks, facets).run(context) : FlatFacets{};
}

}  // namespace delmesh
