// Faces of exactly zero area. A face with two corners at one place (a needle) covers nothing that its neighbours do not
// cover and is dropped. A face whose corners lie on a line (a cap) has one corner on its longest edge: flipping that
// edge together with the neighbour there gives two faces with area that cover the neighbour, and nothing moves.

#include "delmesh/exact/predicates.hpp"
#include "repair/complex.hpp"

#include <algorithm>
#include <unordered_map>

namespace delmesh::repairing {
namespace {

bool is_needle(const Complex& complex, std::size_t f) {
    const Index a = complex.place(complex.corners[3 * f]);
    const Index b = complex.place(complex.corners[3 * f + 1]);
    const Index c = complex.place(complex.corners[3 * f + 2]);
    return a == b || b == c || c == a;
}

bool is_cap(const Complex& complex, std::size_t f) {
    const Index* c = &complex.corners[3 * f];
    return are_collinear(complex.point(c[0]), complex.point(c[1]), complex.point(c[2]));
}

/// The order of points along any line that they lie on, exact.
bool before(const Vec3& a, const Vec3& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

void drop_needles(Complex& complex, Log& log) {
    std::vector<char> gone(complex.face_count(), 0);
    bool any = false;
    for (std::size_t f = 0; f < gone.size(); ++f) {
        if (!is_needle(complex, f)) continue;
        gone[f] = 1;
        any = true;
        log.add(Defect::zero_length_edge, complex.origin[f].index());
    }
    if (any) complex.drop_faces([&](std::size_t f) { return gone[f] != 0; });
}

/// Flips caps away. All edges that can ever matter join two corners of caps, so only those are looked up.
class CapRemover {
public:
    CapRemover(Complex& complex, std::vector<Index> caps, Log& log)
        : complex_(complex),
          log_(log),
          caps_(std::move(caps)),
          gone_(complex.face_count(), 0),
          cap_(complex.face_count(), 0),
          next_(complex.halfedge_count(), none),
          prev_(complex.halfedge_count(), none),
          flips_left_(64 * caps_.size()) {
        for (const Index f : caps_) cap_[f] = 1;
        link_edges_of_caps();
    }

    void run(const Context* context) {
        drop_clusters_without_area();
        std::vector<Index> stack;
        for (std::size_t i = caps_.size(); i-- > 0;)
            if (gone_[caps_[i]] == 0) stack.push_back(caps_[i]);
        for (std::size_t i = stack.size(); i-- > 0;) log_.add(Defect::zero_area, complex_.origin[stack[i]].index());
        for (std::size_t steps = 0; !stack.empty(); ++steps) {
            if (steps % 1024 == 0) check_cancelled(context);
            const Index f = stack.back();
            stack.pop_back();
            if (gone_[f] == 0 && cap_[f] != 0) resolve(f, stack);
        }
        complex_.drop_faces([&](std::size_t f) { return gone_[f] != 0; });
    }

private:
    [[nodiscard]] std::uint64_t key(Index h) const {
        const Index a = complex_.place_from(h);
        const Index b = complex_.place_to(h);
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    void link_edges_of_caps() {
        corner_of_cap_.assign(complex_.points.size(), 0);
        for (const Index f : caps_)
            for (Index i = 0; i < 3; ++i) corner_of_cap_[complex_.place_from(3 * f + i)] = 1;
        // Backwards, so that lists are in ascending order.
        for (auto h = static_cast<Index>(complex_.halfedge_count()); h-- > 0;) link(h);
    }

    void link(Index h) {
        if (corner_of_cap_[complex_.place_from(h)] == 0 || corner_of_cap_[complex_.place_to(h)] == 0) return;
        const auto [it, is_new] = first_.try_emplace(key(h), h);
        prev_[h] = none;
        next_[h] = is_new ? none : it->second;
        if (!is_new) prev_[it->second] = h;
        it->second = h;
    }

    void unlink(Index h) {
        const auto it = first_.find(key(h));
        if (it == first_.end()) return;
        if (next_[h] != none) prev_[next_[h]] = prev_[h];
        if (prev_[h] != none)
            next_[prev_[h]] = next_[h];
        else if (next_[h] != none)
            it->second = next_[h];
        else
            first_.erase(it);
    }

    void unlink_face(Index f) {
        for (Index i = 0; i < 3; ++i) unlink(3 * f + i);
    }
    void link_face(Index f) {
        for (Index i = 0; i < 3; ++i) link(3 * f + i);
    }

    void drop(Index f) {
        unlink_face(f);
        gone_[f] = 1;
    }
    void drop_and_say_so(Index f) {
        drop(f);
        log_.add(Defect::zero_area_dropped, complex_.origin[f].index());
    }

    /// Caps that are connected with no face that has area cover nothing: dropped together, whatever they look like.
    void drop_clusters_without_area() {
        std::vector<char> seen(complex_.face_count(), 0);
        std::vector<char> walked(complex_.halfedge_count(), 0);
        std::vector<Index> cluster;
        for (const Index seed : caps_) {
            if (seen[seed] != 0) continue;
            cluster.assign(1, seed);
            seen[seed] = 1;
            bool has_area = false;
            for (std::size_t i = 0; i < cluster.size(); ++i)
                for (Index h = 3 * cluster[i]; h < 3 * cluster[i] + 3; ++h) {
                    const Index first = first_.at(key(h));
                    if (walked[first] == 0) has_area |= gather(first, seen, cluster);
                    walked[first] = 1;
                }
            if (!has_area)
                for (const Index f : cluster) drop_and_say_so(f);
        }
    }

    /// Adds the caps of a list to the cluster; true if a face there has area.
    bool gather(Index first, std::vector<char>& seen, std::vector<Index>& cluster) const {
        bool has_area = false;
        for (Index g = first; g != none; g = next_[g]) {
            if (cap_[g / 3] == 0) has_area = true;
            if (cap_[g / 3] == 0 || seen[g / 3] != 0) continue;
            seen[g / 3] = 1;
            cluster.push_back(g / 3);
        }
        return has_area;
    }

    /// The edge between the two outer corners.
    [[nodiscard]] Index long_edge(Index f) const {
        const Index* c = &complex_.corners[3 * f];
        for (Index i = 0; i < 3; ++i) {
            const Vec3& middle = complex_.point(c[i]);
            const Vec3& a = complex_.point(c[(i + 1) % 3]);
            const Vec3& b = complex_.point(c[(i + 2) % 3]);
            if (before(a, middle) == before(middle, b)) return 3 * f + (i + 1) % 3;
        }
        return none;  // not reached: one of three different points on a line is between the others
    }

    /// The neighbour at h to flip with: best a face joined by number, then one that runs the other way, then one with
    /// area, then the first. Looks at a few only, as a crowded edge has no right answer.
    [[nodiscard]] Index find_neighbour(Index h) const {
        Index best = none;
        int best_score = -1;
        int left = 16;
        for (Index g = first_.at(key(h)); g != none && left > 0; g = next_[g], --left) {
            if (g / 3 == h / 3) continue;
            const int score =
                (complex_.share_numbers(h, g) ? 4 : 0) + (complex_.opposite(h, g) ? 2 : 0) + (cap_[g / 3] == 0 ? 1 : 0);
            if (score > best_score || (score == best_score && g < best)) {
                best = g;
                best_score = score;
            }
        }
        return best;
    }

    void resolve(Index f, std::vector<Index>& stack) {
        const Index h = long_edge(f);
        const Index g = find_neighbour(h);
        if (g == none) return drop(f);
        if (flips_left_ == 0) return drop_and_say_so(f);
        const Index neighbour = g / 3;
        if (cap_[neighbour] != 0 && key(long_edge(neighbour)) != key(g)) {
            // The neighbour is longer: it comes first.
            stack.insert(stack.end(), {f, neighbour});
        } else if (complex_.place_apex(h) == complex_.place_apex(g)) {
            drop(f);
            drop(neighbour);
        } else {
            --flips_left_;
            flip(h, g);
            if (cap_[neighbour] != 0) stack.insert(stack.end(), {neighbour, f});
        }
    }

    /// The neighbour (from, to, d) becomes (from, c, d), the cap becomes (c, to, d); c is the middle of the cap.
    void flip(Index h, Index g) {
        const Index cap = h / 3;
        const Index neighbour = g / 3;
        unlink_face(cap);
        unlink_face(neighbour);
        const Index middle = complex_.corners[Complex::prev(h)];
        for (Index i = 0; i < 3; ++i) complex_.corners[3 * cap + i] = complex_.corners[3 * neighbour + i];
        complex_.corners[3 * cap + g % 3] = middle;
        complex_.corners[Complex::next(g)] = middle;
        complex_.origin[cap] = complex_.origin[neighbour];
        cap_[cap] = cap_[neighbour];
        link_face(cap);
        link_face(neighbour);
    }

    Complex& complex_;
    Log& log_;
    std::vector<Index> caps_;
    std::vector<char> gone_;
    std::vector<char> cap_;
    std::vector<char> corner_of_cap_;
    std::unordered_map<std::uint64_t, Index> first_;  ///< of the list of half-edges at an edge; never iterated
    std::vector<Index> next_;
    std::vector<Index> prev_;
    /// Every flip gives area to a cap or shortens two of them; the limit keeps contrived input from taking n^2.
    std::size_t flips_left_;
};

}  // namespace

void remove_degenerate(Complex& complex, Log& log, const Context* context) {
    drop_needles(complex, log);
    check_cancelled(context);
    std::vector<Index> caps;
    for (std::size_t f = 0; f < complex.face_count(); ++f)
        if (is_cap(complex, f)) caps.push_back(static_cast<Index>(f));
    if (!caps.empty()) CapRemover(complex, std::move(caps), log).run(context);
}

}  // namespace delmesh::repairing
