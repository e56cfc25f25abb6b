#include "delaunay/flat_caps.hpp"

#include "base/parallel.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delmesh/mesh/edits.hpp"
#include "exact/double_double.hpp"

#include <algorithm>
#include <vector>

namespace delmesh {
namespace {

using exact::DoubleDouble;
using exact::two_sum;

/// More than all roundings of a length or a quotient can take away from it, relatively.
constexpr double upwards = 1 + 0x1p-48;
/// What underflow in the frame may add to a height.
constexpr double underflow = 0x1p-500;

HalfedgeId longest_side(const Mesh& mesh, const UnitFrame& frame, FaceId f) {
    HalfedgeId longest;
    double length = -1;
    for (HalfedgeId h = Mesh::halfedge(f); Mesh::face(h) == f; h = HalfedgeId(h.value() + 1)) {
        const double d = squared_norm(frame(mesh.point(mesh.target(h))) - frame(mesh.point(mesh.origin(h))));
        if (d > length) longest = h;
        length = std::max(length, d);
    }
    return longest;
}

class CapFlips {
public:
    CapFlips(Mesh& mesh, const UnitFrame& frame, double allowed)
        : mesh_(mesh),
          plain_(&mesh),
          frame_(frame),
          allowed_(allowed) {}
    CapFlips(MarkedMesh& marked, const UnitFrame& frame, double allowed)
        : mesh_(marked.mesh()),
          marked_(&marked),
          frame_(frame),
          allowed_(allowed) {}

    FlatCaps run(const Context* context) {
        find_low_faces(context);
        if (!low_.empty()) moved_.assign(mesh_.face_count(), 0);
        while (!low_.empty()) {
            const FaceId f = low_.back();
            low_.pop_back();
            try_flip(f);
        }
        return result_;
    }

private:
    void find_low_faces(const Context* context) {
        std::vector<std::uint8_t> low(mesh_.face_count(), 0);
        parallel_blocks(mesh_.face_count(), context, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) low[f] = is_low(FaceId(f)) ? 1 : 0;
        });
        for (std::size_t f = low.size(); f-- > 0;)
            if (low[f] != 0) low_.emplace_back(f);
    }

    /// Plain doubles first: they see most faces to be far too high.
    [[nodiscard]] bool is_low(FaceId f) const {
        const HalfedgeId h = Mesh::halfedge(f);
        const Vec3 a = frame_(mesh_.point(mesh_.origin(h)));
        const Vec3 b = frame_(mesh_.point(mesh_.target(h))) - a;
        const Vec3 c = frame_(mesh_.point(mesh_.apex(h))) - a;
        const double square = std::max({squared_norm(b), squared_norm(c), squared_norm(c - b)});
        const double limit = 2 * allowed_ + 0x1p-48;
        return squared_norm(cross(b, c)) <= limit * limit * square &&
               height_above(mesh_, frame_, longest_side(mesh_, frame_, f)) <= allowed_;
    }

    void try_flip(FaceId f) {
        const HalfedgeId h = longest_side(mesh_, frame_, f);
        const HalfedgeId t = mesh_.twin(h);
        if (!t.valid() || !is_non_delaunay(mesh_, h) || !may_flip(h)) return;
        const FaceId g = Mesh::face(t);
        const double moved = std::max(moved_[f.index()], moved_[g.index()]) + height_above(mesh_, frame_, h);
        if (!(moved * upwards <= allowed_)) return;
        marked_ != nullptr ? marked_->flip_cap(h) : flip(*plain_, h);
        moved_[f.index()] = moved_[g.index()] = moved * upwards;
        result_.moved = std::max(result_.moved, moved * upwards);
        ++result_.flips;
        for (const FaceId made : {g, f})
            if (is_low(made)) low_.push_back(made);
    }

    [[nodiscard]] bool may_flip(HalfedgeId h) const {
        return marked_ != nullptr ? marked_->is_flippable(h) : can_flip(mesh_, h) && !makes_cap(h);
    }

    /// Would the flip leave a face without area, or an edge without length?
    [[nodiscard]] bool makes_cap(HalfedgeId h) const {
        const HalfedgeId t = mesh_.twin(h);
        const Vec3& u = mesh_.point(mesh_.apex(h));
        const Vec3& v = mesh_.point(mesh_.apex(t));
        return u == v || exact::are_collinear_inline(u, v, mesh_.point(mesh_.origin(h))) ||
               exact::are_collinear_inline(u, v, mesh_.point(mesh_.target(h)));
    }

    const Mesh& mesh_;
    Mesh* plain_ = nullptr;         ///< the same, if that is all there is
    MarkedMesh* marked_ = nullptr;  ///< else
    const UnitFrame& frame_;
    double allowed_;
    std::vector<FaceId> low_;
    std::vector<double> moved_;
    FlatCaps result_;
};

}  // namespace

double height_above(const Mesh& mesh, const UnitFrame& frame, HalfedgeId h) {
    const Vec3 p = frame(mesh.point(mesh.origin(h)));
    const Vec3 q = frame(mesh.point(mesh.target(h)));
    const Vec3 u = frame(mesh.point(mesh.apex(h)));
    const DoubleDouble a[3] = {two_sum(q.x, -p.x), two_sum(q.y, -p.y), two_sum(q.z, -p.z)};
    const DoubleDouble b[3] = {two_sum(u.x, -p.x), two_sum(u.y, -p.y), two_sum(u.z, -p.z)};
    const Vec3 normal{(a[1] * b[2] - a[2] * b[1]).value(), (a[2] * b[0] - a[0] * b[2]).value(),
                      (a[0] * b[1] - a[1] * b[0]).value()};
    // The products cancel, which leaves an error of 2^-98 of their size.
    const double length = norm(q - p);
    return (norm(normal) + 0x1p-98 * length * (norm(u - p) + length) + underflow) / length * upwards;
}

FlatCaps flip_flat_caps(Mesh& mesh, const UnitFrame& frame, double allowed, const Context* context) {
    return allowed > 0 ? CapFlips(mesh, frame, allowed).run(context) : FlatCaps{};
}

FlatCaps flip_flat_caps(MarkedMesh& marked, const UnitFrame& frame, double allowed, const Context* context) {
    return allowed > 0 ? CapFlips(marked, frame, allowed).run(context) : FlatCaps{};
}

}  // namespace delmesh
