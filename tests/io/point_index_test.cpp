#include "io/point_index.hpp"

#include "io/io_support.hpp"

#include <limits>
#include <map>
#include <tuple>

namespace delmesh::io {
namespace {

TEST(PointIndex, AgreesWithAnOrderedMap) {
    test::Random random(7);
    std::vector<Vec3> points;
    PointIndex index(points);
    std::map<std::tuple<double, double, double>, std::uint32_t> expected;
    for (int i = 0; i < 100'000; ++i) {
        const auto coordinate = [&] { return static_cast<double>(random.below(30)) / 7; };
        const Vec3 p{coordinate(), coordinate(), coordinate()};
        const auto number = static_cast<std::uint32_t>(expected.size());
        EXPECT_EQ(index.add(p), expected.try_emplace({p.x, p.y, p.z}, number).first->second);
    }
    EXPECT_EQ(points.size(), expected.size());
}

TEST(PointIndex, ZerosAreEqualAndTheFirstStays) {
    std::vector<Vec3> points;
    PointIndex index(points);
    EXPECT_EQ(index.add({-0.0, 0, 0}), 0u);
    EXPECT_EQ(index.add({0.0, -0.0, 0}), 0u);
    EXPECT_TRUE(std::signbit(points[0].x));
    EXPECT_EQ(index.add({5e-324, 0, 0}), 1u);
}

TEST(PointIndex, ManyNansDoNoHarm) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec3> points;
    PointIndex index(points);
    for (int i = 0; i < 100'000; ++i) EXPECT_EQ(index.add({nan, nan, nan}), 0u);
}

}  // namespace
}  // namespace delmesh::io
