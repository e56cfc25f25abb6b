#include "delmesh/simplify/progressive_mesh.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

[[noreturn]] void refuse(std::size_t step, const char* why) {
    throw Error(ErrorCode::file_format, fmt::format("step {} of the progressive mesh does not fit: {}", step, why),
                {step}, 1);
}

void apply(Mesh& mesh, const RefineStep& step, std::size_t index) {
    const auto is_there = [&](VertexId v) { return v.index() < mesh.vertex_count(); };
    if (!is_there(step.vertex)) refuse(index, "there is no such vertex yet");
    if (!is_finite(step.kept) || !is_finite(step.added)) refuse(index, "a coordinate is not finite");
    if (step.kind == RefineStep::Kind::move) return mesh.set_point(step.vertex, step.kept);
    if (!is_there(step.left) || (step.right.valid() && !is_there(step.right)))
        refuse(index, "there is no such neighbour yet");
    if (!can_split_vertex(mesh, step.vertex, step.left, step.right)) refuse(index, "the vertex can not be split there");
    split_vertex(mesh, step.vertex, step.left, step.right, step.added);
    mesh.set_point(step.vertex, step.kept);
}

}  // namespace

std::size_t ProgressiveMesh::most_vertices() const {
    const auto splits = std::count_if(steps.begin(), steps.end(),
                                      [](const RefineStep& s) { return s.kind == RefineStep::Kind::split; });
    return base.vertex_count() + static_cast<std::size_t>(splits);
}

Mesh ProgressiveMesh::at(std::size_t vertices) const {
    Mesh mesh = base;
    const std::size_t wanted = std::min(vertices, most_vertices());
    reserve(mesh, wanted, base.face_count() + 2 * (std::max(wanted, base.vertex_count()) - base.vertex_count()));
    const bool all = vertices >= most_vertices();
    for (std::size_t i = 0; i < steps.size() && (all || mesh.vertex_count() < vertices); ++i) apply(mesh, steps[i], i);
    return mesh;
}

}  // namespace delmesh
