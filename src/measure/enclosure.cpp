// Best first: the piece with the largest upper bound is split next. Pieces are taken in batches of a fixed size, so
// that the course of the search does not depend on the number of threads.

#include "measure/enclosure.hpp"

#include "base/parallel.hpp"
#include "measure/piece.hpp"

#include <algorithm>
#include <limits>

namespace delmesh::measure {
namespace {

constexpr std::size_t batch_size = 2048;
constexpr std::size_t triangles_per_block = 1024;
/// The margin covers so many splits; by then a piece is a point.
constexpr std::uint16_t max_depth = 200;

class Search {
public:
    Search(const Surface& a, const Surface& b, double lower, double width, const Context* context)
        : surfaces_{&a, &b},
          context_(context),
          width_(width),
          lower_(lower) {}

    void start() {
        add_triangles(0);
        add_triangles(1);
    }

    /// True while there is a piece whose bound is too high.
    [[nodiscard]] bool is_open() const { return !open_.empty() && open_.front().upper > enough(); }

    void split_batch() {
        std::vector<Piece> batch;
        while (batch.size() < batch_size && is_open()) batch.push_back(pop());
        std::vector<Parts> parts(batch.size());
        std::vector<double> lowers(batch.size(), lower_);
        const auto run = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const FaceTree& to = target(batch[i]);
                parts[i] = split(batch[i], to);
                for (std::size_t k = 0; k < parts[i].count; ++k)
                    lowers[i] = evaluate(parts[i].part[k], to, lowers[i], enough());
            }
        };
        parallel_blocks(batch.size(), context_, run, 64);
        lower_ = std::max(lower_, *std::max_element(lowers.begin(), lowers.end()));
        for (const Parts& some : parts)
            for (std::size_t k = 0; k < some.count; ++k) add(some.part[k]);
    }

    [[nodiscard]] Enclosure result() const {
        const double open = open_.empty() ? 0 : open_.front().upper;
        return {lower_, std::max(lower_, std::max(open, closed_upper_)), added_};
    }
    [[nodiscard]] std::size_t pieces() const { return added_; }

private:
    [[nodiscard]] double enough() const { return lower_ + width_; }
    [[nodiscard]] const FaceTree& target(const Piece& piece) const { return surfaces_[1 - piece.backward]->tree; }

    void add_triangles(std::uint8_t backward) {
        const auto triangles = surfaces_[backward]->tree.triangles();
        const std::size_t blocks = triangles.size() / triangles_per_block + 1;
        std::vector<std::vector<Piece>> open(blocks);
        std::vector<double> lowers(blocks, lower_), uppers(blocks, 0);
        const auto run = [&](std::size_t begin, std::size_t end) {
            const std::size_t block = begin / triangles_per_block;
            Piece piece;
            piece.backward = backward;
            for (std::size_t t = begin; t < end; ++t) {
                piece.corner = {triangles[t].a, triangles[t].b, triangles[t].c};
                piece.upper = std::numeric_limits<double>::infinity();
                if (!is_cancelled(context_)) lowers[block] = evaluate(piece, target(piece), lowers[block], enough());
                if (piece.upper > enough()) {
                    open[block].push_back(piece);
                } else {
                    uppers[block] = std::max(uppers[block], piece.upper);
                }
            }
        };
        parallel_blocks(triangles.size(), context_, run, triangles_per_block);
        lower_ = std::max(lower_, *std::max_element(lowers.begin(), lowers.end()));
        closed_upper_ = std::max(closed_upper_, *std::max_element(uppers.begin(), uppers.end()));
        for (const auto& some : open)
            for (const Piece& piece : some) add(piece);
    }

    void add(const Piece& piece) {
        ++added_;
        if (piece.upper <= enough() || piece.depth >= max_depth) {
            closed_upper_ = std::max(closed_upper_, piece.upper);
            return;
        }
        open_.push_back(piece);
        open_.back().number = added_;
        std::push_heap(open_.begin(), open_.end(), comes_later);
    }

    Piece pop() {
        std::pop_heap(open_.begin(), open_.end(), comes_later);
        const Piece piece = open_.back();
        open_.pop_back();
        return piece;
    }

    /// Numbers make the order strict, and the same for every implementation of heaps.
    static bool comes_later(const Piece& s, const Piece& t) {
        return s.upper < t.upper || (s.upper == t.upper && s.number > t.number);
    }

    const Surface* surfaces_[2];
    const Context* context_;
    double width_;
    double lower_;
    double closed_upper_ = 0;
    std::size_t added_ = 0;
    /// A heap, the largest upper bound on top.
    std::vector<Piece> open_;
};

}  // namespace

Enclosure enclose_hausdorff(const Surface& a, const Surface& b, double lower, double width, std::size_t max_pieces,
                            const Context* context) {
    Search search(a, b, lower, std::max(width - 2 * enclosure_margin, enclosure_margin), context);
    search.start();
    while (search.is_open() && search.pieces() < max_pieces && !is_cancelled(context)) search.split_batch();
    Enclosure enclosure = search.result();
    enclosure.lower = std::max(0.0, enclosure.lower - enclosure_margin);
    enclosure.upper += enclosure_margin;
    return enclosure;
}

}  // namespace delmesh::measure
