#pragma once
// Points to take away together.

#include "base/random.hpp"
#include "delaunay/split_model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delmesh {

class SplitTargets {
public:
    struct Point {
        std::uint32_t edge = 0;
        double at = 0;
    };

    SplitTargets(SplitModel& model, Random& random) : model_(model), random_(random) {}

    /// Neighbouring points, in random order.
    void take_cluster(Point seed, std::size_t size);
    /// All points of neighbouring edges.
    void take_edges(std::uint32_t edge, std::size_t size);
    /// A chain of points, each the nearest to the one before across a facet: in strips points vanish only all together.
    void take_thread(Point seed, std::size_t size);

    /// Two such chains, side by side.
    void take_threads(Point seed, std::size_t size);

    [[nodiscard]] std::size_t size() const { return taken_.size(); }
    /// Takes them off the model.
    void remove();

private:
    [[nodiscard]] bool is_taken(const Point& t) const;
    void add_nearest(const Side& from, Point2 at);
    void add_neighbours(const Point& of);
    bool move_across(int& k, Point& at);
    void follow(const Point& seed, std::size_t size);

    SplitModel& model_;
    Random& random_;
    std::vector<Point> taken_;
    std::vector<Point> nearby_;
    std::vector<std::uint32_t> edges_;
};

}  // namespace delmesh
