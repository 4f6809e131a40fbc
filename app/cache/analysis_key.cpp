#include "app/cache/analysis_key.h"

#include <algorithm>
#include <limits>

#include "app/cache/stage_cache.h"
#include "app/shot/drawn_mattes.h"
#include "app/shot/form_files.h"
#include "engine/core/hash.h"
#include "engine/media/plates.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// Increase this when the result of the analysis changes.
constexpr int kAnalysisVersion = 68;
constexpr int kFormVersion = 10;  // of the form alone
constexpr int kFocusVersion = 2;  // of the focus alone

// What keys know files by.
struct Files {
    Fingerprints& known;
    const PaintedMattes& painted;  // those without a file
    int first_frame;               // of the plate
    PixelAspect aspect;            // likewise
};

void add(Hasher& hasher, const Expected<Hash128>& file) {
    if (file)
        hasher.text("file").value(file->high).value(file->low);
    else
        hasher.text("not there");
}

// By its contents: saving a project elsewhere takes its painted mattes along, and their analysis is
// worth keeping.
void add_file(Hasher& hasher, const std::string& path, const Files& files) {
    add(hasher, files.known.contents(path));
}

Status add_pattern(Hasher& hasher, const std::string& text, const Files& files) {
    hasher.value(!text.empty());
    if (text.empty()) return {};
    WEFT_TRY(pattern, SequencePattern::parse(text));
    hasher.value(pattern.is_single());
    if (pattern.is_single()) {
        // A movie's first frame is that of the plate.
        if (has_movie_extension(text)) hasher.value(files.first_frame);
        add_file(hasher, text, files);
        return {};
    }
    WEFT_TRY(frames, pattern.list_frames());
    hasher.value(static_cast<std::uint64_t>(frames.size()));
    for (const int frame : frames)
        add(hasher.value(frame), files.known.id(pattern.path_for(frame)));
    return {};
}

void add_painted(Hasher& hasher, int frame, const std::string& path, const Files& files) {
    hasher.value(frame);
    const auto unwritten = files.painted.find(path);
    if (unwritten == files.painted.end())
        add_file(hasher, path, files);
    else
        hasher.text("in memory").text(path).image(*unwritten->second);
}

// What is confirmed on the frames of [first, last).
void add_confirmed(Hasher& hasher, const MatteSource& matte, int first, int last,
                   const Files& files) {
    for (const auto& [frame, edge] : matte.confirmed) {
        if (frame < first || frame >= last || matte.keyframes.contains(frame)) continue;
        add_painted(hasher.text("confirmed"), frame, edge.path, files);
        add_painted(hasher, frame, edge.area, files);
    }
}

void add_settings(Hasher& hasher, const MatteSource& matte) {
    hasher.value(matte.steadiness)
        .value(static_cast<int>(matte.propagate_direction))
        .value(matte.propagate_from.value_or(std::numeric_limits<int>::min()))
        .value(matte.propagate_to.value_or(std::numeric_limits<int>::max()));
    hasher.value(matte.select.value.value_or(-1))
        .text(matte.select.channel)
        .value(matte.select.invert)
        .text(matte.select.crypto);
}

Status add_matte(Hasher& hasher, const MatteSource& matte, const Files& files) {
    WEFT_CHECK_OK(add_pattern(hasher, matte.files, files));
    for (const auto& [frame, key] : matte.keyframes)
        add_painted(hasher, frame, key.path, files);
    add_confirmed(hasher, matte, std::numeric_limits<int>::min(), std::numeric_limits<int>::max(),
                  files);
    if (!matte.shape.empty()) {
        add_shape(hasher.text("shape"), matte.shape);
        if (!files.aspect.square()) hasher.value(files.aspect.ratio());
        if (matte.shape.follow != ShapeFollow::kNone) add_file(hasher, matte.shape.track, files);
    }
    add_settings(hasher, matte);
    return {};
}

Status add_mattes(Hasher& hasher, const Region& region, const Files& files) {
    WEFT_CHECK_OK(add_matte(hasher, *region.matte, files));
    for (const MatteSource& holdout : *region.holdouts)
        WEFT_CHECK_OK(add_matte(hasher, holdout, files));
    return {};
}

// What every part of the analysis depends on.
void add_plate(Hasher& hasher, const Shot& shot) {
    hasher.value(kAnalysisVersion)
        .text(shot.project.plate.layer)
        .value(shot.project.plate.movie_start);
    add_plate_ids(hasher, shot);
    hasher.text(shot.spaces.plate.name).value(static_cast<int>(shot.project.plate.missing));
}

// And what light, gloss and focus depend on; mattes are those of any quality.
void add_quality(Hasher& hasher, const Shot& shot) {
    hasher.value(static_cast<int>(shot.plan.quality));
}

// The keys of what is propagated from a layer's keyframes. `in_front`: the holdouts that hide some
// of it.
Expected<RegionKeys::Layer> matte_keys(const Shot& shot, const MatteSource& matte,
                                       const std::vector<MatteSource>& in_front,
                                       const Files& files) {
    Hasher common;
    add_plate(common, shot);
    add_settings(common.text("matte"), matte);
    for (const MatteSource& holdout : in_front)
        WEFT_CHECK_OK(add_matte(common, holdout, files));
    const Hash128 same = common.finish();
    RegionKeys::Layer out;
    const auto first = matte.keyframes.begin(), end = matte.keyframes.end();
    for (auto after = first;; ++after) {
        Hasher hasher;
        hasher.value(same.high).value(same.low).value(after == first).value(after == end);
        int from = std::numeric_limits<int>::min(), to = std::numeric_limits<int>::max();
        if (after != first) {
            const auto& [frame, key] = *std::prev(after);
            out.keyframes.push_back(frame);
            add_painted(hasher, frame, key.path, files);
            from = frame;
        }
        if (after != end) {
            add_painted(hasher, after->first, after->second.path, files);
            to = after->first;
        }
        add_confirmed(hasher, matte, from, to, files);
        out.stretches.push_back(hasher.finish().hex());
        if (after == end) return out;
    }
}

Expected<std::map<int, RegionKeys::Layer>> all_matte_keys(const Shot& shot, const Region& region,
                                                          const Files& files) {
    std::map<int, RegionKeys::Layer> out;
    const auto add = [&](int layer, const MatteSource& matte) -> Status {
        if (matte.keyframes.empty()) return {};
        const bool holdout = layer > 0;
        WEFT_TRY(keys, matte_keys(shot, matte,
                                  holdout ? std::vector<MatteSource>() : *region.holdouts, files));
        out[layer] = std::move(keys);
        return {};
    };
    WEFT_CHECK_OK(add(0, *region.matte));
    int holdout = 0;
    for (const MatteSource& matte : *region.holdouts)
        if (!matte.by_frame()) WEFT_CHECK_OK(add(++holdout, matte));
    for (int zone = 0; zone < static_cast<int>(region.zones->size()); ++zone)
        WEFT_CHECK_OK(add(zone_layer(zone), (*region.zones)[static_cast<std::size_t>(zone)].matte));
    return out;
}

Expected<std::string> surface_key(const Shot& shot, std::size_t index, const Files& files) {
    const RegionPlan& plan = shot.plan.regions[index];
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    add_plate(hasher, shot);
    add_quality(hasher, shot);
    hasher.text(shot.spaces.working.name);
    WEFT_CHECK_OK(add_mattes(hasher, region, files));
    WEFT_CHECK_OK(add_pattern(hasher, region.motion.files, files));
    hasher.value(plan.motion_forward)
        .value(static_cast<int>(region.motion.convention))
        .text(region.motion.layer);
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
    hasher.value(static_cast<int>(plan.temporal)).value(static_cast<int>(plan.surface));
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
        if (!plan.placement.aspect.square()) hasher.value(plan.placement.aspect.ratio());
        if (plan.placement.corners) {
            for (const Vec2 c : *plan.placement.corners)
                hasher.value(c.x).value(c.y);
        }
    }
    return hasher.finish().hex();
}

// Of what is followed around zones: apart from the surface, which does not depend on it.
Expected<std::map<int, std::string>> around_keys(const Shot& shot, const Region& region,
                                                 const std::string& surface, const Files& files) {
    std::map<int, std::string> out;
    for (int zone = 0; zone < static_cast<int>(region.zones->size()); ++zone) {
        const Zone& of = (*region.zones)[static_cast<std::size_t>(zone)];
        if (of.kind != ZoneKind::kSurroundings) continue;
        Hasher hasher;
        add_plate(hasher, shot);
        hasher.text("around").text(surface);
        WEFT_CHECK_OK(add_matte(hasher, of.matte, files));
        out[zone_layer(zone)] = hasher.finish().hex();
    }
    return out;
}

// Apart from the rest, so that another form does not make the surface be followed again.
Expected<std::string> form_key(const Shot& shot, std::size_t index, const std::string& surface,
                               const Files& files) {
    const RegionPlan& plan = shot.plan.regions[index];
    if (plan.form_from == RegionPlan::FormFrom::kNothing) return surface;
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    hasher.text("form").value(kFormVersion).text(surface);
    add_form_settings(hasher, region);
    hasher.value(plan.placement.aspect.ratio());
    if (reads_form(plan.form_from))
        WEFT_CHECK_OK(add_pattern(hasher, form_files(region).pattern, files));
    for (const int frame : plan.form_evidence)
        hasher.value(frame);
    // The regions of a shot find its lens together.
    for (std::size_t k = 0; plan.shares_lens() && k < shot.plan.regions.size(); ++k) {
        const RegionPlan& other = shot.plan.regions[k];
        if (k == index || !other.shares_lens()) continue;
        WEFT_TRY(beside, surface_key(shot, k, files));
        hasher.text(beside);
        for (const int frame : other.form_evidence)
            hasher.value(frame);
    }
    return hasher.finish().hex();
}

// Apart from the rest too. What is read on a frame does not depend on the frames to be rendered.
Expected<std::string> focus_key(const Shot& shot, std::size_t index, const Files& files) {
    const RegionPlan& plan = shot.plan.regions[index];
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    add_plate(hasher, shot);
    add_quality(hasher, shot);
    hasher.text("focus").value(kFocusVersion).text(shot.spaces.working.name);
    WEFT_CHECK_OK(add_mattes(hasher, region, files));
    WEFT_CHECK_OK(add_pattern(hasher, region.finish.depth, files));
    hasher.text(region.finish.depth_layer);
    // The light, whose edges do not count.
    const bool passes = plan.light_pass != RegionPlan::Pass::kNone && plan.lights();
    hasher.value(plan.estimates_light()).value(passes).value(plan.detail);
    if (passes) {
        WEFT_CHECK_OK(add_pattern(hasher, region.light.albedo, files));
        WEFT_CHECK_OK(add_pattern(hasher, region.light.lighting, files));
        hasher.text(region.light.pass_layer);
    }
    for (const Zone& zone : *region.zones) {
        if (zone.kind != ZoneKind::kDetail) continue;
        WEFT_CHECK_OK(add_matte(hasher, zone.matte, files));
        hasher.value(zone.value);
        for (const NumberKey& key : zone.value_keys.keys) {
            hasher.value(key.frame).value(static_cast<int>(key.after));
            for (const double value : key.numbers)
                hasher.value(value);
        }
    }
    return hasher.finish().hex();
}

}  // namespace

const std::string& RegionKeys::Layer::at(int frame) const {
    const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), frame);
    return stretches[static_cast<std::size_t>(after - keyframes.begin())];
}

const std::string& RegionKeys::of(const AnalysisKey& key) const {
    if (key.kind == AnalysisKind::kForm) return form;
    if (key.kind == AnalysisKind::kFocus) return focus;
    if (key.kind == AnalysisKind::kCoords && is_zone_layer(key.layer)) return around.at(key.layer);
    const bool matte = key.kind == AnalysisKind::kMatte ||
                       key.kind == AnalysisKind::kMatteForward ||
                       key.kind == AnalysisKind::kMatteBackward;
    const auto layer = matte ? mattes.find(key.layer) : mattes.end();
    return layer == mattes.end() ? surface : layer->second.at(key.frame);
}

std::vector<std::string> RegionKeys::all() const {
    std::vector<std::string> out{surface, form, focus};
    for (const auto& [layer, key] : around)
        out.push_back(key);
    for (const auto& [layer, keys] : mattes)
        out.insert(out.end(), keys.stretches.begin(), keys.stretches.end());
    return out;
}

void RegionKeys::adopt(
    const RegionKeys& now,
    const std::function<bool(const std::string& from, const std::string& to)>& move) {
    const auto take = [&](std::string& old, const std::string& other) {
        if (move(old, other)) old = other;
    };
    take(surface, now.surface);
    take(form, now.form);
    take(focus, now.focus);
    for (auto& [layer, key] : around)
        if (const auto other = now.around.find(layer); other != now.around.end())
            take(key, other->second);
    for (auto& [layer, keys] : mattes) {
        const auto other = now.mattes.find(layer);
        if (other == now.mattes.end() || other->second.keyframes != keys.keyframes) continue;
        for (std::size_t i = 0; i < keys.stretches.size(); ++i)
            take(keys.stretches[i], other->second.stretches[i]);
    }
}

Expected<RegionKeys> region_keys(const Shot& shot, std::size_t index,
                                 const PaintedMattes& painted) {
    const FrameReader& plate = *shot.plate;
    const Files files{*shot.files, painted, plate.shown_frame(plate.frames().front()),
                      PixelAspect(plate.pixel_aspect())};
    WEFT_TRY(surface, surface_key(shot, index, files));
    const Region& region = *shot.project.regions[shot.region_index[index]];
    WEFT_TRY(form, form_key(shot, index, surface, files));
    WEFT_TRY(focus, focus_key(shot, index, files));
    WEFT_TRY(around, around_keys(shot, region, surface, files));
    WEFT_TRY(mattes, all_matte_keys(shot, region, files));
    return RegionKeys{std::move(surface), std::move(form), std::move(focus), std::move(mattes),
                      std::move(around)};
}

}  // namespace weft
