#pragma once
// Plain values one after the other, in the machine's (little-endian) order: what the caches hold.

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/image.h"

namespace weft {

class ByteWriter {
  public:
    template <class T>
    requires std::is_trivially_copyable_v<T> ByteWriter& value(const T& v) {
        return raw(&v, sizeof v);
    }
    ByteWriter& raw(const void* data, std::size_t size) {
        const auto* p = static_cast<const std::uint8_t*>(data);
        bytes_.insert(bytes_.end(), p, p + size);
        return *this;
    }
    /// Width, height, pixels.
    template <class T, int C>
    ByteWriter& image(const Image<T, C>& image) {
        value(image.width()).value(image.height());
        return raw(image.data(), image.size_bytes());
    }
    [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
};

/// Reads bytes that may be truncated or damaged, and that must outlive it. After the first failed
/// read nothing more is read.
class ByteReader {
  public:
    explicit ByteReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
    template <class T>
    requires std::is_trivially_copyable_v<T> ByteReader& value(T& v) { return raw(&v, sizeof v); }
    ByteReader& raw(void* data, std::size_t size) {
        if (size > bytes_.size() - position_) ok_ = false;
        if (!ok_) return *this;
        if (size > 0) std::memcpy(data, bytes_.data() + position_, size);
        position_ += size;
        return *this;
    }
    /// As ByteWriter wrote it; sides of at most 65,536 px.
    template <class T, int C>
    ByteReader& image(Image<T, C>& image) {
        constexpr int kLargest = 1 << 16;
        int width = 0, height = 0;
        value(width).value(height);
        ok_ = ok_ && width >= 0 && height >= 0 && width <= kLargest && height <= kLargest &&
              holds(static_cast<double>(width) * height * C, sizeof(T));
        if (!ok_) return *this;
        image = Image<T, C>(width, height);
        return raw(image.data(), image.size_bytes());
    }
    /// True if everything was read and no bytes are left.
    [[nodiscard]] bool complete() const { return ok_ && position_ == bytes_.size(); }
    [[nodiscard]] bool ok() const { return ok_; }
    /// Whether this many elements are left. Call it before memory is allocated for them.
    [[nodiscard]] bool holds(double count, std::size_t element_bytes) const {
        return count * static_cast<double>(element_bytes) <=
               static_cast<double>(bytes_.size() - position_);
    }

  private:
    const std::vector<std::uint8_t>& bytes_;
    std::size_t position_ = 0;
    bool ok_ = true;
};

}  // namespace weft
