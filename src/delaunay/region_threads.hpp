#pragma once
// Threads at right angles to needles, laid anew in all of a region.

#include "base/random.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_repair.hpp"
#include "delmesh/base/context.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// Where needles fill a region of any outline, threads at right angles to them leave all parts Delaunay but those that
/// end at a border that leans. So threads need only begin where such a part would be too long, and a thread that begins
/// at one place of the border often does for others. Which ones do for all is searched for: some neighbours among them
/// are taken away as a whole, and others are laid from other places until all is Delaunay.
class RegionThreads {
public:
    RegionThreads(SplitModel& model, SplitRepair& limits, std::uint64_t seed)
        : model_(model),
          limits_(limits),
          random_(seed) {}

    /// Finds the edges that are connected to e through facets with points, or with edges that need some.
    void gather(std::uint32_t e);
    [[nodiscard]] std::span<const std::uint32_t> edges() const { return edges_; }
    [[nodiscard]] std::size_t point_count() const;

    /// Replaces the points of what has been gathered by fewer ones, with that much work. False if that fails: then all
    /// is as it was. All of its edges must be Delaunay; there must be no transaction.
    [[nodiscard]] bool thin(std::uint64_t work, const Context* context = nullptr);

private:
    using Place = PlacedPoint;
    using Thread = std::vector<Place>;

    void visit(std::uint32_t e);
    bool lay_first(std::size_t max_points);
    bool close(std::size_t max_points, std::size_t most_threads);
    bool lay(std::uint32_t e, std::size_t part, double at, std::size_t max_points);
    void put(std::uint32_t e, std::size_t part, double at);
    void cross(std::uint32_t s, double at);
    [[nodiscard]] bool has_room(std::uint32_t e, std::size_t part, double at) const;
    [[nodiscard]] double choose_place(std::uint32_t e, std::size_t part);
    void try_once();
    void choose_threads(const Place& near, std::size_t count);
    void take_chosen();
    void take_all();
    [[nodiscard]] std::vector<Place> places() const;
    void put_back(std::span<const Place> places);

    SplitModel& model_;
    SplitRepair& limits_;
    Random random_;
    bool is_first_ = false;
    std::vector<std::uint32_t> edges_;
    std::vector<bool> reached_;
    std::vector<bool> visited_;  ///< facets
    std::vector<Thread> threads_;
    std::vector<Thread> taken_;
    std::vector<std::size_t> chosen_;
    Thread points_;
};

}  // namespace delmesh
