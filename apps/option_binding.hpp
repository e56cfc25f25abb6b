#pragma once
// Makes command-line options and JSON out of an options struct that describes its fields (delmesh/base/option.hpp).

#include "console.hpp"
#include "delmesh/base/option.hpp"

#include <CLI/CLI.hpp>

#include <concepts>
#include <string>
#include <type_traits>

namespace delmesh::app {

namespace detail {
void bind(CLI::App& command, const OptionInfo& info, bool& value);
void bind(CLI::App& command, const OptionInfo& info, double& value);
void bind(CLI::App& command, const OptionInfo& info, std::size_t& value);
/// A choice among names; `value` is the index.
void bind_choice(CLI::App& command, const OptionInfo& info, std::span<const std::string_view> names, int value,
                 const std::function<void(int)>& set);
}  // namespace detail

/// Adds an option to the command for each field of `options`, with its range, default and help.
/// `options` must outlive the parsing.
template <class Options>
void bind_options(CLI::App& command, Options& options) {
    Options::describe(options, [&command](auto& value, const OptionInfo& info) {
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_enum_v<Value>) {
            detail::bind_choice(command, info, choices(Value{}), static_cast<int>(value),
                                [&value](int chosen) { value = static_cast<Value>(chosen); });
        } else if constexpr (std::same_as<Value, bool> || std::same_as<Value, double> ||
                             std::same_as<Value, std::size_t>) {
            detail::bind(command, info, value);
        } else {
            static_assert(std::same_as<Value, std::size_t>,
                          "describe options as bool, double, std::size_t or an enumeration");
        }
    });
}

/// The fields and their values, by name with '_' for '-'.
template <class Options>
[[nodiscard]] Json options_to_json(const Options& options) {
    Json json;
    Options::describe(options, [&json](const auto& value, const OptionInfo& info) {
        std::string key(info.name);
        for (char& c : key)
            if (c == '-') c = '_';
        if (!info.unit.empty()) key += "_" + std::string(info.unit);
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_enum_v<Value>) {
            json[key] = choices(Value{})[static_cast<std::size_t>(value)];
        } else {
            json[key] = value;
        }
    });
    return json;
}

}  // namespace delmesh::app
