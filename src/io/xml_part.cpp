#include "io/xml_part.hpp"

#include <expat.h>
#include <fmt/format.h>
#include <new>
#include <utility>

namespace delmesh::io {

XmlPart::XmlPart(ZipArchive& archive, std::string part)
    : archive_(archive),
      part_(std::move(part)),
      parser_(XML_ParserCreateNS(nullptr, between), &XML_ParserFree) {
    if (parser_ == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &XmlPart::on_start, &XmlPart::on_end);
    XML_SetStartDoctypeDeclHandler(parser_.get(), &XmlPart::on_doctype);
    XML_SetStartNamespaceDeclHandler(parser_.get(), &XmlPart::on_name_space);
}

void XmlPart::parse() {
    archive_.read(part_, [this](std::string_view bytes, bool last) { feed(bytes, last); });
}

void XmlPart::feed(std::string_view bytes, bool last) {
    // The library looks at an unfinished tag anew with each piece.
    constexpr std::uint64_t longest_tag = std::uint64_t{1} << 20;
    const XML_Status status = XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()), last ? 1 : 0);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (status != XML_STATUS_OK) {
        const XML_Error error = XML_GetErrorCode(parser_.get());
        if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
        fail(fmt::format("expected XML, found damaged data ({})", XML_ErrorString(error)));
    }
    fed_ += bytes.size();
    const XML_Index done = XML_GetCurrentByteIndex(parser_.get());
    if (done >= 0 && fed_ > static_cast<std::uint64_t>(done) + longest_tag)
        fail(fmt::format("expected XML, found a tag of more than {} bytes", longest_tag));
}

std::string XmlPart::name_space(const std::string& prefix) const {
    const auto found = name_spaces_.find(prefix);
    return found == name_spaces_.end() ? std::string() : found->second;
}

void XmlPart::fail(const std::string& what, ErrorCode code) const {
    throw Error(code, fmt::format("{}: {}: line {}: {}", archive_.name(), quote(part_),
                                  XML_GetCurrentLineNumber(parser_.get()), with_advice(what, code)));
}

template <class Call>
void XmlPart::guarded(Call&& call) {
    if (thrown_) return;
    try {
        call();
    } catch (...) {
        thrown_ = std::current_exception();
        XML_StopParser(parser_.get(), XML_FALSE);
    }
}

void XmlPart::on_start(void* self, const char* name, const char** attributes) {
    auto* const part = static_cast<XmlPart*>(self);
    part->guarded([&] {
        if (part->start) part->start(name, XmlAttributes(attributes));
    });
}

void XmlPart::on_end(void* self, const char* name) {
    auto* const part = static_cast<XmlPart*>(self);
    part->guarded([&] {
        if (part->end) part->end(name);
    });
}

void XmlPart::on_doctype(void* self, const char*, const char*, const char*, int) {
    auto* const part = static_cast<XmlPart*>(self);
    part->guarded([&] { part->fail("expected no document type, found one"); });
}

void XmlPart::on_name_space(void* self, const char* prefix, const char* uri) {
    auto* const part = static_cast<XmlPart*>(self);
    part->guarded([&] {
        if (prefix != nullptr && uri != nullptr) part->name_spaces_[prefix] = uri;
    });
}

}  // namespace delmesh::io
