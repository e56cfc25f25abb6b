#include "delmesh/mesh/mesh.hpp"

#include "delmesh/base/error.hpp"
#include "mesh/edge_groups.hpp"
#include "mesh/fan_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

namespace delmesh {
namespace {

constexpr std::size_t max_elements = VertexId::none_value - 1;
constexpr std::size_t max_listed = 16;

/// The first offenders of one kind and how many there are.
struct Offenders {
    std::vector<std::size_t> first;
    std::size_t count = 0;

    void add(std::size_t element) {
        if (first.size() < max_listed) first.push_back(element);
        ++count;
    }
    void add(std::size_t a, std::size_t b) {
        if (first.size() < max_listed) first.insert(first.end(), {a, b});
        ++count;
    }
    /// Throws if there are any; `sentence` has room for the first one.
    void raise(ErrorCode code, const std::string& sentence) const {
        if (count > 0) throw Error(code, sentence, first, count);
    }
    [[nodiscard]] std::string others() const {
        return count > 1 ? fmt::format(" (and {} more like it)", count - 1) : std::string();
    }
    [[nodiscard]] std::size_t at(std::size_t i) const { return i < first.size() ? first[i] : 0; }
};

void check_points(const std::vector<Vec3>& points) {
    Offenders bad;
    for (std::size_t v = 0; v < points.size(); ++v)
        if (!is_finite(points[v])) bad.add(v);
    bad.raise(ErrorCode::not_finite,
              fmt::format("vertex {} has a coordinate that is not finite{}; `delmesh repair` removes such vertices",
                          bad.at(0), bad.others()));
}

void check_faces(const std::vector<std::uint32_t>& corners, std::size_t vertex_count) {
    Offenders range;
    Offenders repeats;
    for (std::size_t f = 0; f < corners.size() / 3; ++f) {
        const std::uint32_t a = corners[3 * f];
        const std::uint32_t b = corners[3 * f + 1];
        const std::uint32_t c = corners[3 * f + 2];
        if (a >= vertex_count || b >= vertex_count || c >= vertex_count) range.add(f);
        if (a == b || b == c || c == a) repeats.add(f);
    }
    range.raise(ErrorCode::index_out_of_range,
                fmt::format("face {} names a vertex that does not exist, as there are {}{}; the file is damaged",
                            range.at(0), vertex_count, range.others()));
    repeats.raise(ErrorCode::degenerate_face,
                  fmt::format("face {} repeats a vertex{}; `delmesh repair` removes such faces", repeats.at(0),
                              repeats.others()));
}

std::vector<HalfedgeId> pair_halfedges(std::span<const VertexId> origin, std::size_t vertex_count) {
    Offenders crowded;
    Offenders inconsistent;
    const auto from = [&](HalfedgeId h) { return origin[h.index()].value(); };
    const auto to = [&](HalfedgeId h) { return origin[Mesh::next(h).index()].value(); };
    const auto low = [&](HalfedgeId h) { return std::min(from(h), to(h)); };
    const auto high = [&](HalfedgeId h) { return std::max(from(h), to(h)); };
    EdgeGroups<HalfedgeId> edges(vertex_count, origin.size(), low);
    std::vector<HalfedgeId>& twin = edges.links();
    edges.visit(high, [&](std::span<const HalfedgeId> halfedges) {
        for (const HalfedgeId h : halfedges) twin[h.index()] = HalfedgeId();
        const HalfedgeId h = halfedges.front();
        const HalfedgeId g = halfedges.back();
        if (halfedges.size() > 2) {
            crowded.add(low(h), high(h));
        } else if (halfedges.size() == 2) {
            if (from(h) == from(g)) inconsistent.add(low(h), high(h));
            twin[h.index()] = g;
            twin[g.index()] = h;
        }
    });
    crowded.raise(
        ErrorCode::non_manifold_edge,
        fmt::format("the edge between vertices {} and {} has more than two faces{}; `delmesh repair` cuts the "
                    "mesh open there",
                    crowded.at(0), crowded.at(1), crowded.others()));
    inconsistent.raise(ErrorCode::inconsistent_edge,
                       fmt::format("the two faces at the edge between vertices {} and {} are oriented differently{}; "
                                   "`delmesh repair` turns faces round",
                                   inconsistent.at(0), inconsistent.at(1), inconsistent.others()));
    return std::move(twin);
}

}  // namespace

Mesh::Mesh(PolygonSoup soup) {
    if (!soup.is_triangles()) triangulate(soup);
    if (soup.points.size() > max_elements || soup.corners.size() > max_elements)
        throw Error(ErrorCode::too_large,
                    fmt::format("{} points and {} triangles are more than 32-bit ids can name (at most {} and {})",
                                soup.points.size(), soup.corners.size() / 3, max_elements, max_elements / 3));
    check_points(soup.points);
    check_faces(soup.corners, soup.points.size());

    points_ = std::move(soup.points);
    origin_.reserve(soup.corners.size());
    for (const std::uint32_t v : soup.corners) origin_.emplace_back(v);
    soup = PolygonSoup();
    twin_ = pair_halfedges(origin_, points_.size());
    find_outgoing();
}

/// Chooses the outgoing half-edge of every vertex and makes sure that its fan holds all faces of the vertex.
void Mesh::find_outgoing() {
    out_.assign(points_.size(), HalfedgeId());
    std::vector<std::uint32_t> valence(points_.size(), 0);
    for (std::size_t i = 0; i < origin_.size(); ++i) {
        HalfedgeId& out = out_[origin_[i].index()];
        if (!out.valid() || !twin_[i].valid()) out = HalfedgeId(i);
        ++valence[origin_[i].index()];
    }
    Offenders pinched;
    for (std::size_t v = 0; v < out_.size(); ++v) {
        std::uint32_t seen = 0;
        for (HalfedgeId h = out_[v]; h.valid() && seen < valence[v]; ++seen) {
            h = next_around(h);
            if (h == out_[v]) h = HalfedgeId();
        }
        if (seen != valence[v]) pinched.add(v);
    }
    pinched.raise(ErrorCode::non_manifold_vertex,
                  fmt::format("the faces at vertex {} form more than one fan{}; `delmesh repair` gives each fan a "
                              "vertex of its own",
                              pinched.at(0), pinched.others()));
}

std::size_t Mesh::count_edges() const {
    std::size_t sides = 0;
    for (std::size_t h = 0; h < twin_.size(); ++h)
        if (origin_[h].valid()) sides += twin_[h].valid() ? 1 : 2;
    return sides / 2;
}

bool Mesh::are_joined(VertexId a, VertexId b) const {
    return *are_joined_within(*this, a, b, std::numeric_limits<std::size_t>::max());
}

HalfedgeId Mesh::find_halfedge(VertexId a, VertexId b) const {
    FanSearch from_a(*this, a, b);
    FanSearch from_b(*this, b, a);
    while (!from_a.step()) {
        if (!from_b.step()) continue;
        if (!from_b.found()) return {};
        // Without a half-edge from b the edge is on the boundary, and a's outgoing one has no twin: the first of its
        // fan.
        const HalfedgeId back = from_b.outgoing();
        return back.valid() ? twin(back) : halfedge(a);
    }
    return from_a.outgoing();
}

PolygonSoup to_soup(const Mesh& mesh) {
    PolygonSoup soup;
    soup.points.assign(mesh.points().begin(), mesh.points().end());
    soup.corners.reserve(mesh.corners().size());
    for (const VertexId v : mesh.corners()) soup.corners.push_back(v.value());
    return soup;
}

}  // namespace delmesh
