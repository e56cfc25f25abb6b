// Faces at one place. Two layers are kept only where they are needed; docs/repair.md, "Double faces", says when.

#include "repair/complex.hpp"
#include "repair/union_find.hpp"

#include <algorithm>
#include <array>

namespace delmesh::repairing {
namespace {

/// Two faces at one place, first < second, that are left when further copies in pairs are gone.
struct Layers {
    Index first;
    Index second;
    bool opposite;  ///< oriented differently
};

class DuplicateRemover {
public:
    DuplicateRemover(Complex& complex, const Edges& edges, Log& log)
        : complex_(complex),
          log_(log),
          edges_(edges),
          gone_(complex.face_count(), 0) {}

    Doubled run() {
        edges_.visit([&](std::span<const Index> edge) { find_in(edge); });
        Doubled result;
        if (!layers_.empty()) result.kept = judge_patches();
        result.dropped = std::find(gone_.begin(), gone_.end(), 1) != gone_.end();
        if (!result.dropped) return result;
        for (std::size_t f = 0; f < gone_.size(); ++f)
            if (gone_[f] != 0) log_.add(Defect::duplicate_face, complex_.origin[f].index());
        complex_.drop_faces([&](std::size_t f) { return gone_[f] != 0; });
        return result;
    }

private:
    /// Finds the faces at one place that have their largest place opposite to this edge, so that each is found once.
    void find_in(std::span<const Index> edge) {
        if (edge.size() < 2) return;
        const Index high = std::max(complex_.place_from(edge[0]), complex_.place_to(edge[0]));
        sides_.clear();
        for (const Index h : edge)
            if (complex_.place_apex(h) > high) sides_.push_back(h);
        if (sides_.size() < 2) return;
        std::stable_sort(sides_.begin(), sides_.end(),
                         [&](Index a, Index b) { return complex_.place_apex(a) < complex_.place_apex(b); });
        for (auto run = sides_.begin(); run != sides_.end();) {
            const auto end = std::find_if(run, sides_.end(),
                                          [&](Index h) { return complex_.place_apex(h) != complex_.place_apex(*run); });
            if (end - run > 1) reduce({run, end});
            run = end;
        }
    }

    /// Of an odd number of faces at one place one is kept, of an even number two: that does not change the parity of
    /// any edge. Faces of opposite orientation cancel as far as they can.
    void reduce(std::span<const Index> sides) {
        for (const Index h : sides) gone_[h / 3] = 1;
        std::array<std::vector<Index>, 2> ways;
        for (const Index h : sides) ways[complex_.opposite(h, sides[0]) ? 1 : 0].push_back(h);
        const std::vector<Index>& more = ways[ways[1].size() > ways[0].size() ? 1 : 0];
        gone_[more[0] / 3] = 0;
        if (sides.size() % 2 == 1) return;
        const bool opposite = ways[0].size() == ways[1].size();
        const Index second = opposite ? ways[1][0] : more[1];
        gone_[second / 3] = 0;
        layers_.push_back({more[0] / 3, second / 3, opposite});
    }

    /// What decides about a patch: double faces that are connected by edges.
    struct Patch {
        std::size_t size = 0;
        std::size_t opposite = 0;  ///< double faces whose layers are oriented differently
        bool alone = true;         ///< no edge has a face that is not double
        std::size_t rim = 0;       ///< edges with an odd number of double faces
        std::ptrdiff_t opened =
            0;  ///< edges that would become odd if one layer went, less those that would become even

        /// A patch by itself stays double if it is a flat closed surface; one that hangs together with other faces does
        /// if that keeps holes away.
        [[nodiscard]] bool stays_double() const { return alone ? rim > 0 && 2 * opposite > size : opened > 0; }
    };

    bool judge_patches() {
        layer_of_.assign(complex_.face_count(), none);
        for (Index i = 0; i < layers_.size(); ++i) layer_of_[layers_[i].first] = layer_of_[layers_[i].second] = i;
        UnionFind patch_of(layers_.size());
        EdgeList double_edges;
        std::vector<bool> at_layers(complex_.points.size(), false);
        for (const Layers& layers : layers_)
            for (Index h = 3 * layers.first; h < 3 * layers.first + 3; ++h) at_layers[complex_.place_from(h)] = true;
        edges_.visit_between(at_layers, [&](std::span<const Index> edge) {
            if (connect(edge, patch_of)) double_edges.add(edge);
        });
        std::vector<Patch> patches(layers_.size());
        for (Index i = 0; i < layers_.size(); ++i) {
            Patch& patch = patches[patch_of.find(i)];
            ++patch.size;
            patch.opposite += layers_[i].opposite ? 1 : 0;
        }
        for (std::size_t e = 0; e < double_edges.size(); ++e) account(double_edges[e], patch_of, patches);
        bool any_kept = false;
        for (Index i = 0; i < layers_.size(); ++i) {
            if (patches[patch_of.find(i)].stays_double())
                any_kept = true;
            else
                gone_[layers_[i].second] = 1;
        }
        return any_kept;
    }

    /// True if there are any double faces at the edge.
    bool connect(std::span<const Index> edge, UnionFind& patch_of) const {
        Index first = none;
        for (const Index h : edge) {
            const Index layer = layer_of_[h / 3];
            if (layer == none) continue;
            if (first == none) first = layer;
            patch_of.unite(first, layer);
        }
        return first != none;
    }

    void account(std::span<const Index> edge, UnionFind& patch_of, std::vector<Patch>& patches) const {
        std::size_t single = 0;
        std::size_t in_layers = 0;
        Index layer = none;
        for (const Index h : edge) {
            if (layer_of_[h / 3] != none) {
                layer = layer_of_[h / 3];
                ++in_layers;
            } else if (gone_[h / 3] == 0) {
                ++single;
            }
        }
        if (layer == none) return;
        Patch& patch = patches[patch_of.find(layer)];
        const std::size_t doubles = in_layers / 2;
        if (single > 0) patch.alone = false;
        if (doubles % 2 == 0) return;
        ++patch.rim;
        patch.opened += single % 2 == 0 ? 1 : -1;
    }

    Complex& complex_;
    Log& log_;
    const Edges& edges_;
    std::vector<char> gone_;
    std::vector<Layers> layers_;
    std::vector<Index> layer_of_;
    std::vector<Index> sides_;
};

}  // namespace

Doubled remove_duplicates(Complex& complex, const Edges& edges, Log& log) {
    return DuplicateRemover(complex, edges, log).run();
}

}  // namespace delmesh::repairing
