#include "app/session/shot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/session/crypto_files.h"
#include "app/session/frame_plan.h"
#include "app/session/missing_frames.h"
#include "app/session/project_source.h"
#include "app/session/track_file.h"
#include "engine/core/frame_range.h"
#include "engine/core/hash.h"
#include "engine/media/sequence_pattern.h"
#include "engine/synthesis/texture_plane.h"
#include "texture_db/library.h"

namespace weft {
namespace {

// Of light on a display-referred plate: where a body turns away from the sun, a hundredth of its
// light is left.
constexpr float kLeastGain = 1.0f / 64;

constexpr const char* kSrgb = "srgb";
constexpr const char* kLinear = "linear";

bool float_depth(PixelDepth depth) {
    return depth == PixelDepth::kHalf || depth == PixelDepth::kFloat;
}

PlanePlacement plane_placement(const Placement& p) {
    PlanePlacement out;
    out.scale = static_cast<float>(p.scale);
    out.rotate_deg = static_cast<float>(p.rotate_deg);
    out.offset_px = {p.offset_px.x, p.offset_px.y};
    if (p.corners_px) {
        out.corners.emplace();
        for (std::size_t k = 0; k < 4; ++k)
            (*out.corners)[k] = {(*p.corners_px)[k].x, (*p.corners_px)[k].y};
    }
    return out;
}

// Opens a project step by step; each step leaves something in `shot_`.
class ShotOpener {
  public:
    ShotOpener(const Project& project, const OpenShotOptions& options) : options_(options) {
        shot_.project = project;
    }

    Expected<std::shared_ptr<const Shot>> open() {
        WEFT_CHECK_OK(open_plate_reader());
        WEFT_CHECK_OK(choose_spaces());
        WEFT_CHECK_OK(add_regions());
        return std::make_shared<const Shot>(std::move(shot_));
    }

  private:
    Status open_plate_reader() {
        const Plate& plate = shot_.project.plate;
        if (plate.path.empty())
            return fail(ErrorCode::kUsage, "No plate is set. Give one with --plate.");
        shot_.plate = options_.plate;
        if (!shot_.plate) {
            WEFT_TRY(reader, open_plate(plate.path, {plate.layer, plate.movie_start}));
            std::vector<int> wanted;
            if (!shot_.project.settings.frames.empty()) {
                WEFT_TRY(list, parse_frame_list(shot_.project.settings.frames));
                wanted = std::move(list);
            }
            shot_.plate =
                cached(with_missing_frames(reader, plate.missing, wanted), options_.cache_bytes);
        }
        for (const std::string& w : shot_.plate->warnings())
            shot_.warnings.push_back(w);
        shot_.plan.layers = !shot_.project.output.layers.empty();
        WEFT_TRY(frames, frames_to_render(shot_.project, *shot_.plate));
        shot_.plan.frames = std::move(frames);
        shot_.plan.quality = shot_.project.settings.quality == Quality::kDraft
                                 ? FlowQuality::kDraft
                                 : FlowQuality::kFinal;
        shot_.plan.seed = static_cast<std::uint64_t>(shot_.project.settings.seed);
        return {};
    }

    static Expected<ColorSpace> space(const std::string& given, const char* by_file_type) {
        return parse_color_space(given.empty() ? by_file_type : given);
    }

    Status choose_spaces() {
        const Project& p = shot_.project;
        WEFT_TRY(plate, space(p.plate.space, shot_.plate->display_encoded() ? kSrgb : kLinear));
        WEFT_TRY(working, space(p.color.working_space, kLinear));
        // Output of the plate's own kind keeps the plate's space, so that the plate passes through
        // untouched; another kind has its usual one.
        const bool float_out = float_depth(output_depth(p.output, shot_.plate->depth()));
        const bool same_kind = float_out == !shot_.plate->display_encoded();
        WEFT_TRY(out, same_kind && p.color.out_space.empty()
                          ? Expected<ColorSpace>(plate)
                          : space(p.color.out_space, float_out ? kLinear : kSrgb));
        shot_.spaces = {plate, working, out, {}};
        ShotPlan& plan = shot_.plan;
        plan.display_referred = !float_out;
        WEFT_TRY(working_from_plate, make_color_transform(plate, working));
        WEFT_TRY(display_from_plate, make_color_transform(plate, {kSrgb}));
        WEFT_TRY(out_from_working, make_color_transform(working, out));
        WEFT_TRY(out_from_plate, make_color_transform(plate, out));
        WEFT_TRY(working_from_display, make_color_transform({kSrgb}, working));
        WEFT_TRY(display_from_working, make_color_transform(working, {kSrgb}));
        plan.display_from_working = display_from_working;
        const PixelDepth depth = shot_.plate->depth();
        plan.plate_quantum = depth == PixelDepth::kU8    ? 1.0f / 255.0f
                             : depth == PixelDepth::kU16 ? 1.0f / 65535.0f
                                                         : 0.0f;
        plan.working_from_plate = working_from_plate;
        plan.display_from_plate = display_from_plate;
        plan.out_from_working = out_from_working;
        plan.out_from_plate = out_from_plate;
        working_from_display_ = working_from_display;
        return {};
    }

    // Frozen frames are keyframes that are read from their files, except where one is painted.
    static Status add_frozen_mattes(Region& region) {
        if (region.matte->frozen.empty()) return {};
        if (region.matte->frozen_files.empty() || !region.matte->files.empty()) {
            return fail(ErrorCode::kUsage,
                        "Frozen mattes need their files (--matte-frozen-files), and painted "
                        "keyframes (--matte FRAME=FILE) to be propagated beside them.");
        }
        WEFT_TRY(pattern, SequencePattern::parse(region.matte->frozen_files));
        region.matte = region.matte.with([&](MatteSource& matte) {
            for (const int frame : matte.frozen)
                matte.keyframes.try_emplace(frame, MatteKeyframe{pattern.path_for(frame), {}});
        });
        return {};
    }

    Status add_regions() {
        std::vector<Leaf<Region>> planned;
        for (std::size_t k = 0; k < shot_.project.regions.size(); ++k) {
            if (!shot_.project.regions[k]->enabled) continue;
            Status frozen;
            shot_.project.regions[k] = shot_.project.regions[k].with([&](Region& changed) {
                frozen = name_crypto_files(changed, shot_.project.plate.path);
                if (frozen) frozen = add_frozen_mattes(changed);
            });
            const Region& region = *shot_.project.regions[k];
            auto added = frozen ? add_region(region) : std::move(frozen);
            if (!added) return fail_in(std::move(added).error(), "Region '" + region.name + "'");
            shot_.region_index.push_back(k);
            planned.push_back(shot_.project.regions[k]);
        }
        shot_.cuts = std::make_shared<CutWatch>();
        shot_.source = make_project_source(shot_.plate, std::move(planned), shot_.cuts);
        return {};
    }

    static MatteReach reach_of(const MatteSource& matte) {
        MatteReach reach;
        reach.direction = matte.carry;
        if (matte.carry_from) reach.first = *matte.carry_from;
        if (matte.carry_to) reach.last = *matte.carry_to;
        return reach;
    }

    // Painted ones in their order among the painted, which names them in the analysis.
    static Status add_holdouts(const Region& region, RegionPlan& plan) {
        for (const MatteSource& holdout : *region.holdouts) {
            if (!holdout.files.empty()) {
                plan.has_holdout = true;
                continue;
            }
            if (holdout.keyframes.empty())
                return fail(ErrorCode::kUsage,
                            "A holdout has no matte. Give files or painted keyframes (--holdout), "
                            "or remove it.");
            PaintedHoldout painted;
            for (const auto& [frame, key] : holdout.keyframes)
                painted.keys.push_back(frame);
            painted.steadiness = static_cast<float>(holdout.steadiness);
            painted.reach = reach_of(holdout);
            plan.painted_holdouts.push_back(std::move(painted));
        }
        return {};
    }

    Status add_region(const Region& region) {
        RegionPlan plan;
        plan.random_key = region.id;
        if (region.matte->empty()) {
            return fail(ErrorCode::kUsage,
                        "It has no matte. Give files or painted keyframes (--matte).");
        }
        for (const auto& [frame, key] : region.matte->keyframes)
            plan.matte_keys.push_back(frame);
        plan.matte_steadiness = static_cast<float>(region.matte->steadiness);
        plan.matte_reach = reach_of(*region.matte);
        WEFT_CHECK_OK(add_holdouts(region, plan));
        plan.reference_frames = region.reference_frames;
        if (plan.reference_frames.empty()) {
            WEFT_TRY(first, default_reference(region, plan));
            plan.reference_frames = {first};
        }
        // Where the artist has put the texture back in place, it is anchored too.
        for (const auto& [frame, pins] : region.corrections) {
            for (const CorrectionPin& pin : pins)
                plan.corrections[frame].push_back({{pin.from.x, pin.from.y}, {pin.to.x, pin.to.y}});
            auto& frames = plan.reference_frames;
            if (std::find(frames.begin(), frames.end(), frame) == frames.end())
                frames.push_back(frame);
        }
        plan.true_motion = !region.motion.files.empty();
        plan.motion_forward = region.motion.direction == MotionDirection::kForward;
        WEFT_CHECK_OK(add_track(region.motion, plan));
        plan.placement = plane_placement(region.placement);
        WEFT_CHECK_OK(add_placement_keys(region, plan));
        WEFT_CHECK_OK(plane_from_plate(plan.placement));
        plan.has_uv = !region.placement.uv.empty();
        if (plan.has_uv && region.temporal.mode != TemporalMode::kLocked) {
            return fail(ErrorCode::kUsage,
                        "A UV pass needs --temporal locked: the other modes make the texture "
                        "where it lies.");
        }
        plan.seam = region.synthesis.seam;
        plan.overlap_px = region.synthesis.overlap_px;
        plan.feather_px = region.synthesis.feather_px;
        plan.seam_cost = region.synthesis.seam_cost;
        plan.refine_passes = region.synthesis.refine;
        plan.orientations = {region.synthesis.rotations, region.synthesis.mirror};
        plan.align = region.synthesis.align;
        plan.amendments = *region.amendments;
        plan.temporal = region.temporal.mode;
        plan.blend = static_cast<float>(region.temporal.blend);
        plan.weight = static_cast<float>(region.temporal.weight);
        plan.light_source = region.light.source;
        plan.light = {region.light.form, static_cast<float>(region.light.strength)};
        plan.light.least_gain = kLeastGain;
        if (!shot_.plan.display_referred)
            plan.light.least_gain = 0, plan.light.most_gain = std::numeric_limits<float>::max();
        WEFT_CHECK_OK(add_light(region.light, plan));
        const bool final = shot_.plan.quality == FlowQuality::kFinal;
        plan.grain = final ? static_cast<float>(region.finish.grain) : 0.0f;
        plan.focus = final ? static_cast<float>(region.finish.focus) : 0.0f;
        plan.has_depth = plan.focus > 0 && !region.finish.depth.empty();
        WEFT_TRY(metered, grain_frames(region, plan, *shot_.plate));
        plan.grain_frames = std::move(metered);
        if (!final)
            plan.shutter_deg = 0.0f;
        else if (region.finish.shutter_deg)
            plan.shutter_deg = static_cast<float>(*region.finish.shutter_deg);
        else
            plan.shutter_deg.reset();
        WEFT_TRY(blurred, shutter_frames(region, plan, *shot_.plate));
        plan.shutter_evidence = std::move(blurred);
        WEFT_TRY(evidence, light_evidence(region, plan, shot_.plan, *shot_.plate));
        plan.light_evidence = std::move(evidence);
        plan.has_lines = !region.lines.files.empty();
        plan.extract_lines = region.lines.extract && !plan.has_lines;
        plan.line_width_px = static_cast<float>(region.lines.width_px);
        if (options_.textures) {
            WEFT_CHECK_OK(add_texture(region, plan));
            WEFT_CHECK_OK(add_light_picture(region, plan));
        }
        WEFT_CHECK_OK(check_files(region, plan, shot_.plan, *shot_.plate));
        shot_.plan.regions.push_back(std::move(plan));
        return {};
    }

    // The first painted frame where mattes are propagated, since there the artist has looked; else
    // the first frame that the plate and the matte have, whatever part of it is rendered: every
    // part of a shot, on every machine, has the same reference.
    [[nodiscard]] Expected<int> default_reference(const Region& region,
                                                  const RegionPlan& plan) const {
        if (plan.propagated()) return plan.matte_keys.front();
        WEFT_TRY(pattern, SequencePattern::parse(region.matte->files));
        if (pattern.is_single()) return shot_.plate->frames().front();
        WEFT_TRY(mattes, pattern.list_frames());
        for (const int frame : shot_.plate->frames()) {
            if (std::binary_search(mattes.begin(), mattes.end(), frame)) return frame;
        }
        return fail(ErrorCode::kMissingFrames,
                    "The matte " + region.matte->files +
                        " has no file for any frame of the plate, which has " +
                        frames_text(shot_.plate->frames()) +
                        ". Check the pattern and its numbers.");
    }

    struct ReadTexture {
        PlateFrame picture;
        TextureCredit credit;
    };
    // A picture file, or "db:ID" for a sample of a texture library.
    [[nodiscard]] Expected<ReadTexture> read_texture(const std::string& path) const {
        ReadTexture out;
        if (!names_library_texture(path)) {
            WEFT_TRY(picture, read_image(path));
            out.picture = std::move(picture);
            if (auto credit = read_texture_credit(path)) out.credit = std::move(*credit);
            return out;
        }
        WEFT_TRY(resolved, resolve_texture(options_.texture_library, path));
        out.credit = std::move(resolved.credit);
        out.picture.rgb = ImageF3(resolved.pixels.size());
        std::transform(
            resolved.pixels.data(), resolved.pixels.data() + resolved.pixels.size_bytes(),
            out.picture.rgb.data(), [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
        return out;
    }

    struct OpenTexture {
        ImageF3 pixels;
        ColorSpace space;
        ShotTexture named;
    };
    Expected<OpenTexture> open_texture(const Region& region, const std::string& path, bool is_plane,
                                       int overlap_px) {
        WEFT_TRY(read, read_texture(path));
        auto& [picture, credit] = read;
        if (!is_plane) {
            // Now, not after minutes of analysis.
            if (const Status fits = check_sample(picture.rgb.size(), overlap_px); !fits)
                return fail_in(fits.error(), path);
        }
        const std::string& given =
            region.texture.space.empty() ? shot_.project.color.texture_space : region.texture.space;
        WEFT_TRY(texture_space, space(given, float_depth(picture.depth) ? kLinear : kSrgb));
        if (picture.nonfinite > 0) {
            shot_.warnings.push_back("The texture " + path + " has " +
                                     std::to_string(picture.nonfinite) +
                                     " pixels of NaN or infinity; they are taken as black.");
        }
        OpenTexture out;
        out.pixels = std::move(picture.rgb);
        out.space = texture_space;
        for (int k = 0; k < out.pixels.height(); ++k) {
            float* row = out.pixels.row(k);
            std::replace_if(
                row, row + out.pixels.stride(), [](float v) { return !std::isfinite(v); }, 0.0f);
        }
        Hasher hasher;
        hasher.image(out.pixels);
        out.named = {region.name, path,          hasher.finish().hex(), out.pixels.size(), is_plane,
                     credit.id,   credit.author, credit.licence,        credit.source,     {}};
        return out;
    }

    Status add_texture(const Region& region, RegionPlan& plan) {
        const bool is_plane = !region.texture.plane.empty();
        const std::string& path = is_plane ? region.texture.plane : region.texture.sample;
        if (path.empty()) {
            return fail(ErrorCode::kUsage,
                        "It has no texture. Give a sample (--texture) or a plane (--plane).");
        }
        WEFT_TRY(first, open_texture(region, path, is_plane, plan.overlap_px));
        const ColorSpace texture_space = first.space;
        WEFT_TRY(working_from_texture, make_color_transform(texture_space, shot_.spaces.working));
        WEFT_TRY(display_from_texture, make_color_transform(texture_space, {kSrgb}));
        auto texture = std::make_shared<TexturePicture>();
        texture->pixels = std::move(first.pixels);
        texture->is_plane = is_plane;
        texture->wrap = region.texture.wrap;
        if (is_plane && region.placement.fit)
            plan.placement.picture_texels = texture->pixels.size();
        for (const std::string& further : region.texture.also) {
            if (is_plane) break;
            WEFT_TRY(sample, open_texture(region, further, false, plan.overlap_px));
            // One space for all: the first one's.
            WEFT_TRY(to_first, make_color_transform(sample.space, texture_space));
            to_first->apply(sample.pixels);
            texture->also.push_back(std::move(sample.pixels));
            first.named.also.push_back(std::move(sample.named));
        }
        shot_.textures.push_back(std::move(first.named));
        shot_.spaces.textures.push_back(texture_space);
        plan.texture = std::move(texture);
        plan.working_from_texture = working_from_texture;
        plan.display_from_texture = display_from_texture;
        plan.working_from_display = working_from_display_;
        return {};
    }

    [[nodiscard]] Status add_track(const MotionSource& motion, RegionPlan& plan) const {
        if (motion.track.empty()) return {};
        if (plan.true_motion) {
            return fail(ErrorCode::kUsage,
                        "It has both a track and files of true motion. Give one of --track and "
                        "--motion.");
        }
        WEFT_TRY(track, read_corner_track(motion.track,
                                          {shot_.plate->size(), shot_.plate->frames().front()}));
        plan.track = std::move(track);
        return {};
    }

    static Status add_placement_keys(const Region& region, RegionPlan& plan) {
        const Placement& given = region.placement;
        const auto read = [](const std::string& text, std::size_t count,
                             const char* flag) -> Expected<KeyedNumbers> {
            auto keys = parse_keyed_number(text, count);
            if (!keys) return fail_in(std::move(keys).error(), flag);
            return keys;
        };
        WEFT_TRY(scale, read(given.scale_keys, 1, "--scale-keys"));
        WEFT_TRY(rotate, read(given.rotate_keys, 1, "--rotate-keys"));
        WEFT_TRY(offset, read(given.offset_keys, 2, "--offset-keys"));
        for (const auto& [frame, values] : scale.keys) {
            if (!(values[0] >= 0.001f))
                return fail(ErrorCode::kUsage, "--scale-keys: a scale must be 0.001 or more");
        }
        plan.scale_keys = std::move(scale);
        plan.rotate_keys = std::move(rotate);
        plan.offset_keys = std::move(offset);
        if (plan.placement_moves() && region.temporal.mode != TemporalMode::kLocked) {
            return fail(ErrorCode::kUsage,
                        "A placement with keys needs --temporal locked: the other modes make the "
                        "texture where it lies.");
        }
        const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
        if (!plan.scale_keys.empty()) {
            const auto& keys = plan.scale_keys.keys;
            plan.placement.scale = std::min_element(keys.begin(), keys.end(), smaller)->second[0];
        }
        return {};
    }

    static Status add_light(const LightParams& light, RegionPlan& plan) {
        auto keys = parse_keyed_number(light.strength_keys);
        if (!keys) return fail_in(std::move(keys).error(), "--light-keys");
        plan.strength_keys = std::move(*keys);
        for (auto& [frame, values] : plan.strength_keys.keys)
            values[0] = std::clamp(values[0], 0.0f, 1.0f);
        auto lamps = parse_lamps(light.lamps);
        if (!lamps) return fail_in(std::move(lamps).error(), "--lamps");
        plan.lamps = std::move(*lamps);
        if (light.source == LightSource::kPainted && plan.lamps.empty())
            return fail(ErrorCode::kUsage, "Painted light needs lamps. Give them with --lamps.");
        plan.cast = static_cast<float>(light.cast);
        plan.highlights = static_cast<float>(light.highlights);
        plan.light_pass = !light.lighting.empty() ? RegionPlan::Pass::kLighting
                          : !light.albedo.empty() ? RegionPlan::Pass::kAlbedo
                                                  : RegionPlan::Pass::kNone;
        plan.exact_light = light.exact;
        if (light.exact && plan.light_pass == RegionPlan::Pass::kNone) {
            return fail(ErrorCode::kUsage,
                        "--light-exact needs a pass. Give one with --albedo or --lighting.");
        }
        return {};
    }

    Status add_light_picture(const Region& region, RegionPlan& plan) {
        if (plan.light_source != LightSource::kImage) return {};
        if (region.light.image.empty()) {
            return fail(ErrorCode::kUsage,
                        "The light source 'image' needs a picture. Give one with --light PICTURE.");
        }
        WEFT_TRY(picture, read_image(region.light.image));
        WEFT_TRY(to_linear,
                 make_color_transform({float_depth(picture.depth) ? kLinear : kSrgb}, {kLinear}));
        to_linear->apply(picture.rgb);
        plan.light_picture = std::make_shared<const ImageF3>(std::move(picture.rgb));
        return {};
    }

    OpenShotOptions options_;
    Shot shot_;
    std::shared_ptr<const ColorTransform> working_from_display_;
};

}  // namespace

Expected<std::shared_ptr<const Shot>> open_shot(const Project& project,
                                                const OpenShotOptions& options) {
    return ShotOpener(project, options).open();
}

}  // namespace weft
