#pragma once
// The best points of one edge while all other edges stay as they are.

#include "base/random.hpp"
#include "delaunay/split_model.hpp"

#include <array>
#include <span>
#include <vector>

namespace delmesh {

/// Finds new points for a stretch of an edge such that all its parts become Delaunay, with the least cost: 10 for each
/// point, and for each part of another edge that a point makes bad the weight of that edge. Among equal places it takes
/// a random one. Keeps its buffers from call to call.
class BestResponse {
public:
    BestResponse(SplitModel& model, Random& random) : model_(model), random_(random) {}

    /// From now on fewer places are tried where several points are needed.
    void be_quick() { is_quick_ = true; }

    /// New points to put in place of the points first ... last-1 of edge e, which must be prepared. May be none. An
    /// empty stretch (first == last) asks for one point or more in part `first`, whether that is bad or not.
    [[nodiscard]] std::span<const double> solve(std::uint32_t e, std::size_t first, std::size_t last);

    /// One point for the part `first`, even if no point makes both halves Delaunay.
    [[nodiscard]] double halve(std::uint32_t e, std::size_t first);

    /// The same, rather where it carries on a straight thread of points over several edges.
    [[nodiscard]] double weave(std::uint32_t e, std::size_t first);

    /// Where point i of edge e lies farthest from all other points and corners that are known to see it, while no part
    /// becomes bad; where it is now, if there is nothing better.
    [[nodiscard]] double spread(std::uint32_t e, std::size_t i);

    static constexpr int point_cost = 10;

private:
    struct Event {
        double at = 0;
        int weight = 0;
    };
    /// A stretch of the edge and the weight of what a point there makes bad.
    struct Cell {
        double begin = 0;
        double end = 0;
        int weight = 0;
    };
    struct Candidate {
        double at = 0;
        double reach = -1;  ///< unknown if negative
    };
    /// A point in the frame of a side, and 1/y.
    struct Seen {
        double x = 0;
        double y = 0;
        double inverse = 0;
    };
    /// The points that one side of the edge can see, in its frame; for single triangles only.
    struct View {
        std::uint32_t side = SplitModel::none;
        bool listed = false;
        std::vector<Seen> points;
    };

    void look(std::uint32_t e, bool far);
    void look_at(const Side& side, std::uint32_t s, std::uint32_t other, bool far, std::vector<Seen>& points) const;
    [[nodiscard]] std::span<const Part> around_stretch(std::span<const Part> parts, Point2 p, Point2 d) const;
    [[nodiscard]] Point2 nearest(const View& view, double a, double b, double& cot) const;
    [[nodiscard]] bool see(double a, double b, std::array<Point2, 2>& at, std::array<double, 2>& cot) const;
    [[nodiscard]] double step(double a, double b, bool up) const;
    template <bool up>
    [[nodiscard]] double listed_reach(double from) const;
    [[nodiscard]] double reach_up(double from) const;
    [[nodiscard]] double reach_down(double from) const;

    void block(std::uint32_t e);
    void block_by_side(std::uint32_t own_side, std::uint32_t s);
    void find_cells();
    [[nodiscard]] int soft_weight(double t) const;

    void aim_at(std::uint32_t e, std::size_t first);
    [[nodiscard]] double place_in_middle();
    [[nodiscard]] std::array<double, 2> near_ends(double begin, double end);
    [[nodiscard]] double pick(double low, double high);
    [[nodiscard]] bool place_one(double low, double high);
    void place_many();
    [[nodiscard]] double distance2_to_others(double t) const;
    void add_candidates();
    void add_farthest_candidates();
    void add_quick_candidates();
    void insert_candidate(double at);
    void sort_candidates();
    void finish_candidates();
    void weigh_candidates();
    [[nodiscard]] bool cheapest_chain();
    [[nodiscard]] int cheapest_candidate(std::size_t first, std::size_t last, int least);
    void plain_chain();

    SplitModel& model_;
    Random& random_;
    bool is_quick_ = false;
    double low_ = 0;  ///< the stretch that is being solved
    double high_ = 1;
    double room_ = 0;
    double first_reach_ = -1;  ///< from low_, once it is known
    double last_reach_ = -1;   ///< from high_
    std::array<View, 2> views_;
    bool is_listed_ = false;     ///< all that both sides see
    std::vector<Cell> blocked_;  ///< one for each part of another edge, with its weight
    std::vector<Event> events_;
    std::vector<Cell> cells_;
    std::vector<double> aligned_;
    std::vector<Candidate> candidates_;
    std::vector<double> load_;  ///< of each candidate: what it makes bad
    std::vector<int> cost_;     ///< of the way to it, and of itself; where no way ends
    std::vector<int> before_;
    std::vector<double> chosen_;
};

}  // namespace delmesh
