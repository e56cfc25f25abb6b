#include "repair/complex.hpp"

#include "base/let_go.hpp"

#include <algorithm>

namespace delmesh::repairing {
namespace {

struct Item {
    Index high;
    Index h;
    friend auto operator<=>(const Item&, const Item&) = default;
};

/// The half-edges in buckets of the smaller place that they join, sorted by the larger one, then by number.
std::vector<Item> bucket_by_edge(const Complex& complex, std::vector<Index>& begin) {
    const auto low = [&](Index h) { return std::min(complex.place_from(h), complex.place_to(h)); };
    const auto count = static_cast<Index>(complex.halfedge_count());
    begin.assign(complex.points.size() + 1, 0);
    for (Index h = 0; h < count; ++h) ++begin[low(h)];
    Index sum = 0;
    for (Index& b : begin) sum = b += sum;
    std::vector<Item> items(count);
    for (Index h = count; h-- > 0;) items[--begin[low(h)]] = {std::max(complex.place_from(h), complex.place_to(h)), h};
    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
        std::sort(items.begin() + begin[v], items.begin() + begin[v + 1]);
    return items;
}

}  // namespace

void EdgeGroups::regroup(const Complex& complex) {
    let_go(halfedges_);
    let_go(starts_);
    std::vector<Index> begin;
    const std::vector<Item> items = bucket_by_edge(complex, begin);
    halfedges_.reserve(items.size());
    starts_.reserve(items.size() / 2 + 2);
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        for (Index i = begin[v]; i < begin[v + 1]; ++i) {
            if (i == begin[v] || items[i].high != items[i - 1].high) starts_.push_back(i);
            halfedges_.push_back(items[i].h);
        }
    }
    starts_.push_back(static_cast<Index>(items.size()));
}

void Log::note(Defect kind, std::array<std::size_t, 2> place, std::size_t numbers) {
    constexpr std::size_t most = 16;
    Finding& finding = found_[static_cast<std::size_t>(kind)];
    ++finding.count;
    if (finding.places.size() + numbers <= most)
        finding.places.insert(finding.places.end(), place.begin(), place.begin() + numbers);
}

std::vector<Finding> Log::findings() const {
    std::vector<Finding> result;
    for (std::size_t kind = 0; kind < defect_kinds; ++kind) {
        if (found_[kind].count == 0) continue;
        result.push_back(found_[kind]);
        result.back().kind = static_cast<Defect>(kind);
    }
    return result;
}

}  // namespace delmesh::repairing
