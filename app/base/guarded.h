#pragma once
// A value shared between threads, accessible only through its lock.

#include <mutex>
#include <utility>

namespace weft {

/// Thread-safe: the value is accessed through lock() and try_lock() only.
template <class T>
class Guarded {
  public:
    /// Holds the lock during its lifetime. Null after a try_lock() that failed.
    class Access {
      public:
        explicit operator bool() const { return lock_.owns_lock(); }
        T* operator->() const { return value_; }
        T& operator*() const { return *value_; }
        /// The lock, for a condition variable.
        [[nodiscard]] std::unique_lock<std::mutex>& lock() { return lock_; }

      private:
        friend class Guarded;
        Access(T& value, std::unique_lock<std::mutex> lock)
            : value_(&value), lock_(std::move(lock)) {}
        T* value_;
        std::unique_lock<std::mutex> lock_;
    };

    [[nodiscard]] Access lock() const { return {value_, std::unique_lock(mutex_)}; }
    /// Does not block.
    [[nodiscard]] Access try_lock() const {
        return {value_, std::unique_lock(mutex_, std::try_to_lock)};
    }

  private:
    mutable std::mutex mutex_;
    mutable T value_;
};

}  // namespace weft
