#include "app/render/job_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

std::string pixels_text(std::int64_t count) {
    return count == 1 ? "1 pixel" : fmt::format("{} pixels", count);
}

bool any_above(const RgbNumbers& numbers, double limit) {
    return std::max({numbers.r, numbers.g, numbers.b}) > limit;
}

bool raises_light(const LightParams& light) {
    return light.strength > 1 ||
           std::any_of(
               light.strength_keys.keys.begin(), light.strength_keys.keys.end(),
               [](const NumberKey& key) { return !key.numbers.empty() && key.numbers[0] > 1; });
}

// The settings of a region that the artist has made it brighter with than it is by itself.
void add_brightening(const Region& region, std::vector<SettingRef>& settings) {
    const GradeParams& grade = region.grade;
    const LightParams& light = region.light;
    const bool brightest_zone =
        std::any_of(region.zones->begin(), region.zones->end(), [](const Zone& zone) {
            return zone.kind == ZoneKind::kLight && (zone.value > 1 || !zone.value_keys.empty());
        });
    const std::pair<bool, std::string_view> found[] = {
        {grade.match < 1, "grade.match"},
        {grade.exposure > 0, "grade.exposure"},
        {any_above(grade.multiply, 1), "grade.multiply"},
        {grade.contrast > 1, "grade.contrast"},
        {grade.gamma > 1, "grade.gamma"},
        {any_above(grade.offset, 0), "grade.offset"},
        {light.source != LightSource::kPlate && light.source != LightSource::kNone,
         setting::kLightSource},
        {raises_light(light), "light.strength"},
        {light.highlights > 0, setting::kHighlights},
        {light.exact, setting::kLightExact},
        {brightest_zone, setting::kZone}};
    for (const auto& [brightens, key] : found) {
        const auto is_it = [&, name = key](const SettingRef& known) { return known.key == name; };
        if (brightens && std::none_of(settings.begin(), settings.end(), is_it))
            settings.push_back({key});
    }
}

// By itself a texture has the exposure of the plate, and its highlights roll off like a camera's.
void warn_above_one(const std::vector<FrameResult>& frames, const Project& project,
                    std::vector<std::string>& warnings) {
    std::int64_t pixels = 0;
    std::vector<int> where;
    for (const FrameResult& f : frames) {
        pixels += f.above_one;
        if (f.above_one > 0) where.push_back(f.frame);
    }
    if (where.empty()) return;
    std::vector<SettingRef> settings;
    for (const auto& region : project.regions)
        if (region->enabled) add_brightening(*region, settings);
    if (settings.empty()) return;
    warnings.push_back(
        fmt::format("{} on {} would be brighter than the output can hold; their "
                    "highlights were rolled off. Lower what brightens the texture{}.",
                    pixels_text(pixels), frames_text(where), by(settings)));
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

std::vector<std::string> warnings_of(const std::vector<FrameResult>& frames,
                                     const Project& project) {
    std::vector<std::string> warnings;
    warn_above_one(frames, project, warnings);
    warn_nonfinite(frames, warnings);
    warn_untouched(frames, warnings);
    return warnings;
}

}  // namespace weft
