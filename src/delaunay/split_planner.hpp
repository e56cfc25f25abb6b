#pragma once
// A chooser of splits that is there only while it is needed: for a large mesh its model takes more memory than the mesh
// that is made meanwhile.

#include "delaunay/choose_splits.hpp"

#include <optional>

namespace delmesh {

class SplitPlanner {
public:
    /// `baseline`: another solution, or none; see `SplitChooser`. It is empty while the chooser of a large mesh has it.
    /// All must outlive the planner. `large`: from so many edges on, half as many in a mesh of very many faces,
    /// the chooser is let go and made again.
    SplitPlanner(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitSearchOptions& options,
                 std::vector<SplitPoint>& baseline, std::size_t large = 20'000)
        : marked_(marked),
          bad_(bad),
          options_(options),
          baseline_(baseline),
          is_large_(bad.size() >= (marked.mesh().face_count() < most_faces ? large : large / 2)) {}

    /// `SplitChooser::search`; hands over the plan.
    [[nodiscard]] std::vector<SplitPoint> search(const Context* context);
    /// `SplitChooser::proved_bound`.
    [[nodiscard]] std::size_t proved_bound() const { return proved_bound_; }
    /// `SplitChooser::leaves_open`.
    [[nodiscard]] bool leaves_open() const { return chooser_ ? chooser_->leaves_open() : plan_.leaves_open; }
    /// `SplitChooser::close_by_baseline`; hands over the changed plan.
    [[nodiscard]] std::vector<SplitPoint> close_by_baseline();
    /// `SplitChooser::lay_slices`; hands over the plan.
    [[nodiscard]] std::optional<std::vector<SplitPoint>> lay_slices(const SliceOptions& options,
                                                                    std::span<const std::array<VertexId, 2>> distrusted,
                                                                    const Context* context);
    /// `SplitChooser::mend`; hands over the changed plan.
    [[nodiscard]] std::optional<std::vector<SplitPoint>> mend(std::span<const std::array<VertexId, 2>> edges);
    /// `SplitChooser::take_better_regions`; hands over the changed plan.
    [[nodiscard]] std::optional<std::vector<SplitPoint>> take_better_regions(std::span<const SplitPoint> truth);

private:
    static constexpr std::size_t most_faces = 500'000;

    SplitChooser& chooser();
    /// The plan.
    [[nodiscard]] std::vector<SplitPoint> hand_over();
    /// Lets the chooser go if its model is large.
    void rest();

    const MarkedMesh& marked_;
    std::span<const EdgeId> bad_;
    SplitSearchOptions options_;
    std::vector<SplitPoint>& baseline_;
    const bool is_large_;
    std::optional<SplitChooser> chooser_;
    std::size_t proved_bound_ = 0;
    SplitPlan plan_;  ///< what the chooser knew when it was let go
};

}  // namespace delmesh
