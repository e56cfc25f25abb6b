#pragma once
// How an options struct describes its fields: once, for the command line, the JSON report, bindings and documentation.
//
// Each struct has `template <class Self, class Visitor> static void describe(Self& self, Visitor&& visit)`, which calls
// `visit(self.field, OptionInfo{...})` for each field, in the order of the documentation. Fields are bool, integers,
// double, enumerations or `NumberByRule`; for an enumeration E, `choices(E{})` gives the names of its values 0, 1, ...
// The default is what a default-constructed struct holds.

#include <limits>
#include <string_view>

namespace delmesh {

struct OptionInfo {
    std::string_view name;       ///< in words joined by '-', as on the command line
    std::string_view unit = {};  ///< "deg", "rel" (of the bounding-box diagonal), "abs" (of the coordinates) or nothing
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::string_view help = {};  ///< one line
};

/// A number, or a rule to find it. `Rule` is an enumeration whose last value says that the number is given.
template <class Rule>
struct NumberByRule {
    Rule rule{};
    double number = 0;
};

}  // namespace delmesh
