#include "engine/pipeline/region_light.h"

#include "engine/lighting/painted_light.h"

namespace weft {

Expected<ImageF3> ShotSource::light_pass(int /*region*/, int frame) const {
    return fail(ErrorCode::kRenderFailed,
                "The lighting pass of frame " + std::to_string(frame) + " is missing.");
}

Expected<ImageF3> ShotSource::positions(int /*region*/, int frame) const {
    return fail(ErrorCode::kRenderFailed,
                "The position pass of frame " + std::to_string(frame) + " is missing.");
}

Expected<NormalPass> ShotSource::normals(int /*region*/, int frame) const {
    return fail(ErrorCode::kRenderFailed,
                "The normal pass of frame " + std::to_string(frame) + " is missing.");
}

Expected<ImageF2> ShotSource::uv(int /*region*/, int frame) const {
    return fail(ErrorCode::kRenderFailed,
                "The UV pass of frame " + std::to_string(frame) + " is missing.");
}

Expected<std::optional<Shading>> region_shading(const ShotSource& source, const RegionPlan& region,
                                                const AnalysisStore& store, int index, int frame,
                                                const ImageF3& working) {
    using Found = Expected<std::optional<Shading>>;
    if (region.light_source == LightSource::kPainted)
        return Found(painted_shading(region.lamps, frame, source.size(), region.placement.aspect));
    if (region.light_source != LightSource::kPlate) return Found(std::nullopt);
    if (region.light_pass != RegionPlan::Pass::kNone) {
        WEFT_TRY(pass, source.light_pass(index, frame));
        return Found(region.light_pass == RegionPlan::Pass::kAlbedo
                         ? shading_from_albedo(working, pass)
                         : shading_from_lighting(pass, working));
    }
    if (!region.estimates_light()) return Found(std::nullopt);
    WEFT_TRY(bytes, store.get({index, frame, AnalysisKind::kShading}));
    WEFT_TRY(shading, decode_shading(bytes));
    return Found(std::move(shading));
}

}  // namespace weft
