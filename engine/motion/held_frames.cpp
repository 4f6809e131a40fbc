#include "engine/motion/held_frames.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace weft {
namespace {

constexpr int kHeldBlock = 8;
constexpr std::int64_t kLeastPixels = 64;
// A block with fewer pixels of the surface is not judged by itself, because one pixel is not
// reliable.
constexpr int kLeastInBlock = 4;

struct Difference {
    std::int64_t extent = 0;    // Pixels of either extent.
    std::int64_t compared = 0;  // Of those, hidden in neither frame.
    std::int64_t sum = 0;
    float worst_block = 0;
};

bool hidden(ViewU8x1 holdout, int x, int y) {
    return !holdout.empty() && holdout.at(x, y) > 0;
}

int levels_apart(const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

void add_block(const HoldView& a, const HoldView& b, int x0, int y0, Difference& out) {
    const int x1 = std::min(x0 + kHeldBlock, a.display.width());
    const int y1 = std::min(y0 + kHeldBlock, a.display.height());
    std::int64_t sum = 0;
    int count = 0;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            if (a.extent.at(x, y) < 128 && b.extent.at(x, y) < 128) continue;
            ++out.extent;
            if (hidden(a.holdout, x, y) || hidden(b.holdout, x, y)) continue;
            sum += levels_apart(a.display.pixel(x, y), b.display.pixel(x, y));
            ++count;
        }
    }
    out.sum += sum;
    out.compared += count;
    if (count < kLeastInBlock) return;
    out.worst_block =
        std::max(out.worst_block, static_cast<float>(sum) / static_cast<float>(count));
}

template <class T, int C>
Image<std::remove_const_t<T>, C> owned(ImageView<T, C> view) {
    Image<std::remove_const_t<T>, C> out(view.size());
    for (int y = 0; y < view.height(); ++y)
        std::copy_n(view.row(y), C * view.width(), out.row(y));
    return out;
}

}  // namespace

bool same_drawing(const HoldView& a, const HoldView& b, const HoldLimits& limits) {
    Difference d;
    for (int y = 0; y < a.display.height(); y += kHeldBlock) {
        for (int x = 0; x < a.display.width(); x += kHeldBlock) {
            add_block(a, b, x, y, d);
            if (d.worst_block > limits.block) return false;
        }
    }
    if (d.compared < kLeastPixels || 3 * d.compared < d.extent) return false;
    return static_cast<float>(d.sum) <= limits.mean * static_cast<float>(d.compared);
}

bool HeldFrames::advance(const HoldView& frame) {
    if (first_ && same_drawing({first_->display, first_->extent, first_->holdout}, frame, limits_))
        return true;
    first_ = Kept{owned(frame.display), owned(frame.extent), owned(frame.holdout)};
    return false;
}

}  // namespace weft
