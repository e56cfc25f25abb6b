#pragma once
// A part of an edge, by parameters from one end of it to the other.

namespace delmesh {

struct Stretch {
    double from = 0;
    double to = 1;
};

}  // namespace delmesh
