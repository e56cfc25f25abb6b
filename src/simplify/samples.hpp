#pragma once
// Samples of the original surface, each attached to the face of the present one that is nearest to it.

#include "delmesh/mesh/mesh.hpp"
#include "simplify/sample_source.hpp"
#include "simplify/star.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delmesh {

/// Squared distances, local unit.
struct SampleError {
    double sum = 0;       ///< over the samples, times their weights
    double forward = 0;   ///< the largest one from a sample to the star
    double backward = 0;  ///< the largest one from a point of the star to the surface around the nearest sample

    [[nodiscard]] double worst() const { return forward > backward ? forward : backward; }
};

/// Of a surface as it was, followed through collapses and moves. A sample
/// stays with the faces around the vertex that changed, so it keeps to its side of a thin part.
class SurfaceSamples {
public:
    /// See `SampleSource`.
    SurfaceSamples(const Mesh& mesh, std::size_t count, double scale, std::size_t most);

    /// Nothing is asked before `reattach`.
    explicit SurfaceSamples(SampleSource source);
    /// The mesh has been decimated by somebody else: `now` says which of its vertices the ones at the start have
    /// become.
    void reattach(const Mesh& mesh, double scale, const std::vector<VertexId>& now);

    /// The faces have got other ids.
    void renumber(const std::vector<FaceId>& ids, std::size_t faces);

    struct Member {
        Vec3 point;  ///< local to the star
        std::uint32_t sample = 0;
        std::uint32_t face = 0;  ///< of the star: where the sample is now, or goes to after `measure`
        double distance2 = 0;
    };

    /// The surface of the star is about to move by no more than `by`. False if samples might get farther from it than
    /// `most` so. Otherwise they stay with their faces, but how far off they are is not known until they are
    /// freshened: much cheaper than to find them anew with each move.
    [[nodiscard]] bool let_slide(const Star& star, double by, double most);
    /// Finds what slid with the faces of the star anew, which must be asked for before it is gathered.
    void freshen(const Mesh& mesh, double scale, const Star& star);
    /// The same for all, which must be asked for before anything but stars.
    void freshen(const Mesh& mesh, double scale);
    /// How often the nearest face of a sample has been looked for.
    [[nodiscard]] std::size_t found() const { return found_; }

    /// Takes the samples of the star in hand.
    void gather(const Star& star);
    /// The mesh has so many faces now. New ones have no samples yet.
    void set_faces(std::size_t faces) { first_.resize(faces, none); }
    [[nodiscard]] std::span<const Member> members() const { return members_; }
    [[nodiscard]] double weight(const Member& m) const { return samples_[m.sample].weight; }
    /// Of the star as it is now; `backward` is left out.
    [[nodiscard]] const SampleError& present() const { return present_; }
    /// Of the star with its centre at w, found afresh.
    SampleError measure(const Star& star, const Vec3& w);
    /// The same without `backward`.
    SampleError measure_forward(const Star& star, const Vec3& w);
    [[nodiscard]] double measure_backward(const Star& star, const Vec3& w) const;
    /// Attaches the samples in hand as the last call of `measure` found.
    void commit(const Star& star);

    /// A sample, where it was and how far from the surface.
    struct Place {
        std::uint32_t sample = 0;
        FaceId face;
        float distance2 = 0;
    };
    /// Takes in hand the samples of these faces, each named once, that have been replaced by others.
    void gather(std::span<const FaceId> faces, std::vector<Place>& places) const;
    /// Finds the nearest of the faces for each of the samples, whose places are changed. Stops where the sum would
    /// exceed `most`.
    SampleError find_places(const Mesh& mesh, double scale, std::span<const FaceId> faces, double most,
                            std::vector<Place>& places);
    /// The largest squared distance of the middle of a face from the nearest of the samples' surfaces. Faces at
    /// `except` are left out.
    [[nodiscard]] double measure_backward(const Mesh& mesh, double scale, std::span<const FaceId> faces,
                                          std::span<const Place> places, VertexId except) const;
    /// All samples of these faces now are there.
    void put(std::span<const FaceId> faces, std::span<const Place> places);
    [[nodiscard]] const Vec3& point(const Place& place) const { return samples_[place.sample].point; }
    [[nodiscard]] double weight(const Place& place) const { return samples_[place.sample].weight; }
    /// Of the samples of a face, times their weights.
    [[nodiscard]] double error(FaceId f) const;
    [[nodiscard]] double sum() const { return sum_; }

    /// The part of the surface where there is an error at all: more than a tenth of the root mean square.
    [[nodiscard]] double busy_part() const;
    /// The mean squared distance of all samples.
    [[nodiscard]] double mean2() const { return weight_ > 0 && sum_ > 0 ? sum_ / weight_ : 0; }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Sample {
        Vec3 point;
        std::array<float, 3> normal{};
        float weight = 0;
        float distance2 = 0;
        std::uint32_t next = none;
    };
    struct Spoke {
        Vec3 arm;  ///< from the centre to ring[i]
        double length2 = 0;
        double dot_next = 0;  ///< with the arm after
        Vec3 normal;
        double inverse2 = 0;  ///< 1 / |normal|^2
    };
    [[nodiscard]] static Sample sample_of(const SampleSource& source, std::size_t i);
    [[nodiscard]] static FaceId find_nearest(const Mesh& mesh, double scale, VertexId v, const Vec3& point,
                                             float& distance2);
    [[nodiscard]] double reach(FaceId f) const;
    void freshen(const Mesh& mesh, double scale, FaceId f);
    void prepare(const Star& star, const Vec3& w);
    void attach(Member& member, std::size_t faces, const Vec3& from_centre) const;
    [[nodiscard]] double distance2_to_surface(const Vec3& x) const;
    [[nodiscard]] double distance2_beyond(const Sample& sample, const Vec3& away) const;

    double sum_ = 0;
    double weight_ = 0;
    double stride_ = 1;                   ///< one of so many is followed
    std::optional<SampleSource> source_;  ///< what is to be attached
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> first_;  ///< per face
    std::vector<float> slid_;     ///< per face, while any slide: no sample of it is farther off; negative: none slides
    std::vector<double> slides_;  ///< what they are to become
    std::size_t found_ = 0;
    std::vector<Member> members_;
    std::vector<Spoke> spokes_;
    struct Triangle {
        std::array<Vec3, 3> corners;
        Vec3 middle;
        double radius = 0;
    };
    std::vector<Triangle> triangles_;
    SampleError present_, last_;
};

}  // namespace delmesh
