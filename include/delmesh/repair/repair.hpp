#pragma once
// Makes a manifold of whatever a file holds. docs/repair.md explains each step and every choice.

#include "delmesh/base/context.hpp"
#include "delmesh/base/ids.hpp"
#include "delmesh/base/option.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace delmesh {

struct RepairOptions {
    /// Vertices that are no farther apart than this fraction of the bounding-box diagonal become one. 0: only vertices
    /// at exactly the same place do. In [0, 1].
    double weld_tolerance_rel = 0;
    /// Turns closed components outwards even where all of them face inwards and agree in themselves, so that the
    /// orientation could be meant. (Where they disagree, they are always turned.)
    bool outward = false;

    /// See option.hpp.
    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit(self.weld_tolerance_rel,
              OptionInfo{.name = "weld",
                         .unit = "rel",
                         .lowest = 0,
                         .highest = 1,
                         .help = "vertices no farther apart than this become one; 0: only at exactly the same place"});
        visit(self.outward, OptionInfo{.name = "outward",
                                       .help = "turn closed components outwards even where all of them face inwards"});
    }
};

/// What can be wrong with a soup, in the order in which it is mended.
enum class Defect : unsigned char {
    index_out_of_range,   ///< faces that name a vertex which is not there: dropped
    not_finite,           ///< vertices with a NaN or an infinity: dropped
    face_not_finite,      ///< faces that use such a vertex: dropped
    repeated_vertex,      ///< faces that repeat a vertex: dropped, or cut down where three vertices remain
    duplicate_vertex,     ///< vertices at the place of another one, with which they were joined to close a seam
    near_vertex,          ///< vertices moved, within the tolerance, to the place of another one
    zero_length_edge,     ///< faces of which two corners are at one place: dropped
    zero_area,            ///< faces without area: flipped away with a neighbour, or dropped at a boundary
    zero_area_dropped,    ///< faces without area that are connected with no face that has area: dropped
    duplicate_face,       ///< faces at the place of another one: dropped
    non_manifold_edge,    ///< edges with three or more faces: these were joined in pairs
    inconsistent_face,    ///< faces that were turned round to agree with their component
    non_orientable,       ///< non-orientable components, each named by a face: cut open
    cut_edge,             ///< the edges at which they were cut
    inside_out,           ///< outermost closed components that faced inwards, each named by a face: turned round
    non_manifold_vertex,  ///< vertices with more than one fan of faces: each fan got a vertex of its own
    isolated_vertex,      ///< vertices without a face: dropped
    stray_line,           ///< line elements whose ends are gone, or that repeat another one: dropped
};
inline constexpr std::size_t defect_kinds = static_cast<std::size_t>(Defect::stray_line) + 1;

/// The name of a kind, as it stands in JSON.
[[nodiscard]] std::string_view name(Defect kind);
/// What the numbers in `Finding::places` are: "vertices", "faces", "lines" or "vertex pairs" (flattened).
[[nodiscard]] std::string_view places_are(Defect kind);

/// One kind of defect: how many there were, and the first of them (at most 16 numbers) as elements of the input.
struct Finding {
    Defect kind{};
    std::size_t count = 0;
    std::vector<std::size_t> places;
};

/// A sentence for people, for example: "3 faces repeat a vertex: dropped (faces 4, 17, 23)".
[[nodiscard]] std::string sentence(const Finding& finding);

struct RepairReport {
    /// False if the soup is what it was, bit for bit.
    bool changed = false;
    /// The context was cancelled: the soup is what it was, and nothing else here means anything.
    bool cancelled = false;
    /// The kinds that were found, in the order of `Defect`; empty if nothing was changed.
    std::vector<Finding> findings;
    /// For each output vertex the input vertex it was made of (the one whose number it kept, or was copied from).
    std::vector<VertexId> vertex_origin;
    /// For each output face the input face in which it lies.
    std::vector<FaceId> face_origin;

    [[nodiscard]] std::size_t count(Defect kind) const {
        for (const Finding& f : findings)
            if (f.kind == kind) return f.count;
        return 0;
    }
    /// Calls visitor(name, count, places, what the places are, sentence) for each finding.
    template <class Visitor>
    void visit(Visitor&& visitor) const {
        for (const Finding& f : findings) visitor(name(f.kind), f.count, f.places, places_are(f.kind), sentence(f));
    }
};

/// Makes a soup from which a `Mesh` can be built, whatever the soup was: an oriented manifold without isolated
/// vertices, zero-length edges or faces of exactly zero area.
///
/// Guarantees: the points of the surface stay where they are (unless a tolerance is given, and then no vertex moves
/// farther than that); no boundary appears at an edge with an even number of faces, except where a surface that can not
/// be oriented is cut, and at an obtuse triangle that only its own back was joined with, which goes; vertices and faces
/// keep their order, and copies of vertices follow at the end; a clean soup stays as it is bit for bit, polygons too; a
/// second repair changes nothing. If anything was wrong the result consists of triangles. Deterministic. Does not mend
/// self-intersections, gaps, or a vertex that touches the inside of an edge.
///
/// Throws `Error`: bad_argument (an option out of range, or `starts` that do not fit `corners`), too_large. On any
/// exception the soup is what it was. Cost: O(n log n) time, O(n) memory.
RepairReport repair(PolygonSoup& soup, const RepairOptions& options = {}, const Context* context = nullptr);

/// What `repair` would report; the soup stays as it is.
[[nodiscard]] RepairReport diagnose(const PolygonSoup& soup, const RepairOptions& options = {},
                                    const Context* context = nullptr);

}  // namespace delmesh
