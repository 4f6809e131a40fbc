#pragma once
// Memory that a thread uses again: fresh pages for every search cost more than the search.

#include <utility>
#include <vector>

namespace weft {

/// A vector of `count` elements, which hold anything. Each thread keeps the few that it has used at
/// one time. To be destroyed by the thread that made it.
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
        // The next one asks for room before it is needed; without any it is simply freed.
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
