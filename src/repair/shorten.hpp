#pragma once
// Short cuts that make a surface orientable.

#include "repair/complex.hpp"

namespace delmesh::repairing {

/// Lengths of edges as integers, so that sums do not depend on their order and a shorter cut is shorter for certain.
class EdgeWeights {
public:
    explicit EdgeWeights(const Complex& complex);
    /// At least 1.
    [[nodiscard]] std::uint64_t at(Index h) const;
    /// A difference of points in the unit of the weights.
    [[nodiscard]] Vec3 scaled(const Vec3& d) const;

private:
    const Complex& complex_;
    int exponent_ = 0;
};

/// Chooses which faces of a component to turn round (`turn`, 0 for all of them at first) so that the partners that then
/// run in the same direction, which is where the surface has to be cut, are short in sum. `turn` stays as it is unless
/// something strictly shorter is found, so that a surface that was cut this way before is cut at the same place again.
///
/// Faces are oriented in the order of their distance from a face, so that the cut runs where the front meets itself;
/// then single faces are turned while that shortens the cut. Two such fronts and the given orientation compete; where
/// the surface is cut already (`settled`), only the given orientation is improved on. Not the shortest cut there is
/// (finding that is hard), but free of detours. Cost: O(n log n) and the turns.
class CutShortener {
public:
    CutShortener(const Complex& complex, const Partners& partners, std::vector<char>& turn, const Context* context)
        : complex_(complex),
          partners_(partners),
          weights_(complex),
          turn_(turn),
          distance_(complex.face_count()),
          context_(context) {}

    void run(const std::vector<Index>& component, bool settled);
    [[nodiscard]] const EdgeWeights& weights() const { return weights_; }

private:
    using State = std::vector<char>;
    [[nodiscard]] State save(const std::vector<Index>& component) const;
    [[nodiscard]] bool agree(Index h, Index g) const;
    [[nodiscard]] std::uint64_t cut_length(const std::vector<Index>& component) const;
    [[nodiscard]] std::int64_t gain(Index f) const;
    void turn_single_faces(const std::vector<Index>& component);
    [[nodiscard]] Vec3 centre(Index f) const;
    Index follow_front(const std::vector<Index>& component, Index root);

    const Complex& complex_;
    const Partners& partners_;
    EdgeWeights weights_;
    std::vector<char>& turn_;
    std::vector<double> distance_;
    const Context* context_;
};

}  // namespace delmesh::repairing
