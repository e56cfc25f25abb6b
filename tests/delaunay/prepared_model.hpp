#pragma once

#include "delaunay/classify.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/split_model.hpp"

#include <utility>

namespace delmesh::test {

/// A model in which every physical edge is prepared.
struct PreparedModel {
    explicit PreparedModel(Mesh from)
        : mesh(std::move(from)),
          marked(mesh, mark_edges(mesh, nullptr), {}),
          model(marked) {
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
            if (!marked.is_planar(HalfedgeId(i))) model.prepare(model.edge_of(HalfedgeId(i)));
    }

    Mesh mesh;
    MarkedMesh marked;
    SplitModel model;
};

}  // namespace delmesh::test
