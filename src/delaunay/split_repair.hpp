#pragma once
// Makes edges Delaunay one after the other, each by the best response to the others.

#include "base/random.hpp"
#include "delaunay/best_response.hpp"
#include "delaunay/split_model.hpp"

#include <cstddef>
#include <cstdint>

namespace delmesh {

class SplitRepair {
public:
    SplitRepair(SplitModel& model, Random& random) : model_(model), random_(random), response_(model, random) {}

    /// See BestResponse.
    void be_quick() { response_.be_quick(); }
    /// Of the steps, those that place points on the bad edge itself and not on the one that it sees.
    void set_self_share(double share) { self_share_ = share; }

    /// Works off the model's suspects: places new points on an edge with bad parts, or on the edge whose point such a
    /// part sees. Each time an edge turns up its weight grows, so that others avoid to make it bad. False as soon as
    /// that has taken more than `steps` steps, or as the points, and 0.4 for each edge that is still suspected, exceed
    /// `max_points`. `last_first`: newest suspects first, which draws threads of points across strips; else random.
    bool run(std::size_t max_points, std::size_t steps, bool last_first);

    /// As `run`, but only ever adds points, one at a time, where they carry on straight threads: that closes long thin
    /// strips in which the places of points depend on each other, by many points.
    bool weave(std::size_t max_points, std::size_t steps);

    /// Moves point i of an edge away from others, as far as that makes nothing bad.
    void spread(std::uint32_t e, std::size_t i);

    /// From now on `run` also gives up when the model's work has come this far.
    void set_work_limit(std::uint64_t limit) { work_limit_ = limit; }
    [[nodiscard]] bool is_exhausted() const { return model_.work() >= work_limit_; }

private:
    void resolve(std::uint32_t e, std::size_t part);
    bool resolve_culprit(std::uint32_t e, std::size_t part);
    void replace(std::uint32_t e, std::size_t first, std::size_t last);
    [[nodiscard]] bool takes_whole_edge(std::size_t points);
    [[nodiscard]] std::size_t point_seen(std::uint32_t e, std::size_t part, int k) const;

    SplitModel& model_;
    Random& random_;
    BestResponse response_;
    double self_share_ = 0.45;
    std::uint64_t work_limit_ = ~std::uint64_t{0};
};

}  // namespace delmesh
