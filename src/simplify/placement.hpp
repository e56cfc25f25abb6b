#pragma once
// Where the merged vertex goes.

#include "delmesh/simplify/quadric_program.hpp"
#include "simplify/edge_cost.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"

#include <optional>
#include <vector>

namespace delmesh {

struct Place {
    Vec3 point;  ///< local
    double cost = 0;
};

class Placer {
public:
    Placer(const Mesh& mesh, const Tuning& tuning) : mesh_(mesh), tuning_(tuning) {}

    /// The best place found where all conditions hold in floating point, or why there is none.
    std::optional<Place> best(Star& star, const EdgeCost& cost);
    /// From now on `best` starts from more places and takes more steps. Many times slower where edges are blocked.
    void look_harder() { looks_harder_ = true; }
    /// The paper's: the lowest point over the intersection of half-spaces.
    std::optional<Place> paper(Star& star, const EdgeCost& cost);

    /// A better place than `start`, where all conditions hold; nothing if there is none.
    std::optional<Place> improve(Star& star, const EdgeCost& cost, const Vec3& start);

    /// Of the last call that found no place: the condition that the best place of all would have violated, and the
    /// face of the star that belongs to it.
    [[nodiscard]] Blocker blocker() const { return blocker_; }
    [[nodiscard]] std::size_t witness() const { return witness_; }
    /// Places tried and programs solved so far.
    [[nodiscard]] std::size_t evaluations() const { return evaluations_; }
    [[nodiscard]] std::size_t programs() const { return programs_; }

private:
    bool fits(Star& star, const Vec3& w);
    void bisect(Star& star, const EdgeCost& cost, const Vec3& goal, Place& place);
    [[nodiscard]] std::optional<Place> best_from_afar(Star& star, const EdgeCost& cost, const Vec3& goal);
    void descend(Star& star, const EdgeCost& cost, Place& place, bool feasible, bool& found);
    void linearise(Star& star, const Vec3& w);

    const Mesh& mesh_;
    const Tuning& tuning_;
    bool looks_harder_ = false;
    Blocker blocker_ = Blocker::none;
    Blocker last_ = Blocker::none;
    std::size_t witness_ = 0;
    std::size_t faults_ = 0;      ///< that a place may leave
    std::size_t fail_first_ = 0;  ///< faces are tried from the one on that failed last
    std::size_t evaluations_ = 0;
    std::size_t programs_ = 0;
    std::vector<HalfSpace> half_spaces_;
};

}  // namespace delmesh
