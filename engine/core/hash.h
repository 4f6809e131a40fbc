#pragma once
// Content hashes: names of cached analyses, texture ids, settings hashes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/core/image.h"

namespace weft {

/// 128 bits of XXH3 (xxHash 0.8, not cryptographic), written as 32 hexadecimal digits.
struct Hash128 {
    std::uint64_t high = 0, low = 0;
    auto operator<=>(const Hash128&) const = default;
    [[nodiscard]] std::string hex() const;
};

/// Feeds values in order; the same values in the same order give the same hash on every x86-64.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& bytes(const void* data, std::size_t size);
    /// The length goes in too, so that ("ab","c") differs from ("a","bc").
    Hasher& text(std::string_view s);
    template <class T>
    requires std::is_arithmetic_v<T> Hasher& value(T v) { return bytes(&v, sizeof v); }
    template <class T, int C>
    Hasher& image(const Image<T, C>& image) {
        value(image.width()).value(image.height()).value(C);
        return bytes(image.data(), image.size_bytes());
    }
    [[nodiscard]] Hash128 finish() const;

  private:
    void* state_;
};

}  // namespace weft
