#pragma once
// Building blocks of the document: a shared immutable value, and the preserved keys of newer
// versions.

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace weft {

/// An immutable value shared by copies. Never empty; thread-safe to read and copy. A change makes a
/// new leaf and leaves older copies of the document unchanged.
template <class T>
class Leaf {
  public:
    Leaf() : value_(shared_default()) {}
    Leaf(T value) : value_(std::make_shared<const T>(std::move(value))) {}
    // Not movable: a moved-from leaf would be empty.
    Leaf(const Leaf&) = default;
    Leaf& operator=(const Leaf&) = default;
    ~Leaf() = default;

    const T& operator*() const { return *value_; }
    const T* operator->() const { return value_.get(); }

    /// Returns a new leaf with a copy of the value after `change(T&)`.
    template <class Change>
    [[nodiscard]] Leaf with(Change&& change) const {
        T copy = *value_;
        std::forward<Change>(change)(copy);
        return Leaf(std::move(copy));
    }

    /// Equal for leaves that share a value; used to count memory once.
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

/// Unknown keys of a JSON object, with their values as JSON text. They are written back on saving,
/// so that a project loses nothing when an older Weft saves it.
using Extras = std::map<std::string, std::string>;

}  // namespace weft
