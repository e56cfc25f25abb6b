#include "delaunay/clean.hpp"

#include "base/parallel.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/non_delaunay.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {
namespace {

/// The indices below `count` for which the test holds, in order.
template <class Test>
std::vector<std::size_t> find_where(std::size_t count, const Context* context, Test&& test) {
    std::vector<std::uint8_t> holds(count, 0);
    parallel_blocks(count, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) holds[i] = test(i) ? 1 : 0;
    });
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < count; ++i)
        if (holds[i] != 0) found.push_back(i);
    return found;
}

bool has_no_length(const Mesh& mesh, HalfedgeId h) {
    return mesh.is_live(Mesh::face(h)) && mesh.point(mesh.origin(h)) == mesh.point(mesh.target(h));
}

/// The half-edge of the same edge that leaves the vertex to keep: one of the input, else the older one.
HalfedgeId from_kept(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    return t.valid() && mesh.origin(t) < mesh.origin(h) ? t : h;
}

Cleaning merge_vertices(MarkedMesh& marked, const Context* context) {
    const Mesh& mesh = marked.mesh();
    std::vector<std::size_t> edges = find_where(mesh.halfedge_count(), context, [&mesh](std::size_t i) {
        return mesh.names_edge(HalfedgeId(i)) && has_no_length(mesh, HalfedgeId(i));
    });
    Cleaning result;
    for (bool again = true; again;) {
        again = false;
        std::vector<std::size_t> blocked;
        for (const std::size_t i : edges) {
            if (!has_no_length(mesh, HalfedgeId(i))) continue;
            const HalfedgeId h = from_kept(mesh, HalfedgeId(i));
            if (!can_collapse(mesh, h) || (!marked.is_input(mesh.origin(h)) && marked.is_input(mesh.target(h)))) {
                blocked.push_back(i);
                continue;
            }
            marked.merge(h);
            ++result.changes;
            again = true;
        }
        edges = std::move(blocked);
    }
    if (result.changes > 0) {
        marked.compact_all();
    } else if (!edges.empty()) {
        result.left = mesh.edge(HalfedgeId(edges.front()));
    }
    return result;
}

class CapRemoval {
public:
    CapRemoval(MarkedMesh& marked, const Context* context) : marked_(marked), mesh_(marked.mesh()) {
        const auto is_flat = [this](std::size_t f) { return is_cap(mesh_, FaceId(f)); };
        for (const std::size_t f : find_where(mesh_.face_count(), context, is_flat)) caps_.emplace_back(f);
    }

    Cleaning run() {
        Cleaning result;
        bool dropped = false;
        while (!caps_.empty()) {
            const FaceId f = caps_.back();
            caps_.pop_back();
            if (!mesh_.is_live(f) || !is_cap(mesh_, f)) continue;
            const HalfedgeId h = side_to_flip(mesh_, f);
            if (mesh_.is_boundary(h) && can_remove_face(mesh_, Mesh::face(h))) {
                marked_.drop(Mesh::face(h));
                dropped = true;
            } else if (marked_.is_flippable(h)) {
                flip(h);
            } else {
                result.left = mesh_.edge(h);
                continue;
            }
            ++result.changes;
            if (mesh_.is_live(f)) caps_.push_back(f);
        }
        if (dropped) {
            marked_.compact_all();
            result.left.reset();
        }
        return result;
    }

private:
    void flip(HalfedgeId h) {
        const FaceId other = Mesh::face(mesh_.twin(h));
        marked_.flip_cap(h);
        caps_.push_back(other);
        caps_.push_back(Mesh::face(h));
    }

    MarkedMesh& marked_;
    const Mesh& mesh_;
    std::vector<FaceId> caps_;
};

}  // namespace

Cleaning clean_up(MarkedMesh& marked, const Context* context) {
    Cleaning merged = merge_vertices(marked, context);
    Cleaning result = CapRemoval(marked, context).run();
    result.changes += merged.changes;
    // Any change may free what was stuck; the edge that could not go is of interest only without one.
    if (!result.left) result.left = merged.left;
    return result;
}

}  // namespace delmesh
