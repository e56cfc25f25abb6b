#pragma once
// The XML files in a ZIP archive, an element at a time.

#include "io/zip_archive.hpp"

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

struct XML_ParserStruct;

namespace delmesh::io {

/// The attributes of an element. Names in a name space are "SPACE|NAME".
class XmlAttributes {
public:
    explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}
    /// Empty if it is not there.
    [[nodiscard]] std::string_view get(std::string_view name) const {
        for (const char** pair = pairs_; *pair != nullptr; pair += 2)
            if (name == *pair) return pair[1];
        return {};
    }

private:
    const char** pairs_;
};

/// Goes through one file. Document types, and with them entities, are refused.
class XmlPart {
public:
    static constexpr char between = '|';  ///< a name space and a name

    XmlPart(ZipArchive& archive, std::string part);
    XmlPart(const XmlPart&) = delete;
    XmlPart& operator=(const XmlPart&) = delete;

    /// What is called for each element; it may throw.
    std::function<void(std::string_view name, const XmlAttributes&)> start;
    std::function<void(std::string_view name)> end;

    /// Throws `Error` (file_format) where the file is not XML.
    void parse();

    [[nodiscard]] const std::string& part() const { return part_; }
    /// The name space that a prefix stands for; empty if it is unknown.
    [[nodiscard]] std::string name_space(const std::string& prefix) const;
    /// Throws `Error` with the names of the archive and the file, and the line.
    [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::file_format) const;

private:
    void feed(std::string_view bytes, bool last);
    template <class Call>
    void guarded(Call&& call);
    static void on_start(void* self, const char* name, const char** attributes);
    static void on_end(void* self, const char* name);
    static void on_doctype(void* self, const char* name, const char* system, const char* publ, int internal);
    static void on_name_space(void* self, const char* prefix, const char* uri);

    ZipArchive& archive_;
    std::string part_;
    std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
    std::map<std::string, std::string> name_spaces_;
    std::exception_ptr thrown_;  ///< an exception on its way past the C library
    std::uint64_t fed_ = 0;
};

}  // namespace delmesh::io
