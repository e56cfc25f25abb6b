#pragma once
// Where the vertices and faces of a remeshed mesh come from.

#include "delmesh/base/ids.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delmesh {

/// The point (1 - t) * a + t * b on the input edge from a to b, a < b, 0 < t < 1, both input vertices. In the rare
/// case of a point inside a facet, or put in after one (see docs/provenance.md), `a` and `b` are the ends of the split
/// edge at that time.
struct SplitPoint {
    VertexId a;
    VertexId b;
    double t = 0;
};

struct Provenance {
    /// Output vertices below this are the input vertices, in order, bit for bit.
    std::size_t input_vertices = 0;
    /// Output vertex `input_vertices + i` was made at `splits[i]`.
    std::vector<SplitPoint> splits;
    /// For each output face, the planar facet it lies in; facets are named by their smallest input face.
    std::vector<FaceId> facet_of_face;
    /// For each input face its facet (faces joined across planar edges).
    std::vector<FaceId> facet_of_input_face;
};

}  // namespace delmesh
