#include "delmesh/version.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(Version, IsTheOneThatTheBuildUses) {
    EXPECT_EQ(version, DELMESH_PROJECT_VERSION);
}

}  // namespace
}  // namespace delmesh
