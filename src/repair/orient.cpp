// Makes all faces of a component face the same way. A component that can not be oriented is cut where that costs least.

#include "repair/complex.hpp"
#include "repair/shorten.hpp"

#include <algorithm>
#include <optional>

namespace delmesh::repairing {
namespace {

class Orienter {
public:
    Orienter(Complex& complex, Joined& joined, Log& log)
        : complex_(complex),
          partners_(joined.partners),
          crowded_(joined.crowded),
          log_(log),
          turn_(complex.face_count(), 0) {
        component_.reserve(complex.face_count());
    }

    std::uint64_t run(const Context* context) {
        log_.forget(Defect::non_orientable);
        log_.forget(Defect::cut_edge);
        std::vector<char> seen(complex_.face_count(), 0);
        for (Index f = 0; f < seen.size(); ++f) {
            if (f % 65536 == 0) check_cancelled(context);
            if (seen[f] == 0) settle(f, seen, context);
        }
        turn_faces();
        if (twisted_.empty()) return 0;
        is_cut_.assign(complex_.face_count(), 0);
        part_partners();
        return report_cuts();
    }

private:
    /// Decides which faces of the component of `root` are to be turned round.
    void settle(Index root, std::vector<char>& seen, const Context* context) {
        if (explore(root, seen)) {
            turn_the_fewer(component_);
            note_mended();
            return;
        }
        if (!shortener_) shortener_.emplace(complex_, partners_, turn_, context);
        for (const Index f : component_) turn_[f] = 0;
        shortener_->run(component_, is_settled());
        turn_the_fewer(component_);
        note_mended();
        twisted_.insert(twisted_.end(), component_.begin(), component_.end());
        twisted_starts_.push_back(twisted_.size());
    }

    /// Gathers a component; `turn_` tells how its faces agree with the root. False if they can not.
    bool explore(Index root, std::vector<char>& seen) {
        bool agrees = true;
        component_.assign(1, root);
        seen[root] = 1;
        for (std::size_t i = 0; i < component_.size(); ++i)
            for (Index h = 3 * component_[i]; h < 3 * component_[i] + 3; ++h) {
                const Index g = partners_[h];
                if (g == none) continue;
                const char wanted = turn_[h / 3] ^ (complex_.opposite(h, g) ? 0 : 1);
                if (seen[g / 3] == 0) {
                    seen[g / 3] = 1;
                    turn_[g / 3] = wanted;
                    component_.push_back(g / 3);
                } else if (turn_[g / 3] != wanted) {
                    agrees = false;
                }
            }
        return agrees;
    }

    void turn_the_fewer(const std::vector<Index>& faces) {
        std::size_t turned = 0;
        for (const Index f : faces) turned += turn_[f] != 0 ? 1 : 0;
        if (2 * turned <= faces.size()) return;
        for (const Index f : faces) turn_[f] ^= 1;
    }

    [[nodiscard]] bool will_agree(Index h, Index g) const {
        return complex_.opposite(h, g) == (turn_[h / 3] == turn_[g / 3]);
    }

    /// True if a component comes out as it went in: no face is turned, all that was joined stays joined and all that
    /// was not stays apart. So it is after a repair.
    [[nodiscard]] bool is_settled() const {
        return std::none_of(component_.begin(), component_.end(), [&](Index f) {
            if (turn_[f] != 0) return true;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index g = partners_[h];
                if (g != none && will_agree(h, g) != complex_.share_numbers(h, g)) return true;
            }
            return false;
        });
    }

    void note_mended() {
        if (is_settled()) return;
        for (const Index f : component_) complex_.mended[f] = true;
    }

    void turn_faces() {
        if (std::find(turn_.begin(), turn_.end(), 1) == turn_.end()) return;
        const auto moved = [&](Index h) { return h != none && turn_[h / 3] != 0 ? Complex::turned_halfedge(h) : h; };
        for (Index f = 0; f < turn_.size(); ++f) {
            if (turn_[f] != 0) {
                complex_.turn(f);
                complex_.turned[f].flip();
                std::swap(partners_[3 * f], partners_[3 * f + 2]);
            }
            for (Index h = 3 * f; h < 3 * f + 3; ++h) partners_[h] = moved(partners_[h]);
        }
        for (std::size_t e = 0; e < crowded_.size(); ++e) {
            const std::span<Index> edge = crowded_[e];
            std::transform(edge.begin(), edge.end(), edge.begin(), moved);
            std::sort(edge.begin(), edge.end());
        }
    }

    /// Parts partners that run in the same direction. Where that leaves half-edges of both directions alone at one
    /// edge, these are joined.
    void part_partners() {
        for (const Index f : twisted_)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index g = partners_[h];
                if (g != none && !complex_.opposite(h, g)) partners_[h] = partners_[g] = none;
            }
        std::vector<Index> along;
        std::vector<Index> against;
        Edges(complex_).visit([&](std::span<const Index> edge) {
            along.clear();
            against.clear();
            for (const Index h : edge)
                if (partners_[h] == none) (complex_.opposite(h, edge[0]) ? against : along).push_back(h);
            for (std::size_t i = 0; i < std::min(along.size(), against.size()); ++i) {
                partners_[along[i]] = against[i];
                partners_[against[i]] = along[i];
            }
            cut_ += note_cut(along.size() > against.size() ? along : against, std::min(along.size(), against.size()));
        });
    }

    /// The half-edges from `start` on stay alone at their edge, in pairs and perhaps one more.
    std::uint64_t note_cut(const std::vector<Index>& alone, std::size_t start) {
        const std::size_t pairs = (alone.size() - start) / 2;
        if (pairs == 0) return 0;
        for (std::size_t i = 0; i < pairs; ++i) cuts_.push_back(alone[start + 2 * i]);
        for (std::size_t i = start; i < alone.size(); ++i) is_cut_[alone[i] / 3] = 1;
        return pairs * shortener_->weights().at(alone[start]);
    }

    std::uint64_t report_cuts() {
        for (const Index h : cuts_) {
            if (complex_.mended[h / 3])
                log_.add_pair(Defect::cut_edge, complex_.source(complex_.from(h)), complex_.source(complex_.to(h)));
        }
        for (std::size_t i = 0; i < twisted_starts_.size(); ++i) {
            const auto first = twisted_.begin() + static_cast<std::ptrdiff_t>(i == 0 ? 0 : twisted_starts_[i - 1]);
            const auto last = twisted_.begin() + static_cast<std::ptrdiff_t>(twisted_starts_[i]);
            if (complex_.mended[*first] && std::any_of(first, last, [&](Index f) { return is_cut_[f] != 0; }))
                log_.add(Defect::non_orientable, complex_.origin[*first].index());
        }
        return cut_;
    }

    Complex& complex_;
    Partners& partners_;
    EdgeList& crowded_;
    Log& log_;
    std::vector<char> turn_;
    std::vector<Index> component_;
    std::vector<Index> twisted_;  ///< faces of components that can not be oriented, one component after another
    std::vector<std::size_t> twisted_starts_;
    std::vector<Index> cuts_;   ///< a half-edge for each two that stay alone at one edge
    std::vector<char> is_cut_;  ///< faces with such a half-edge
    std::uint64_t cut_ = 0;
    std::optional<CutShortener> shortener_;
};

}  // namespace

std::uint64_t orient(Complex& complex, Joined& joined, Log& log, const Context* context) {
    return Orienter(complex, joined, log).run(context);
}

}  // namespace delmesh::repairing
