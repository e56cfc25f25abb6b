#include "delmesh/measure/distance.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/polygon_soup.hpp"
#include "measure/enclosure.hpp"
#include "measure/sampling.hpp"
#include "measure/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

using measure::Frame;
using measure::OneWay;
using measure::Surface;
using measure::TriangleView;

void check_options(const DistanceOptions& options) {
    DistanceOptions::describe(options, [](const auto& value, const OptionInfo& info) {
        const auto number = static_cast<double>(value);
        if (number >= info.lowest && number <= info.highest) return;
        throw Error(ErrorCode::bad_argument, fmt::format("option {} is {}, but must be from {} to {}", info.name,
                                                         number, info.lowest, info.highest));
    });
}

void check_view(const TriangleView& view, char which) {
    if (view.corners.empty())
        throw Error(ErrorCode::no_surface, fmt::format("mesh {} has no faces, so it has no surface to measure", which));
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
        const std::uint32_t v = view.corners[i];
        if (v >= view.points.size())
            throw Error(ErrorCode::index_out_of_range,
                        fmt::format("face {} of mesh {} names a vertex that does not exist", i / 3, which), {i / 3}, 1);
        if (!is_finite(view.points[v]))
            throw Error(ErrorCode::not_finite,
                        fmt::format("vertex {} of mesh {} has a coordinate that is not finite", v, which), {v}, 1);
    }
}

std::size_t face_samples(const DistanceOptions& options, std::size_t faces) {
    const double by_faces = std::ceil(options.samples_per_face * static_cast<double>(faces));
    return std::max(options.min_samples, static_cast<std::size_t>(by_faces));
}

/// Averages in the units of the frame.
struct Average {
    double mean = 0;
    double rms = 0;
};

Average average(const OneWay& way, bool by_area) {
    const measure::Sum& sum = by_area ? way.inside : way.outline;
    if (sum.count == 0) return {};
    const auto count = static_cast<double>(sum.count);
    return {sum.distance / count, std::sqrt(sum.squared / count)};
}

/// Turns distances of the frame into figures.
class Figures {
public:
    explicit Figures(const Frame& frame) : frame_(frame) {}

    [[nodiscard]] DistanceFigure figure(double forward, double backward) const {
        const double value = std::max(forward, backward);
        return {frame_.distance_to_world(value), percent(value), frame_.distance_to_world(forward),
                frame_.distance_to_world(backward)};
    }
    /// `sampled` is the largest distance of a sample, all in the units of the frame.
    [[nodiscard]] DistanceEnclosure enclosure(const measure::Enclosure& e, double sampled, double bound_rel) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double upper = std::max(e.upper, sampled);
        DistanceEnclosure result;
        result.lower = std::nextafter(frame_.distance_to_world(e.lower), 0);  // scaling may round, far below 1e-300
        result.upper = std::nextafter(frame_.distance_to_world(upper), infinity);
        result.lower_percent = percent(e.lower);
        result.upper_percent = percent(upper);
        result.reached = upper - e.lower <= bound_rel * frame_.diagonal();
        result.pieces = e.pieces;
        return result;
    }
    [[nodiscard]] double percent(double distance) const {
        return distance == 0 ? 0 : 100 * (distance / frame_.diagonal());
    }

private:
    const Frame& frame_;
};

DistancePlace place(const Frame& frame, const Surface& a, const Surface& b, const OneWay& forward,
                    const OneWay& backward) {
    const bool from_a = forward.farthest.distance2 >= backward.farthest.distance2;
    const measure::Farthest& far = (from_a ? forward : backward).farthest;
    const measure::Triangle& nearest = (from_a ? b : a).tree.triangles()[far.nearest];
    const Vec3 here = frame.to_world(far.point);
    const Vec3 there = frame.to_world(measure::nearest_point(far.point, nearest));
    return from_a ? DistancePlace{here, there} : DistancePlace{there, here};
}

/// A lower bound of the Hausdorff distance, proved from the farthest samples.
double proved_lower(const Surface& a, const Surface& b, const OneWay& forward, const OneWay& backward) {
    const auto lower = [](const measure::Farthest& far, const Surface& to) {
        return far.distance2 > 0 ? to.tree.lower_distance(far.point, far.nearest) : 0;
    };
    return std::max(lower(forward.farthest, b), lower(backward.farthest, a));
}

DistanceReport measure_views(const TriangleView& view_a, const TriangleView& view_b, const DistanceOptions& options,
                             const Context* context) {
    check_options(options);
    check_view(view_a, 'A');
    check_view(view_b, 'B');
    report_progress(context, "distance", 0);
    const Frame frame(view_a, view_b);
    const Surface a(view_a, frame, context);
    const Surface b(view_b, frame, context);
    report_progress(context, "distance", 0.2);
    const std::size_t count = face_samples(options, std::max(view_a.corners.size(), view_b.corners.size()) / 3);
    const OneWay forward = measure::sample_distances(a, b, count, options.seed, context);
    report_progress(context, "distance", 0.6);
    const OneWay backward = measure::sample_distances(b, a, count, options.seed, context);
    report_progress(context, "distance", 1);

    const bool by_area = forward.inside.count > 0 && backward.inside.count > 0;
    const Average mean_forward = average(forward, by_area), mean_backward = average(backward, by_area);
    const auto farthest = [](const OneWay& way) { return std::sqrt(std::max(0.0, way.farthest.distance2)); };
    const Figures figures(frame);
    DistanceReport report;
    report.hausdorff = figures.figure(farthest(forward), farthest(backward));
    report.mean = figures.figure(mean_forward.mean, mean_backward.mean);
    report.rms = figures.figure(mean_forward.rms, mean_backward.rms);
    report.at = place(frame, a, b, forward, backward);
    report.samples = forward.inside.count + forward.outline.count + backward.inside.count + backward.outline.count;
    report.diagonal = frame.distance_to_world(frame.diagonal());
    if (options.bound_rel > 0) {
        report_progress(context, "enclosure", 0);
        const measure::Enclosure e =
            measure::enclose_hausdorff(a, b, proved_lower(a, b, forward, backward),
                                       options.bound_rel * frame.diagonal(), options.max_pieces, context);
        const double sampled = std::max(farthest(forward), farthest(backward));
        report.enclosure = figures.enclosure(e, sampled, options.bound_rel);
        report_progress(context, "enclosure", 1);
    }
    report.complete = forward.complete && backward.complete;
    return report;
}

std::vector<std::uint32_t> corner_indices(const Mesh& mesh) {
    std::vector<std::uint32_t> indices;
    indices.reserve(mesh.corners().size());
    for (const VertexId v : mesh.corners()) indices.push_back(v.value());
    return indices;
}

}  // namespace

DistanceReport measure_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options, const Context* context) {
    const auto corners_a = corner_indices(a), corners_b = corner_indices(b);
    return measure_views({a.points(), corners_a}, {b.points(), corners_b}, options, context);
}

DistanceReport measure_distance(const PolygonSoup& a, const PolygonSoup& b, const DistanceOptions& options,
                                const Context* context) {
    const auto triangles = [](const PolygonSoup& soup, PolygonSoup& copy) -> const PolygonSoup& {
        if (soup.is_triangles()) return soup;
        copy = soup;
        triangulate(copy);
        return copy;
    };
    PolygonSoup copy_a, copy_b;
    const PolygonSoup& soup_a = triangles(a, copy_a);
    const PolygonSoup& soup_b = triangles(b, copy_b);
    return measure_views({soup_a.points, soup_a.corners}, {soup_b.points, soup_b.corners}, options, context);
}

}  // namespace delmesh
