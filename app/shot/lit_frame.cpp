#include "app/shot/lit_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/color/color_space.h"
#include "engine/core/hash.h"
#include "engine/core/luma.h"

namespace weft {
namespace {

constexpr double kDark = 0.03;        // mean luminance: only darker frames are doubted
constexpr double kTooDark = 1.0 / 3;  // of the shot's light
constexpr double kLit = 0.8;          // of the shot's light
constexpr double kUsual = 0.9;        // quantile of the frames' light that is the shot's
constexpr std::size_t kLitLooks = 24;
constexpr float kBurnt = 0.985f;    // display-encoded; less is no white
constexpr double kAllBurnt = 0.97;  // share of the pixels
constexpr int kColumns = 160;       // of the grid that is looked at

double measured(ViewF3 plate, bool display_encoded) {
    const int step = std::max(1, plate.width() / kColumns);
    double sum = 0, burnt = 0, count = 0;
    for (int y = step / 2; y < plate.height(); y += step) {
        for (int x = step / 2; x < plate.width(); x += step) {
            const float* p = plate.pixel(x, y);
            const float luma = luma_709(p);
            count += 1;
            if (!(luma > 0)) continue;  // NaN too
            if (display_encoded && std::min({p[0], p[1], p[2]}) >= kBurnt) burnt += 1;
            sum += display_encoded ? srgb_to_linear(std::min(luma, 1.0f)) : std::min(luma, 16.0f);
        }
    }
    return burnt >= kAllBurnt * count ? 0.0 : sum / std::max(1.0, count);
}

// Evenly spread over them, both ends included.
std::vector<int> spread(const std::vector<int>& frames, std::size_t most) {
    if (frames.size() <= most) return frames;
    std::vector<int> out;
    for (std::size_t k = 0; k < most; ++k)
        out.push_back(frames[k * (frames.size() - 1) / (most - 1)]);
    return out;
}

}  // namespace

std::optional<double> light_of_frame(const CachedReader& plate, int frame,
                                     VisibilityCache* memory) {
    const auto stamp = plate.stamp(frame);
    if (!stamp) return std::nullopt;
    Hasher hasher;
    hasher.text("light").value(stamp->high).value(stamp->low);
    const Hash128 key = hasher.finish();
    if (memory) {
        if (const auto known = memory->find(key)) return known;
    }
    const auto decoded = plate.read_shared(frame);
    if (!decoded) return std::nullopt;
    const double light = measured((*decoded)->rgb, plate.display_encoded());
    if (memory) memory->keep(key, light);
    return light;
}

bool is_doubtful(double light) {
    return light < kDark;
}

std::optional<int> lit_frame(const CachedReader& plate, int frame,
                             const std::vector<int>& candidates, VisibilityCache* memory) {
    const auto here = light_of_frame(plate, frame, memory);
    if (!here || !is_doubtful(*here) || candidates.size() < 2) return std::nullopt;
    const std::vector<int> looks = spread(candidates, kLitLooks);
    std::vector<double> light;
    for (const int look : looks)
        light.push_back(light_of_frame(plate, look, memory).value_or(0.0));
    std::vector<double> sorted = light;
    const auto at = sorted.begin() +
                    static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    const double usual = *at;
    if (*here >= kTooDark * usual) return std::nullopt;
    std::optional<int> best;
    for (std::size_t k = 0; k < looks.size(); ++k) {
        if (light[k] < kLit * usual) continue;
        if (!best || std::abs(looks[k] - frame) < std::abs(*best - frame)) best = looks[k];
    }
    return best;
}

}  // namespace weft
