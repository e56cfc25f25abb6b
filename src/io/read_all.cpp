#include "io/read_all.hpp"

#include <limits>

namespace delmesh::io {

std::string read_all(Input& input) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    std::string bytes;
    bytes.reserve(input.plausible(most, 1));
    while (input.ensure(1) > 0) {
        const std::string_view here = input.view();
        if (here.size() > most - bytes.size())
            throw Error(ErrorCode::too_large,
                        input.name() + ": expected less than 2 GiB, found more: save the mesh as binary PLY");
        bytes.append(here);
        input.skip(here.size());
    }
    return bytes;
}

}  // namespace delmesh::io
