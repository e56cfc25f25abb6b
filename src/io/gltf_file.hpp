#pragma once
// The parts of a glTF 2.0 file: its JSON, as far as meshes need it, and the bytes of its buffers.

#include "io/gltf_json.hpp"
#include "io/input.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace delmesh::io {

/// The bytes of a buffer view, unpacked, and how far apart its elements are; 0 where they follow one another.
struct GltfView {
    std::string_view bytes;
    std::uint64_t stride = 0;
};

/// Everything throws `Error` in one line that names the file: file_format where the data are not what they should be,
/// unsupported_format where an extension is needed that is not read.
class GltfFile {
public:
    /// Reads .glb and .gltf. Buffers in files of their own are looked for in `folder` and below; nowhere if it is
    /// empty.
    GltfFile(Input& input, std::filesystem::path folder);
    GltfFile(const GltfFile&) = delete;
    GltfFile& operator=(const GltfFile&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Of the file and of those beside it that were read so far.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] const Json& root() const { return root_; }
    /// The bytes stay where they are as long as this does.
    [[nodiscard]] GltfView buffer_view(std::uint64_t number);
    /// The member of that name among the extensions of `object`; null if there is none.
    [[nodiscard]] const Json* extension(const Json& object, const char* name) const;
    /// Whether the file can not be read without the extension.
    [[nodiscard]] bool is_required(std::string_view extension) const;

    /// Advises to save damaged files anew.
    [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::file_format) const;
    /// For sentences with advice of their own.
    [[noreturn]] void refuse(const std::string& what, ErrorCode code) const;

    /// The list of that name; an empty one where there is none.
    [[nodiscard]] const Json::List& list(const Json& object, const char* key) const;
    /// Element `number` of the list `key` of the whole file.
    [[nodiscard]] const Json& element(const char* key, std::uint64_t number) const;
    [[nodiscard]] std::uint64_t whole_number(const Json& value, const char* what) const;
    [[nodiscard]] std::optional<std::uint64_t> find_number(const Json& object, const char* key) const;
    /// The same where it must be there.
    [[nodiscard]] std::uint64_t number(const Json& object, const char* key) const;
    /// `count` numbers; empty where there is no such member.
    [[nodiscard]] std::vector<double> reals(const Json& object, const char* key, std::size_t count) const;
    /// A view into the JSON; empty where there is no such member.
    [[nodiscard]] std::string_view text(const Json& object, const char* key) const;

private:
    struct Buffer {
        bool known = false;
        std::string owned;
        std::string_view bytes;
    };

    /// The JSON and, in a .glb file, the binary chunk.
    [[nodiscard]] std::string_view open_container();
    void parse(std::string_view json);
    void check_version() const;
    /// Throws where one is needed that is not read.
    void note_extensions();
    /// The bytes of a buffer.
    [[nodiscard]] std::string_view buffer(std::uint64_t number);
    [[nodiscard]] bool has_data(std::uint64_t buffer) const;
    /// The bytes that `json` (a buffer view, or an extension of one) names.
    [[nodiscard]] std::string_view slice(const Json& json);
    [[nodiscard]] std::string unpack(const Json& view, const Json& packed, std::uint64_t number);
    [[nodiscard]] std::string decode_base64(std::string_view text) const;
    [[nodiscard]] std::string_view read_beside(std::string_view uri);

    std::string name_;
    std::filesystem::path folder_;
    std::string bytes_;
    std::uint64_t size_ = 0;
    std::uint64_t json_begin_ = 0;
    std::optional<std::string_view> chunk_;
    Json root_;
    std::set<std::string, std::less<>> required_;  ///< extensions
    std::vector<Buffer> buffers_;
    std::map<std::filesystem::path, std::string> files_;  ///< beside this one: many buffers may name the same
    std::map<std::uint64_t, std::string> unpacked_;       ///< views
    std::uint64_t unpacked_bytes_ = 0;
};

}  // namespace delmesh::io
