#include "io/gltf_json.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace delmesh::io {

namespace {

bool is_wanted(std::size_t depth, const std::string& key) {
    constexpr std::array wanted{"asset",  "scene",     "scenes",      "nodes",  "extensionsRequired",
                                "meshes", "accessors", "bufferViews", "buffers"};
    if (depth == 1) return std::ranges::find(wanted, key) != wanted.end();
    return key != "extras" && key != "extensions";
}

/// Builds values as they come. (The library's own way of leaving some out takes time that grows with their square.)
class Builder final : public nlohmann::json_sax<Json> {
public:
    explicit Builder(Json& root) : root_(root) {}

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        if (left_out_ > 0) return true;
        if (is_wanted(open_.size(), name)) {
            slot_ = &(*open_.back())[name];
        } else {
            is_unwanted_ = true;
        }
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        error_ = position > 0 ? position - 1 : 0;
        return false;
    }

    [[nodiscard]] const std::optional<std::size_t>& error() const { return error_; }

private:
    /// Where the next value goes; null if it is left out.
    Json* take_slot() {
        if (left_out_ > 0 || std::exchange(is_unwanted_, false)) return nullptr;
        if (open_.empty()) return &root_;
        if (open_.back()->is_object()) return slot_;
        open_.back()->push_back(nullptr);
        return &open_.back()->back();
    }
    bool put(Json value) {
        if (Json* const slot = take_slot()) *slot = std::move(value);
        return true;
    }
    bool open(Json value) {
        Json* const slot = take_slot();
        if (slot == nullptr) {
            ++left_out_;
        } else {
            *slot = std::move(value);
            open_.push_back(slot);
        }
        return true;
    }
    bool close() {
        if (left_out_ > 0) {
            --left_out_;
        } else {
            open_.pop_back();
        }
        return true;
    }

    Json& root_;
    std::vector<Json*> open_;  ///< what is being filled: only its last element can grow, so these addresses hold
    Json* slot_ = nullptr;     ///< for the value of the last key
    bool is_unwanted_ = false;
    std::size_t left_out_ = 0;  ///< open objects and lists of what is left out
    std::optional<std::size_t> error_;
};

}  // namespace

std::optional<std::size_t> parse_gltf_json(std::string_view text, Json& root) {
    Builder builder(root);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.error();
}

}  // namespace delmesh::io
