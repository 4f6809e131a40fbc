#pragma once
// A monotone priority queue for Dijkstra with integer keys (Ahuja, Mehlhorn, Orlin & Tarjan 1990):
// a key sits in the bucket of its highest bit that differs from the key popped last.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft {

/// Keys pushed must not be smaller than the key popped last. Not thread-safe.
class RadixHeap {
  public:
    using Item = std::pair<std::uint64_t, std::int32_t>;

    [[nodiscard]] bool empty() const { return count_ == 0; }

    void push(std::uint64_t key, std::int32_t value) {
        buckets_[bucket_of(key)].emplace_back(key, value);
        ++count_;
    }

    /// The item with the smallest key; any of them on a tie.
    Item pop() {
        if (buckets_[0].empty()) refill();
        const Item item = buckets_[0].back();
        buckets_[0].pop_back();
        --count_;
        return item;
    }

  private:
    [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const {
        return static_cast<std::size_t>(std::bit_width(key ^ last_));
    }

    // Distributes the first bucket in use over the lower ones, relative to its smallest key.
    void refill() {
        std::size_t b = 1;
        while (buckets_[b].empty())
            ++b;
        std::uint64_t smallest = buckets_[b].front().first;
        for (const Item& item : buckets_[b])
            smallest = std::min(smallest, item.first);
        last_ = smallest;
        for (const Item& item : buckets_[b])
            buckets_[bucket_of(item.first)].push_back(item);
        buckets_[b].clear();
    }

    std::array<std::vector<Item>, 65> buckets_;
    std::uint64_t last_ = 0;
    std::size_t count_ = 0;
};

}  // namespace weft
