#pragma once

#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace delmesh::test {

/// Reads a.glb, whatever it holds: indices stay in range, an error is one line, no piece of memory is larger than
/// `most`. Returns whether it could be read.
inline bool reads_without_harm(const std::string& bytes, std::size_t most) {
    bool could_read = true;
    largest_allocation = 0;
    try {
        const PolygonSoup soup = parse(bytes, "a.glb");
        for (const std::uint32_t corner : soup.corners) EXPECT_LT(corner, soup.points.size());
    } catch (const Error& error) {
        could_read = false;
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("a.glb: ")) << message;
        EXPECT_EQ(message.find('\n'), message.npos) << message;
    }
    EXPECT_LE(largest_allocation, most);
    return could_read;
}

}  // namespace delmesh::test
