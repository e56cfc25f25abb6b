#include "delmesh/mesh/shapes.hpp"

#include "delmesh/base/error.hpp"
#include "mesh/shape_makers.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace delmesh {

namespace {

struct Sample {
    SampleInfo info;
    shapes::Maker make;
};

constexpr std::array<Sample, 18> all_samples{{
    {{"grid", "plane square grid with integer coordinates: every edge is co-circular", 20000}, shapes::make_grid},
    {{"inclined-grid", "the same with spacing 0.1, turned in space: flat and co-circular but for rounding", 2000},
     shapes::make_inclined_grid},
    {{"jittered-grid", "plane grid with moved points: a sixth of the edges want a flip, none a split", 20000},
     shapes::make_jittered_grid},
    {{"saddle", "open hyperbolic paraboloid", 20000}, shapes::make_saddle},
    {{"terrain", "open noisy height field with holes", 20000}, shapes::make_terrain},
    {{"icosphere", "geodesic sphere, Delaunay as it is", 20000}, shapes::make_icosphere},
    {{"stretched-sphere", "geodesic sphere stretched 8 times", 5120}, shapes::make_stretched_sphere},
    {{"noisy-sphere", "sphere with noise: about 10 % of the edges are not Delaunay", 20000}, shapes::make_noisy_sphere},
    {{"noisy-surface", "closed bumpy surface with noise: about 12 % of the edges are not Delaunay", 100000},
     shapes::make_noisy_surface},
    {{"torus", "torus of rhombi, each cut along its long diagonal", 20000}, shapes::make_torus},
    {{"sheared-box", "box sheared into slivers, with exactly plane sides", 4800}, shapes::make_sheared_box},
    {{"plate", "plate with steps and holes in uneven sheared cells: plane sides, sharp edges, many handles", 5000},
     shapes::make_plate},
    {{"washer", "flat ring of needles, as CAD systems write it", 2000}, shapes::make_washer},
    {{"spikes", "plane with thin spikes: edges that can not be flipped", 4000}, shapes::make_spikes},
    {{"thin-helix", "pinched tube, a chain of stretched tetrahedra: edges that can not be flipped", 2000},
     shapes::make_thin_helix},
    {{"flat-tets", "nearly flat tetrahedra, down to a thickness of 2e-9", 400}, shapes::make_flat_tets},
    {{"needle-fans", "fans of needles with angles down to 1e-9", 310}, shapes::make_needle_fans},
    {{"many-parts", "spheres, tori, boxes, patches and tetrahedra of many sizes", 20000}, shapes::make_many_parts},
}};

constexpr auto all_infos = [] {
    std::array<SampleInfo, all_samples.size()> infos{};
    for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = all_samples[i].info;
    return infos;
}();

/// Faces whose half-edges still have 32-bit ids, with room for what a sample adds to what was asked for.
constexpr std::size_t max_faces = 1'000'000'000;

}  // namespace

std::span<const SampleInfo> samples() {
    return all_infos;
}

PolygonSoup make_sample(std::string_view name, std::size_t faces, unsigned seed) {
    const auto* sample = std::find_if(all_samples.begin(), all_samples.end(),
                                      [name](const Sample& candidate) { return candidate.info.name == name; });
    if (sample == all_samples.end()) {
        throw Error(ErrorCode::bad_argument, "there is no sample named '" + std::string(name) + "'");
    }
    if (faces > max_faces) throw Error(ErrorCode::bad_argument, "a sample can not have more than 10^9 faces");
    return sample->make(faces == 0 ? sample->info.default_faces : faces, shapes::Noise(seed));
}

}  // namespace delmesh
