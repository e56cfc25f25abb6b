#include "simplify/placement.hpp"

#include "simplify/faults.hpp"
#include "simplify/paper_region.hpp"

#include <array>
#include <cmath>
#include <span>

namespace delmesh {
namespace {

/// Steps of sequential quadratic programming when looking harder.
constexpr int patient_steps = 6;

}  // namespace

bool Placer::fits(Star& star, const Vec3& w) {
    ++evaluations_;
    last_ = find_blocker(mesh_, star, w, fail_first_);
    if (!tuning_.constrained && last_ >= Blocker::subtending)
        if (tuning_.mending == Mending::off || count_faults(mesh_, star, w) <= faults_) last_ = Blocker::none;
    return last_ == Blocker::none;
}

void Placer::bisect(Star& star, const EdgeCost& cost, const Vec3& goal, Place& place) {
    const Vec3 start = place.point;
    double low = 0;
    double step = 0.5;
    for (int i = 0; i < tuning_.bisections; ++i, step *= 0.5) {
        const double t = low + step;
        const Vec3 w = start + (goal - start) * t;
        if (!fits(star, w)) continue;
        low = t;
        place = {w, cost.steered(w)};
    }
}

namespace {

/// The gradient of the angle at `at` of the triangle (w, at, other) with respect to w: a turn of w around `at` away
/// from `other`.
Vec3 angle_gradient(const Vec3& w, const Vec3& at, const Vec3& unit_normal_towards_other) {
    const Vec3 arm = w - at;
    return cross(unit_normal_towards_other, arm) * (1 / squared_norm(arm));
}

/// An angle as a unit complex number: no libm function, whose bits differ between systems, gets into the result.
struct Angle {
    double cosine = 0;
    double sine = 1;

    /// From the dot and the length of the cross product of the two arms.
    static Angle of(double dot_product, double cross_length) {
        const double scale = 1 / std::sqrt(dot_product * dot_product + cross_length * cross_length);
        return {dot_product * scale, cross_length * scale};
    }
    static Angle from_cot(double cot) { return of(cot, 1); }
};

Angle operator+(Angle a, Angle b) {
    return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

/// Grows with pi - angle like that angle near zero; algebraic.
double slack(Angle angle) {
    const double sine = angle.sine;
    if (angle.cosine <= 0) return sine;
    return sine >= 0 ? 2 - sine : -2 - sine;
}

}  // namespace

void Placer::linearise(Star& star, const Vec3& w) {
    find_outers(mesh_, star);
    constexpr Angle right{};
    const std::size_t size = star.ring.size();
    const std::size_t faces = star.face_count();
    half_spaces_.clear();
    struct Part {
        Angle a, b;
        Vec3 grad_a, grad_b;
    };
    thread_local std::vector<Part> parts;
    parts.assign(size, {});
    const auto add = [&](double value, const Vec3& gradient) {
        half_spaces_.push_back({gradient, dot(gradient, w) - value});
    };
    for (std::size_t i = 0; i < faces; ++i) {
        const Vec3& p = star.ring[i].point;
        const Vec3& q = star.ring[star.after(i)].point;
        const Vec3 a = p - w, b = q - w, side = q - p;
        Vec3 n = cross(a, b);
        const double area = std::sqrt(squared_norm(n));
        n = n * (1 / area);
        parts[i].a = Angle::of(-dot(a, side), area);
        parts[i].b = Angle::of(dot(b, side), area);
        // n points along (w,p,q). At p the other arm is q, which lies clockwise of w; at q the other way round.
        parts[i].grad_a = angle_gradient(w, p, n);
        parts[i].grad_b = angle_gradient(w, q, -n);
        const Angle outer = star.ring[i].outer.valid() ? Angle::from_cot(star.ring[i].outer_cot) : right;
        add(slack(outer + Angle::of(dot(a, b), area)), parts[i].grad_a + parts[i].grad_b);
    }
    for (std::size_t i = 0; i < size; ++i) {
        const bool first = !star.closed && i == 0;
        const bool last = !star.closed && i + 1 == size;
        const std::size_t before = i == 0 ? size - 1 : i - 1;
        const Angle from_before = first ? right : parts[before].a;
        const Angle from_after = last ? right : parts[i].b;
        const Vec3 gradient = (first ? Vec3{} : parts[before].grad_a) + (last ? Vec3{} : parts[i].grad_b);
        add(slack(from_before + from_after), -gradient);
    }
}

void Placer::descend(Star& star, const EdgeCost& cost, Place& place, bool feasible, bool& found) {
    found = feasible;
    const auto factors = factorise(cost.steered);
    if (!factors) return;
    Vec3 at = place.point;
    const int steps = looks_harder_ ? patient_steps : tuning_.sqp_steps;
    for (int step = 0; step < steps; ++step) {
        linearise(star, at);
        ++programs_;
        const auto goal = minimise(*factors, half_spaces_);
        if (!goal) return;
        if (fits(star, *goal)) {
            const Place there{*goal, cost.steered(*goal)};
            if (found && !(there.cost < place.cost * (1 - 1e-3))) {
                if (there.cost < place.cost) place = there;
                return;
            }
            place = there;
            found = true;
            at = *goal;
            continue;
        }
        if (found) {
            const double before = place.cost;
            bisect(star, cost, *goal, place);
            if (!(place.cost < before * (1 - 1e-3))) return;
            at = place.point;
        } else {
            at = *goal;
        }
    }
}

/// From places where the cost says nothing, but where there may be more room.
std::optional<Place> Placer::best_from_afar(Star& star, const EdgeCost& cost, const Vec3& goal) {
    Vec3 centre;
    for (const Star::Corner& corner : star.ring) centre = centre + corner.point;
    centre = centre * (1.0 / static_cast<double>(star.ring.size()));
    const std::array<Vec3, 4> starts{centre, star.ring[0].point, (centre + star.u_point) * 0.5,
                                     (centre + star.v_point) * 0.5};
    for (const Vec3& start : starts) {
        Place place{start, cost.steered(start)};
        bool found = fits(star, start);
        if (found) bisect(star, cost, goal, place);
        descend(star, cost, place, found, found);
        if (found) return place;
    }
    return std::nullopt;
}

std::optional<Place> Placer::best(Star& star, const EdgeCost& cost) {
    if (tuning_.mending != Mending::off) {
        faults_ = count_faults(mesh_, star);
        blocker_ = Blocker::rounding;
        if (tuning_.mending == Mending::only_faults && faults_ == 0) return std::nullopt;
        if (tuning_.mending != Mending::no_more && faults_ > 0) --faults_;
    }
    fail_first_ = 0;
    const auto factors = factorise(cost.steered);
    Vec3 goal = cost.middle;
    if (factors) goal = factors->lowest;
    if (fits(star, goal)) return Place{goal, cost.steered(goal)};
    witness_ = fail_first_;
    blocker_ = last_;
    const double optimum = cost.steered(goal);
    std::array<Vec3, 3> starts{cost.middle, star.u_point, star.v_point};
    std::optional<Place> found;
    for (const Vec3& start : std::span(starts).first(tuning_.ends ? 3 : 1)) {
        const Place place{start, cost.steered(start)};
        if (found && !(place.cost < found->cost)) continue;
        if (fits(star, start)) found = place;
    }
    bool ok = found.has_value();
    Place place = found ? *found : Place{goal, optimum};
    if (ok) bisect(star, cost, goal, place);
    if (tuning_.sqp_steps > 0 && (!ok || place.cost > optimum)) descend(star, cost, place, ok, ok);
    if (!ok && looks_harder_) return best_from_afar(star, cost, goal);
    if (!ok) return std::nullopt;
    return place;
}

std::optional<Place> Placer::improve(Star& star, const EdgeCost& cost, const Vec3& start) {
    fail_first_ = 0;
    const auto factors = factorise(cost.steered);
    if (!factors) return std::nullopt;
    if (fits(star, factors->lowest)) return Place{factors->lowest, cost.steered(factors->lowest)};
    Place place{start, cost.steered(start)};
    bisect(star, cost, factors->lowest, place);
    bool found = true;
    descend(star, cost, place, true, found);
    if (place.point == start) return std::nullopt;
    return place;
}

std::optional<Place> Placer::paper(Star& star, const EdgeCost& cost) {
    fail_first_ = 0;
    witness_ = 0;
    blocker_ = Blocker::region;
    const auto factors = factorise(cost.steered);
    find_outers(mesh_, star);
    if (!factors || !find_paper_region(star, cost.middle, half_spaces_)) return std::nullopt;
    ++programs_;
    const auto point = minimise(*factors, half_spaces_);
    if (!point) return std::nullopt;
    if (fits(star, *point)) return Place{*point, cost.steered(*point)};
    witness_ = fail_first_;
    blocker_ = last_;
    return std::nullopt;
}

}  // namespace delmesh
