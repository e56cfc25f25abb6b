#include "simplify/samples.hpp"

#include "simplify/triangle_point.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delmesh {

SurfaceSamples::Sample SurfaceSamples::sample_of(const SampleSource& source, std::size_t i) {
    const SampleSource::Facing facing = source.facing(i);
    return {.point = source.point(i), .normal = facing.normal, .weight = facing.weight};
}

SurfaceSamples::SurfaceSamples(const Mesh& mesh, std::size_t count, double scale, std::size_t most)
    : first_(mesh.face_count(), none) {
    const SampleSource source(mesh, count, scale, most);
    stride_ = static_cast<double>(source.stride());
    samples_.reserve(source.size());
    for (std::size_t i = 0; i < source.size(); ++i) {
        std::uint32_t& first = first_[source.face(mesh, i).index()];
        samples_.push_back(sample_of(source, i));
        samples_[i].next = first;
        first = static_cast<std::uint32_t>(i);
        weight_ += samples_[i].weight;
    }
}

SurfaceSamples::SurfaceSamples(SampleSource source)
    : stride_(static_cast<double>(source.stride())),
      source_(std::move(source)) {}

/// The nearest of the faces at v, or at a vertex that is nearer, and so on.
FaceId SurfaceSamples::find_nearest(const Mesh& mesh, double scale, VertexId v, const Vec3& point, float& distance2) {
    const Frame frame{scale, 1 / scale, point};
    double best = std::numeric_limits<double>::infinity();
    FaceId face;
    for (VertexId at = v; at.valid();) {
        VertexId next;
        const Vec3 centre = frame.to_local(mesh.point(at));
        each_outgoing(mesh, at, [&](HalfedgeId h) {
            const TrianglePoint p = nearest_on_triangle({}, centre, frame.to_local(mesh.point(mesh.target(h))),
                                                        frame.to_local(mesh.point(mesh.apex(h))));
            if (!(p.distance2 < best)) return;
            best = p.distance2;
            face = Mesh::face(h);
            const std::array<VertexId, 3> corner{at, mesh.target(h), mesh.apex(h)};
            const auto most = std::max_element(p.weights.begin(), p.weights.end());
            next = corner[static_cast<std::size_t>(most - p.weights.begin())];
        });
        at = next == at ? VertexId() : next;
    }
    distance2 = static_cast<float>(best);
    return face;
}

void SurfaceSamples::reattach(const Mesh& mesh, double scale, const std::vector<VertexId>& now) {
    const std::size_t count = source_->size();
    std::vector<FaceId> face(count);
    std::vector<float> distance2(count);
    std::vector<std::uint32_t> place(mesh.face_count() + 1);
    for (std::size_t i = 0; i < count; ++i) {
        face[i] = find_nearest(mesh, scale, now[source_->near(i).index()], source_->point(i), distance2[i]);
        ++place[face[i].index() + 1];
    }
    for (std::size_t f = 1; f < place.size(); ++f) place[f] += place[f - 1];
    // In the order of the faces: what is used together lies together.
    samples_.resize(count);
    first_.assign(mesh.face_count(), none);
    sum_ = weight_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = place[face[i].index()]++;
        Sample& sample = samples_[at] = sample_of(*source_, i);
        sample.distance2 = distance2[i];
        sample.next = first_[face[i].index()];
        first_[face[i].index()] = at;
        weight_ += sample.weight;
        sum_ += static_cast<double>(sample.weight) * static_cast<double>(sample.distance2);
    }
    source_.reset();
}

void SurfaceSamples::renumber(const std::vector<FaceId>& ids, std::size_t faces) {
    std::vector<std::uint32_t> first(faces, none);
    for (std::size_t f = 0; f < ids.size(); ++f)
        if (ids[f].valid()) first[ids[f].index()] = first_[f];
    first_.swap(first);
}

namespace {

template <class Visit>
void each_face(const Star& star, Visit&& visit) {
    for (std::size_t i = 0; i < star.face_count(); ++i) visit(star.ring[i].face);
    for (int i = 0; i < star.dying_count; ++i) visit(star.dying_face[i]);
}

/// Where a search for the nearest face begins: most often it ends there.
VertexId nearest_corner(const Mesh& mesh, double scale, FaceId f, const Vec3& point) {
    const auto corners = mesh.corners().subspan(3 * f.index(), 3);
    const auto distance2 = [&](VertexId v) { return squared_norm((mesh.point(v) - point) * scale); };
    return *std::min_element(corners.begin(), corners.end(),
                             [&](VertexId a, VertexId b) { return distance2(a) < distance2(b); });
}

}  // namespace

/// Of the samples of a face, how far off the farthest may be.
double SurfaceSamples::reach(FaceId f) const {
    if (slid_[f.index()] >= 0) return static_cast<double>(slid_[f.index()]);
    float farthest2 = 0;
    for (std::uint32_t i = first_[f.index()]; i != none; i = samples_[i].next)
        farthest2 = std::max(farthest2, samples_[i].distance2);
    return std::sqrt(static_cast<double>(farthest2));
}

bool SurfaceSamples::let_slide(const Star& star, double by, double most) {
    if (!(by < most)) return false;
    slid_.resize(first_.size(), -1);
    slides_.clear();
    bool fits = true;
    each_face(star, [&](FaceId f) {
        slides_.push_back(reach(f) + by);
        fits = fits && slides_.back() <= most;
    });
    if (!fits) return false;
    std::size_t i = 0;
    each_face(star, [&](FaceId f) { slid_[f.index()] = static_cast<float>(slides_[i++]); });
    return true;
}

void SurfaceSamples::freshen(const Mesh& mesh, double scale, FaceId f) {
    if (slid_[f.index()] < 0) return;
    std::uint32_t next = std::exchange(first_[f.index()], none);
    slid_[f.index()] = -1;
    while (next != none) {
        const std::uint32_t i = next;
        Sample& s = samples_[i];
        next = s.next;
        sum_ -= static_cast<double>(s.weight) * static_cast<double>(s.distance2);
        const FaceId nearest = find_nearest(mesh, scale, nearest_corner(mesh, scale, f, s.point), s.point, s.distance2);
        sum_ += static_cast<double>(s.weight) * static_cast<double>(s.distance2);
        s.next = std::exchange(first_[nearest.index()], i);
        float& slid = slid_[nearest.index()];
        if (slid >= 0) slid = std::max(slid, std::sqrt(s.distance2));
        ++found_;
    }
}

void SurfaceSamples::freshen(const Mesh& mesh, double scale, const Star& star) {
    if (slid_.empty()) return;
    each_face(star, [&](FaceId f) { freshen(mesh, scale, f); });
}

void SurfaceSamples::freshen(const Mesh& mesh, double scale) {
    for (std::size_t f = 0; f < slid_.size(); ++f) freshen(mesh, scale, FaceId(f));
    slid_.clear();
}

void SurfaceSamples::gather(const Star& star) {
    members_.clear();
    present_ = {};
    const auto take = [&](FaceId f, std::size_t face) {
        for (std::uint32_t i = first_[f.index()]; i != none; i = samples_[i].next) {
            const Sample& s = samples_[i];
            members_.push_back({star.frame.to_local(s.point), i, static_cast<std::uint32_t>(face), s.distance2});
            present_.sum += static_cast<double>(s.weight) * s.distance2;
            present_.forward = std::max<double>(present_.forward, s.distance2);
        }
    };
    // Asks memory for all of them at once.
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        const std::uint32_t sample = first_[star.ring[i].face.index()];
        if (sample != none) __builtin_prefetch(samples_.data() + sample);
    }
    for (std::size_t i = 0; i < star.face_count(); ++i) take(star.ring[i].face, i);
    for (int i = 0; i < star.dying_count; ++i) take(star.dying_face[i], 0);
}

void SurfaceSamples::gather(std::span<const FaceId> faces, std::vector<Place>& places) const {
    places.clear();
    for (const FaceId f : faces)
        for (std::uint32_t i = first_[f.index()]; i != none; i = samples_[i].next)
            places.push_back({i, f, samples_[i].distance2});
}

SampleError SurfaceSamples::find_places(const Mesh& mesh, double scale, std::span<const FaceId> faces, double most,
                                        std::vector<Place>& places) {
    const Frame frame{scale, 1 / scale, mesh.point(mesh.origin(Mesh::halfedge(faces[0])))};
    triangles_.clear();
    for (const FaceId f : faces) {
        const HalfedgeId h = Mesh::halfedge(f);
        const Vec3 a = frame.to_local(mesh.point(mesh.origin(h))), b = frame.to_local(mesh.point(mesh.target(h))),
                   c = frame.to_local(mesh.point(mesh.apex(h)));
        const Vec3 middle = (a + b + c) * (1.0 / 3);
        const double radius2 = std::max({squared_norm(a - middle), squared_norm(b - middle), squared_norm(c - middle)});
        triangles_.push_back({{a, b, c}, middle, std::sqrt(radius2) * (1 + 1e-9)});
    }
    SampleError error;
    std::size_t nearest = 0;
    for (Place& place : places) {
        const Sample& s = samples_[place.sample];
        const Vec3 x = frame.to_local(s.point);
        // Neighbours in the list lie close by, so the last one's face is a good guess.
        const auto distance2_to = [&](const Triangle& t) {
            return nearest_on_triangle(x, t.corners[0], t.corners[1], t.corners[2]).distance2;
        };
        double best = distance2_to(triangles_[nearest]);
        double reach = std::sqrt(best);
        for (std::size_t i = 0, guess = nearest; i < triangles_.size(); ++i) {
            const double far = reach + triangles_[i].radius;
            if (i == guess || squared_norm(x - triangles_[i].middle) > far * far) continue;
            const double distance2 = distance2_to(triangles_[i]);
            if (!(distance2 < best)) continue;
            best = distance2;
            reach = std::sqrt(best);
            nearest = i;
        }
        place.face = faces[nearest];
        place.distance2 = static_cast<float>(best);
        error.sum += static_cast<double>(s.weight) * static_cast<double>(place.distance2);
        error.forward = std::max<double>(error.forward, place.distance2);
        if (error.sum > most) break;
    }
    return error;
}

void SurfaceSamples::put(std::span<const FaceId> faces, std::span<const Place> places) {
    for (const FaceId f : faces) {
        for (std::uint32_t i = first_[f.index()]; i != none; i = samples_[i].next)
            sum_ -= static_cast<double>(samples_[i].weight) * samples_[i].distance2;
        first_[f.index()] = none;
    }
    for (const Place& place : places) {
        Sample& s = samples_[place.sample];
        s.distance2 = place.distance2;
        sum_ += static_cast<double>(s.weight) * s.distance2;
        s.next = first_[place.face.index()];
        first_[place.face.index()] = place.sample;
    }
}

double SurfaceSamples::error(FaceId f) const {
    double sum = 0;
    for (std::uint32_t i = first_[f.index()]; i != none; i = samples_[i].next)
        sum += static_cast<double>(samples_[i].weight) * samples_[i].distance2;
    return sum;
}

double SurfaceSamples::busy_part() const {
    const double least = 0.01 * mean2();
    double busy = 0;
    for (const Sample& s : samples_)
        if (static_cast<double>(s.distance2) > least) busy += static_cast<double>(s.weight);
    return weight_ > 0 && busy > 0 ? busy / weight_ : 1;
}

void SurfaceSamples::prepare(const Star& star, const Vec3& w) {
    const std::size_t size = star.ring.size();
    spokes_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
        spokes_[i].arm = star.ring[i].point - w;
        spokes_[i].length2 = squared_norm(spokes_[i].arm);
    }
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        Spoke& s = spokes_[i];
        const Spoke& next = spokes_[star.after(i)];
        s.dot_next = dot(s.arm, next.arm);
        s.normal = cross(s.arm, next.arm);
        s.inverse2 = 1 / squared_norm(s.normal);
    }
}

/// The nearest point of each triangle (centre, ring[i], ring[i+1]), after Ericson 2005, section 5.1.5, with all that
/// does not depend on the sample taken out.
void SurfaceSamples::attach(Member& member, std::size_t faces, const Vec3& from_centre) const {
    const double to_centre2 = squared_norm(from_centre);
    member.distance2 = to_centre2;
    const double first = dot(spokes_[0].arm, from_centre);
    double along = first;
    for (std::size_t i = 0; i < faces; ++i) {
        const Spoke& b = spokes_[i];
        const std::size_t j = i + 1 == spokes_.size() ? 0 : i + 1;
        const Spoke& c = spokes_[j];
        const double d1 = along;
        const double d2 = along = j == 0 ? first : dot(c.arm, from_centre);
        if (d1 <= 0 && d2 <= 0) continue;  // the centre
        const double d3 = d1 - b.length2, d4 = d2 - b.dot_next;
        const double d5 = d1 - b.dot_next, d6 = d2 - c.length2;
        double distance2;
        if (d3 >= 0 && d4 <= d3) {
            distance2 = to_centre2 - (d1 + d3);
        } else if (d6 >= 0 && d5 <= d6) {
            distance2 = to_centre2 - (d2 + d6);
        } else if (d1 * d4 <= d3 * d2 && d1 >= 0 && d3 <= 0) {
            distance2 = to_centre2 - d1 * d1 / b.length2;
        } else if (d5 * d2 <= d1 * d6 && d2 >= 0 && d6 <= 0) {
            distance2 = to_centre2 - d2 * d2 / c.length2;
        } else if (d3 * d6 <= d5 * d4 && d4 >= d3 && d5 >= d6) {
            const double side2 = (d4 - d3) + (d5 - d6);
            distance2 = to_centre2 - (d1 + d3) - (d4 - d3) * ((d4 - d3) / side2);
        } else {
            const double height = dot(b.normal, from_centre);
            distance2 = height * height * b.inverse2;
        }
        if (distance2 < member.distance2) {
            member.distance2 = std::max(0.0, distance2);
            member.face = static_cast<std::uint32_t>(i);
        }
    }
}

SampleError SurfaceSamples::measure_forward(const Star& star, const Vec3& w) {
    prepare(star, w);
    found_ += members_.size();
    last_ = {};
    for (Member& m : members_) {
        m.face = std::min<std::uint32_t>(m.face, static_cast<std::uint32_t>(star.face_count() - 1));
        attach(m, star.face_count(), m.point - w);
        last_.sum += samples_[m.sample].weight * static_cast<double>(static_cast<float>(m.distance2));
        last_.forward = std::max(last_.forward, m.distance2);
    }
    return last_;
}

SampleError SurfaceSamples::measure(const Star& star, const Vec3& w) {
    SampleError error = measure_forward(star, w);
    error.backward = measure_backward(star, w);
    return error;
}

double SurfaceSamples::measure_backward(const Star& star, const Vec3& w) const {
    double worst = distance2_to_surface(w);
    for (std::size_t i = 0; i < star.face_count(); ++i)
        worst = std::max(worst,
                         distance2_to_surface((w + star.ring[i].point + star.ring[star.after(i)].point) * (1.0 / 3)));
    return worst;
}

/// From the surface around the sample, a disk in its tangent plane about as large as what it stands for.
double SurfaceSamples::distance2_beyond(const Sample& sample, const Vec3& away) const {
    constexpr double disk = 1.2;
    const double height = dot(away, Vec3{sample.normal[0], sample.normal[1], sample.normal[2]});
    const double height2 = height * height;
    const double radius2 = disk * stride_ * static_cast<double>(sample.weight);
    const double aside2 = squared_norm(away) - height2;
    if (!(aside2 > radius2)) return height2;
    const double beyond = std::sqrt(aside2) - std::sqrt(radius2);
    return height2 + beyond * beyond;
}

double SurfaceSamples::distance2_to_surface(const Vec3& x) const {
    double best = -1;
    std::uint32_t nearest = none;
    for (const Member& m : members_) {
        const double distance2 = squared_norm(x - m.point);
        if (best >= 0 && !(distance2 < best)) continue;
        best = distance2;
        nearest = static_cast<std::uint32_t>(&m - members_.data());
    }
    if (nearest == none) return 0;
    return distance2_beyond(samples_[members_[nearest].sample], x - members_[nearest].point);
}

double SurfaceSamples::measure_backward(const Mesh& mesh, double scale, std::span<const FaceId> faces,
                                        std::span<const Place> places, VertexId except) const {
    double worst = 0;
    for (const FaceId f : faces) {
        const HalfedgeId h = Mesh::halfedge(f);
        const std::array<VertexId, 3> corner{mesh.origin(h), mesh.target(h), mesh.apex(h)};
        if (std::find(corner.begin(), corner.end(), except) != corner.end()) continue;
        const Frame frame{scale, 1 / scale, mesh.point(corner[0])};
        const Vec3 middle = (frame.to_local(mesh.point(corner[1])) + frame.to_local(mesh.point(corner[2]))) * (1.0 / 3);
        double best = std::numeric_limits<double>::infinity();
        const Sample* nearest = nullptr;
        for (const Place& place : places) {
            const Sample& sample = samples_[place.sample];
            const double distance2 = squared_norm(middle - frame.to_local(sample.point));
            if (!(distance2 < best)) continue;
            best = distance2;
            nearest = &sample;
        }
        if (nearest != nullptr)
            worst = std::max(worst, distance2_beyond(*nearest, middle - frame.to_local(nearest->point)));
    }
    return worst;
}

void SurfaceSamples::commit(const Star& star) {
    each_face(star, [&](FaceId f) { first_[f.index()] = none; });
    for (const Member& m : members_) {
        Sample& s = samples_[m.sample];
        s.distance2 = static_cast<float>(m.distance2);
        std::uint32_t& first = first_[star.ring[m.face].face.index()];
        s.next = first;
        first = m.sample;
    }
    sum_ += last_.sum - present_.sum;
}

}  // namespace delmesh
