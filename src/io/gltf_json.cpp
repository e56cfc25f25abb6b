#include "io/gltf_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace delmesh::io {

// --- values ---

Json::Json() = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json::Json(Value value) : value_(std::move(value)) {}

Json Json::of_bool(bool value) {
    return Json(Value(value));
}
Json Json::of_whole(std::uint64_t value) {
    return Json(Value(value));
}
Json Json::of_real(double value) {
    return Json(Value(value));
}
Json Json::of_text(std::string value) {
    return Json(Value(std::make_unique<std::string>(std::move(value))));
}
Json Json::of_list() {
    return Json(Value(std::make_unique<List>()));
}
Json Json::of_members() {
    return Json(Value(std::make_unique<Members>()));
}

bool Json::is_true() const {
    const bool* const value = std::get_if<bool>(&value_);
    return value != nullptr && *value;
}

std::optional<std::uint64_t> Json::whole() const {
    const auto* const value = std::get_if<std::uint64_t>(&value_);
    return value == nullptr ? std::nullopt : std::optional(*value);
}

std::optional<double> Json::real() const {
    if (const auto* const value = std::get_if<double>(&value_)) return *value;
    if (const auto value = whole()) return static_cast<double>(*value);
    return std::nullopt;
}

const std::string* Json::text() const {
    const auto* const value = std::get_if<std::unique_ptr<std::string>>(&value_);
    return value == nullptr ? nullptr : value->get();
}

const Json::List* Json::list() const {
    const auto* const value = std::get_if<std::unique_ptr<List>>(&value_);
    return value == nullptr ? nullptr : value->get();
}

Json::List* Json::list() {
    auto* const value = std::get_if<std::unique_ptr<List>>(&value_);
    return value == nullptr ? nullptr : value->get();
}

Json::Members* Json::members() {
    auto* const value = std::get_if<std::unique_ptr<Members>>(&value_);
    return value == nullptr ? nullptr : value->get();
}

const Json* Json::find(std::string_view name) const {
    const auto* const value = std::get_if<std::unique_ptr<Members>>(&value_);
    if (value == nullptr) return nullptr;
    const auto found =
        std::find_if((*value)->rbegin(), (*value)->rend(), [&](const auto& m) { return m.first == name; });
    return found == (*value)->rend() ? nullptr : &found->second;
}

// --- text ---

namespace {

using Library = nlohmann::json;

bool is_wanted(std::size_t depth, bool names_extensions, const std::string& key) {
    constexpr std::array wanted{"asset",  "scene",     "scenes",      "nodes",  "extensionsRequired",
                                "meshes", "accessors", "bufferViews", "buffers"};
    if (depth == 1) return std::ranges::find(wanted, key) != wanted.end();
    if (names_extensions) return key == draco_extension || key == meshopt_extension || key == newer_meshopt_extension;
    return key != "extras";
}

/// Builds values as the library's parser finds them.
class Builder final : public nlohmann::json_sax<Library> {
public:
    explicit Builder(Json& root) : root_(root) {}

    bool null() override { return put({}); }
    bool boolean(bool value) override { return put(Json::of_bool(value)); }
    bool number_integer(number_integer_t value) override { return put(Json::of_real(static_cast<double>(value))); }
    bool number_unsigned(number_unsigned_t value) override { return put(Json::of_whole(value)); }
    bool number_float(number_float_t value, const string_t&) override { return put(Json::of_real(value)); }
    bool string(string_t& value) override { return put(Json::of_text(std::move(value))); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::of_members()); }
    bool start_array(std::size_t) override { return open(Json::of_list()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        if (left_out_ > 0) return true;
        is_unwanted_ = !is_wanted(open_.size(), extensions_ == open_.size(), name);
        if (is_unwanted_) return true;
        is_extensions_ = extensions_ == 0 && name == "extensions";
        open_.back()->members()->emplace_back(std::move(name), Json());
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        fault_ = {position > 0 ? position - 1 : 0, false};
        return false;
    }

    [[nodiscard]] const std::optional<JsonFault>& fault() const { return fault_; }

private:
    /// Where the next value goes; null if it is left out.
    Json* take_slot() {
        if (left_out_ > 0 || std::exchange(is_unwanted_, false)) return nullptr;
        if (open_.empty()) return &root_;
        if (Json::Members* const members = open_.back()->members()) return &members->back().second;
        return &open_.back()->list()->emplace_back();
    }
    bool put(Json value) {
        is_extensions_ = false;
        if (Json* const slot = take_slot()) *slot = std::move(value);
        return true;
    }
    bool open(Json value) {
        Json* const slot = take_slot();
        if (slot == nullptr) {
            ++left_out_;
            return true;
        }
        *slot = std::move(value);
        open_.push_back(slot);
        if (std::exchange(is_extensions_, false)) extensions_ = open_.size();
        if (open_.size() > deepest_json) fault_ = {0, true};
        return !fault_;
    }
    bool close() {
        if (left_out_ > 0) {
            --left_out_;
        } else {
            open_.pop_back();
            if (open_.size() < extensions_) extensions_ = 0;
        }
        return true;
    }

    Json& root_;
    std::vector<Json*> open_;  ///< what is being filled: only its last element can grow, so these addresses hold
    bool is_unwanted_ = false;
    bool is_extensions_ = false;
    std::size_t extensions_ = 0;  ///< at which depth the members of an object are extensions; 0: at none
    std::size_t left_out_ = 0;    ///< open objects and lists of what is left out
    std::optional<JsonFault> fault_;
};

}  // namespace

std::optional<JsonFault> parse_gltf_json(std::string_view text, Json& root) {
    Builder builder(root);
    Library::sax_parse(text.begin(), text.end(), &builder);
    return builder.fault();
}

}  // namespace delmesh::io
