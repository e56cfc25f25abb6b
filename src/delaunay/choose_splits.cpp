#include "delaunay/choose_splits.hpp"

#include "delaunay/block_search.hpp"
#include "delaunay/close_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delmesh {
namespace {

/// A unit of work takes 5 to 8 ns.
constexpr double work_per_edge = 27'000;
constexpr double quick_work_per_edge = 1'000;
constexpr double quick_work_per_split = 200;
constexpr double construct_work_per_edge = 550;
constexpr double least_construct_work = 100'000;
constexpr double least_work = 130e6;
constexpr double least_work_of_few = 110e6;  ///< for each start, see below
/// Nobody wants to wait for minutes unasked. A higher effort is asked.
constexpr double most_work = 0.8e9;
constexpr double most_block_work = 0.8e9;  ///< in blocks, each round half of it
/// For planes. What they can solve at all took less than half of it so far.
constexpr std::uint64_t slice_work = 200'000'000;
constexpr int default_effort = 3;
/// From here on the search cuts the mesh into blocks.
constexpr std::size_t many_edges = 4000;
/// Each round may do half of the work. There are at least three, so that each place is within a block once, and more as
/// long as they pay and less than twice the work is done.
constexpr double round_share = 0.5;
constexpr int least_rounds = 3;
constexpr int most_rounds = 9;
constexpr double most_shares = 2;
constexpr std::size_t worthwhile = 400;  ///< a round that saves less than 1/400 of the points is the last one
constexpr int polish_rounds = 2;
constexpr double spread_share = 0.2;
constexpr double region_share = 0.3;
/// The share of the work in which an edge must be closed; else the rest is closed by borrowing.
constexpr double patience = 0.1;
constexpr double most_patience = 0.5;  ///< the same, as long as edges get closed
constexpr std::size_t dear = 2;        ///< where borrowing makes so many times the points, patience begins again
/// With no more edges than these, and at least this many times as many points, the search starts more than once.
constexpr std::size_t few_edges = 200;
constexpr std::size_t hard = 2;
struct Starts {
    int most;
    double first, others;  ///< of the work, for each
};
constexpr Starts long_starts{2, 0.6, 0.6};
/// For needles: where shells need so many points for each edge, luck helps more than patience.
constexpr Starts short_starts{6, 0.45, 0.15};
constexpr std::size_t wild = 30;
constexpr double start_rest = 0.4;     ///< for what the starts have found together
constexpr double long_share = 0.5;     ///< of more work than by default, for a search that goes on
constexpr double gap_share = 0.2;      ///< of the same, for what lies above the proved bound
constexpr std::size_t small_gap = 30;  ///< where that is no more than one point in so many
constexpr int most_useless = 2;        ///< searches in a row
/// More for the search where no edge stayed open for long.
constexpr double spare_share = 0.6;
/// And for as long as a point that is saved takes less work than this.
constexpr double cheap_point = 250e3;
constexpr double extra_share = 0.1;
constexpr int most_extra = 3;

/// By default the search ends where little comes of it. Whoever asks for more effort wants that little.
std::uint64_t patience_of(int effort) {
    return effort <= default_effort ? 1 : std::uint64_t{1} << (effort - default_effort);
}

}  // namespace

SplitChooser::SplitChooser(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitSearchOptions& options)
    : model_(marked),
      search_(model_, options.seed),
      options_(options) {
    model_.expect(bad.size());
    if (options.is_greedy) model_.know_bad(bad);
    bad_.reserve(bad.size());
    for (const EdgeId e : bad) {
        bad_.push_back(model_.edge_of(Mesh::halfedge(e)));
        if (!options.is_greedy) model_.prepare(bad_.back());
    }
}

std::uint32_t SplitChooser::edge_between(VertexId a, VertexId b) {
    const MarkedMesh& marked = model_.layout().marked();
    // Points within a facet may lie between others that are not there yet.
    if (std::max(a, b).index() >= marked.mesh().vertex_count()) return SplitModel::none;
    HalfedgeId h = marked.mesh().find_halfedge(a, b);
    if (!h.valid()) h = marked.mesh().find_halfedge(b, a);
    return h.valid() && !marked.is_planar(h) ? model_.edge_of(h) : SplitModel::none;
}

/// Sorted. Leaves out points within facets.
std::vector<PlacedPoint> SplitChooser::place(std::span<const SplitPoint> splits) {
    std::vector<PlacedPoint> points;
    points.reserve(splits.size());
    std::uint32_t e = SplitModel::none;
    for (std::size_t i = 0; i < splits.size(); ++i) {
        if (i == 0 || splits[i].a != splits[i - 1].a || splits[i].b != splits[i - 1].b)
            e = edge_between(splits[i].a, splits[i].b);
        if (e != SplitModel::none) points.push_back({e, splits[i].t});
    }
    std::sort(points.begin(), points.end());
    return points;
}

void SplitChooser::set_baseline(std::span<const SplitPoint> splits) {
    baseline_ = place(splits);
    search_.set_other(baseline_);
}

std::vector<EdgeId> SplitChooser::bad_edges() const {
    const FacetLayout& layout = model_.layout();
    std::vector<EdgeId> edges;
    for (const std::uint32_t e : bad_) edges.push_back(layout.marked().mesh().edge(layout.edge(e).halfedge));
    return edges;
}

double SplitChooser::default_work() const {
    const double least = bad_.size() <= few_edges ? least_work_of_few : least_work;
    return std::clamp(work_per_edge * static_cast<double>(bad_.size()), least, most_work);
}

double SplitChooser::full_work() const {
    if (options_.quick && !baseline_.empty())
        return quick_work_per_edge * static_cast<double>(bad_.size()) +
               quick_work_per_split * static_cast<double>(baseline_.size());
    return std::ldexp(default_work(), options_.effort - default_effort);
}

void SplitChooser::search(const Context* context) {
    const double full = full_work();
    const bool in_blocks = bad_.size() >= many_edges;
    const bool goes_on = options_.effort > default_effort && !in_blocks;
    const double first = goes_on ? default_work() : full;
    if (options_.effort > 0 && bad_.size() <= few_edges) {
        find_best_places(first, context);
    } else {
        find_places(first, context);
    }
    if (goes_on) go_on(full - first, context);
    if (is_cancelled(context) || is_hopeless()) return;
    if (options_.effort > 0) {
        search_.thin_rings(static_cast<std::uint64_t>(0.1 * full));
        spread(full, in_blocks, context);
    }
    if (baseline_.empty()) return;
    leaves_open_ = !search_.open().empty();
    if (!leaves_open_) close_by_baseline();
}

void SplitChooser::close_by_baseline() {
    delmesh::take_better_regions(model_, search_.open(), placed_points(model_), baseline_);
    is_compared_ = true;
    leaves_open_ = false;
}

bool SplitChooser::lay_slices(const SliceOptions& options, std::span<const std::array<VertexId, 2>> distrusted,
                              const Context* context) {
    for (const auto& [a, b] : distrusted) {
        const std::uint32_t e = edge_between(a, b);
        if (e == SplitModel::none) continue;
        model_.prepare(e);
        model_.distrust(e);
    }
    search_.set_open(bad_);
    search_.close_by_slices(slice_work, options, context);
    return search_.open().empty();
}

/// What is still open in a large mesh makes the shells explode again: no use in improving the rest.
bool SplitChooser::is_hopeless() const {
    return bad_.size() >= many_edges && baseline_.empty() && !search_.open().empty();
}

void SplitChooser::find_places(double full, const Context* context) {
    const std::uint64_t before = model_.work();
    search_.construct(bad_, static_cast<std::uint64_t>(full));
    const bool in_blocks = bad_.size() >= many_edges;
    if (options_.effort > 0) in_blocks ? improve_blocks_once(false, context) : wait_for_open_edges(full, context);
    if (is_cancelled(context)) return;
    const std::vector<PlacedPoint> points = placed_points(model_);
    const std::vector<std::uint32_t> open = search_.open();
    close(full);
    const bool may_wait = options_.effort > 0 && !in_blocks && bad_.size() > few_edges;
    if (may_wait && !open.empty() && model_.point_count() > dear * points.size()) {
        put(points, open);
        wait_for_open_edges(full, context);
        if (is_cancelled(context)) return;
        close(full);
    }
    if (is_hopeless()) return;
    const std::uint64_t closed = model_.work();
    if (options_.effort > 0 && !in_blocks)
        search_.lay_regions(static_cast<std::uint64_t>(region_share * full), context);
    // What is laid leaves less to the search: it counts twice.
    const double left =
        (1 + spare_share) * full - static_cast<double>(model_.work() - before + (model_.work() - closed));
    if (options_.effort > 0) in_blocks ? improve_blocks(context) : improve(full, std::max(full, left), context);
}

/// By whatever it takes.
void SplitChooser::close(double full) {
    search_.close_rings(static_cast<std::uint64_t>(std::min(full, 0.3 * default_work())));
    search_.close_open(static_cast<std::uint64_t>(full));
}

/// Goes on beyond that work for as long as it pays.
void SplitChooser::improve(double full, double work, const Context* context) {
    const double extra = extra_share * full;
    const double end = static_cast<double>(model_.work()) + work - extra;
    search_.improve(static_cast<std::uint64_t>(work - extra), context);
    if (static_cast<double>(model_.work()) < end) return;
    for (int i = 0; i <= most_extra && !is_cancelled(context); ++i) {
        const std::size_t before = model_.point_count();
        search_.improve(static_cast<std::uint64_t>(extra), context);
        if (static_cast<double>(model_.point_count()) + extra / cheap_point > static_cast<double>(before)) return;
    }
}

/// Of each region the better one, or of all, if edges of the other solution are open.
void SplitChooser::keep_better(const std::vector<PlacedPoint>& other, const std::vector<std::uint32_t>& open) {
    if (open.empty()) {
        delmesh::take_better_regions(model_, search_.open(), placed_points(model_), other);
        return put(placed_points(model_), {});
    }
    const auto worth = [](std::size_t open_edges, std::size_t count) { return std::pair(open_edges, count); };
    if (worth(open.size(), other.size()) < worth(search_.open().size(), model_.point_count())) put(other, open);
}

bool SplitChooser::is_wild() const {
    // Less work is too little for short starts.
    return options_.effort >= default_effort && baseline_.size() >= wild * bad_.size();
}

/// Where few edges need many points, much depends on luck: it is tried more than once.
void SplitChooser::find_best_places(double full, const Context* context) {
    const Starts starts = is_wild() ? short_starts : long_starts;
    find_places(starts.first * full, context);
    for (int i = 1; i < starts.most && !is_cancelled(context); ++i) {
        if (model_.point_count() < hard * bad_.size()) break;
        const std::vector<PlacedPoint> points = placed_points(model_);
        const std::vector<std::uint32_t> open = search_.open();
        put({}, {});
        find_places(starts.others * full, context);
        keep_better(points, open);
    }
    if (!is_cancelled(context)) search_.improve(static_cast<std::uint64_t>(start_rest * full), context);
}

/// For those who ask for more effort. Half of the work goes into the same search, then some into the gap to the proved
/// bound. Then new ones begin from nothing, and of each region the better one is kept, as long as that pays; where few
/// edges must be split, luck is all that helps.
void SplitChooser::go_on(double work, const Context* context) {
    const double end = static_cast<double>(model_.work()) + work;
    const auto left = [&] { return end - static_cast<double>(model_.work()); };
    const auto improve = [&](double most) {
        search_.be_patient(patience_of(options_.effort));
        search_.improve(static_cast<std::uint64_t>(most), context);
        search_.be_patient(1);
    };
    if (search_.open().empty() && model_.point_count() == bad_.size()) return;  // no method needs fewer
    improve(long_share * work);
    GapCloser gaps(model_, bad_edges(), options_.bound, options_.seed, context);
    if (close_gaps(gaps, gap_share * work, context)) return;
    const bool is_small = bad_.size() <= few_edges;
    const double share = !is_small ? 1 : is_wild() ? short_starts.others : long_starts.others;
    const double once = share * default_work();
    for (int useless = 0; (is_small || useless < most_useless) && left() > 0 && !is_cancelled(context);) {
        const std::vector<PlacedPoint> best = placed_points(model_);
        const std::vector<std::uint32_t> open = search_.open();
        put({}, {});
        find_places(std::min(left(), once), context);
        keep_better(best, open);
        if (model_.point_count() == gaps.bound() && search_.open().empty()) return;
        useless = model_.point_count() < best.size() ? 0 : useless + 1;
    }
    if (left() > 0 && close_gaps(gaps, 0.5 * left(), context)) return;
    if (left() > 0) improve(left());
}

/// Where they are small. True if none is left.
bool SplitChooser::close_gaps(GapCloser& gaps, double work, const Context* context) {
    const auto gap = [&] { return model_.point_count() - gaps.bound(); };
    if (!search_.open().empty() || is_cancelled(context)) return false;
    if (model_.point_count() >= small_gap * gap()) gaps.run(static_cast<std::uint64_t>(work), context);
    proved_bound_ = gaps.bound();
    return gap() == 0;
}

/// Replaces all points, and all edges that are known not to be Delaunay.
void SplitChooser::put(std::span<const PlacedPoint> points, const std::vector<std::uint32_t>& open) {
    for (const std::uint32_t e : search_.open()) model_.give_up(e, false);
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
        if (model_.point_count(e) > 0) model_.cut(e, 0, model_.point_count(e), {});
    add_points(model_, points);
    while (model_.suspect_count() > 0) model_.drop_suspect(model_.suspect_count() - 1);
    search_.set_open(open);
}

void SplitChooser::construct_quickly() {
    const double work = least_construct_work + construct_work_per_edge * static_cast<double>(bad_.size());
    search_.construct_quickly(bad_, static_cast<std::uint64_t>(work));
}

/// For large angles. Does not need the work it may do.
void SplitChooser::spread(double work, bool in_blocks, const Context* context) {
    if (in_blocks) {
        for (int i = 0; i < polish_rounds; ++i) improve_blocks_once(true, context);
        return;
    }
    search_.spread(static_cast<std::uint64_t>(spread_share * work));
    search_.polish(static_cast<std::uint64_t>(spread_share * work), context);
    search_.spread(static_cast<std::uint64_t>(spread_share * work));
}

/// More work than without blocks, as all threads share it.
void SplitChooser::improve_blocks_once(bool polish, const Context* context) {
    if (model_.point_count() == 0 || is_cancelled(context)) return;
    const double wanted = std::min(work_per_edge * static_cast<double>(bad_.size()), most_block_work);
    const double all = std::ldexp(wanted, options_.effort - default_effort);
    report_progress(context, "place", std::min(shares_done_ / most_shares, 1.0));
    BlockSearchOptions options;
    options.seed = options_.seed;
    options.polishes = polish;
    options.patience = patience_of(options_.effort);
    options.work = (polish ? spread_share : round_share) * all / static_cast<double>(model_.point_count());
    shares_done_ += static_cast<double>(improve_in_blocks(model_, round_++, options, context)) / all;
    search_.drop_closed();
}

void SplitChooser::improve_blocks(const Context* context) {
    while (round_ < most_rounds && !is_cancelled(context)) {
        const std::size_t before = model_.point_count();
        improve_blocks_once(false, context);
        if (round_ < least_rounds) continue;
        if (shares_done_ >= most_shares || model_.point_count() + before / worthwhile >= before) return;
    }
}

/// Searches for as long as edges get closed.
void SplitChooser::wait_for_open_edges(double work, const Context* context) {
    for (double spent = 0; spent < most_patience && !is_cancelled(context); spent += patience) {
        const std::size_t before = search_.open().size();
        if (before == 0) return;
        search_.improve(static_cast<std::uint64_t>(patience * work), context);
        if (search_.open().size() == before) return;
    }
}

SplitPoint split_at(const Mesh& mesh, HalfedgeId h, double t) {
    return {std::min(mesh.origin(h), mesh.target(h)), std::max(mesh.origin(h), mesh.target(h)), t};
}

std::vector<SplitPoint> SplitChooser::splits() const {
    const Mesh& mesh = model_.layout().marked().mesh();
    std::vector<SplitPoint> splits;
    splits.reserve(model_.point_count());
    for (const PlacedPoint& point : placed_points(model_))
        splits.push_back(split_at(mesh, model_.layout().edge(point.edge).halfedge, point.at));
    return splits;
}

std::vector<PlacedPoint> SplitChooser::take_baseline() {
    for (PlacedPoint& point : baseline_) point.edge = model_.layout().edge(point.edge).halfedge.value();
    search_.set_other({});
    return std::move(baseline_);
}

SplitPlan SplitChooser::plan() const {
    const Mesh& mesh = model_.layout().marked().mesh();
    const auto name = [&](std::uint32_t e) { return mesh.edge(model_.layout().edge(e).halfedge); };
    SplitPlan plan;
    plan.splits = splits();
    for (const std::uint32_t e : search_.open()) plan.open.push_back(name(e));
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
        if (model_.is_distrusted(e)) plan.distrusted.push_back(name(e));
    plan.is_compared = is_compared_;
    plan.leaves_open = leaves_open_;
    return plan;
}

void SplitChooser::resume(const SplitPlan& plan) {
    const std::vector<PlacedPoint> points = place(plan.splits);
    for (const PlacedPoint& point : points) model_.prepare(point.edge);
    std::vector<std::uint32_t> open;
    for (const EdgeId e : plan.open) open.push_back(model_.edge_of(Mesh::halfedge(e)));
    for (const std::uint32_t e : open) model_.prepare(e);
    for (const EdgeId e : plan.distrusted) {
        const std::uint32_t known = model_.edge_of(Mesh::halfedge(e));
        model_.prepare(known);
        model_.distrust(known);
    }
    put(points, open);
    is_compared_ = plan.is_compared;
    leaves_open_ = plan.leaves_open;
}

bool SplitChooser::mend(std::span<const std::array<VertexId, 2>> edges) {
    std::vector<std::uint32_t> ids;
    for (const auto& [a, b] : edges) {
        const std::uint32_t e = edge_between(a, b);
        if (e != SplitModel::none) ids.push_back(e);
    }
    const bool changed = search_.mend(ids, static_cast<std::uint64_t>(0.1 * full_work()));
    is_compared_ = is_compared_ && !changed;
    return changed;
}

bool SplitChooser::take_better_regions(std::span<const SplitPoint> truth) {
    if (baseline_.empty() || (is_compared_ && truth.size() == model_.point_count())) return false;
    return delmesh::take_better_regions(model_, {}, place(truth), baseline_) > 0;
}

}  // namespace delmesh
