#pragma once
// One function for each sample: about `faces` faces, from one source of noise.

#include "mesh/shape_tools.hpp"

namespace delmesh::shapes {

using Maker = PolygonSoup (*)(std::size_t faces, const Noise& noise);

// shape_surfaces.cpp: grids, spheres and other smooth surfaces
PolygonSoup make_grid(std::size_t faces, const Noise& noise);
PolygonSoup make_inclined_grid(std::size_t faces, const Noise& noise);
PolygonSoup make_jittered_grid(std::size_t faces, const Noise& noise);
PolygonSoup make_saddle(std::size_t faces, const Noise& noise);
PolygonSoup make_terrain(std::size_t faces, const Noise& noise);
PolygonSoup make_icosphere(std::size_t faces, const Noise& noise);
PolygonSoup make_stretched_sphere(std::size_t faces, const Noise& noise);
PolygonSoup make_noisy_sphere(std::size_t faces, const Noise& noise);
PolygonSoup make_noisy_surface(std::size_t faces, const Noise& noise);
PolygonSoup make_torus(std::size_t faces, const Noise& noise);

// shape_bodies.cpp: bodies with features, thin and extreme things
PolygonSoup make_sheared_box(std::size_t faces, const Noise& noise);
PolygonSoup make_plate(std::size_t faces, const Noise& noise);
PolygonSoup make_washer(std::size_t faces, const Noise& noise);
PolygonSoup make_spikes(std::size_t faces, const Noise& noise);
PolygonSoup make_thin_helix(std::size_t faces, const Noise& noise);
PolygonSoup make_flat_tets(std::size_t faces, const Noise& noise);
PolygonSoup make_needle_fans(std::size_t faces, const Noise& noise);
PolygonSoup make_many_parts(std::size_t faces, const Noise& noise);

}  // namespace delmesh::shapes
