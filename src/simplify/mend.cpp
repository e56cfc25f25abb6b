#include "simplify/mend.hpp"

#include "delaunay/non_delaunay.hpp"
#include "delaunay/vertex_limit.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "simplify/decimator.hpp"
#include "simplify/diagonal.hpp"
#include "simplify/faults.hpp"
#include "simplify/frame.hpp"
#include "simplify/least_vertices.hpp"
#include "simplify/numbering.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace delmesh {
namespace {

/// How many neighbours of a vertex say where it could go.
constexpr std::size_t most_neighbours = 12;
constexpr int draws = 3;

/// Of the edge of h and the four around it.
std::size_t faults_beside(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    std::size_t faults = 0;
    for (const HalfedgeId e : {h, Mesh::next(h), Mesh::prev(h), Mesh::next(t), Mesh::prev(t)})
        faults += is_non_delaunay(mesh, e) ? 1 : 0;
    return faults;
}

}  // namespace

bool Mender::flip_edge(HalfedgeId h) {
    if (mesh_.is_boundary(h) || !can_flip(mesh_, h) || turns_over(mesh_, scale_, h)) return false;
    const std::size_t before = faults_beside(mesh_, h);
    log_.keep();
    const std::size_t after = faults_beside(mesh_, log_.flip(h));
    if (after < before || (after == before && random_.uniform() < 0.25)) return true;
    log_.undo();
    return false;
}

/// Needles are Delaunay where their ends lie at one height: so along the longest edge to the height of a neighbour, or
/// just towards it. All is drawn between places at the start, so that nothing shrinks from pass to pass.
bool Mender::move_vertex(VertexId v) {
    gather(mesh_, v, scale_, star_);
    const std::size_t before = count_faults(mesh_, star_);
    if (before == 0) return false;
    Vec3 longest;
    for (const Star::Corner& corner : star_.ring)
        if (squared_norm(corner.point) > squared_norm(longest)) longest = corner.point;
    const Vec3 along = longest * (1 / std::sqrt(squared_norm(longest)));
    Vec3 best;
    bool found = false;
    std::size_t fewest = before + 1;
    double least = 0;
    const auto look_at = [&](const Vec3& w) {
        if (turns_over(star_, w)) return;
        const std::size_t faults = count_faults(mesh_, star_, w);
        const double far = squared_norm(w);
        if (faults > fewest || (faults == fewest && found && far >= least) || far == 0) return;
        best = w, fewest = faults, least = far, found = true;
    };
    for (std::size_t i = 0; i < std::min(star_.ring.size(), most_neighbours); ++i)
        look_at(along * dot(star_.ring[i].point, along));
    if (fewest >= before && random_.uniform() < 0.5) found = false;
    for (int i = 0; i < draws; ++i) look_at(draw_place(v));
    if (!found || (fewest == before && random_.uniform() < 0.5)) return false;
    const Vec3 to = settle_(star_.frame.to_mesh(best));
    if (to == mesh_.point(v)) return false;
    mesh_.set_point(v, to);
    return true;
}

Vec3 Mender::draw_place(VertexId v) {
    const auto local = [&](VertexId at) { return star_.frame.to_local(homes_[at.index()]); };
    const auto neighbour = [&] {
        return local(
            star_.ring[static_cast<std::size_t>(random_.uniform() * static_cast<double>(star_.ring.size()))].vertex);
    };
    const double part = random_.uniform();
    const double far = part * part * part;
    const Vec3 home = local(v);
    const Vec3 first = neighbour();
    const Vec3 second = neighbour();
    Vec3 lift;
    if (random_.uniform() < 0.5) {
        const Vec3& normal = star_.ring[0].old_normal;
        const double twice_area = std::sqrt(squared_norm(normal));
        if (twice_area > 0) lift = normal * ((random_.uniform() - 0.5) * far / std::sqrt(twice_area));
    }
    return home + (first - home) * far + (second - home) * (far * random_.uniform()) + lift;
}

std::size_t Mender::run(std::uint64_t seed) {
    random_ = Random(seed);
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh_.names_edge(h) || !is_non_delaunay(mesh_, h) || flip_edge(h)) continue;
        for (const VertexId v : {mesh_.origin(h), mesh_.target(h), mesh_.apex(h)}) (void)move_vertex(v);
        if (mesh_.twin(h).valid()) (void)move_vertex(mesh_.apex(mesh_.twin(h)));
    }
    return count_faults(mesh_);
}

namespace {

/// In one go, and what the passes may look at: half-edges.
constexpr int passes = 40;
constexpr int rounds = 12;
constexpr std::size_t most_work = 50'000'000;

void decimate(Mesh& mesh, Tuning& tuning, Precision precision, std::size_t vertices, Mending how,
              const Context* context) {
    tuning.mending = how;
    Decimator(mesh, tuning, {0, precision}).run(vertices, context);
    drop_isolated(mesh);
    renumber(mesh, Numbering(mesh).in_order_of_names(mesh));
}

/// Where few faults are left, few points may do. What has lost its length or area on the way here can not be split.
bool split_the_rest(Mesh& mesh, const RemeshOptions& remesh, std::size_t vertices, const Context* context) {
    RemeshOptions few = with_at_most(remesh, vertices);
    few.placement = SplitPlacement::shells;
    Mesh copy = mesh;
    try {
        if (make_delaunay(copy, few, context).stop != StopReason::done) return false;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::zero_length_edge || error.code() == ErrorCode::degenerate_geometry) return false;
        throw;
    }
    mesh = std::move(copy);
    return true;
}

}  // namespace

bool mend(Mesh& mesh, Tuning tuning, const RemeshOptions& remesh, std::size_t vertices, const Context* context) {
    const Precision precision = remesh.precision;
    tuning.constrained = false;
    const double scale = local_scale(mesh);
    const std::size_t least = least_vertices(mesh);
    const auto settle = [precision](const Vec3& w) { return precision == Precision::float32 ? round_to_float(w) : w; };
    std::uint64_t seed = 0;
    std::size_t work = 0;
    std::vector<Vec3> homes;
    for (std::size_t wanted = 2 * vertices;; wanted /= 2) {
        const std::size_t stop = std::max(wanted, least);
        for (int round = 0; round < rounds && work < most_work && !is_cancelled(context); ++round) {
            decimate(mesh, tuning, precision, stop, Mending::fewer, context);
            decimate(mesh, tuning, precision, stop, Mending::no_more, context);
            std::size_t faults = count_faults(mesh);
            if (homes.size() != mesh.vertex_count()) homes.assign(mesh.points().begin(), mesh.points().end());
            Mender mender(mesh, scale, settle, homes);
            for (int pass = 0; pass < passes && faults > 0 && work < most_work; ++pass) {
                faults = mender.run(++seed);
                work += mesh.halfedge_count();
            }
            if (faults > 0) decimate(mesh, tuning, precision, least, Mending::only_faults, context);
            if (count_faults(mesh) == 0) return true;
        }
        if (mesh.vertex_count() < vertices && split_the_rest(mesh, remesh, vertices, context)) return true;
        if (stop == least || work >= most_work || is_cancelled(context)) return false;
    }
}

}  // namespace delmesh
