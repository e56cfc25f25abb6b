// What shells are said to need at least, they need.

#include "delaunay/shell_bound.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/refine.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <limits>

namespace delmesh {
namespace {

constexpr std::size_t stopped_short = std::numeric_limits<std::size_t>::max();

/// A mesh whose planar edges are Delaunay.
struct Started {
    explicit Started(const PolygonSoup& soup, const RemeshOptions& options)
        : mesh(soup),
          marked(mesh, mark_edges(mesh, nullptr), {}),
          start(flip_planar_edges(marked, options, nullptr, report)) {}

    [[nodiscard]] bool need_more_than(const RemeshOptions& options, std::size_t count) const {
        return shells_need_more_than(marked, start.bad, options, count);
    }

    /// Afterwards nothing else can be asked.
    [[nodiscard]] std::size_t run_shells(const RemeshOptions& options) {
        refine_and_clean(marked, options, nullptr, report, start.queue);
        return report.stop == StopReason::done ? report.splits : stopped_short;
    }

    Mesh mesh;
    RemeshReport report;
    MarkedMesh marked;
    RefineStart start;
};

RemeshOptions options_with(double unit) {
    RemeshOptions options;
    options.shell_unit_abs = unit;
    options.max_vertices = 20000;
    return options;
}

class ShellBound : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(ShellBound, IsNoMoreThanWhatShellsNeed) {
    for (const double unit : {1.0, 0.7, 0.013}) {
        const RemeshOptions options = options_with(unit);
        const std::size_t needed = Started(GetParam().soup, options).run_shells(options);
        if (needed == stopped_short) continue;
        const Started again(GetParam().soup, options);
        EXPECT_FALSE(again.need_more_than(options, needed)) << needed << " of unit " << unit;
    }
}

INSTANTIATE_TEST_SUITE_P(Families, ShellBound, testing::ValuesIn(test::families(30)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

class ShellsOfNoise : public testing::Test {
protected:
    RemeshOptions options_ = options_with(1);
    PolygonSoup soup_ = make_sample("noisy-surface", 2000);
};

TEST_F(ShellsOfNoise, IsNotFarBelowOnRoughSurfaces) {
    const std::size_t needed = Started(soup_, options_).run_shells(options_);
    ASSERT_NE(needed, stopped_short);
    const Started again(soup_, options_);
    EXPECT_GT(needed, 3 * again.start.bad.size());
    EXPECT_TRUE(again.need_more_than(options_, needed / 2));
}

/// The margins are those of doubles.
TEST_F(ShellsOfNoise, SaysNothingWhereItCanNotKnow) {
    Started started(soup_, options_);
    EXPECT_TRUE(started.need_more_than(options_, 10));
    RemeshOptions floats = options_;
    floats.precision = Precision::float32;
    EXPECT_FALSE(started.need_more_than(floats, 10));
    const std::vector<EdgeId> bad = started.start.bad;
    EXPECT_NE(started.run_shells(options_), stopped_short);
    EXPECT_FALSE(shells_need_more_than(started.marked, bad, options_, 0)) << "edges have been split before";
}

}  // namespace
}  // namespace delmesh
