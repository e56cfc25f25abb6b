#pragma once
// What the merged vertex of a collapse [u,v] -> w would be surrounded by, and whether a place for w keeps all Delaunay.

#include "delmesh/mesh/mesh.hpp"
#include "simplify/frame.hpp"

#include <vector>

namespace delmesh {

/// Which condition a place for w violates.
enum class Blocker : unsigned char {
    none,
    topology,
    fold,
    subtending,
    incident,
    region,    ///< the half-spaces of the paper have no point in common
    rounding,  ///< all held in floating point, but not exactly
    error,
    distance,  ///< a sample of the original would be too far away
};
inline constexpr std::size_t blocker_count = 9;

/// Surviving face i is (w, ring[i], ring[i+1]); in a closed star the last one ends at ring[0].
struct Star {
    struct Corner {
        VertexId vertex;
        FaceId face;          ///< the face that starts here; not valid at the end of an open star
        HalfedgeId across;    ///< the ring edge that starts here, from inside
        Vec3 point;           ///< local
        Vec3 old_normal;      ///< of the face that starts here, before the collapse; twice its area long
        double cot_at_w = 0;  ///< of the face that starts here, as `find_blocker` found it last
        // From here on: once `find_outers` was called.
        VertexId outer;        ///< the vertex behind the ring edge that starts here; not valid at the boundary
        Vec3 outer_point;      ///< local
        double outer_cot = 0;  ///< cotangent of the angle at `outer`; 0 at the boundary
    };

    VertexId u, v;
    Frame frame;
    Vec3 u_point, v_point;  ///< local
    bool closed = false;
    bool has_outers = false;
    std::vector<Corner> ring;
    /// Normals of the one or two faces that die, and the local point u that lies in both.
    Vec3 dying[2];
    FaceId dying_face[2];
    int dying_count = 0;

    [[nodiscard]] std::size_t face_count() const { return closed ? ring.size() : ring.size() - 1; }
    [[nodiscard]] std::size_t before(std::size_t i) const { return (i == 0 ? ring.size() : i) - 1; }
    [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == ring.size() ? 0 : i + 1; }
};

/// Fills the star of the edge of h. False if the collapse would change the topology: the surviving faces must form one
/// chain or one cycle around w with distinct vertices.
[[nodiscard]] bool gather(const Mesh& mesh, HalfedgeId h, double scale, Star& star);

/// The star of a vertex as it is: nothing dies.
void gather(const Mesh& mesh, VertexId v, double scale, Star& star);

/// Looks up what lies behind the ring, unless that is known. Most stars are given up before that is needed.
void find_outers(const Mesh& mesh, Star& star);

/// The first condition that w (local) violates, in floating point; faces are tried from `first` on, which is set to the
/// offending one. Within rounding, `none` is only a proposal: `keeps_delaunay` decides.
[[nodiscard]] Blocker find_blocker(const Mesh& mesh, Star& star, const Vec3& w, std::size_t& first);

/// True if a face of the star turns over when its centre goes to w (local).
[[nodiscard]] bool turns_over(const Star& star, const Vec3& w);

/// Exact: no face of the star has lost its area with its centre at the given point of the mesh's space, so no edge its
/// length.
[[nodiscard]] bool keeps_area(const Mesh& mesh, const Star& star, const Vec3& w);

/// Exact; requires `find_outers`: the same, and every edge at w and every ring edge is Delaunay with w at the given
/// point of the mesh's space.
[[nodiscard]] bool keeps_delaunay(const Mesh& mesh, const Star& star, const Vec3& w);

}  // namespace delmesh
