#include "app/measure/measure_job.h"

#include <algorithm>
#include <cstdint>

#include "app/measure/form_measure.h"
#include "app/measure/truth_measure.h"
#include "app/render/form_job.h"
#include "app/shot/frame_plan.h"
#include "engine/composite/focus.h"
#include "engine/core/alpha.h"
#include "engine/core/frame_range.h"
#include "engine/core/setting.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_scene.h"
#include "engine/pipeline/sweep.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

// Passes frames to one SequenceMeasure per result.
class Measurer {
  public:
    Measurer(const MeasureJobOptions& options, const CancelToken& cancel)
        : options_(options), cancel_(cancel) {}

    Expected<MeasureJobResult> run() {
        WEFT_CHECK_OK(open());
        if (!options_.st.empty()) {
            WEFT_TRY(form, measure_form(*shot_, *options_.project.regions.front(), options_.st,
                                        frames_, cancel_));
            out_.form = std::move(form);
        }
        WEFT_TRY(measure_options, make_options());
        std::vector<SequenceMeasure> measures;
        for (std::size_t k = 0; k < readers_.size(); ++k) {
            // Only the first measure needs the plane; the others use its ideal frames.
            measures.emplace_back(measure_options);
            if (measure_options.ideal) measure_options.ideal->plane = ImageU8x3(1, 1);
        }
        out_.results.resize(readers_.size());
        for (std::size_t at = 0; at < frames_.size(); ++at) {
            if (cancel_.cancelled()) return cancelled(cancel_);
            if (auto added = add(measures, at); !added) {
                return fail_in(std::move(added).error(), "Frame " + std::to_string(frames_[at]));
            }
        }
        for (std::size_t k = 0; k < measures.size(); ++k)
            out_.results[k].all = measures[k].summary();
        if (!options_.truth.empty()) {
            WEFT_TRY(truth, ResultReader::open(options_.truth, options_.project));
            WEFT_TRY(compared, measure_truth(*shot_, readers_.front(), truth, frames_,
                                             options_.truth_blur_px, cancel_));
            out_.truth = std::move(compared);
        }
        WEFT_CHECK_OK(measure_light());
        return std::move(out_);
    }

  private:
    Status open() {
        OpenShotOptions open;
        open.textures = false;
        Project project = options_.project;
        for (const std::string& pattern : options_.results) {
            WEFT_TRY(reader, ResultReader::open(pattern, project));
            readers_.push_back(std::move(reader));
        }
        // Without a frame list, measure the frames that the result has.
        if (project.settings.frames.empty())
            project.settings.frames = format_frame_list(readers_.front().files().frames());
        WEFT_TRY(shot, open_shot(project, open));
        shot_ = shot;
        out_.warnings = shot_->warnings;
        if (region().propagated()) {
            return fail(ErrorCode::kUsage, "Measuring needs a matte for every frame",
                        "'weft matte' makes them.");
        }
        frames_ = shot_->plan.frames;
        for (std::size_t k = 0; k < readers_.size(); ++k)
            WEFT_CHECK_OK(check_result(options_.results[k], readers_[k].files()));
        return {};
    }

    [[nodiscard]] Status check_result(const std::string& pattern, const FrameReader& files) const {
        for (const int frame : frames_) {
            if (!std::binary_search(files.frames().begin(), files.frames().end(), frame)) {
                return fail(ErrorCode::kMissingFrames, "The result " + pattern + " has no frame " +
                                                           std::to_string(frame) + ".");
            }
        }
        if (files.size() != shot_->plate->size())
            return fail(ErrorCode::kUnreadable, "The result and the plate differ in size.");
        return {};
    }

    [[nodiscard]] const RegionPlan& region() const { return shot_->plan.regions.front(); }

    Expected<MeasureOptions> make_options() {
        MeasureOptions out;
        out.estimator = options_.estimator;
        out.measure_grain = true;
        out.measure_pops = true;
        out.quantise_ideal = readers_.front().files().depth() == PixelDepth::kU8;
        const Region& settings = *options_.project.regions.front();
        const bool textured = !settings.texture.sample.empty() || !settings.texture.plane.empty();
        if (!textured) return out;
        if (!region().true_motion && !options_.ideal_by_estimate) {
            out_.warnings.push_back("The floor and the sharpness kept need true motion" +
                                    by({{setting::kMotion}}) + ".");
            return out;
        }
        if (region().reference_frames.front() != frames_.front()) {
            out_.warnings.push_back(
                "The reference frame is not the first measured one: no floor, no sharpness kept.");
            return out;
        }
        if (region().placement_moves()) {
            out_.warnings.push_back(
                "The placement has keys over time: no floor, no sharpness kept.");
            return out;
        }
        WEFT_TRY(plane, ideal_plane(options_.project, region(), shot_->plate->size()));
        PlanePlacement placed = region().placement;
        if (settings.placement.fit && !settings.texture.plane.empty())
            placed.picture_texels = plane.size();
        WEFT_TRY(mapping, texture_mapping(placed));
        WEFT_TRY(form, laid_form());
        out.ideal = IdealInputs{std::move(plane), mapping.with_form(form), {}};
        return out;
    }

    // The ideal texture lies on the surface as the render laid it.
    Expected<std::shared_ptr<const SurfaceForm>> laid_form() {
        if (!region().has_form()) return std::shared_ptr<const SurfaceForm>();
        JobSpec spec;
        spec.project = options_.project;
        spec.cache = options_.cache;
        return find_laid_form(spec, cancel_, out_.warnings);
    }

    // Compares Φ with the artist's pass, and writes its pictures.
    Status measure_light() {
        const LightParams& light = options_.project.regions.front()->light;
        if (light.albedo.empty() && light.lighting.empty() && options_.pictures.empty()) return {};
        WriteRule rule;
        WriteLimits limits = options_.limits;
        limits.reads.insert(limits.reads.end(), options_.results.begin(), options_.results.end());
        if (!options_.truth.empty()) limits.reads.push_back(options_.truth);
        if (!options_.st.empty()) limits.reads.push_back(options_.st);
        WEFT_TRY(fence, make_fence(options_.project, limits));
        rule.fence = fence;
        rule.existing = existing_by(options_.overwrite);
        WEFT_TRY(meter, LightMeter::open(options_.project, frames_, options_.cache, cancel_,
                                         out_.warnings));
        for (const int frame : frames_) {
            if (cancel_.cancelled()) return cancelled(cancel_);
            WEFT_CHECK_OK(meter->add(frame));
            if (options_.pictures.empty()) continue;
            WEFT_TRY(result, readers_.front().read(frame));
            WEFT_TRY(pictures, meter->pictures(frame, result.display));
            WEFT_CHECK_OK(write_light_pictures(options_.pictures, frame, pictures, rule));
        }
        if (meter->has_truth()) out_.light = meter->summary();
        return {};
    }

    Status measure_focus(const ImageF3& display, ViewU8x1 matte, Spread& into) {
        if (!linear_from_display_) {
            WEFT_TRY(to_linear, make_color_transform({"srgb"}, {"linear"}));
            linear_from_display_ = to_linear;
        }
        const float blur = edge_blur_px(transformed(display, *linear_from_display_), matte);
        if (blur > 0) into.add(static_cast<double>(blur));
        return {};
    }

    Status add(std::vector<SequenceMeasure>& measures, std::size_t at) {
        const int frame = frames_[at];
        WEFT_TRY(matte, visible_matte(*shot_, frame));
        std::optional<FlowField> motion;
        if (region().true_motion && at > 0) {
            WEFT_TRY(field, true_motion_between(*shot_, frames_[at - 1], frame));
            motion = std::move(field);
        }
        for (std::size_t k = 0; k < measures.size(); ++k) {
            WEFT_TRY(result, readers_[k].read(frame));
            WEFT_TRY(source, plate_like(*shot_, frame, result.has_alpha));
            WEFT_TRY(
                measured,
                measures[k].add({frame, result.display, source, matte, motion ? &*motion : nullptr,
                                 region().motion_forward ? MotionDirection::kForward
                                                         : MotionDirection::kBackward,
                                 nullptr, k > 0 ? &measures.front() : nullptr}));
            out_.results[k].frames.push_back(measured);
            WEFT_CHECK_OK(measure_focus(result.display, matte, out_.results[k].focus_px));
            WEFT_CHECK_OK(measure_focus(source, matte, out_.results[k].source_focus_px));
            if (options_.measured) options_.measured(k, measured);
        }
        return {};
    }

    const MeasureJobOptions& options_;
    CancelToken cancel_;
    std::vector<ResultReader> readers_;
    std::shared_ptr<const Shot> shot_;
    std::shared_ptr<const ColorTransform> linear_from_display_;
    std::vector<int> frames_;
    MeasureJobResult out_;
};

// Straight colours. The colour under a straight alpha of 0, which shows nowhere, becomes black.
void straighten(ImageF3& rgb, ViewF1 alpha, AlphaKind kind) {
    if (kind == AlphaKind::kAssociated) {
        unassociate(rgb, alpha);
        return;
    }
    for (int y = 0; y < rgb.height(); ++y) {
        for (int x = 0; x < rgb.width(); ++x)
            if (!(alpha.row(y)[x] > 0)) std::fill_n(rgb.pixel(x, y), 3, 0.0f);
    }
}

// A surface of half alpha is measured as a whole one is; under an alpha of 0 nothing shows.
std::uint8_t shown_part(std::uint8_t matte, float alpha) {
    return alpha > 0 ? matte : std::uint8_t{0};
}

}  // namespace

Expected<ResultReader> ResultReader::open(const std::string& pattern, const Project& project) {
    ResultReader out;
    WEFT_TRY(files, open_plate(pattern, {"", project.plate.movie_start}));
    out.files_ = files;
    const std::string& given = project.color.out_space;
    WEFT_TRY(space, parse_color_space(given.empty() ? out.files_->color().space : given));
    WEFT_TRY(display_from_result, make_color_transform(space, {"srgb"}));
    out.display_from_result_ = display_from_result;
    return out;
}

Expected<MeasuredPicture> ResultReader::read(int frame) const {
    WEFT_TRY(picture, files_->read(frame));
    const bool has_alpha = has_coverage(picture.alpha);
    if (has_alpha) straighten(picture.rgb, picture.alpha, picture.alpha_kind);
    display_from_result_->apply(picture.rgb);
    return MeasuredPicture{std::move(picture.rgb), has_alpha};
}

Expected<ImageF3> plate_like(const Shot& shot, int frame, bool has_alpha) {
    WEFT_TRY(plate, shot.source->plate(frame));
    WEFT_TRY(alpha, shot.source->alpha(frame));
    ImageF3 out = *plate;
    if (alpha.coverage && has_alpha)
        straighten(out, *alpha.coverage, alpha.kind);
    else if (alpha.coverage && !alpha.associated())
        associate(out, *alpha.coverage);
    shot.plan.display_from_plate->apply(out);
    return out;
}

Expected<ImageU8x3> ideal_plane(const Project& project, const RegionPlan& plan, Size plate) {
    const Region& region = *project.regions.front();
    const auto read = [&](const std::string& path) -> Expected<ImageU8x3> {
        WEFT_TRY(picture, read_image(path));
        const std::string& given =
            region.texture.space.empty() ? project.color.texture_space : region.texture.space;
        WEFT_TRY(space, parse_color_space(given.empty() ? picture.color.space : given));
        WEFT_TRY(display, make_color_transform(space, {"srgb"}));
        return make_views(picture.rgb, *display).display;
    };
    if (!region.texture.plane.empty()) return read(region.texture.plane);
    std::vector<ImageU8x3> samples;
    WEFT_TRY(first, read(region.texture.sample));
    samples.push_back(std::move(first));
    for (const std::string& path : region.texture.also) {
        WEFT_TRY(further, read(path));
        samples.push_back(std::move(further));
    }
    PlaneOptions grow = plane_options(plan, static_cast<std::uint64_t>(project.settings.seed),
                                      plane_size(plan.placement, plate));
    grow.tileable = grow.whole_periods = true;
    WEFT_TRY(plane, grow_plane({samples.begin(), samples.end()}, grow));
    return std::move(plane.pixels);
}

Expected<Matte> visible_matte(const Shot& shot, int frame) {
    WEFT_TRY(extent, shot.source->matte(0, frame));
    WEFT_TRY(holdout, shot.source->holdout(0, frame));
    Matte visible = holdout ? without_holdout(extent, *holdout) : std::move(extent);
    WEFT_TRY(alpha, shot.source->alpha(frame));
    if (!alpha.coverage || visible.empty()) return visible;
    for (int y = 0; y < visible.height(); ++y) {
        std::transform(visible.row(y), visible.row(y) + visible.width(), alpha.coverage->row(y),
                       visible.row(y), shown_part);
    }
    return visible;
}

Expected<FlowField> true_motion_between(const Shot& shot, int earlier, int later) {
    return shot.source->motion(0, shot.plan.regions.front().motion_forward ? earlier : later);
}

Expected<MeasureJobResult> run_measure_job(const MeasureJobOptions& options,
                                           const CancelToken& cancel) {
    return Measurer(options, cancel).run();
}

}  // namespace weft
