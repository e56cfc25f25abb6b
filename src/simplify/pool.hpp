#pragma once
// Room for items that come and go, named by numbers.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace delmesh {

/// Grows without a copy, and keeps no list of what is free beside it.
template <class Item>
class Pool {
    static_assert(std::is_trivially_copyable_v<Item> && sizeof(Item) >= sizeof(std::uint32_t) &&
                  alignof(Item) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

public:
    [[nodiscard]] Item& operator[](std::uint32_t at) { return blocks_[at / block_size][at % block_size]; }
    [[nodiscard]] const Item& operator[](std::uint32_t at) const { return blocks_[at / block_size][at % block_size]; }

    /// Room for one more: what was given back last, if there is any, so that equal calls give equal numbers.
    std::uint32_t take() {
        if (free_ == none) {
            if (size_ % block_size == 0) add_block();
            ::new (&(*this)[size_]) Item();
            return size_++;
        }
        const std::uint32_t at = free_;
        std::memcpy(&free_, &(*this)[at], sizeof free_);
        ::new (&(*this)[at]) Item();
        return at;
    }
    void give_back(std::uint32_t at) {
        std::memcpy(static_cast<void*>(&(*this)[at]), &free_, sizeof free_);
        free_ = at;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    /// So large a block goes back to the system when it is freed, and takes no memory before it is used.
    static constexpr std::uint32_t block_size = std::bit_floor((std::uint32_t{1} << 19) / sizeof(Item));

    void add_block() { blocks_.emplace_back(static_cast<Item*>(::operator new(block_size * sizeof(Item)))); }
    struct Free {
        void operator()(Item* block) const { ::operator delete(block); }
    };

    std::vector<std::unique_ptr<Item[], Free>> blocks_;
    std::uint32_t size_ = 0;
    std::uint32_t free_ = none;
};

}  // namespace delmesh
