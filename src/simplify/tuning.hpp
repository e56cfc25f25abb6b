#pragma once

#include <cstddef>

namespace delmesh {

/// What a collapse may do to a mesh that is not Delaunay, where `Tuning::constrained` is false.
enum class Mending : unsigned char {
    off,          ///< anything
    no_more,      ///< it leaves no more edges that are not Delaunay than there were around
    fewer,        ///< ... or fewer, where there were any
    only_faults,  ///< only where there were any, and it leaves fewer
};

/// The weights and limits of the decimator, found by measurement (docs/simplify.md).
struct Tuning {
    int area_power = 2;         ///< a plane counts with this power of its face's area: 1 or 2
    double boundary = 10;       ///< weight of planes upright on boundary and crease edges
    double crease_cosine = -1;  ///< edges whose faces' normals have a smaller cosine are creases
    double volume = 1;          ///< weight of keeping the volume, relative to the trace of the quadric
    double regular = 1e-5;      ///< pull to the edge's midpoint, relative to the trace
    double length_cost = 1e-9;  ///< breaks ties of flat regions in favour of short edges
    int bisections = 4;
    int sqp_steps = 1;
    double slack = 1.5;           ///< an edge is collapsed at once if it costs at most this times the next key
    double samples = 30000;       ///< so many samples of the original are followed ...
    double density = 12;          ///< ... and so many more for each vertex of the finest level, as far as there are
    double density_of_large = 8;  ///< ... or that many, where a large mesh is thinned to a level of many vertices
    double reach = 4.5;           ///< no sample gets farther away than this many times the root of the mean square
    double guard = 3;             ///< ... once fewer than this many times the vertices asked for are left
    double sweep_until = 2;   ///< while more than so many times the vertices asked for are left, edges go in sweeps ...
    double sweep_part = 0.4;  ///< ... each of which tries the cheapest so many of those that may be free
    double sweep_reach = 2.5;  ///< ... and moves no end farther off than this many times the usual (root mean square)
    double sweep_many = 1.5;   ///< as `sweep_until`, where very many vertices are asked for
    bool ends = true;          ///< the ends of an edge are tried as places
    std::size_t polish_below = 12000;  ///< levels of up to so many vertices get care for single vertices:
    double reduce_from = 1.2;          ///< from this many times the number wanted on, edges go by the samples' sum ...
    std::size_t reduce_most = 600;     ///< ... or only so many of them;
    int polish_rounds = 6;             ///< then vertices are exchanged in so many rounds at most ...
    double polish_gain = 0.025;        ///< ... as long as each lowers the mean square by this part ...
    std::size_t polish_most = 2000;    ///< ... tries so many changes of each kind at most ...
    std::size_t polish_few = 1000;     ///< ... or only so many where there are many vertices ...
    std::size_t polish_work = 5'000'000;  ///< ... in between, as many as times the vertices make that ...
    double polish_reach2 = 1.35;          ///< ... and may leave samples farther off by this factor (squared)
    bool paper = false;       ///< the paper's placement, with quadrics that add up (else those of the current faces)
    bool constrained = true;  ///< false: for comparison only; the result is not Delaunay
    Mending mending = Mending::off;  ///< instead, where the mesh is not Delaunay yet

    /// Section 5 of the paper: the quadrics of Garland and Heckbert, and nothing else.
    static Tuning of_the_paper(double crease_cosine) {
        Tuning tuning;
        tuning.area_power = 1;
        tuning.crease_cosine = crease_cosine;
        tuning.volume = 0;
        tuning.paper = true;
        return tuning;
    }
};

}  // namespace delmesh
