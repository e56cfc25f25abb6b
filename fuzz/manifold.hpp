#pragma once
// From random bytes to a mesh, by way of `repair`, whose laws are checked on the way.

#include "bytes.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/mesh/validate.hpp"
#include "delmesh/repair/repair.hpp"
#include "target.hpp"

#include <bit>
#include <optional>

namespace delmesh::fuzz {

inline bool same_bits(const PolygonSoup& a, const PolygonSoup& b) {
    if (a.points.size() != b.points.size() || a.corners != b.corners || a.starts != b.starts) return false;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        for (const int axis : {0, 1, 2}) {
            if (std::bit_cast<std::uint64_t>(a.points[i][axis]) != std::bit_cast<std::uint64_t>(b.points[i][axis]))
                return false;
        }
    }
    return true;
}

/// Nothing where no surface is left.
inline std::optional<Mesh> repaired_mesh(Bytes& bytes) {
    PolygonSoup mended = soup(bytes);
    (void)repair(mended);
    PolygonSoup again = mended;
    const RepairReport second = repair(again);
    require(!second.changed && same_bits(mended, again), "a second repair changes nothing");
    if (mended.corners.empty()) return std::nullopt;
    Mesh mesh(std::move(mended));
    require(validate(mesh).empty(), "a repaired soup builds a valid mesh", validate(mesh));
    return mesh;
}

/// The whole of a target: reads a choice of options and a mesh, and runs where there is one.
template <class Run>
int run_on_mesh(const std::uint8_t* data, std::size_t size, Run&& run) {
    Bytes bytes(data, size);
    const std::uint8_t choice = bytes.byte();
    if (std::optional<Mesh> mesh = repaired_mesh(bytes)) run(choice, *mesh);
    return 0;
}

/// Seeds that decode to grids, fans, closed bodies and rubbish of every style.
inline std::vector<std::string> soup_seeds() {
    std::vector<std::string> result;
    const std::vector<std::vector<std::uint8_t>> faces{
        {0, 1, 2, 0, 2, 3},
        {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3},
        {0, 1, 2, 0, 1, 3, 0, 1, 4},
        {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7},
        {0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4, 4, 5, 1, 5, 0, 1}};
    for (std::uint8_t style = 0; style < styles; ++style) {
        for (const std::uint8_t scale : {std::uint8_t{4}, std::uint8_t{0}, std::uint8_t{8}}) {
            for (const auto& list : faces) {
                std::string text{static_cast<char>(style), '\x06', static_cast<char>(scale), '\1'};
                for (int p = 0; p < 9; ++p) {
                    for (const int value : {p % 3, p / 3, p * p % 2}) {
                        text += static_cast<char>(value);
                        if (style != 0) text += static_cast<char>(128 + p);
                    }
                }
                for (std::size_t i = 0; i < list.size(); i += 3) {
                    text += '\2';
                    for (std::size_t k = 0; k < 3; ++k) text += static_cast<char>(list[i + k]);
                }
                result.push_back(text);
            }
        }
    }
    return result;
}

}  // namespace delmesh::fuzz
