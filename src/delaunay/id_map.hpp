#pragma once
// A map from 32-bit keys to 32-bit values, of which nothing is ever erased: a hash table in one flat array (open
// addressing), and a plain array by key where that takes less memory.

#include "base/let_go.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace delmesh {

class IdMap {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    /// All keys lie below `universe`.
    explicit IdMap(std::size_t universe = std::numeric_limits<std::uint32_t>::max()) : universe_(universe) {
        rehash(least_slots);
    }

    /// Makes room for so many keys.
    void expect(std::size_t count) {
        if (values_.empty() && 2 * count * sizeof(Slot) >= universe_ * sizeof(std::uint32_t)) use_array();
    }

    /// `none` if the key is not there.
    [[nodiscard]] std::uint32_t find(std::uint32_t key) const {
        if (!values_.empty()) return values_[key];
        for (std::size_t i = home(key);; i = (i + 1) & mask_) {
            if (slots_[i].key == key) return slots_[i].value;
            if (slots_[i].key == none) return none;
        }
    }

    /// Requires that the key is not `none` and not there yet.
    void insert(std::uint32_t key, std::uint32_t value) {
        if (values_.empty() && 2 * ++size_ > slots_.size()) grow();
        place({key, value});
    }

private:
    struct Slot {
        std::uint32_t key = none;
        std::uint32_t value = none;
    };
    static constexpr std::size_t least_slots = 128;

    [[nodiscard]] std::size_t home(std::uint32_t key) const {
        return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ull) >> 32) & mask_;
    }

    void place(Slot slot) {
        if (!values_.empty()) {
            values_[slot.key] = slot.value;
            return;
        }
        std::size_t i = home(slot.key);
        while (slots_[i].key != none) i = (i + 1) & mask_;
        slots_[i] = slot;
    }

    void grow() {
        const std::size_t count = 2 * slots_.size();
        if (count * sizeof(Slot) < universe_ * sizeof(std::uint32_t)) return rehash(count);
        use_array();
    }

    void use_array() {
        values_.assign(universe_, none);
        for (const Slot& slot : slots_)
            if (slot.key != none) place(slot);
        let_go(slots_);
    }

    void rehash(std::size_t count) {
        std::vector<Slot> old(count);
        old.swap(slots_);
        mask_ = count - 1;
        for (const Slot& slot : old)
            if (slot.key != none) place(slot);
    }

    std::size_t universe_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> values_;  ///< by key; empty as long as there are slots
    std::size_t mask_ = 0;
    std::size_t size_ = 0;
};

}  // namespace delmesh
