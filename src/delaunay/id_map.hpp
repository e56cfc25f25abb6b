#pragma once
// A hash map from 32-bit keys to 32-bit values: open addressing in one flat array, nothing is ever erased.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delmesh {

class IdMap {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    explicit IdMap(std::size_t expected = 64) { rehash(expected * 2); }

    /// `none` if the key is not there.
    [[nodiscard]] std::uint32_t find(std::uint32_t key) const {
        for (std::size_t i = home(key);; i = (i + 1) & mask_) {
            if (slots_[i].key == key) return slots_[i].value;
            if (slots_[i].key == none) return none;
        }
    }

    /// Requires that the key is not `none` and not there yet.
    void insert(std::uint32_t key, std::uint32_t value) {
        if (2 * ++size_ > slots_.size()) rehash(slots_.size() * 2);
        place({key, value});
    }

private:
    struct Slot {
        std::uint32_t key = none;
        std::uint32_t value = none;
    };

    [[nodiscard]] std::size_t home(std::uint32_t key) const {
        return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ull) >> 32) & mask_;
    }

    void place(Slot slot) {
        std::size_t i = home(slot.key);
        while (slots_[i].key != none) i = (i + 1) & mask_;
        slots_[i] = slot;
    }

    void rehash(std::size_t at_least) {
        std::size_t count = 16;
        while (count < at_least) count *= 2;
        std::vector<Slot> old(count);
        old.swap(slots_);
        mask_ = count - 1;
        for (const Slot& slot : old)
            if (slot.key != none) place(slot);
    }

    std::vector<Slot> slots_;
    std::size_t mask_ = 0;
    std::size_t size_ = 0;
};

}  // namespace delmesh
