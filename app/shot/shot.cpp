#include "app/shot/shot.h"

#include <algorithm>
#include <cmath>

#include "app/exchange/crypto_files.h"
#include "app/exchange/track_file.h"
#include "app/shot/frame_plan.h"
#include "app/shot/missing_frames.h"
#include "app/shot/project_source.h"
#include "app/shot/region_projection.h"
#include "app/shot/region_reference.h"
#include "app/shot/settled_region.h"
#include "app/shot/shot_inputs.h"
#include "app/shot/shown_sample.h"
#include "app/shot/texture_file.h"
#include "engine/core/frame_range.h"
#include "engine/core/hash.h"
#include "engine/core/luma.h"
#include "engine/core/setting.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/opaque_picture.h"
#include "engine/pipeline/plate_views.h"
#include "engine/synthesis/texture_plane.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

constexpr const char* kSrgb = "srgb";
constexpr const char* kCineon = "cineon";
constexpr const char* kLinear = "linear";

bool float_depth(PixelDepth depth) {
    return depth == PixelDepth::kHalf || depth == PixelDepth::kFloat;
}

// Opens a project step by step; each step fills in a part of `shot_`.
class ShotOpener {
  public:
    ShotOpener(const Project& project, const OpenShotOptions& options) : options_(options) {
        shot_.project = project;
        shot_.painted = options.painted;
        if (options.files) shot_.files = options.files;
        if (options.watch_inputs) shot_.inputs = std::make_shared<InputWatch>(shot_.files);
    }

    Expected<std::shared_ptr<const Shot>> open() {
        WEFT_CHECK_OK(open_plate_reader());
        WEFT_CHECK_OK(choose_spaces());
        WEFT_CHECK_OK(add_regions());
        WEFT_CHECK_OK(watch_inputs());
        return std::make_shared<const Shot>(std::move(shot_));
    }

  private:
    // Records the files that cache keys depend on; they may be read much later.
    Status watch_inputs() const {
        if (!shot_.inputs) return {};
        WEFT_TRY(files, input_files(shot_));
        for (const std::string& path : files)
            shot_.inputs->relied_on(path);
        return {};
    }

    // Returns `path` after recording that it will be read.
    [[nodiscard]] const std::string& watched(const std::string& path) const {
        if (shot_.inputs) shot_.inputs->before_read(path);
        return path;
    }

    Status open_plate_reader() {
        const Plate& plate = shot_.project.plate;
        if (plate.path.empty())
            return fail(ErrorCode::kUsage, "No plate is set.",
                        "Choose one" + by({{setting::kPlate}}) + ".");
        shot_.plate = options_.plate;
        if (!shot_.plate) {
            WEFT_TRY(reader,
                     open_plate(plate.path, {plate.layer, plate.movie_start, plate.pixel_aspect}));
            std::vector<int> wanted;
            if (!shot_.project.settings.frames.empty()) {
                WEFT_TRY(list, parse_frame_list(shot_.project.settings.frames));
                wanted = std::move(list);
            }
            shot_.plate =
                cached(with_missing_frames(reader, plate.missing, wanted), options_.cache_bytes);
        }
        shot_.warnings = shot_.plate->warnings();
        const std::vector<LayerKind>& layers = shot_.project.output.layers;
        shot_.plan.layers = !layers.empty();
        shot_.plan.form_layers = std::any_of(layers.begin(), layers.end(), shows_form);
        WEFT_TRY(frames, frames_to_render(shot_.project, *shot_.plate));
        shot_.plan.frames = std::move(frames);
        shot_.plan.quality = shot_.project.settings.quality == Quality::kDraft
                                 ? FlowQuality::kDraft
                                 : FlowQuality::kFinal;
        shot_.plan.seed = static_cast<std::uint64_t>(shot_.project.settings.seed);
        return {};
    }

    void warn_of_color(const std::string& what, const FileColor& says, std::string_view setting) {
        shot_.warnings.push_back(what + " " + says.note + "; its values are taken as " +
                                 says.space +
                                 ". Set its colour space with an OpenColorIO config ($OCIO)" +
                                 by({{setting}}) + ", or convert it.");
    }

    static Expected<ColorSpace> space(const std::string& given, const char* by_file_type) {
        return parse_color_space(given.empty() ? by_file_type : given);
    }

    Status choose_spaces() {
        const Project& p = shot_.project;
        const FileColor says = shot_.plate->color();
        WEFT_TRY(plate, space(p.plate.space, says.space.c_str()));
        if (p.plate.space.empty() && !says.note.empty())
            warn_of_color("The plate " + p.plate.path, says, setting::kPlateSpace);
        WEFT_TRY(working, space(p.color.working_space, kLinear));
        // An output of the plate's kind keeps the plate's space, so that the plate passes through
        // unchanged; other kinds use their default.
        const bool float_out = float_depth(output_depth(p.output, shot_.plate->depth()));
        // Only DPX declares itself as log; in other formats log would be displayed as it is.
        const bool log_out = p.output.path.ends_with(".dpx") || p.output.path.ends_with(".DPX");
        const bool same_kind =
            float_out == !shot_.plate->display_encoded() && (plate.name != kCineon || log_out);
        WEFT_TRY(out, same_kind && p.color.out_space.empty()
                          ? Expected<ColorSpace>(plate)
                          : space(p.color.out_space, float_out ? kLinear : kSrgb));
        shot_.spaces = {plate, working, out, {}};
        ShotPlan& plan = shot_.plan;
        plan.display_referred = !float_out && out.name != kCineon;
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
        plan.exposure_greys = {
            working_grey(ExposureGreys::kOldSurface), working_grey(ExposureGreys::kBright),
            working_grey(ExposureGreys::kWhite), working_grey(ExposureGreys::kWhitest),
            shot_.plate->display_encoded() && plate.name != kCineon};
        return {};
    }

    // What a grey of this reflectance is in the working space.
    [[nodiscard]] float working_grey(float reflectance) const {
        ImageF3 grey(Size{1, 1}, linear_to_srgb(reflectance));
        working_from_display_->apply(grey);
        return luma_709(grey.data());
    }

    Status add_regions() {
        std::vector<Leaf<Region>> planned;
        for (std::size_t k = 0; k < shot_.project.regions.size(); ++k) {
            if (!shot_.project.regions[k]->enabled) continue;
            Status settled;
            shot_.project.regions[k] = shot_.project.regions[k].with(
                [&](Region& changed) { settled = settle_region(changed, shot_); });
            const Region& region = *shot_.project.regions[k];
            auto added = settled ? add_region(region) : std::move(settled);
            if (!added) return fail_in(std::move(added).error(), "Region '" + region.name + "'");
            shot_.region_index.push_back(k);
            planned.push_back(shot_.project.regions[k]);
        }
        shot_.cuts = std::make_shared<CutWatch>();
        shot_.source = make_project_source(shot_.plate, std::move(planned), shot_.cuts,
                                           shot_.inputs, shot_.painted);
        return {};
    }

    Status add_region(const Region& region) {
        RegionPlan plan;
        plan.random_key = region.id;
        WEFT_CHECK_OK(check_crypto_names(region, shot_.plate->frames()));
        WEFT_CHECK_OK(project_mattes(*region.matte, *region.holdouts, plan));
        WEFT_CHECK_OK(project_zones(*region.zones, plan));
        WEFT_TRY(reference, add_reference(region, *shot_.plate, looks(), options_.leave_out, plan,
                                          shot_.notes));
        shot_.references.push_back(reference);
        // Corrected frames also anchor the texture.
        project_corrections(region.corrections, plan);
        WEFT_CHECK_OK(project_motion(region.motion, plan));
        WEFT_CHECK_OK(add_track(region.motion, plan));
        WEFT_CHECK_OK(project_placement(region.placement, region.temporal.mode,
                                        PixelAspect(shot_.plate->pixel_aspect()), plan));
        WEFT_CHECK_OK(project_form(region, plan));
        project_synthesis(region.synthesis, plan);
        plan.amendments = *region.amendments;
        project_temporal(region.temporal, plan);
        WEFT_CHECK_OK(project_light(region.light, shot_.plan.display_referred, plan));
        project_grade(region.grade, region.layer, plan);
        project_finish(region.finish, shot_.plan.quality, plan);
        WEFT_CHECK_OK(add_evidence(region, plan));
        project_lines(region.lines, plan);
        if (options_.textures) {
            WEFT_CHECK_OK(add_texture(region, plan));
            WEFT_CHECK_OK(add_light_picture(region, plan));
        }
        WEFT_CHECK_OK(check_files(region, plan, shot_.plan, *shot_.plate));
        look_at_reference(region);
        shot_.plan.regions.push_back(std::move(plan));
        return {};
    }

    // The frames on which grain, motion blur, light, gloss, form and focus are measured.
    Status add_evidence(const Region& region, RegionPlan& plan) const {
        const std::vector<int>& without = options_.leave_out;
        WEFT_TRY(grain, grain_frames(region, plan, *shot_.plate, without));
        plan.grain_frames = std::move(grain);
        WEFT_TRY(blur, shutter_frames(region, plan, *shot_.plate, without));
        plan.shutter_evidence = std::move(blur);
        WEFT_TRY(light, light_evidence(region, plan, shot_.plan, *shot_.plate, without));
        plan.light_evidence = std::move(light);
        WEFT_TRY(gloss, gloss_evidence(region, plan, *shot_.plate, without));
        plan.gloss_evidence = std::move(gloss);
        WEFT_TRY(form, form_evidence(region, plan, *shot_.plate, without));
        plan.form_evidence = std::move(form);
        WEFT_TRY(calm, calm_span(region, plan, *shot_.plate, without));
        plan.calm_span = calm;
        WEFT_TRY(focus, focus_frames(region, plan, *shot_.plate, without));
        plan.focus_frames = std::move(focus);
        return {};
    }

    [[nodiscard]] MatteLooks looks() const { return {options_.visibility.get(), &shot_.painted}; }

    // A reference frame set by the user may not show the region.
    void look_at_reference(const Region& region) {
        ShotReference& reference = shot_.references.back();
        if (reference.by_default || !shows_nothing(region, *shot_.plate, reference.frame, looks()))
            return;
        reference.shows_nothing = true;
        const auto other = choose_reference(region, *shot_.plate, looks());
        if (!other || !other->shown) return;
        reference.better = other->frame;
        shot_.warnings.push_back(empty_reference_text(region.name, reference));
    }

    struct OpenTexture {
        ImageF3 pixels;
        ColorSpace space;
        ShotTexture named;
    };
    Expected<OpenTexture> open_texture(const Region& region, const std::string& path, bool is_plane,
                                       int overlap_px) {
        if (!names_library_texture(path) && shot_.inputs) shot_.inputs->before_read(path);
        WEFT_TRY(read, read_texture(path, options_.texture_library));
        auto& [picture, credit] = read;
        if (!is_plane) {
            // Checked now instead of after minutes of analysis.
            if (const Status fits = check_sample(picture.rgb.size(), overlap_px); !fits)
                return fail_in(fits.error(), path);
        }
        const std::string& given =
            region.texture.space.empty() ? shot_.project.color.texture_space : region.texture.space;
        const FileColor& says = picture.color;
        WEFT_TRY(texture_space, space(given, says.space.c_str()));
        if (given.empty() && !says.note.empty())
            warn_of_color("The texture " + path, says, setting::kTextureSpace);
        if (picture.nonfinite > 0) {
            shot_.warnings.push_back("The texture " + path + " has " +
                                     std::to_string(picture.nonfinite) +
                                     " pixels of NaN or infinity; they are taken as black.");
        }
        if (std::string clear = transparency_warning(path, picture.alpha);
            !clear.empty() && !is_plane)
            shot_.warnings.push_back(std::move(clear));
        OpenTexture out;
        out.pixels = std::move(picture.rgb);
        out.space = texture_space;
        for (int k = 0; k < out.pixels.height(); ++k) {
            float* row = out.pixels.row(k);
            std::replace_if(
                row, row + out.pixels.stride(), [](float v) { return !std::isfinite(v); }, 0.0f);
        }
        // Of a sample each pixel may lie beside any other: there alpha is not used.
        if (is_plane) make_opaque(out.pixels, picture.alpha, picture.alpha_kind);
        Hasher hasher;
        hasher.image(out.pixels);
        out.named = {region.name,
                     path,
                     hasher.finish().hex(),
                     out.pixels.size(),
                     is_plane,
                     SampleKind::kStochastic,
                     {},
                     credit.id,
                     credit.author,
                     credit.licence,
                     credit.source,
                     {}};
        return out;
    }

    Status add_texture(const Region& region, RegionPlan& plan) {
        const bool given = !region.texture.plane.empty();
        const bool is_plane = given || shows_sample(region.texture.mode);
        const std::string& path = given ? region.texture.plane : region.texture.sample;
        if (path.empty()) {
            return fail(
                ErrorCode::kUsage, "It has no texture.",
                "Choose a sample or a plane" + by({{setting::kSample}, {setting::kPlane}}) + ".");
        }
        WEFT_TRY(first, open_texture(region, path, is_plane, plan.overlap_px));
        const ColorSpace texture_space = first.space;
        WEFT_TRY(working_from_texture, make_color_transform(texture_space, shot_.spaces.working));
        WEFT_TRY(display_from_texture, make_color_transform(texture_space, {kSrgb}));
        auto texture = std::make_shared<TexturePicture>();
        texture->pixels = std::move(first.pixels);
        texture->is_plane = is_plane;
        texture->wrap = region.texture.wrap;
        if (given && region.placement.fit) plan.placement.picture_texels = texture->pixels.size();
        if (!given) {
            const SampleDescription sample =
                describe_sample(make_views(texture->pixels, *display_from_texture).display);
            first.named.sample_kind = sample.kind;
            first.named.sample_reason = reason_of(sample);
        }
        plan.mode = given ? PlaneMode::kTile : region.texture.mode;
        if (is_plane && !given)
            show_sample(surface_box(region, *shot_.plate, plan.reference_frames.front(), looks()),
                        *display_from_texture, *texture, plan);
        for (const std::string& further : region.texture.also) {
            if (is_plane) break;
            WEFT_TRY(sample, open_texture(region, further, false, plan.overlap_px));
            // All samples use the space of the first one.
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
        WEFT_TRY(track, read_corner_track(watched(motion.track),
                                          {shot_.plate->size(), shot_.plate->frames().front()}));
        plan.track = std::move(track);
        return {};
    }

    Status add_light_picture(const Region& region, RegionPlan& plan) {
        if (plan.light_source != LightSource::kImage) return {};
        if (region.light.image.empty()) {
            return fail(ErrorCode::kUsage, "The light source 'image' needs an image.",
                        "Choose one" + by({{setting::kLightSource}}) + ".");
        }
        WEFT_TRY(picture, read_image(watched(region.light.image)));
        WEFT_TRY(to_linear, make_color_transform({picture.color.space}, {kLinear}));
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
