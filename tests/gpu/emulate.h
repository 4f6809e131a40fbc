#pragma once
// Runs a kernel body on the host: every block, every thread, one phase between two barriers after
// the other. Threads of a phase may run in any order on a device, so tests run them in several.

#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "gpu/kernels/portable.h"

namespace weft::test {

enum class ThreadOrder { kForward, kBackward, kShuffled };

/// What shared memory and registers hold before a kernel writes to them.
constexpr int kGarbage = 0xA5;

class EmulatedBlock {
  public:
    /// A variable of each thread.
    template <class T>
    class Local {
      public:
        explicit Local(int threads) : values_(static_cast<std::size_t>(threads)) {
            std::memset(static_cast<void*>(values_.data()), kGarbage, sizeof(T) * values_.size());
        }
        T& operator[](int thread) { return values_[static_cast<std::size_t>(thread)]; }

      private:
        std::vector<T> values_;
    };

    EmulatedBlock(int index, int threads, ThreadOrder order) : index_(index), order_(threads) {
        std::iota(order_.begin(), order_.end(), 0);
        if (order == ThreadOrder::kBackward) std::iota(order_.rbegin(), order_.rend(), 0);
        if (order != ThreadOrder::kShuffled) return;
        Rng rng(static_cast<std::uint64_t>(index));
        for (std::size_t i = order_.size(); i > 1; --i)
            std::swap(order_[i - 1], order_[rng.below(i)]);
    }

    [[nodiscard]] int index() const { return index_; }
    template <class T>
    [[nodiscard]] Local<T> local() const {
        return Local<T>(static_cast<int>(order_.size()));
    }
    template <class F>
    void each(F f) const {
        for (const int thread : order_)
            f(thread);
    }

  private:
    int index_;
    std::vector<int> order_;
};

/// All blocks of kernel K, on up to thread_count() threads.
template <class K>
void emulate(int blocks, const typename K::Args& args, ThreadOrder order) {
    parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t i) {
        const auto shared = std::make_unique<typename K::Shared>();
        std::memset(static_cast<void*>(shared.get()), kGarbage, sizeof *shared);
        EmulatedBlock block(static_cast<int>(i), K::kThreads, order);
        K::run(block, *shared, args);
    });
}

}  // namespace weft::test
