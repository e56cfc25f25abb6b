#include "delmesh/base/error.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(Error, CarriesCodeSentenceElementsAndCount) {
    try {
        throw Error(ErrorCode::non_manifold_edge, "edge 3-4 has three faces", {3, 4}, 17);
    } catch (const std::runtime_error& caught) {
        EXPECT_STREQ(caught.what(), "edge 3-4 has three faces");
        const auto& error = dynamic_cast<const Error&>(caught);
        EXPECT_EQ(error.code(), ErrorCode::non_manifold_edge);
        EXPECT_EQ(error.elements(), (std::vector<std::size_t>{3, 4}));
        EXPECT_EQ(error.count(), 17U);
    }
}

}  // namespace
}  // namespace delmesh
