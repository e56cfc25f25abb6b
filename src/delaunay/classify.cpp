#include "delaunay/classify.hpp"

#include "base/parallel.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/edits.hpp"
#include "exact/inline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace delmesh {
namespace {

constexpr std::size_t max_listed = 16;

void check_lengths(const Mesh& mesh) {
    std::vector<std::size_t> ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.names_edge(h) || mesh.point(mesh.origin(h)) != mesh.point(mesh.target(h))) continue;
        if (ends.size() < max_listed) ends.insert(ends.end(), {mesh.origin(h).index(), mesh.target(h).index()});
        ++count;
    }
    if (count == 0) return;
    throw Error(ErrorCode::zero_length_edge,
                fmt::format("vertices {} and {} are joined by an edge but lie at the same place{}; `delmesh repair` "
                            "welds them",
                            ends[0], ends[1], count > 1 ? fmt::format(" (and {} more pairs)", count - 1) : ""),
                ends, count);
}

/// The side of a zero-area face that holds its third corner.
HalfedgeId long_side(const Mesh& mesh, FaceId f) {
    HalfedgeId h = Mesh::halfedge(f);
    for (int i = 0; i < 2; ++i, h = Mesh::next(h)) {
        const Sign sign =
            right_angle_sign(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)));
        if (sign == Sign::negative) return h;
    }
    return h;
}

[[noreturn]] void fail_at_cap(const Mesh& mesh, FaceId f) {
    const HalfedgeId h = Mesh::halfedge(f);
    const std::vector<std::size_t> corners{mesh.origin(h).index(), mesh.target(h).index(), mesh.apex(h).index()};
    throw Error(ErrorCode::degenerate_geometry,
                fmt::format("the face of vertices {}, {} and {} has no area and can not be flipped away; "
                            "`delmesh repair` removes such faces",
                            corners[0], corners[1], corners[2]),
                corners, 1);
}

/// Takes one cap away; the faces that may be caps now go onto the list.
void remove_cap(Mesh& mesh, HalfedgeId h, std::vector<FaceId>& caps) {
    const FaceId f = Mesh::face(h);
    if (mesh.is_boundary(h)) {
        if (!can_remove_face(mesh, f)) fail_at_cap(mesh, f);
        remove_face(mesh, f);
        return;
    }
    // Two points at the same place would make an edge without length.
    const HalfedgeId t = mesh.twin(h);
    if (!can_flip(mesh, h) || mesh.point(mesh.apex(h)) == mesh.point(mesh.apex(t))) fail_at_cap(mesh, f);
    const FaceId other = Mesh::face(t);
    flip(mesh, h);
    for (const FaceId g : {other, f})
        if (is_cap(mesh, g)) caps.push_back(g);
}

}  // namespace

bool is_cap(const Mesh& mesh, FaceId f) {
    const HalfedgeId h = Mesh::halfedge(f);
    const Vec3& a = mesh.point(mesh.origin(h));
    const Vec3& b = mesh.point(mesh.target(h));
    const Vec3& c = mesh.point(mesh.apex(h));
    return exact::are_collinear_inline(a, b, c) && a != b && b != c && c != a;
}

HalfedgeId side_to_flip(const Mesh& mesh, FaceId f) {
    HalfedgeId h = long_side(mesh, f);
    for (;;) {
        const HalfedgeId t = mesh.twin(h);
        if (!t.valid() || !is_cap(mesh, Mesh::face(t))) return h;
        const HalfedgeId longer = long_side(mesh, Mesh::face(t));
        if (longer == t) return h;
        h = longer;
    }
}

std::size_t remove_caps(Mesh& mesh, const Context* context) {
    check_lengths(mesh);
    std::vector<std::uint8_t> flat(mesh.face_count(), 0);
    parallel_blocks(mesh.face_count(), context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) flat[f] = is_cap(mesh, FaceId(f)) ? 1 : 0;
    });
    std::vector<FaceId> caps;
    for (std::size_t f = flat.size(); f-- > 0;)
        if (flat[f] != 0) caps.emplace_back(f);
    std::size_t changes = 0;
    bool removed = false;
    while (!caps.empty()) {
        const FaceId f = caps.back();
        caps.pop_back();
        if (!mesh.is_live(f) || !is_cap(mesh, f)) continue;
        const HalfedgeId h = side_to_flip(mesh, f);
        remove_cap(mesh, h, caps);
        removed = removed || !mesh.is_live(Mesh::face(h));
        if (Mesh::face(h) != f) caps.push_back(f);
        ++changes;
    }
    if (removed) compact(mesh);
    return changes;
}

std::vector<Mark> mark_edges(const Mesh& mesh, const Context* context) {
    std::vector<Mark> marks(mesh.halfedge_count(), Mark::physical);
    parallel_blocks(mesh.halfedge_count(), context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const HalfedgeId h(i);
            const HalfedgeId t = mesh.twin(h);
            if (!t.valid() || t < h) continue;
            const bool planar = exact::is_planar_edge_inline(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)),
                                                             mesh.point(mesh.apex(h)), mesh.point(mesh.apex(t)));
            if (planar) marks[i] = marks[t.index()] = Mark::planar;
        }
    });
    return marks;
}

std::vector<FaceId> find_facets(const Mesh& mesh, const std::vector<Mark>& marks) {
    std::vector<FaceId> parent;
    parent.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) parent.emplace_back(f);
    const auto root = [&parent](FaceId f) {
        while (parent[f.index()] != f) f = parent[f.index()] = parent[parent[f.index()].index()];
        return f;
    };
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const HalfedgeId h(i);
        if (marks[i] == Mark::physical || !mesh.names_edge(h)) continue;
        const FaceId a = root(Mesh::face(h));
        const FaceId b = root(Mesh::face(mesh.twin(h)));
        if (a != b) parent[std::max(a, b).index()] = std::min(a, b);
    }
    for (std::size_t f = 0; f < parent.size(); ++f) parent[f] = root(FaceId(f));
    return parent;
}

}  // namespace delmesh
