#include "app/render/job_warnings.h"

#include <fmt/format.h>

#include <cstdint>

#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

std::string pixels_text(std::int64_t count) {
    return count == 1 ? "1 pixel" : fmt::format("{} pixels", count);
}

void warn_above_one(const std::vector<FrameResult>& frames, std::vector<std::string>& warnings) {
    std::int64_t pixels = 0;
    std::vector<int> where;
    for (const FrameResult& f : frames) {
        pixels += f.above_one;
        if (f.above_one > 0) where.push_back(f.frame);
    }
    if (where.empty()) return;
    warnings.push_back(
        fmt::format("{} on {} would be brighter than the output can hold; their "
                    "highlights were rolled off.",
                    pixels_text(pixels), frames_text(where)));
}

// Lists the first few frames with their counts.
void warn_nonfinite(const std::vector<FrameResult>& frames, std::vector<std::string>& warnings) {
    constexpr int kListed = 8;
    std::int64_t pixels = 0, filled = 0;
    int count = 0;
    std::string list;
    for (const FrameResult& f : frames) {
        if (f.nonfinite == 0) continue;
        pixels += f.nonfinite;
        filled += f.filled;
        if (++count > kListed) continue;
        list += fmt::format("{}frame {} ({})", list.empty() ? "" : ", ", f.frame,
                            pixels_text(f.nonfinite));
    }
    if (count == 0) return;
    if (count > kListed) list += fmt::format(" and {} more frames", count - kListed);
    warnings.push_back(
        fmt::format("The plate has NaN or infinity on {}: {} in a matte filled with "
                    "the texture, {} outside passed through.",
                    list, filled, pixels - filled));
}

void warn_untouched(const std::vector<FrameResult>& frames, std::vector<std::string>& warnings) {
    std::vector<int> where;
    for (const FrameResult& f : frames)
        if (f.untouched) where.push_back(f.frame);
    if (where.empty()) return;
    warnings.push_back(fmt::format(
        "The matte is empty on {}: the plate is unchanged there. If the surface is visible, check "
        "the matte's files, value, channel and inversion{}.",
        frames_text(where),
        by({{setting::kMatteValue}, {setting::kMatteChannel}, {setting::kMatteInvert}})));
}

}  // namespace

std::string unsure_highlights_text(const std::string& region) {
    return fmt::format(
        "The highlights of region '{}' are unsure: its old surface has the colour of the light, or "
        "several paints, and nothing that moves over it tells them from paint, so that bright "
        "paint "
        "may be taken for gloss. Look at the layer gloss{}, "
        "or "
        "lower the highlights{}.",
        region, by({{setting::kLayers, "gloss"}}), by({{setting::kHighlights}}));
}

std::vector<std::string> warnings_of(const std::vector<FrameResult>& frames) {
    std::vector<std::string> warnings;
    warn_above_one(frames, warnings);
    warn_nonfinite(frames, warnings);
    warn_untouched(frames, warnings);
    return warnings;
}

}  // namespace weft
