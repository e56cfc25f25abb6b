#pragma once
// What is thrown for bad input, and only for that: an outcome of an algorithm stands in its report.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delmesh {

enum class ErrorCode {
    bad_argument,         ///< an option or argument is outside its documented range
    not_finite,           ///< a coordinate is NaN or infinite; elements: vertices
    index_out_of_range,   ///< a face names a vertex that is not there; elements: faces
    degenerate_face,      ///< a face repeats a vertex; elements: faces
    non_manifold_edge,    ///< more than two faces at an edge; elements: vertex pairs, flattened
    inconsistent_edge,    ///< two faces run through an edge in the same direction; elements: vertex pairs, flattened
    non_manifold_vertex,  ///< the faces at a vertex form more than one fan; elements: vertices
    zero_length_edge,     ///< two ends of an edge coincide; elements: vertex pairs, flattened
    degenerate_geometry,  ///< a zero-area face that can not be flipped away; elements: vertices
    no_surface,           ///< a mesh without faces where one with faces is needed
    too_large,            ///< more elements than 32-bit ids can name
    file_not_readable,
    file_not_writable,
    file_format,  ///< the bytes are not what the format asks for
    unsupported_format,
};

/// The enumerator's name.
[[nodiscard]] constexpr std::string_view name(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_argument:
            return "bad_argument";
        case ErrorCode::not_finite:
            return "not_finite";
        case ErrorCode::index_out_of_range:
            return "index_out_of_range";
        case ErrorCode::degenerate_face:
            return "degenerate_face";
        case ErrorCode::non_manifold_edge:
            return "non_manifold_edge";
        case ErrorCode::inconsistent_edge:
            return "inconsistent_edge";
        case ErrorCode::non_manifold_vertex:
            return "non_manifold_vertex";
        case ErrorCode::zero_length_edge:
            return "zero_length_edge";
        case ErrorCode::degenerate_geometry:
            return "degenerate_geometry";
        case ErrorCode::no_surface:
            return "no_surface";
        case ErrorCode::too_large:
            return "too_large";
        case ErrorCode::file_not_readable:
            return "file_not_readable";
        case ErrorCode::file_not_writable:
            return "file_not_writable";
        case ErrorCode::file_format:
            return "file_format";
        case ErrorCode::unsupported_format:
            return "unsupported_format";
    }
    return "unknown";
}

/// Thrown for bad input. `what()` is one sentence that names the place and says what to do.
/// `elements` holds the first offenders (at most 16 entries; their meaning is given by the code); `count` says how many
/// there are in all.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message, std::vector<std::size_t> elements = {}, std::size_t count = 0)
        : std::runtime_error(message),
          code_(code),
          elements_(std::move(elements)),
          count_(count) {}

    [[nodiscard]] ErrorCode code() const { return code_; }
    [[nodiscard]] const std::vector<std::size_t>& elements() const { return elements_; }
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    ErrorCode code_;
    std::vector<std::size_t> elements_;
    std::size_t count_;
};

}  // namespace delmesh
