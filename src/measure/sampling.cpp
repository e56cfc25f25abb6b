// Samples are made where they are used, in fixed blocks in the order of the tree. So the nearest triangle of one sample
// is a good hint for the next.

#include "measure/sampling.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh::measure {
namespace {

/// Splits `count` things over the triangles in proportion to weights, without randomness: by rounding partial sums.
class Shares {
public:
    Shares(std::vector<double> weights, std::size_t count) : sums_(std::move(weights)), count_(count) {
        double sum = 0;
        for (double& s : sums_) s = sum += s;
        factor_ = sum > 0 ? static_cast<double>(count) / sum : 0;
        if (sum <= 0) count_ = 0;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    /// The first thing of triangle t; those of t end where those of t+1 begin.
    [[nodiscard]] std::size_t begin(std::size_t t) const {
        if (t == 0) return 0;
        if (t == sums_.size()) return count_;
        return std::min(count_, static_cast<std::size_t>(std::llround(sums_[t - 1] * factor_)));
    }
    /// The triangle that thing i belongs to. O(log n).
    [[nodiscard]] std::size_t owner(std::size_t i) const {
        std::size_t low = 0, high = sums_.size();  // begin(low) <= i < begin(high)
        while (high - low > 1) {
            const std::size_t middle = low + (high - low) / 2;
            (begin(middle) <= i ? low : high) = middle;
        }
        return low;
    }

private:
    std::vector<double> sums_;
    std::size_t count_;
    double factor_ = 0;
};

double to_unit(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

std::uint64_t mixed(std::uint64_t z) {  // SplitMix64: Steele, Lea, Flood 2014
    z += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

/// The additive sequence of the plastic number (Roberts 2018): any run of it fills the unit square evenly.
class PlaneSequence {
public:
    explicit PlaneSequence(std::uint64_t seed) : u_(mixed(2 * seed)), v_(mixed(2 * seed + 1)) {}
    /// The i-th point of a triangle.
    [[nodiscard]] Vec3 point(const Triangle& t, std::uint64_t i) const {
        double u = to_unit(u_ + i * 0xc13fa9a902a6328f);
        double v = to_unit(v_ + i * 0x91e10da5c79e7b1c);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        return t.a + u * (t.b - t.a) + v * (t.c - t.a);
    }

private:
    std::uint64_t u_, v_;
};

/// Distances of a run of samples, each the hint for the next.
class Run {
public:
    explicit Run(const FaceTree& to) : to_(to) {}

    void add(const Vec3& p, Sum& sum) {
        auto [distance2, triangle] = to_.nearest(p, hint_);
        hint_ = triangle;
        if (distance2 < noise_distance2) distance2 = 0;
        ++sum.count;
        sum.distance += std::sqrt(distance2);
        sum.squared += distance2;
        if (distance2 > result.farthest.distance2) result.farthest = {distance2, p, triangle};
    }

    OneWay result;

private:
    const FaceTree& to_;
    std::uint32_t hint_ = 0;
};

void append(Sum& whole, const Sum& part) {
    whole.count += part.count;
    whole.distance += part.distance;
    whole.squared += part.squared;
}

void append(OneWay& whole, const OneWay& part) {
    if (part.farthest.distance2 > whole.farthest.distance2) whole.farthest = part.farthest;
    append(whole.inside, part.inside);
    append(whole.outline, part.outline);
    whole.complete = whole.complete && part.complete;
}

/// Calls sample(run, begin, end) for blocks of [0, count) and adds the results in order.
template <class Sample>
OneWay in_blocks(const FaceTree& to, std::size_t count, std::size_t block, const Context* context,
                 const Sample& sample) {
    std::vector<OneWay> parts(count / block + 1);
    const auto run_block = [&](std::size_t begin, std::size_t end) {
        Run run(to);
        run.result.complete = !is_cancelled(context);
        if (run.result.complete) sample(run, begin, end);
        parts[begin / block] = run.result;
    };
    parallel_blocks(count, context, run_block, block);
    OneWay whole;
    for (const OneWay& part : parts) append(whole, part);
    return whole;
}

constexpr std::size_t samples_per_block = 4096;
constexpr std::size_t faces_per_block = 512;

OneWay sample_vertices(const Surface& from, const FaceTree& to, const Context* context) {
    return in_blocks(to, from.vertices.size(), samples_per_block, context,
                     [&](Run& run, std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) run.add(from.vertices[i], run.result.outline);
                     });
}

/// On each side s of each face (1 + s's share of `extra`) points, at (i + 1/4)/k of its length: the two faces at an
/// edge, which run through it in opposite directions, have different points.
OneWay sample_edges(const Surface& from, const FaceTree& to, std::size_t extra, const Context* context) {
    const auto triangles = from.tree.triangles();
    double total = 0;
    for (const Triangle& t : triangles) total += norm(t.b - t.a) + norm(t.c - t.b) + norm(t.a - t.c);
    const double density = total > 0 ? static_cast<double>(extra) / total : 0;
    const auto sample_side = [density](Run& run, const Vec3& s, const Vec3& e) {
        const Vec3 side = e - s;
        const auto count = 1 + static_cast<std::size_t>(norm(side) * density);
        for (std::size_t i = 0; i < count; ++i) {
            const double t = (static_cast<double>(i) + 0.25) / static_cast<double>(count);
            run.add(s + t * side, run.result.outline);
        }
    };
    return in_blocks(to, triangles.size(), faces_per_block, context, [&](Run& run, std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const Triangle& t = triangles[f];
            sample_side(run, t.a, t.b);
            sample_side(run, t.b, t.c);
            sample_side(run, t.c, t.a);
        }
    });
}

OneWay sample_faces(const Surface& from, const FaceTree& to, std::size_t count, std::uint64_t seed,
                    const Context* context) {
    const auto triangles = from.tree.triangles();
    std::vector<double> areas(triangles.size());
    for (std::size_t t = 0; t < areas.size(); ++t)
        areas[t] = norm(cross(triangles[t].b - triangles[t].a, triangles[t].c - triangles[t].a));
    const Shares shares(std::move(areas), count);
    const PlaneSequence sequence(seed);
    return in_blocks(to, shares.count(), samples_per_block, context, [&](Run& run, std::size_t begin, std::size_t end) {
        std::size_t t = shares.owner(begin);
        std::size_t next = shares.begin(t + 1);
        for (std::size_t i = begin; i < end; ++i) {
            while (i >= next) next = shares.begin(++t + 1);
            run.add(sequence.point(triangles[t], i), run.result.inside);
        }
    });
}

}  // namespace

OneWay sample_distances(const Surface& from, const Surface& to, std::size_t face_samples, std::uint64_t seed,
                        const Context* context) {
    OneWay whole = sample_vertices(from, to.tree, context);
    append(whole, sample_edges(from, to.tree, face_samples / 4, context));
    append(whole, sample_faces(from, to.tree, face_samples, seed, context));
    return whole;
}

}  // namespace delmesh::measure
