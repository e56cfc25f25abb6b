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
/// A number, or one of the names but the last; `rule` is the index of the default.
void bind_number_by_rule(CLI::App& command, const OptionInfo& info, std::span<const std::string_view> names, int rule,
                         const std::function<void(int, double)>& set);

template <class Value>
inline constexpr bool is_number_by_rule = false;
template <class Rule>
inline constexpr bool is_number_by_rule<NumberByRule<Rule>> = true;

/// The number, or the name of the rule.
template <class Rule>
[[nodiscard]] Json rule_to_json(const NumberByRule<Rule>& value) {
    const std::span<const std::string_view> names = choices(Rule{});
    const auto rule = static_cast<std::size_t>(value.rule);
    return rule + 1 == names.size() ? Json(value.number) : Json(names[rule]);
}
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
        } else if constexpr (detail::is_number_by_rule<Value>) {
            using Rule = decltype(value.rule);
            detail::bind_number_by_rule(command, info, choices(Rule{}), static_cast<int>(value.rule),
                                        [&value](int rule, double number) {
                                            value = {static_cast<Rule>(rule), number};
                                        });
        } else {
            static_assert(std::same_as<Value, std::size_t>,
                          "describe options as bool, double, std::size_t, an enumeration or a number by rule");
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
        } else if constexpr (detail::is_number_by_rule<Value>) {
            json[key] = detail::rule_to_json(value);
        } else {
            json[key] = value;
        }
    });
    return json;
}

}  // namespace delmesh::app
