#include "delmesh/mesh/mesh.hpp"

#include "delmesh/base/error.hpp"
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

/// Pairs half-edges by putting each into the bucket of its smaller vertex and sorting the buckets by the larger one.
class Twins {
public:
    Twins(std::span<const VertexId> origin, std::size_t vertex_count) : origin_(origin), begin_(vertex_count + 1, 0) {
        fill_buckets();
    }

    void pair_up(std::vector<HalfedgeId>& twin) {
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) pair_bucket(v, twin);
        crowded_.raise(ErrorCode::non_manifold_edge,
                       fmt::format("the edge between vertices {} and {} has more than two faces{}; `delmesh repair` "
                                   "cuts the mesh open there",
                                   crowded_.at(0), crowded_.at(1), crowded_.others()));
        inconsistent_.raise(ErrorCode::inconsistent_edge,
                            fmt::format("the two faces at the edge between vertices {} and {} are oriented "
                                        "differently{}; `delmesh repair` turns faces round",
                                        inconsistent_.at(0), inconsistent_.at(1), inconsistent_.others()));
    }

private:
    struct Item {
        VertexId high;
        HalfedgeId h;
        friend auto operator<=>(const Item&, const Item&) = default;
    };

    [[nodiscard]] VertexId origin(HalfedgeId h) const { return origin_[h.index()]; }
    [[nodiscard]] VertexId target(HalfedgeId h) const { return origin_[Mesh::next(h).index()]; }
    [[nodiscard]] VertexId low(HalfedgeId h) const { return std::min(origin(h), target(h)); }
    [[nodiscard]] VertexId high(HalfedgeId h) const { return std::max(origin(h), target(h)); }

    void fill_buckets() {
        const std::size_t count = origin_.size();
        for (std::size_t h = 0; h < count; ++h) ++begin_[low(HalfedgeId(h)).index()];
        std::uint32_t sum = 0;
        for (std::uint32_t& b : begin_) sum = b += sum;
        items_.resize(count);
        for (std::size_t h = count; h-- > 0;) {
            const HalfedgeId id(h);
            items_[--begin_[low(id).index()]] = {high(id), id};
        }
    }

    void pair_bucket(std::size_t v, std::vector<HalfedgeId>& twin) {
        const auto first = items_.begin() + begin_[v];
        const auto last = items_.begin() + begin_[v + 1];
        if (last - first > 1) std::sort(first, last);
        for (auto run = first; run != last;) {
            auto end = run + 1;
            while (end != last && end->high == run->high) ++end;
            if (end - run > 2) {
                crowded_.add(v, run->high.index());
            } else if (end - run == 2) {
                if (origin(run[0].h) == origin(run[1].h)) inconsistent_.add(v, run->high.index());
                twin[run[0].h.index()] = run[1].h;
                twin[run[1].h.index()] = run[0].h;
            }
            run = end;
        }
    }

    std::span<const VertexId> origin_;
    std::vector<std::uint32_t> begin_;
    std::vector<Item> items_;
    Offenders crowded_;
    Offenders inconsistent_;
};

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
    twin_.resize(origin_.size());
    Twins(origin_, points_.size()).pair_up(twin_);
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
