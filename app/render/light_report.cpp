#include "app/render/light_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/core/setting.h"

namespace weft {
namespace {

constexpr int kUnsure = 128;       // of 255: below it, light and paint were not told apart
constexpr double kSaid = 0.05;     // of the surface: less is not worth a warning
constexpr std::size_t kMost = 24;  // frames that are looked at

double unsure_share(const Shading& shading) {
    std::int64_t all = 0, unsure = 0;
    for (int y = 0; y < shading.sure.height(); ++y) {
        for (int x = 0; x < shading.sure.width(); ++x) {
            const int sure = shading.sure.row(y)[x];
            if (sure == 0) continue;
            ++all;
            unsure += sure < kUnsure;
        }
    }
    return all > 0 ? static_cast<double>(unsure) / static_cast<double>(all) : 0.0;
}

// Evenly spread over the frames.
std::vector<int> some_of(const std::vector<int>& frames) {
    if (frames.size() <= kMost) return frames;
    std::vector<int> out;
    for (std::size_t k = 0; k < kMost; ++k)
        out.push_back(frames[k * (frames.size() - 1) / (kMost - 1)]);
    return out;
}

double to_thousandths(double value) {
    return std::round(1e3 * value) / 1e3;
}

}  // namespace

Expected<std::vector<LightReport>> light_reports(const Shot& shot, const AnalysisStore& store,
                                                 const std::vector<int>& frames) {
    std::vector<LightReport> out;
    const std::vector<int> looked_at = some_of(frames);
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        if (!shot.plan.regions[k].estimates_light()) continue;
        LightReport light;
        light.region = shot.project.regions[shot.region_index[k]]->name;
        int seen = 0;
        for (const int frame : looked_at) {
            const AnalysisKey key{static_cast<int>(k), frame, AnalysisKind::kShading};
            if (!store.has(key)) continue;
            WEFT_TRY(bytes, store.get(key));
            WEFT_TRY(shading, decode_shading(bytes));
            if (shading.sure.empty()) continue;
            const double share = unsure_share(shading);
            if (seen++ == 0 || share > light.worst) light.worst = share, light.worst_frame = frame;
            light.unsure += share;
        }
        if (seen == 0) continue;
        light.unsure /= seen;
        out.push_back(std::move(light));
    }
    return out;
}

std::optional<std::string> unsure_light_text(const LightReport& light) {
    if (light.unsure < kSaid) return std::nullopt;
    return fmt::format(
        "Light and paint cannot be told apart on {:.0f} % of this surface: paint \"this is light\" "
        "or \"this is paint\" there",
        100 * light.unsure);
}

std::optional<std::string> unsure_light_warning(const LightReport& light) {
    if (light.unsure < kSaid) return std::nullopt;
    return fmt::format(
        "Light and paint cannot be told apart on {:.0f} % of the surface of region '{}' ({:.0f} % "
        "on frame {}). Look at the layer light_confidence{}, and paint what is light or paint "
        "there{}.",
        100 * light.unsure, light.region, 100 * light.worst, light.worst_frame,
        by({{setting::kLayers, "light_confidence"}}),
        by({{setting::kZone, "detail=1@MATTE"}, {setting::kZone, "detail=0@MATTE"}}));
}

nlohmann::ordered_json light_json(const LightReport& light) {
    return {{"region", light.region},
            {"unsure", to_thousandths(light.unsure)},
            {"worst", to_thousandths(light.worst)},
            {"worst_frame", light.worst_frame}};
}

}  // namespace weft
