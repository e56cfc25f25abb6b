#pragma once
// The JSON of a glTF file, as far as meshes need it.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace delmesh::io {

/// A value of 16 bytes. (That of the JSON library asks for memory to destroy itself, which ends the process where there
/// is none.)
class Json {
public:
    using List = std::vector<Json>;
    using Members = std::vector<std::pair<std::string, Json>>;

    Json();
    Json(Json&&) noexcept;
    Json& operator=(Json&&) noexcept;
    ~Json();
    static Json of_bool(bool value);
    static Json of_whole(std::uint64_t value);
    static Json of_real(double value);
    static Json of_text(std::string value);
    static Json of_list();
    static Json of_members();

    [[nodiscard]] bool is_true() const;
    /// A number that is not negative and has no fraction, as it is written.
    [[nodiscard]] std::optional<std::uint64_t> whole() const;
    /// Any number.
    [[nodiscard]] std::optional<double> real() const;
    /// Null where the value is of another kind.
    [[nodiscard]] const std::string* text() const;
    [[nodiscard]] const List* list() const;
    [[nodiscard]] List* list();
    [[nodiscard]] Members* members();
    /// A member of an object, the last one of that name; null if there is none.
    [[nodiscard]] const Json* find(std::string_view name) const;

private:
    using Value = std::variant<std::monostate, bool, std::uint64_t, double, std::unique_ptr<std::string>,
                               std::unique_ptr<List>, std::unique_ptr<Members>>;
    explicit Json(Value value);

    Value value_;
};

struct JsonFault {
    std::size_t position = 0;
    bool too_deep = false;
};

inline constexpr std::size_t deepest_json = 100;

/// The extensions that are kept.
inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";
inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";
/// The same, and more that is refused where it is met.
inline constexpr const char* newer_meshopt_extension = "KHR_meshopt_compression";

/// Parses JSON without what does not say where triangles are: materials, pictures, animations and the like may be
/// large. Time is linear. Returns what is wrong with the text, if anything is.
[[nodiscard]] std::optional<JsonFault> parse_gltf_json(std::string_view text, Json& root);

}  // namespace delmesh::io
