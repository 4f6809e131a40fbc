#include "engine/pipeline/frame_look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/core/luma.h"

namespace weft {
namespace {

constexpr int kColumns = FrameLook::kColumns, kRows = FrameLook::kRows, kBins = FrameLook::kBins;
constexpr int kSampled = 160;  // columns of the picture that are looked at

constexpr float kLeastPlace = 0.10f, kLeastShare = 0.30f;
constexpr float kSameScene = 0.5f;  // correlation

constexpr float kNoise = 10.0f / 255;  // spread of a frame of one colour
constexpr float kFarBelow = 0.1f;      // of the usual spread
constexpr float kLow = 0.02f, kHigh = 0.98f;

// `luma_at(x, y)`: 0 to 1.
template <class Luma>
FrameLook look_of(Size size, const Luma& luma_at) {
    FrameLook out;
    std::array<int, kColumns * kRows> counts{};
    std::array<int, 256> codes{};
    const int step = std::max(1, size.width / kSampled);
    int total = 0;
    for (int y = step / 2; y < size.height; y += step) {
        for (int x = step / 2; x < size.width; x += step) {
            const float luma = luma_at(x, y);
            const auto cell = static_cast<std::size_t>(y * kRows / size.height * kColumns +
                                                       x * kColumns / size.width);
            out.means[cell] += luma;
            ++counts[cell];
            ++codes[static_cast<std::size_t>(std::lround(255 * luma))];
            const int bin = std::min(kBins - 1, static_cast<int>(luma * kBins));
            out.shares[static_cast<std::size_t>(bin)] += 1;
            ++total;
        }
    }
    for (std::size_t k = 0; k < counts.size(); ++k)
        out.means[k] /= static_cast<float>(std::max(1, counts[k]));
    const auto all = static_cast<float>(std::max(1, total));
    for (float& share : out.shares)
        share /= all;
    int below = 0, low = -1, high = -1;
    for (int code = 0; code < 256; ++code) {
        below += codes[static_cast<std::size_t>(code)];
        if (low < 0 && static_cast<float>(below) > kLow * all) low = code;
        if (high < 0 && static_cast<float>(below) >= kHigh * all) high = code;
    }
    out.spread = static_cast<float>(high - low) / 255.0f;
    return out;
}

}  // namespace

FrameLook look_at(ViewF3 plate, bool display_encoded) {
    return look_of(plate.size(), [&](int x, int y) {
        const float luma = luma_709(plate.pixel(x, y));
        const float held = luma > 0 ? std::min(luma, 1.0f) : 0.0f;  // NaN becomes 0
        return display_encoded ? held : std::sqrt(held);
    });
}

FrameLook look_at(ViewU8x1 luma) {
    return look_of(luma.size(),
                   [&](int x, int y) { return static_cast<float>(luma.row(y)[x]) / 255.0f; });
}

LookChange change_between(const FrameLook& a, const FrameLook& b) {
    LookChange out;
    const auto cells = static_cast<float>(a.means.size());
    float mean_a = 0, mean_b = 0;
    for (std::size_t k = 0; k < a.means.size(); ++k) {
        out.place += std::abs(a.means[k] - b.means[k]) / cells;
        mean_a += a.means[k] / cells, mean_b += b.means[k] / cells;
    }
    for (std::size_t k = 0; k < a.shares.size(); ++k)
        out.share += std::abs(a.shares[k] - b.shares[k]) / 2;
    float aa = 0, bb = 0, ab = 0;
    for (std::size_t k = 0; k < a.means.size(); ++k) {
        const float da = a.means[k] - mean_a, db = b.means[k] - mean_b;
        aa += da * da, bb += db * db, ab += da * db;
    }
    if (aa > 0 && bb > 0) out.likeness = ab / std::sqrt(aa * bb);
    return out;
}

bool may_be_cut(const LookChange& change) {
    return change.place > kLeastPlace && change.share > kLeastShare;
}

bool is_another_scene(const FrameLook& a, const FrameLook& b) {
    const LookChange change = change_between(a, b);
    return may_be_cut(change) && change.likeness < kSameScene;
}

bool shows_nothing(const FrameLook& look, float usual) {
    return look.spread <= kNoise && look.spread <= kFarBelow * usual;
}

}  // namespace weft
