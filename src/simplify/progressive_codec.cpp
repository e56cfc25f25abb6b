#include "delmesh/base/error.hpp"
#include "delmesh/simplify/progressive_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr std::array<char, 8> magic = {'d', 'e', 'l', 'm', 'L', 'O', 'D', '1'};

class Writer {
public:
    void byte(unsigned value) { bytes_.push_back(static_cast<std::byte>(value)); }
    /// 7 bits a byte, lowest first, the top bit says that more follow.
    void number(std::uint64_t value) {
        for (; value >= 128; value >>= 7) byte(static_cast<unsigned>(value % 128) | 128u);
        byte(static_cast<unsigned>(value));
    }
    /// The bits that differ from `near`: how many bytes are zero at the top and at the bottom, then the ones between.
    void real(double value, double near) {
        const std::uint64_t bits = std::bit_cast<std::uint64_t>(value) ^ std::bit_cast<std::uint64_t>(near);
        const unsigned top = bits == 0 ? 8 : static_cast<unsigned>(std::countl_zero(bits)) / 8;
        const unsigned bottom = bits == 0 ? 0 : static_cast<unsigned>(std::countr_zero(bits)) / 8;
        byte(top * 16 + bottom);
        for (unsigned i = bottom; i + top < 8; ++i) byte(static_cast<unsigned>(bits >> (8 * i)) & 255u);
    }
    void point(const Vec3& p, const Vec3& near) {
        real(p.x, near.x);
        real(p.y, near.y);
        real(p.z, near.z);
    }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

class Reader {
public:
    Reader(std::span<const std::byte> bytes, std::string_view name) : bytes_(bytes), name_(name) {}

    [[noreturn]] void refuse(std::string_view expected) const {
        throw Error(ErrorCode::file_format, fmt::format("{}: byte {}: expected {}", name_, at_, expected), {at_}, 1);
    }
    unsigned byte(std::string_view expected) {
        if (at_ == bytes_.size()) refuse(fmt::format("{}, found the end of the file", expected));
        return static_cast<unsigned>(bytes_[at_++]);
    }
    std::uint64_t number(std::string_view expected) {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            const unsigned next = byte(expected);
            value |= static_cast<std::uint64_t>(next & 127u) << shift;
            if (next < 128) return value;
        }
        refuse(expected);
    }
    std::uint32_t number_below(std::uint64_t limit, std::string_view expected) {
        const std::uint64_t value = number(expected);
        if (value >= limit) refuse(fmt::format("{} below {}, found {}", expected, limit, value));
        return static_cast<std::uint32_t>(value);
    }
    double real(double near) {
        const unsigned counts = byte("a coordinate");
        const unsigned top = counts / 16, bottom = counts % 16;
        if (top + bottom > 8) refuse("a coordinate of at most 8 bytes");
        std::uint64_t bits = 0;
        for (unsigned i = bottom; i + top < 8; ++i) bits |= static_cast<std::uint64_t>(byte("a coordinate")) << (8 * i);
        const double value = std::bit_cast<double>(bits ^ std::bit_cast<std::uint64_t>(near));
        if (!std::isfinite(value)) refuse("a finite coordinate");
        return value;
    }
    Vec3 point(const Vec3& near) {
        const double x = real(near.x), y = real(near.y), z = real(near.z);
        return {x, y, z};
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

private:
    std::span<const std::byte> bytes_;
    std::string_view name_;
    std::size_t at_ = 0;
};

void write_base(Writer& out, const Mesh& base) {
    out.number(base.vertex_count());
    out.number(base.face_count());
    Vec3 near;
    for (const Vec3& p : base.points()) out.point(p, near), near = p;
    for (const VertexId v : base.corners()) out.number(v.value());
}

Mesh read_base(Reader& in) {
    constexpr std::uint64_t limit = std::numeric_limits<std::uint32_t>::max() / 3;
    const std::uint32_t vertices = in.number_below(limit, "a number of vertices");
    const std::uint32_t faces = in.number_below(limit, "a number of faces");
    PolygonSoup soup;
    if (vertices > in.left() / 3 || faces > in.left() / 3) in.refuse("as many vertices and faces as announced");
    Vec3 near;
    for (std::uint32_t i = 0; i < vertices; ++i) soup.points.push_back(near = in.point(near));
    for (std::uint32_t i = 0; i < 3 * faces; ++i) soup.corners.push_back(in.number_below(vertices, "a vertex"));
    return Mesh(std::move(soup));
}

}  // namespace

std::vector<std::byte> encode(const ProgressiveMesh& progressive) {
    Writer out;
    for (const char c : magic) out.byte(static_cast<unsigned char>(c));
    write_base(out, progressive.base);
    out.number(progressive.steps.size());
    std::vector<Vec3> points(progressive.base.points().begin(), progressive.base.points().end());
    for (const RefineStep& step : progressive.steps) {
        const bool is_split = step.kind == RefineStep::Kind::split;
        out.number(2 * static_cast<std::uint64_t>(step.vertex.value()) + (is_split ? 0 : 1));
        Vec3& point = points[step.vertex.index()];
        out.point(step.kept, point);
        point = step.kept;
        if (!is_split) continue;
        out.number(step.left.value());
        out.number(step.right.valid() ? std::uint64_t{step.right.value()} + 1 : 0);
        out.point(step.added, step.kept);
        points.push_back(step.added);
    }
    return out.take();
}

ProgressiveMesh decode(std::span<const std::byte> bytes, std::string_view name) {
    Reader in(bytes, name);
    for (const char c : magic)
        if (in.byte("a .dlod file") != static_cast<unsigned char>(c)) in.refuse("the first bytes of a .dlod file");
    ProgressiveMesh out;
    out.base = read_base(in);
    std::vector<Vec3> points(out.base.points().begin(), out.base.points().end());
    const std::uint64_t steps = in.number("a number of steps");
    if (steps > in.left() / 4) in.refuse("as many steps as announced");
    for (std::uint64_t i = 0; i < steps; ++i) {
        RefineStep step;
        const std::uint32_t head = in.number_below(2 * static_cast<std::uint64_t>(points.size()), "a step");
        step.vertex = VertexId(head / 2);
        step.kind = head % 2 == 0 ? RefineStep::Kind::split : RefineStep::Kind::move;
        step.kept = points[step.vertex.index()] = in.point(points[step.vertex.index()]);
        if (step.kind == RefineStep::Kind::split) {
            step.left = VertexId(in.number_below(points.size(), "a neighbour"));
            const std::uint32_t right = in.number_below(points.size() + 1, "a neighbour");
            if (right > 0) step.right = VertexId(right - 1);
            step.added = in.point(step.kept);
            points.push_back(step.added);
        }
        out.steps.push_back(step);
    }
    if (in.left() > 0) in.refuse("the end of the file");
    return out;
}

}  // namespace delmesh
