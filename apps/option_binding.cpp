#include "option_binding.hpp"

#include <fmt/format.h>

#include <cmath>

namespace delmesh::app::detail {
namespace {

std::string flag(const OptionInfo& info) {
    return fmt::format("--{}", info.name);
}

std::string help(const OptionInfo& info) {
    return std::string(info.help);
}

std::string type_name(const OptionInfo& info, std::string_view otherwise) {
    if (info.unit == "deg") return "DEG";
    if (info.unit == "rel") return "REL";
    return std::string(otherwise);
}

std::function<std::string(const std::string&)> number_check(const OptionInfo& info) {
    return [low = info.lowest, high = info.highest](const std::string& text) {
        double x = 0;
        if (!CLI::detail::lexical_cast(text, x) || std::isnan(x)) return fmt::format("'{}' is not a number", text);
        if (x < low || x > high) return fmt::format("{} is not in the range from {} to {}", text, low, high);
        return std::string();
    };
}

}  // namespace

void bind(CLI::App& command, const OptionInfo& info, bool& value) {
    if (value) {
        command.add_flag(fmt::format("--{0},!--no-{0}", info.name), value, help(info));
    } else {
        command.add_flag(flag(info), value, help(info));
    }
}

void bind(CLI::App& command, const OptionInfo& info, double& value) {
    CLI::Option* option = command.add_option(flag(info), value, help(info))->type_name(type_name(info, "X"));
    option->default_str(fmt::format("{}", value));
    option->check(number_check(info));
}

void bind(CLI::App& command, const OptionInfo& info, std::size_t& value) {
    CLI::Option* option = command.add_option(flag(info), value, help(info))->type_name("N");
    option->default_str(fmt::format("{}", value));
    option->check([low = info.lowest, high = info.highest](const std::string& text) {
        std::size_t n = 0;
        if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos ||
            !CLI::detail::lexical_cast(text, n))
            return fmt::format("'{}' is not a whole number", text);
        const double x = static_cast<double>(n);
        if (x < low || x > high) return fmt::format("{} is not in the range from {} to {}", text, low, high);
        return std::string();
    });
}

void bind_choice(CLI::App& command, const OptionInfo& info, std::span<const std::string_view> names, int value,
                 const std::function<void(int)>& set) {
    std::map<std::string, int> by_name;
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        by_name[std::string(names[i])] = static_cast<int>(i);
        list += (i == 0 ? "" : "|") + std::string(names[i]);
    }
    command
        .add_option_function<std::string>(
            flag(info), [by_name, set](const std::string& text) { set(by_name.at(text)); }, help(info))
        ->type_name(list)
        ->default_str(std::string(names[static_cast<std::size_t>(value)]))
        ->check([by_name, list](const std::string& text) {
            return by_name.contains(text) ? std::string() : fmt::format("'{}' is not one of {}", text, list);
        });
}

void bind_number_by_rule(CLI::App& command, const OptionInfo& info, std::span<const std::string_view> names, int rule,
                         const std::function<void(int, double)>& set) {
    std::map<std::string, int> by_name;
    std::string list;
    for (std::size_t i = 0; i + 1 < names.size(); ++i) {
        by_name[std::string(names[i])] = static_cast<int>(i);
        list += std::string(names[i]) + "|";
    }
    const int given = static_cast<int>(by_name.size());
    command
        .add_option_function<std::string>(
            flag(info),
            [by_name, given, set](const std::string& text) {
                const auto found = by_name.find(text);
                double number = 0;
                if (found == by_name.end()) CLI::detail::lexical_cast(text, number);
                set(found == by_name.end() ? given : found->second, number);
            },
            help(info))
        ->type_name(list + type_name(info, "X"))
        ->default_str(std::string(names[static_cast<std::size_t>(rule)]))
        ->check([by_name, is_number = number_check(info)](const std::string& text) {
            return by_name.contains(text) ? std::string() : is_number(text);
        });
}

}  // namespace delmesh::app::detail
