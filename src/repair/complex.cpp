#include "repair/complex.hpp"

namespace delmesh::repairing {
void Log::note(Defect kind, std::array<std::size_t, 2> place, std::size_t numbers) {
    constexpr std::size_t most = 16;
    Finding& finding = found_[static_cast<std::size_t>(kind)];
    ++finding.count;
    if (finding.places.size() + numbers <= most)
        finding.places.insert(finding.places.end(), place.begin(), place.begin() + numbers);
}

std::vector<Finding> Log::findings() const {
    std::vector<Finding> result;
    for (std::size_t kind = 0; kind < defect_kinds; ++kind) {
        if (found_[kind].count == 0) continue;
        result.push_back(found_[kind]);
        result.back().kind = static_cast<Defect>(kind);
    }
    return result;
}

}  // namespace delmesh::repairing
