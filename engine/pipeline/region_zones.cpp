#include "engine/pipeline/region_zones.h"

#include <algorithm>

#include "engine/core/parallel.h"

namespace weft {

Expected<Matte> ShotSource::zone(int /*region*/, int zone, int frame) const {
    return fail(ErrorCode::kMissingFrames, "Zone " + std::to_string(zone + 1) +
                                               " has no matte on frame " + std::to_string(frame) +
                                               ".");
}

Expected<Matte> ShotSource::zone_key(int region, int zone, int frame) const {
    return ShotSource::zone(region, zone, frame);
}

Expected<Matte> bare_zone_matte(const ShotSource& source, const ShotPlan& plan,
                                const AnalysisStore& store, int region, int zone, int frame) {
    const ZonePlan& of = region_of(plan, region).zones[static_cast<std::size_t>(zone)];
    if (!of.propagated()) return source.zone(region, zone, frame);
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kMatte, zone_layer(zone)}));
    WEFT_TRY(stored, decode_matte(bytes));
    return std::move(stored.matte);
}

Expected<Matte> zone_matte(const ShotSource& source, const ShotPlan& plan,
                           const AnalysisStore& store, int region, int zone, int frame) {
    const ZonePlan& of = region_of(plan, region).zones[static_cast<std::size_t>(zone)];
    WEFT_TRY(bare, bare_zone_matte(source, plan, store, region, zone, frame));
    return with_edge(std::move(bare), of.edge.at(frame));
}

Expected<ImageF1> zone_factor(const ShotSource& source, const ShotPlan& plan,
                              const AnalysisStore& store, int region, ZoneKind kind, int frame) {
    const std::vector<ZonePlan>& zones = region_of(plan, region).zones;
    ImageF1 out;
    for (int k = 0; k < static_cast<int>(zones.size()); ++k) {
        const ZonePlan& zone = zones[static_cast<std::size_t>(k)];
        if (zone.kind != kind) continue;
        WEFT_TRY(matte, zone_matte(source, plan, store, region, k, frame));
        if (out.empty()) out = ImageF1(matte.width(), matte.height(), 1.0f);
        const float step = (zone.value_at(frame) - 1) / 255.0f;
        std::transform(matte.data(), matte.data() + matte.size_bytes(), out.data(), out.data(),
                       [&](std::uint8_t m, float factor) {
                           return factor * (1 + static_cast<float>(m) * step);
                       });
    }
    return out;
}

Expected<ImageF1> light_detail(const ShotSource& source, const ShotPlan& plan,
                               const AnalysisStore& store, int region, int frame) {
    const RegionPlan& own = region_of(plan, region);
    ImageF1 out;
    if (own.detail != kEstimatedDetail) out = ImageF1(source.size(), own.detail);
    for (int k = 0; k < static_cast<int>(own.zones.size()); ++k) {
        const ZonePlan& zone = own.zones[static_cast<std::size_t>(k)];
        if (zone.kind != ZoneKind::kDetail) continue;
        WEFT_TRY(matte, zone_matte(source, plan, store, region, k, frame));
        if (out.empty()) out = ImageF1(matte.size(), kEstimatedDetail);
        const float value = std::clamp(zone.value_at(frame), 0.0f, 1.0f);
        std::transform(matte.data(), matte.data() + matte.size_bytes(), out.data(), out.data(),
                       [&](std::uint8_t m, float detail) {
                           return detail + static_cast<float>(m) / 255.0f * (value - detail);
                       });
    }
    return out;
}

void scale_light(Shading& shading, float reference, ViewF1 factor) {
    if (factor.empty()) return;
    constexpr float kLeast = 1e-4f;  // of the reference
    const int d = shading.downscale;
    parallel_rows(shading.value.height(), 16, [&](int j0, int j1) {
        for (int j = j0; j < j1; ++j) {
            for (int i = 0; i < shading.value.width(); ++i) {
                const int x1 = std::min((i + 1) * d, factor.width());
                const int y1 = std::min((j + 1) * d, factor.height());
                float sum = 0;
                for (int y = j * d; y < y1; ++y)
                    for (int x = i * d; x < x1; ++x)
                        sum += factor.at(x, y);
                const int count = (x1 - i * d) * (y1 - j * d);
                if (count <= 0) continue;
                float& s = shading.value.at(i, j);
                s = std::max(kLeast * reference,
                             reference + sum / static_cast<float>(count) * (s - reference));
            }
        }
    });
}

}  // namespace weft
