#pragma once
// A value for some of the half-edges: 4 bytes for each, and the value for those that have one.

#include "delmesh/base/ids.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

template <class Value>
class Slots {
public:
    explicit Slots(std::size_t halfedges) : slot_(halfedges, 0) {}

    [[nodiscard]] const Value* find(HalfedgeId h) const {
        const std::uint32_t slot = slot_[h.index()];
        return slot == 0 ? nullptr : &values_[slot - 1];
    }
    void set(HalfedgeId h, const Value& value) {
        std::uint32_t& slot = slot_[h.index()];
        if (slot == 0) {
            if (free_.empty()) {
                values_.emplace_back();
                slot = static_cast<std::uint32_t>(values_.size());
            } else {
                slot = free_.back();
                free_.pop_back();
            }
        }
        values_[slot - 1] = value;
    }
    void remove(HalfedgeId h) {
        std::uint32_t& slot = slot_[h.index()];
        if (slot == 0) return;
        free_.push_back(slot);
        slot = 0;
    }

private:
    std::vector<std::uint32_t> slot_;  ///< 1 + index of the value, or 0
    std::vector<Value> values_;
    std::vector<std::uint32_t> free_;
};

}  // namespace delmesh
