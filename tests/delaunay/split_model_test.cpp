// The model of split points against the mesh: put in truly, flipped by exact signs, the same edges are not Delaunay.

#include "delaunay/split_model.hpp"

#include "base/random.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/refine.hpp"
#include "delaunay/split_point.hpp"
#include "delaunay/split_regions.hpp"
#include "delmesh/mesh/polygon_soup.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace delmesh {
namespace {

using EdgeEnds = std::pair<VertexId, VertexId>;

EdgeEnds ends(const Mesh& mesh, HalfedgeId h) {
    return std::minmax(mesh.origin(h), mesh.target(h));
}

void prepare_all(SplitModel& model) {
    const MarkedMesh& marked = model.layout().marked();
    for (std::size_t i = 0; i < marked.mesh().halfedge_count(); ++i)
        if (!marked.is_planar(HalfedgeId(i))) model.prepare(model.edge_of(HalfedgeId(i)));
}

/// Puts random points on random edges, again and again, so that points are taken away, too.
void scatter(SplitModel& model, Random& random, int changes) {
    std::vector<double> points;
    for (int i = 0; i < changes; ++i) {
        const std::uint32_t e = random.below(model.edge_count());
        points.clear();
        for (std::uint32_t n = random.below(9); n > 0; --n) points.push_back(0.05 + 0.9 * random.uniform());
        std::sort(points.begin(), points.end());
        model.cut(e, 0, model.point_count(e), points);
    }
}

std::set<EdgeEnds> bad_in_model(const SplitModel& model) {
    std::set<EdgeEnds> bad;
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.first_bad(e) >= 0) bad.insert(ends(model.layout().marked().mesh(), model.layout().edge(e).halfedge));
    return bad;
}

std::set<EdgeEnds> bad_in_truth(const SplitModel& model, const RefineStart& start) {
    const MarkedMesh& marked = model.layout().marked();
    std::vector<SplitPoint> plan;
    for (const PlacedPoint& point : placed_points(model)) {
        const EdgeEnds ab = ends(marked.mesh(), model.layout().edge(point.edge).halfedge);
        plan.push_back({ab.first, ab.second, point.at});
    }
    Mesh mesh = marked.mesh();
    MarkedMesh copy(mesh, marked);
    RemeshReport report;
    std::set<EdgeEnds> bad;
    for (const HalfedgeId h : carry_out(copy, {}, nullptr, report, start, plan)) {
        const EdgePart part = part_of_input_edge(copy, h);
        bad.insert({part.a, part.b});
    }
    EXPECT_EQ(report.splits, plan.size());
    return bad;
}

class Model : public testing::TestWithParam<const char*> {};

TEST_P(Model, FindsTheEdgesThatAreNotDelaunay) {
    Random random(7);
    for (int round = 0; round < 4; ++round) {
        Mesh mesh(make_sample(GetParam(), 300));
        std::vector<Mark> marks = mark_edges(mesh, nullptr);
        MarkedMesh marked(mesh, std::move(marks), {});
        RemeshReport report;
        const RefineStart start = flip_planar_edges(marked, {}, nullptr, report);
        SplitModel model(marked);
        prepare_all(model);
        const std::set<EdgeEnds> before = bad_in_model(model);
        EXPECT_EQ(before.size(), start.bad.size());
        scatter(model, random, 40 << round);
        EXPECT_EQ(bad_in_model(model), bad_in_truth(model, start));

        model.begin();
        const std::set<EdgeEnds> kept = bad_in_model(model);
        scatter(model, random, 50);
        model.rollback();
        EXPECT_EQ(bad_in_model(model), kept) << "after a rollback";
        scatter(model, random, 20);
        EXPECT_EQ(bad_in_model(model), bad_in_truth(model, start)) << "after a rollback and more";
    }
}

/// An upright prism over a polygon with uneven corners: facets of two or more triangles whose frames are rounded.
Mesh make_prism(Random& random) {
    constexpr std::uint32_t n = 9;
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < 2 * n; ++i) {
        const double u = (i % n + 0.2 + 0.6 * random.uniform()) / n * 4 - 2;
        const double scale = 3 / (1 + u * u);
        if (i < n)
            soup.points.push_back({scale * (1 - u * u), 2 * scale * u, 0});
        else
            soup.points.push_back({soup.points[i - n].x, soup.points[i - n].y, 7.1});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        for (const std::uint32_t v : {i, j, n + i, j, n + j, n + i}) soup.corners.push_back(v);
        if (i > 1)
            for (const std::uint32_t v : {0u, i, i - 1, n, n + i - 1, n + i}) soup.corners.push_back(v);
    }
    return Mesh(std::move(soup));
}

TEST(PrismModel, SeesThroughAllTrianglesOfAFacet) {
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        Mesh mesh = make_prism(random);
        std::vector<Mark> marks = mark_edges(mesh, nullptr);
        MarkedMesh marked(mesh, std::move(marks), {});
        RemeshReport report;
        const RefineStart start = flip_planar_edges(marked, {}, nullptr, report);
        SplitModel model(marked);
        prepare_all(model);
        for (int change = 0; change < 20; ++change) {
            scatter(model, random, 2);
            EXPECT_EQ(bad_in_model(model), bad_in_truth(model, start));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, Model, testing::Values("saddle", "noisy-surface", "plate", "terrain"),
                         [](const auto& named) {
                             std::string name = named.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace delmesh
