#include "repair/shorten.hpp"

#include "repair/direction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace delmesh::repairing {

EdgeWeights::EdgeWeights(const Complex& complex) : complex_(complex) {
    double longest = 0;
    for (Index h = 0; h < complex.halfedge_count(); ++h)
        longest = std::fmax(
            longest, largest_component(difference(complex.point(complex.from(h)), complex.point(complex.to(h)))));
    if (longest > 0) exponent_ = 28 - std::ilogb(longest);
}

Vec3 EdgeWeights::scaled(const Vec3& d) const {
    return {std::scalbn(d.x, exponent_), std::scalbn(d.y, exponent_), std::scalbn(d.z, exponent_)};
}

std::uint64_t EdgeWeights::at(Index h) const {
    const Vec3 d = difference(complex_.point(complex_.from(h)), complex_.point(complex_.to(h)));
    return 1 + static_cast<std::uint64_t>(norm(scaled(d)));
}

void CutShortener::run(const std::vector<Index>& component, bool settled) {
    State best = save(component);
    std::uint64_t shortest = cut_length(component);
    const auto compete = [&] {
        turn_single_faces(component);
        const std::uint64_t length = cut_length(component);
        if (length >= shortest) return;
        shortest = length;
        best = save(component);
    };
    compete();
    if (!settled) {
        const Index root = *std::min_element(component.begin(), component.end());
        const Index far = follow_front(component, root);
        compete();
        follow_front(component, far);
        compete();
    }
    for (std::size_t i = 0; i < best.size(); ++i) turn_[component[i]] = best[i];
}

CutShortener::State CutShortener::save(const std::vector<Index>& component) const {
    State state;
    state.reserve(component.size());
    for (const Index f : component) state.push_back(turn_[f]);
    return state;
}

bool CutShortener::agree(Index h, Index g) const {
    return complex_.opposite(h, g) == (turn_[h / 3] == turn_[g / 3]);
}

std::uint64_t CutShortener::cut_length(const std::vector<Index>& component) const {
    std::uint64_t sum = 0;
    for (const Index f : component)
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            if (partners_[h] != none && h < partners_[h] && !agree(h, partners_[h])) sum += weights_.at(h);
    return sum;
}

/// By how much the cut gets shorter if f is turned.
std::int64_t CutShortener::gain(Index f) const {
    std::int64_t sum = 0;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (partners_[h] == none) continue;
        const auto weight = static_cast<std::int64_t>(weights_.at(h));
        sum += agree(h, partners_[h]) ? -weight : weight;
    }
    return sum;
}

/// Turns faces while that shortens the cut; each turn does so by a whole number.
void CutShortener::turn_single_faces(const std::vector<Index>& component) {
    std::queue<Index> queue;
    for (const Index f : component)
        if (gain(f) > 0) queue.push(f);
    std::size_t left = 32 * component.size();
    while (!queue.empty() && left > 0) {
        const Index f = queue.front();
        queue.pop();
        if (gain(f) <= 0) continue;
        if (--left % 65536 == 0) check_cancelled(context_);
        turn_[f] ^= 1;
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            if (partners_[h] != none && gain(partners_[h] / 3) > 0) queue.push(partners_[h] / 3);
    }
}

Vec3 CutShortener::centre(Index f) const {
    Vec3 sum;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) sum = sum + complex_.point(complex_.from(h)) * (1.0 / 3);
    return sum;
}

/// Orients each face like the neighbour through which the root is nearest. Returns the face farthest off.
Index CutShortener::follow_front(const std::vector<Index>& component, Index root) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Index f : component) distance_[f] = std::numeric_limits<double>::infinity();
    distance_[root] = 0;
    turn_[root] = 0;
    queue.emplace(0, root);
    Index last = root;
    while (!queue.empty()) {
        const auto [distance, f] = queue.top();
        queue.pop();
        if (distance > distance_[f]) continue;
        last = f;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index g = partners_[h];
            if (g == none) continue;
            const double there = distance + norm(weights_.scaled(difference(centre(f), centre(g / 3))));
            if (!(there < distance_[g / 3])) continue;
            distance_[g / 3] = there;
            turn_[g / 3] = turn_[f] ^ (complex_.opposite(h, g) ? 0 : 1);
            queue.emplace(there, g / 3);
        }
    }
    return last;
}

}  // namespace delmesh::repairing
