// The exact signs against rationals.

#include "delmesh/exact/predicates.hpp"

#include "bytes.hpp"
#include "exact/reference.hpp"
#include "target.hpp"

namespace delmesh::fuzz {

std::vector<std::string> seeds() {
    std::vector<std::string> result;
    for (std::uint8_t style = 0; style < styles; ++style) {
        for (std::uint8_t k = 0; k < 8; ++k) {
            std::string text{static_cast<char>(style), static_cast<char>(k)};
            for (int i = 0; i < 24; ++i) text += static_cast<char>(i * (k + 1) % 5 + (i % 2 != 0 ? k : 0));
            result.push_back(text);
        }
    }
    return result;
}

namespace {

void compare(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine) {
    require(orientation(p, q, u, v) == reference::orientation(p, q, u, v), "orientation");
    require(are_collinear(p, q, u) == reference::collinear(p, q, u), "are_collinear");
    if (u == p || u == q || v == p || v == q) return;
    require(delaunay_sign(p, q, u, v) == reference::delaunay(p, q, u, v), "delaunay_sign");
    require(right_angle_sign(p, q, u) == reference::right_angle(p, q, u), "right_angle_sign");
    require(dihedral_sign(p, q, u, v, cosine) == reference::dihedral(p, q, u, v, cosine), "dihedral_sign");
    require(is_planar_edge(p, q, u, v) == reference::planar_edge(p, q, u, v), "is_planar_edge");
}

}  // namespace
}  // namespace delmesh::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace delmesh;
    using namespace delmesh::fuzz;
    Bytes bytes(data, size);
    const auto style = static_cast<Style>(bytes.below(styles));
    const double cosine =
        std::array{1.0, 0.0, -1.0, 0.5, -0.5, 0.9848077530122081, std::nextafter(1.0, 0.0), 0x1p-1074}[bytes.below(8)];
    const Vec3 p = point(bytes, style);
    const Vec3 q = point(bytes, style);
    const Vec3 u = point(bytes, style);
    const Vec3 v = point(bytes, style);
    if (is_finite(p) && is_finite(q) && is_finite(u) && is_finite(v)) compare(p, q, u, v, cosine);
    return 0;
}
