#include "delmesh/mesh/shapes.hpp"
#include "repair/repair_support.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delmesh::test {
namespace {

TEST(Orient, TurnsTheFewer) {
    const PolygonSoup clean = make_sample("saddle", 200);
    PolygonSoup soup = clean;
    for (const std::size_t f : {3U, 17U, 40U, 41U, 99U}) turn_face(soup, f);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.corners, clean.corners);
    EXPECT_EQ(out.report.count(Defect::inconsistent_face), 5U);
    EXPECT_EQ(out.report.findings.front().places, (std::vector<std::size_t>{3, 17, 40, 41, 99}));
}

TEST(Orient, EachComponentByItself) {
    PolygonSoup soup = make_sample("saddle", 60);
    const std::size_t half = soup.face_count();
    append(soup, make_sample("saddle", 60));
    for (std::size_t i = 3 * half / 2; i < soup.points.size(); ++i) soup.points[i].z += 50;
    for (std::size_t f = half + 2; f < soup.face_count(); ++f) turn_face(soup, f);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.report.count(Defect::inconsistent_face), 2U);
}

TEST(Orient, ClosedComponentsFaceOutwards) {
    for (const std::size_t turned : {0U, 1U, 5U, 7U, 11U}) {
        SCOPED_TRACE(turned);
        PolygonSoup soup = make_cube({-5, 2, 1});
        for (std::size_t f = 0; f < turned; ++f) turn_face(soup, f);
        const Repaired out = repair_and_check(soup);
        EXPECT_NEAR(examine(out.soup).volume6, 6, 1e-12);
        EXPECT_LE(out.report.count(Defect::inconsistent_face), 6U);
        EXPECT_EQ(out.report.count(Defect::inside_out) > 0, turned > 6);
    }
}

/// Nothing is wrong with a mesh that faces inwards throughout: it stays, unless it is asked for.
TEST(Orient, WhatAgreesThatItFacesInwardsStays) {
    PolygonSoup soup = make_cube({0, 0, 0});
    append(soup, make_cube({5, 0, 0}));
    turn_all_faces(soup);
    EXPECT_FALSE(repair_and_check(soup).report.changed);
    EXPECT_NEAR(examine(repair_and_check(soup, {.outward = true}).soup).volume6, 12, 1e-12);
    // One that disagrees is enough to doubt them all.
    append(soup, make_cube({0, 5, 0}));
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.report.count(Defect::inside_out), 2U);
    EXPECT_NEAR(examine(out.soup).volume6, 18, 1e-12);
    // So is a face that had to be turned, anywhere.
    PolygonSoup other = make_cube({0, 0, 0});
    turn_all_faces(other);
    PolygonSoup open = make_sample("saddle", 60);
    turn_face(open, 3);
    append(other, open);
    EXPECT_EQ(repair_and_check(other).report.count(Defect::inside_out), 1U);
}

TEST(Orient, OpenSurfacesAreNotTurned) {
    PolygonSoup soup = make_cube({0, 0, 0});
    soup.corners.resize(soup.corners.size() - 3);
    turn_all_faces(soup);
    EXPECT_FALSE(repair_and_check(soup).report.changed);
}

/// A cube with a hollow, and another cube in the hollow.
PolygonSoup make_nest() {
    PolygonSoup soup = make_cube({0, 0, 0}, 10);
    PolygonSoup hollow = make_cube({1, 1, 1}, 8);
    turn_all_faces(hollow);
    append(soup, hollow);
    append(soup, make_cube({2, 2, 2}, 6));
    append(soup, make_cube({20, 0, 0}, 1));
    return soup;
}

TEST(Orient, CavitiesStayCavities) {
    EXPECT_FALSE(repair_and_check(make_nest()).report.changed);
    PolygonSoup inside_out = make_nest();
    turn_all_faces(inside_out);
    EXPECT_FALSE(repair_and_check(inside_out).report.changed);
    const Repaired out = repair_and_check(inside_out, {.outward = true});
    EXPECT_EQ(out.report.count(Defect::inside_out), 2U);
    EXPECT_NEAR(examine(out.soup).volume6, examine(make_nest()).volume6, 1e-9);
}

TEST(Orient, WhatLiesBesideIsNotInside) {
    // The inside-out cube is in the bounding box of the torus, but not in the torus.
    PolygonSoup soup = make_sample("torus", 800);
    PolygonSoup cube = make_cube({-0.01, -0.01, -0.01}, 0.02);
    turn_all_faces(cube);
    append(soup, cube);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.report.count(Defect::inside_out), 1U);
}

TEST(Orient, ManyNestedShells) {
    PolygonSoup soup;
    for (int i = 0; i < 300; ++i) append(soup, make_cube({1.0 * i, 1.0 * i, 1.0 * i}, 2000 - 2 * i));
    turn_all_faces(soup);
    const Repaired out = repair_and_check(soup, {.outward = true});
    // Only the outermost says so; the others are turned with it.
    EXPECT_EQ(out.report.count(Defect::inside_out), 1U);
    for (std::size_t c = 0; c < 300; ++c) {
        PolygonSoup shell;
        shell.points = out.soup.points;
        shell.corners.assign(out.soup.corners.begin() + static_cast<std::ptrdiff_t>(36 * c),
                             out.soup.corners.begin() + static_cast<std::ptrdiff_t>(36 * c + 36));
        EXPECT_GT(examine(shell).volume6, 0);
    }
}

TEST(Orient, MoebiusBandIsCutAcross) {
    for (const std::uint32_t across : {1U, 3U, 6U}) {
        SCOPED_TRACE(across);
        const PolygonSoup band = make_band(60, across, true);
        for (const PolygonSoup& way : {band, take_apart(band)}) {
            const Repaired out = repair_and_check(way);
            EXPECT_EQ(out.report.count(Defect::non_orientable), 1U);
            EXPECT_LE(out.report.count(Defect::cut_edge), across + 1);
            EXPECT_EQ(count_components(out.soup), 1U);
            EXPECT_EQ(examine(out.soup).euler, 1);
        }
    }
    EXPECT_FALSE(repair_and_check(make_band(60, 3, false)).report.changed);
}

TEST(Orient, MoebiusBandOfTurnedFaces) {
    PolygonSoup band = make_band(40, 3, true);
    for (std::size_t f = 0; f < band.face_count(); f += 3) turn_face(band, f);
    const Repaired out = repair_and_check(band);
    EXPECT_LE(out.report.count(Defect::cut_edge), 4U);
    EXPECT_EQ(count_components(out.soup), 1U);
}

TEST(Orient, KleinBottleIsCutAlongOneLoop) {
    const Repaired out = repair_and_check(make_klein_bottle(40, 16));
    EXPECT_EQ(out.report.count(Defect::non_orientable), 1U);
    EXPECT_LE(out.report.count(Defect::cut_edge), 20U);
    EXPECT_EQ(count_components(out.soup), 1U);
    EXPECT_EQ(examine(out.soup).euler, 0);
}

TEST(Orient, ProjectivePlane) {
    // Six vertices, ten faces, every two of them joined.
    const PolygonSoup soup = triangles(
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0.5}, {0, -1, 0.25}, {0.5, 0, -1}},
        {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 4}, {0, 3, 5}, {1, 2, 3}, {1, 2, 5}, {1, 3, 4}, {2, 4, 5}, {3, 4, 5}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.report.count(Defect::non_orientable), 1U);
    EXPECT_LE(out.report.count(Defect::cut_edge), 5U);
    EXPECT_EQ(count_components(out.soup), 1U);
}

TEST(Orient, OneBandAmongSoundParts) {
    // What is sound is not touched by what is not.
    PolygonSoup soup = make_cube({50, 0, 0});
    append(soup, make_band(30, 2, true));
    append(soup, make_cube({-50, 0, 0}));
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.report.findings.front().places, std::vector<std::size_t>{12});
    for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(out.soup.corners[i], soup.corners[i]);
}

}  // namespace
}  // namespace delmesh::test
