#pragma once
// H×W×C images, row-major and interleaved. `Image` owns its pixels and is a value (copying copies
// them); `ImageView` borrows them, and its stride is counted in elements, not bytes.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// A borrowed H×W×C image. `T` may be const. Cheap to copy; valid while the owner's pixels are.
template <class T, int C>
class ImageView {
  public:
    static constexpr int kChannels = C;

    ImageView() = default;
    ImageView(T* data, int width, int height, std::ptrdiff_t stride)
        : data_(data), width_(width), height_(height), stride_(stride) {}

    /// A view of mutable pixels is a view of const ones.
    template <class U>
    requires(std::is_const_v<T>&& std::is_same_v<std::remove_const_t<T>, U>)
        ImageView(const ImageView<U, C>& o)  // NOLINT(google-explicit-constructor)
        : ImageView(o.data(), o.width(), o.height(), o.stride()) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Size size() const { return {width_, height_}; }
    [[nodiscard]] bool empty() const { return width_ <= 0 || height_ <= 0; }
    /// Elements (not bytes, not pixels) from one row to the next.
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    [[nodiscard]] T* data() const { return data_; }
    [[nodiscard]] T* row(int y) const { return data_ + y * stride_; }
    [[nodiscard]] T* pixel(int x, int y) const {
        return row(y) + static_cast<std::ptrdiff_t>(x) * C;
    }
    [[nodiscard]] T& at(int x, int y, int c = 0) const {
        assert(x >= 0 && y >= 0 && x < width_ && y < height_ && c >= 0 && c < C);
        return pixel(x, y)[c];
    }
    /// The part inside `r`, which must lie inside the image.
    [[nodiscard]] ImageView crop(const Recti& r) const {
        assert(r.x0 >= 0 && r.y0 >= 0 && r.x1 <= width_ && r.y1 <= height_);
        return {pixel(r.x0, r.y0), r.width(), r.height(), stride_};
    }

  private:
    T* data_ = nullptr;
    int width_ = 0;
    int height_ = 0;
    std::ptrdiff_t stride_ = 0;
};

/// An H×W×C image that owns its pixels, tightly packed. Const access from several threads is safe.
template <class T, int C>
class Image {
  public:
    static constexpr int kChannels = C;

    Image() = default;
    Image(int width, int height, T fill = T{})
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * C, fill) {
        assert(width >= 0 && height >= 0);
    }
    explicit Image(Size s, T fill = T{}) : Image(s.width, s.height, fill) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Size size() const { return {width_, height_}; }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(width_) * C; }
    [[nodiscard]] std::size_t size_bytes() const { return pixels_.size() * sizeof(T); }

    [[nodiscard]] T* data() { return pixels_.data(); }
    [[nodiscard]] const T* data() const { return pixels_.data(); }
    [[nodiscard]] T* row(int y) { return data() + y * stride(); }
    [[nodiscard]] const T* row(int y) const { return data() + y * stride(); }
    [[nodiscard]] T* pixel(int x, int y) { return row(y) + static_cast<std::ptrdiff_t>(x) * C; }
    [[nodiscard]] const T* pixel(int x, int y) const {
        return row(y) + static_cast<std::ptrdiff_t>(x) * C;
    }
    [[nodiscard]] T& at(int x, int y, int c = 0) { return view().at(x, y, c); }
    [[nodiscard]] const T& at(int x, int y, int c = 0) const { return view().at(x, y, c); }

    [[nodiscard]] ImageView<T, C> view() { return {data(), width_, height_, stride()}; }
    [[nodiscard]] ImageView<const T, C> view() const { return {data(), width_, height_, stride()}; }
    operator ImageView<T, C>() { return view(); }              // NOLINT
    operator ImageView<const T, C>() const { return view(); }  // NOLINT

    bool operator==(const Image&) const = default;

  private:
    int width_ = 0;
    int height_ = 0;
    std::vector<T> pixels_;
};

using ImageU8x3 = Image<std::uint8_t, 3>;
using ImageF1 = Image<float, 1>;
using ImageF2 = Image<float, 2>;
using ImageF3 = Image<float, 3>;
/// Coverage of a region at the plate's size: 0 outside, 255 inside, between on soft edges.
using Matte = Image<std::uint8_t, 1>;

using ViewU8x1 = ImageView<const std::uint8_t, 1>;
using ViewU8x3 = ImageView<const std::uint8_t, 3>;
using ViewF1 = ImageView<const float, 1>;
using ViewF2 = ImageView<const float, 2>;
using ViewF3 = ImageView<const float, 3>;

}  // namespace weft
