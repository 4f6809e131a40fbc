#include "app/render/analysis_key.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/render/stage_cache.h"
#include "engine/core/hash.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Increase this when the result of the analysis changes.
constexpr int kAnalysisVersion = 15;

void add_file(Hasher& hasher, const std::string& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    const auto time = fs::last_write_time(path, error).time_since_epoch().count();
    hasher.text(path)
        .value(static_cast<std::uint64_t>(error ? 0 : size))
        .value(static_cast<std::int64_t>(time));
}

Status add_pattern(Hasher& hasher, const std::string& text) {
    hasher.text(text);
    if (text.empty()) return {};
    WEFT_TRY(pattern, SequencePattern::parse(text));
    if (pattern.is_single()) {
        add_file(hasher, text);
        return {};
    }
    WEFT_TRY(frames, pattern.list_frames());
    for (const int frame : frames)
        add_file(hasher, pattern.path_for(frame));
    return {};
}

Status add_matte(Hasher& hasher, const MatteSource& matte, const PaintedMattes& painted) {
    WEFT_CHECK_OK(add_pattern(hasher, matte.files));
    for (const auto& [frame, key] : matte.keyframes) {
        hasher.value(frame);
        if (const auto unwritten = painted.find(key.path); unwritten != painted.end())
            hasher.text("in memory").text(key.path).image(*unwritten->second);
        else
            add_file(hasher, key.path);
    }
    hasher.value(matte.steadiness)
        .value(static_cast<int>(matte.propagate_direction))
        .value(matte.propagate_from.value_or(std::numeric_limits<int>::min()))
        .value(matte.propagate_to.value_or(std::numeric_limits<int>::max()));
    hasher.value(matte.select.value.value_or(-1))
        .text(matte.select.channel)
        .value(matte.select.invert)
        .text(matte.select.crypto);
    return {};
}

Status add_mattes(Hasher& hasher, const Region& region, const PaintedMattes& painted) {
    WEFT_CHECK_OK(add_matte(hasher, *region.matte, painted));
    for (const MatteSource& holdout : *region.holdouts)
        WEFT_CHECK_OK(add_matte(hasher, holdout, painted));
    // Of zones only what is propagated: their values are applied when a frame is rendered.
    for (const Zone& zone : *region.zones)
        if (zone.matte.files.empty()) WEFT_CHECK_OK(add_matte(hasher, zone.matte, painted));
    return {};
}

}  // namespace

Expected<std::string> region_key(const Shot& shot, std::size_t index,
                                 const PaintedMattes& painted) {
    const RegionPlan& plan = shot.plan.regions[index];
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    hasher.value(kAnalysisVersion)
        .text(shot.project.plate.layer)
        .value(shot.project.plate.movie_start);
    add_plate_stamps(hasher, *shot.plate);
    hasher.text(shot.spaces.plate.name).text(shot.spaces.working.name);
    hasher.value(static_cast<int>(shot.plan.quality));
    WEFT_CHECK_OK(add_mattes(hasher, region, painted));
    WEFT_CHECK_OK(add_pattern(hasher, region.motion.files));
    hasher.value(plan.motion_forward)
        .value(static_cast<int>(region.motion.convention))
        .text(region.motion.layer)
        .value(static_cast<int>(shot.project.plate.missing));
    for (const auto& [frame, quad] : plan.track) {
        hasher.value(frame);
        for (const glm::dvec2 corner : quad)
            hasher.value(corner.x).value(corner.y);
    }
    for (const int frame : plan.reference_frames)
        hasher.value(frame);
    for (const auto& [frame, pins] : plan.corrections) {
        hasher.value(frame);
        for (const SurfacePin& pin : pins)
            hasher.value(pin.from.x).value(pin.from.y).value(pin.to.x).value(pin.to.y);
    }
    hasher.value(static_cast<std::uint64_t>(plan.light_evidence.size()));
    for (const int frame : plan.light_evidence)
        hasher.value(frame);
    for (const int frame : plan.grain_frames)
        hasher.value(frame);
    hasher.value(plan.estimates_shutter());
    for (const int frame : plan.shutter_evidence)
        hasher.value(frame);
    hasher.value(static_cast<int>(plan.temporal));
    if (plan.temporal == TemporalMode::kPaper && plan.texture) {
        for (const ImageF3& further : plan.texture->also)
            hasher.image(further);
        hasher.value(static_cast<int>(plan.seam_cost)).value(plan.refine_passes).value(plan.align);
        hasher.value(plan.orientations.rotations).value(plan.orientations.mirror);
        hasher.image(plan.texture->pixels).value(shot.plan.seed).value(plan.random_key);
        hasher.value(plan.blend).value(plan.weight).value(plan.overlap_px).value(plan.feather_px);
        hasher.value(static_cast<int>(plan.seam))
            .value(plan.placement.scale)
            .value(plan.placement.rotate_deg);
        hasher.value(plan.placement.offset_px.x).value(plan.placement.offset_px.y);
        if (plan.placement.corners) {
            for (const Vec2 c : *plan.placement.corners)
                hasher.value(c.x).value(c.y);
        }
    }
    return hasher.finish().hex();
}

}  // namespace weft
