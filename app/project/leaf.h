#pragma once
// The two building blocks of the document: a shared immutable value, and keys that this version
// does not know but keeps.

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace weft {

/// An immutable value that copies share. Never empty; thread-safe to read and to copy. A change
/// makes a new leaf and leaves every older copy of the document as it was.
template <class T>
class Leaf {
  public:
    Leaf() : value_(shared_default()) {}
    Leaf(T value) : value_(std::make_shared<const T>(std::move(value))) {}
    // No moves: a moved-from leaf would be empty.
    Leaf(const Leaf&) = default;
    Leaf& operator=(const Leaf&) = default;
    ~Leaf() = default;

    const T& operator*() const { return *value_; }
    const T* operator->() const { return value_.get(); }

    /// A copy of the value after `change(T&)`, as a new leaf.
    template <class Change>
    [[nodiscard]] Leaf with(Change&& change) const {
        T copy = *value_;
        std::forward<Change>(change)(copy);
        return Leaf(std::move(copy));
    }

    /// Equal for leaves that share one value; for counting memory once.
    [[nodiscard]] const void* identity() const { return value_.get(); }
    friend bool operator==(const Leaf& a, const Leaf& b) {
        return a.value_ == b.value_ || *a.value_ == *b.value_;
    }

  private:
    static const std::shared_ptr<const T>& shared_default() {
        static const std::shared_ptr<const T> value = std::make_shared<const T>();
        return value;
    }
    std::shared_ptr<const T> value_;
};

/// Keys of a JSON object that this version does not know, with their values as JSON text. They are
/// written back on saving, so a project may pass through an older Weft without losing anything.
using Extras = std::map<std::string, std::string>;

}  // namespace weft
