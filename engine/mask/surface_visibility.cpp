#include "engine/mask/surface_visibility.h"

#include <algorithm>
#include <cstdint>

namespace weft {
namespace {

constexpr int kInside = 128;         // coverage that counts as inside for the outline
constexpr int kFaint = 16;           // below this, coverage does not count
constexpr double kFirstStays = 0.5;  // of the best score
constexpr double kWell = 0.9;        // likewise

// Pixels of the outline, and those of them that lie on the picture's border.
struct Outline {
    std::int64_t all = 0, on_border = 0;
};

Outline outline_of(ViewU8x1 matte) {
    const int width = matte.width(), height = matte.height();
    Outline out;
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* const row = matte.row(y);
        const std::uint8_t* const above = y > 0 ? matte.row(y - 1) : nullptr;
        const std::uint8_t* const below = y + 1 < height ? matte.row(y + 1) : nullptr;
        for (int x = 0; x < width; ++x) {
            if (row[x] < kInside) continue;
            if (!above || !below || x == 0 || x == width - 1) {
                ++out.all;
                ++out.on_border;
            } else if (row[x - 1] < kInside || row[x + 1] < kInside || above[x] < kInside ||
                       below[x] < kInside) {
                ++out.all;
            }
        }
    }
    return out;
}

}  // namespace

double SurfaceVisibility::score() const {
    if (!(full_px > 0)) return 0;
    const double sharp = 1 - 0.75 * soft;
    return visible_px * (visible_px / full_px) * (1 - 0.5 * cut) * sharp * sharp;
}

SurfaceVisibility surface_visibility(ViewU8x1 matte, ViewU8x1 holdout) {
    const bool held = !holdout.empty();
    std::int64_t full = 0, visible = 0, covered = 0, partly = 0;
    for (int y = 0; y < matte.height(); ++y) {
        const std::uint8_t* const row = matte.row(y);
        const std::uint8_t* const held_row = held ? holdout.row(y) : nullptr;
        for (int x = 0; x < matte.width(); ++x) {
            const int coverage = row[x];
            full += coverage;
            visible += coverage * (held ? 255 - held_row[x] : 255);
            covered += coverage >= kFaint ? 1 : 0;
            partly += coverage >= kFaint && coverage <= 255 - kFaint ? 1 : 0;
        }
    }
    SurfaceVisibility out;
    out.full_px = static_cast<double>(full) / 255;
    out.visible_px = static_cast<double>(visible) / (255.0 * 255.0);
    if (covered > 0) out.soft = static_cast<double>(partly) / static_cast<double>(covered);
    const Outline outline = outline_of(matte);
    if (outline.all > 0)
        out.cut = static_cast<double>(outline.on_border) / static_cast<double>(outline.all);
    return out;
}

std::optional<std::size_t> first_well_shown(const std::vector<double>& scores) {
    if (scores.empty()) return std::nullopt;
    const double best = *std::max_element(scores.begin(), scores.end());
    if (!(best > 0)) return std::nullopt;
    if (scores.front() >= kFirstStays * best) return 0;
    const auto found = std::find_if(scores.begin(), scores.end(),
                                    [&](double score) { return score >= kWell * best; });
    return static_cast<std::size_t>(found - scores.begin());
}

}  // namespace weft
