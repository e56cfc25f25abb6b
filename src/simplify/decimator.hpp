#pragma once
// The loop of collapses: cheapest edge first, each one checked exactly before it is made.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "simplify/loosen.hpp"
#include "simplify/placement.hpp"
#include "simplify/queue.hpp"
#include "simplify/recorder.hpp"
#include "simplify/refit.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"
#include "simplify/sweeper.hpp"
#include "simplify/tuning.hpp"
#include "simplify/watchlists.hpp"
#include "simplify/weights.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delmesh {

struct DecimatorLimits {
    double error = 0;  ///< largest distance to the planes of the history, in the mesh's units; 0: none
    Precision precision = Precision::float64;
};

struct DecimatorCounts {
    std::size_t collapses = 0, popped = 0, requeued = 0, woken = 0, parked = 0;
    std::size_t asked = 0;  ///< edges, each time all have a turn
    std::array<std::size_t, blocker_count> blocked{};
};

class Decimator {
public:
    /// The mesh must be Delaunay and must outlive the decimator.
    Decimator(Mesh& mesh, const Tuning& tuning, const DecimatorLimits& limits = {}, Recorder* recorder = nullptr);

    /// Collapses until so many vertices are left, nothing can be collapsed any more, or the context is cancelled.
    void run(std::size_t vertices, const Context* context = nullptr);

    /// From now on `most` or fewer samples of the surface as it is, with its first `count` vertices, are followed.
    void follow_samples(std::size_t count, std::size_t most) { samples_.emplace(mesh_, count, scale_, most); }
    /// From now on these are followed.
    void follow_samples(SurfaceSamples samples) { samples_ = std::move(samples); }
    /// The sweeper has gone the first part of the way. Requires `follow_samples`, with those from before. Where others
    /// went before it, `merged_before` says into which of the vertices that it began with those of the samples were
    /// merged.
    void continue_from(std::unique_ptr<Sweeper> sweeper, std::vector<VertexId> merged_before);
    /// On the last part of the way to so many vertices, collapses must not leave a sample far from the surface, nor the
    /// surface far from the samples: such edges wait until the mean error has grown or nothing else is left.
    void guard_for(std::size_t vertices);
    /// Moves vertices towards the samples that are followed; returns how many moves it took.
    std::size_t refit(const RefitTuning& tuning, const Context* context = nullptr);
    /// As `run`, but cares for the samples only, and flips what a collapse leaves that is not Delaunay; stops early
    /// where little goes: see `Polisher`. Not while steps are recorded, as the next one.
    void reduce(std::size_t vertices, const Context* context = nullptr);
    /// Spends the vertices of a level better: see `Polisher`. There must be no dead elements. Vertices that go leave
    /// their ids to those that come. Returns how many vertices went or moved.
    std::size_t polish(const Context* context = nullptr);
    /// Renumbers the mesh so that there are no dead elements any more. Not while steps are recorded.
    void close_gaps(Numbering& numbering);
    /// From here on looks harder for places, and changes the mesh where edges are blocked, so that they have another
    /// chance: see `Loosener`. `freedom` is how much larger than usual an error may get (its square). Not
    /// while steps are recorded: a progressive mesh knows no flips.
    void loosen(std::uint64_t seed, double freedom);

    [[nodiscard]] bool has_samples() const { return samples_.has_value(); }
    /// Requires `follow_samples`.
    [[nodiscard]] SurfaceSamples& samples() { return *samples_; }
    [[nodiscard]] double scale() const { return scale_; }

    /// Vertices that have faces.
    [[nodiscard]] std::size_t vertices() const { return vertices_; }
    [[nodiscard]] double worst_error() const { return worst_error_; }
    /// The edges that are blocked now, by what blocked them.
    [[nodiscard]] std::array<std::size_t, blocker_count> count_blocked() const;
    [[nodiscard]] const DecimatorCounts& counts() const { return counts_; }
    [[nodiscard]] const Placer& placer() const { return placer_; }
    /// What edges and samples took so far, in places tried. Counts where vertices have very many faces, or faces very
    /// many samples.
    [[nodiscard]] std::size_t work_beside_places() const {
        return counts_.asked / 2 + (samples_ ? samples_->found() / 4 : 0);
    }

private:
    /// An edge that waits for something to change; outdated if its stamp is.
    struct Watch {
        HalfedgeId edge;
        std::uint32_t stamp = 0;
    };
    /// An edge that waits until so large a distance is allowed.
    struct Parked {
        double distance2 = 0;
        Watch watch;

        friend bool operator>(const Parked& a, const Parked& b) {
            return a.distance2 > b.distance2 || (a.distance2 == b.distance2 && a.watch.edge > b.watch.edge);
        }
    };
    [[nodiscard]] double key_of(HalfedgeId h) const;
    void enqueue_all();
    void enqueue(HalfedgeId h);
    void forget(HalfedgeId h);
    [[nodiscard]] Watch wait(HalfedgeId h, Blocker why);
    void follow(const CompactMap& map);
    void refresh_weights();
    void move_history(VertexId v, const Vec3& to);
    void start_afresh();
    void leave_queue();
    void watch_ring(const Watch& watch);
    void block(HalfedgeId h, Blocker why);
    [[nodiscard]] double allowed2() const;
    void park(HalfedgeId h, double distance2);
    void release_parked();
    bool retry();
    void process(const Queue::Entry& entry);
    [[nodiscard]] Vec3 settled(const Vec3& w) const;
    [[nodiscard]] bool exceeds_error(const Quadric& merged);
    void accept(HalfedgeId h, const Vec3& w, const Quadric& merged);
    void wake(VertexId v);

    Mesh& mesh_;
    const Tuning tuning_;
    const DecimatorLimits limits_;
    Recorder* const recorder_;
    const double scale_;
    Placer placer_;
    VertexWeights weights_;
    std::size_t vertices_ = 0;
    double worst_error_ = 0;
    std::vector<Blocker> blocked_;      ///< per half-edge: what it waits for
    std::vector<std::uint32_t> stamp_;  ///< per half-edge: how often that has changed
    Watchlists<Watch> watches_;
    std::vector<Watch> woken_;
    std::vector<Parked> parked_;  ///< a heap, the smallest distance first
    Queue queue_;
    bool is_outdated_ = true;  ///< the queue
    bool shaken_ = false;      ///< from the first call of `loosen` on
    std::optional<SurfaceSamples> samples_;
    std::size_t guarded_ = 0;
    std::size_t retried_ = 0;  ///< collapses made when all edges had another turn
    double quiet_ = 1;         ///< how much larger the mean square is where there is an error at all
    double raised2_ = 0;       ///< allowed because nothing else was left
    Star star_;
    DecimatorCounts counts_;
};

}  // namespace delmesh
