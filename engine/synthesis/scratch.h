#pragma once
// Reused memory of a thread: fresh pages for every search cost more than the search.

#include <utility>
#include <vector>

namespace weft {

/// A vector of `count` elements with undefined values. Each thread keeps up to four for reuse. Must
/// be destroyed by the thread that constructed it.
template <class Vector>
class Scratch {
  public:
    explicit Scratch(std::size_t count) {
        if (!kept().empty()) {
            memory_ = std::move(kept().back());
            kept().pop_back();
        }
        memory_.resize(count);
    }
    ~Scratch() {
        // Kept only if there is room without an allocation; otherwise it is freed.
        if (kept().capacity() > kept().size()) kept().push_back(std::move(memory_));
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    Vector& operator*() { return memory_; }
    const Vector& operator*() const { return memory_; }

  private:
    static std::vector<Vector>& kept() {
        constexpr std::size_t kMost = 4;
        thread_local std::vector<Vector> vectors = [] {
            std::vector<Vector> out;
            out.reserve(kMost);
            return out;
        }();
        return vectors;
    }
    Vector memory_;
};

}  // namespace weft
