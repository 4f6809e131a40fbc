#include "app/cache/analysis_key.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/cache/stage_cache.h"
#include "app/shot/drawn_mattes.h"
#include "app/shot/form_files.h"
#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Increase this when the result of the analysis changes.
constexpr int kAnalysisVersion = 36;
constexpr int kFormVersion = 5;   // of the form alone
constexpr int kFocusVersion = 1;  // of the focus alone

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

// By its contents: saving a project elsewhere takes its painted mattes along, and their analysis is
// worth keeping.
void add_painted(Hasher& hasher, int frame, const std::string& path, const PaintedMattes& painted) {
    hasher.value(frame);
    if (const auto unwritten = painted.find(path); unwritten != painted.end()) {
        hasher.text("in memory").text(path).image(*unwritten->second);
    } else if (const auto contents = hash_of_contents(path)) {
        hasher.text("painted").value(contents->high).value(contents->low);
    } else {
        hasher.text("not there").text(path);
    }
}

// What is confirmed on the frames of [first, last).
void add_confirmed(Hasher& hasher, const MatteSource& matte, int first, int last,
                   const PaintedMattes& painted) {
    for (const auto& [frame, edge] : matte.confirmed) {
        if (frame < first || frame >= last || matte.keyframes.contains(frame)) continue;
        add_painted(hasher.text("confirmed"), frame, edge.path, painted);
        add_painted(hasher, frame, edge.area, painted);
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

Status add_matte(Hasher& hasher, const MatteSource& matte, const PaintedMattes& painted) {
    WEFT_CHECK_OK(add_pattern(hasher, matte.files));
    for (const auto& [frame, key] : matte.keyframes)
        add_painted(hasher, frame, key.path, painted);
    add_confirmed(hasher, matte, std::numeric_limits<int>::min(), std::numeric_limits<int>::max(),
                  painted);
    if (!matte.shape.empty()) {
        add_shape(hasher.text("shape"), matte.shape);
        if (matte.shape.follow != ShapeFollow::kNone) add_file(hasher, matte.shape.track);
    }
    add_settings(hasher, matte);
    return {};
}

Status add_mattes(Hasher& hasher, const Region& region, const PaintedMattes& painted) {
    WEFT_CHECK_OK(add_matte(hasher, *region.matte, painted));
    for (const MatteSource& holdout : *region.holdouts)
        WEFT_CHECK_OK(add_matte(hasher, holdout, painted));
    return {};
}

// What every part of the analysis depends on.
void add_plate(Hasher& hasher, const Shot& shot) {
    hasher.value(kAnalysisVersion)
        .text(shot.project.plate.layer)
        .value(shot.project.plate.movie_start);
    add_plate_stamps(hasher, *shot.plate);
    hasher.text(shot.spaces.plate.name)
        .value(static_cast<int>(shot.project.plate.missing))
        .value(static_cast<int>(shot.plan.quality));
}

// The keys of what is propagated from a layer's keyframes. `in_front`: the holdouts that hide some
// of it.
Expected<RegionKeys::Layer> matte_keys(const Shot& shot, const MatteSource& matte,
                                       const std::vector<MatteSource>& in_front,
                                       const PaintedMattes& painted) {
    Hasher common;
    add_plate(common, shot);
    add_settings(common.text("matte"), matte);
    for (const MatteSource& holdout : in_front)
        WEFT_CHECK_OK(add_matte(common, holdout, painted));
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
            add_painted(hasher, frame, key.path, painted);
            from = frame;
        }
        if (after != end) {
            add_painted(hasher, after->first, after->second.path, painted);
            to = after->first;
        }
        add_confirmed(hasher, matte, from, to, painted);
        out.stretches.push_back(hasher.finish().hex());
        if (after == end) return out;
    }
}

Expected<std::map<int, RegionKeys::Layer>> all_matte_keys(const Shot& shot, const Region& region,
                                                          const PaintedMattes& painted) {
    std::map<int, RegionKeys::Layer> out;
    const auto add = [&](int layer, const MatteSource& matte) -> Status {
        if (matte.keyframes.empty()) return {};
        const bool holdout = layer > 0;
        WEFT_TRY(keys,
                 matte_keys(shot, matte, holdout ? std::vector<MatteSource>() : *region.holdouts,
                            painted));
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

Expected<std::string> surface_key(const Shot& shot, std::size_t index,
                                  const PaintedMattes& painted) {
    const RegionPlan& plan = shot.plan.regions[index];
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    add_plate(hasher, shot);
    hasher.text(shot.spaces.working.name);
    WEFT_CHECK_OK(add_mattes(hasher, region, painted));
    WEFT_CHECK_OK(add_pattern(hasher, region.motion.files));
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

// Of what is followed around zones: apart from the surface, which does not depend on it.
Expected<std::map<int, std::string>> around_keys(const Shot& shot, const Region& region,
                                                 const std::string& surface,
                                                 const PaintedMattes& painted) {
    std::map<int, std::string> out;
    for (int zone = 0; zone < static_cast<int>(region.zones->size()); ++zone) {
        const Zone& of = (*region.zones)[static_cast<std::size_t>(zone)];
        if (of.kind != ZoneKind::kSurroundings) continue;
        Hasher hasher;
        add_plate(hasher, shot);
        hasher.text("around").text(surface);
        WEFT_CHECK_OK(add_matte(hasher, of.matte, painted));
        out[zone_layer(zone)] = hasher.finish().hex();
    }
    return out;
}

// Apart from the rest, so that another form does not make the surface be followed again.
Expected<std::string> form_key(const Shot& shot, std::size_t index, const std::string& surface,
                               const PaintedMattes& painted) {
    const RegionPlan& plan = shot.plan.regions[index];
    if (plan.form_from == RegionPlan::FormFrom::kNothing) return surface;
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    hasher.text("form").value(kFormVersion).text(surface);
    add_form_settings(hasher, region);
    if (reads_form(plan.form_from)) WEFT_CHECK_OK(add_pattern(hasher, form_files(region).pattern));
    for (const int frame : plan.form_evidence)
        hasher.value(frame);
    // The regions of a shot find its lens together.
    for (std::size_t k = 0; plan.shares_lens() && k < shot.plan.regions.size(); ++k) {
        const RegionPlan& other = shot.plan.regions[k];
        if (k == index || !other.shares_lens()) continue;
        WEFT_TRY(beside, surface_key(shot, k, painted));
        hasher.text(beside);
        for (const int frame : other.form_evidence)
            hasher.value(frame);
    }
    return hasher.finish().hex();
}

// Apart from the rest too. What is read on a frame does not depend on the frames to be rendered.
Expected<std::string> focus_key(const Shot& shot, std::size_t index, const PaintedMattes& painted) {
    const RegionPlan& plan = shot.plan.regions[index];
    const Region& region = *shot.project.regions[shot.region_index[index]];
    Hasher hasher;
    add_plate(hasher, shot);
    hasher.text("focus").value(kFocusVersion).text(shot.spaces.working.name);
    WEFT_CHECK_OK(add_mattes(hasher, region, painted));
    WEFT_CHECK_OK(add_pattern(hasher, region.finish.depth));
    // The light, whose edges do not count.
    const bool passes = plan.light_pass != RegionPlan::Pass::kNone && plan.lights();
    hasher.value(plan.estimates_light()).value(passes).value(plan.detail);
    if (passes) {
        WEFT_CHECK_OK(add_pattern(hasher, region.light.albedo));
        WEFT_CHECK_OK(add_pattern(hasher, region.light.lighting));
    }
    for (const Zone& zone : *region.zones) {
        if (zone.kind != ZoneKind::kDetail) continue;
        WEFT_CHECK_OK(add_matte(hasher, zone.matte, painted));
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
    const bool matte = key.kind == AnalysisKind::kMatte || key.kind == AnalysisKind::kMatteForward;
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
    WEFT_TRY(surface, surface_key(shot, index, painted));
    const Region& region = *shot.project.regions[shot.region_index[index]];
    WEFT_TRY(form, form_key(shot, index, surface, painted));
    WEFT_TRY(focus, focus_key(shot, index, painted));
    WEFT_TRY(around, around_keys(shot, region, surface, painted));
    WEFT_TRY(mattes, all_matte_keys(shot, region, painted));
    return RegionKeys{std::move(surface), std::move(form), std::move(focus), std::move(mattes),
                      std::move(around)};
}

}  // namespace weft
