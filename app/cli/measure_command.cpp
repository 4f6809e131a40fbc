#include <nlohmann/json.hpp>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/session/frame_plan.h"
#include "engine/core/frame_range.h"
#include "engine/media/image_files.h"
#include "engine/metrics/sequence_measure.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_scene.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

struct Outcome {
    std::vector<FrameMeasures> frames;
    SequenceMeasures all;
    std::vector<std::string> warnings;
};

// The plane that the result was made from: given, or grown again as the render does.
Expected<ImageU8x3> ideal_plane(const Project& project, const RegionPlan& plan, Size plate) {
    const Region& region = *project.regions.front();
    const std::string& path =
        region.texture.plane.empty() ? region.texture.sample : region.texture.plane;
    WEFT_TRY(picture, read_image(path));
    const bool is_float = picture.depth == PixelDepth::kHalf || picture.depth == PixelDepth::kFloat;
    const std::string& given =
        region.texture.space.empty() ? project.color.texture_space : region.texture.space;
    WEFT_TRY(space, parse_color_space(!given.empty() ? given : is_float ? "linear" : "srgb"));
    WEFT_TRY(display, make_color_transform(space, {"srgb"}));
    ImageU8x3 codes = make_views(picture.rgb, *display).display;
    if (!region.texture.plane.empty()) return codes;
    PlaneOptions grow = plane_options(plan, static_cast<std::uint64_t>(project.settings.seed),
                                      plane_size(plan.placement, plate));
    grow.tileable = true;
    WEFT_TRY(plane, grow_plane(codes, grow));
    return std::move(plane.pixels);
}

// Frame by frame through one SequenceMeasure.
class Measurer {
  public:
    explicit Measurer(const MeasureCommandOptions& options) : options_(options) {}

    Expected<Outcome> run() {
        WEFT_CHECK_OK(open());
        WEFT_TRY(measure_options, make_options());
        SequenceMeasure measure(std::move(measure_options));
        for (const int frame : frames_) {
            auto measured = add(measure, frame);
            if (!measured)
                return fail_in(std::move(measured).error(), "Frame " + std::to_string(frame));
            outcome_.frames.push_back(*measured);
        }
        outcome_.all = measure.summary();
        return std::move(outcome_);
    }

  private:
    Status open() {
        OpenShotOptions open;
        open.textures = false;
        Project project = options_.project;
        WEFT_TRY(result, open_plate(options_.result, {"", project.plate.movie_start}));
        result_ = result;
        // Where no frames were asked for, the result says which there are.
        if (project.settings.frames.empty())
            project.settings.frames = format_frame_list(result_->frames());
        WEFT_TRY(shot, open_shot(project, open));
        shot_ = shot;
        outcome_.warnings = shot_->warnings;
        if (region().propagated()) {
            return fail(ErrorCode::kUsage,
                        "Measuring needs a matte for every frame; 'weft matte' makes them.");
        }
        frames_ = shot_->plan.frames;
        for (const int frame : frames_) {
            if (!std::binary_search(result_->frames().begin(), result_->frames().end(), frame)) {
                return fail(ErrorCode::kMissingFrames, "The result " + options_.result +
                                                           " has no frame " +
                                                           std::to_string(frame) + ".");
            }
        }
        if (result_->size() != shot_->plate->size()) {
            return fail(ErrorCode::kUnreadable, "The result and the plate differ in size.");
        }
        const std::string& out = project.color.out_space;
        WEFT_TRY(out_space, parse_color_space(!out.empty()                 ? out
                                              : result_->display_encoded() ? "srgb"
                                                                           : "linear"));
        WEFT_TRY(display_from_result, make_color_transform(out_space, {"srgb"}));
        display_from_result_ = display_from_result;
        return {};
    }

    [[nodiscard]] const RegionPlan& region() const { return shot_->plan.regions.front(); }

    Expected<MeasureOptions> make_options() {
        MeasureOptions out;
        out.estimator = options_.motion_estimator == "farneback" ? MeasuringEstimator::kFarneback
                                                                 : MeasuringEstimator::kDeepFlow;
        out.quantise_ideal = result_->depth() == PixelDepth::kU8;
        const Region& settings = *options_.project.regions.front();
        const bool textured = !settings.texture.sample.empty() || !settings.texture.plane.empty();
        if (!textured) return out;
        if (!region().true_motion) {
            outcome_.warnings.push_back(
                "Without true motion (--motion) there is no floor and no sharpness kept.");
            return out;
        }
        if (region().reference_frames.front() != frames_.front()) {
            outcome_.warnings.push_back(
                "The reference frame is not the first measured one: no floor, no sharpness kept.");
            return out;
        }
        WEFT_TRY(plane, ideal_plane(options_.project, region(), shot_->plate->size()));
        WEFT_TRY(map, plane_from_plate(region().placement));
        out.ideal = IdealInputs{std::move(plane), map, {}};
        return out;
    }

    Expected<FrameMeasures> add(SequenceMeasure& measure, int frame) {
        WEFT_TRY(result, result_->read(frame));
        display_from_result_->apply(result.rgb);
        WEFT_TRY(plate, shot_->source->plate(frame));
        const ImageF3 source = transformed(*plate, *shot_->plan.display_from_plate);
        WEFT_TRY(extent, shot_->source->matte(0, frame));
        WEFT_TRY(holdout, shot_->source->holdout(0, frame));
        const Matte matte = holdout ? without_holdout(extent, *holdout) : std::move(extent);
        std::optional<FlowField> motion;
        if (region().true_motion && !outcome_.frames.empty()) {
            WEFT_TRY(field, shot_->source->motion(
                                0, region().motion_forward ? outcome_.frames.back().frame : frame));
            motion = std::move(field);
        }
        return measure.add(
            {frame, result.rgb, source, matte, motion ? &*motion : nullptr,
             region().motion_forward ? MotionDirection::kForward : MotionDirection::kBackward,
             nullptr});
    }

    const MeasureCommandOptions& options_;
    std::shared_ptr<const FrameReader> result_;
    std::shared_ptr<const Shot> shot_;
    std::vector<int> frames_;
    std::shared_ptr<const ColorTransform> display_from_result_;
    Outcome outcome_;
};

Json number(const std::optional<double>& v) {
    return v ? Json(*v) : Json();
}

Json spread(const Spread& s) {
    if (s.frames == 0) return Json();
    return {{"mean", s.mean}, {"least", s.least}, {"largest", s.largest}};
}

Json frame_json(const FrameMeasures& f) {
    return {{"frame", f.frame},
            {"tde", number(f.tde)},
            {"source_tde", number(f.source_tde)},
            {"tde_floor", number(f.tde_floor)},
            {"tde_at_floor", number(f.tde_at_floor)},
            {"sharpness_kept", number(f.sharpness_kept)},
            {"rms_contrast_kept", number(f.rms_contrast_kept)},
            {"mean_v", number(f.mean_v)},
            {"source_mean_v", number(f.source_mean_v)},
            {"region_px", f.region_pixels},
            {"outside_differing_px", f.outside_differing},
            {"outside_max", f.outside_max}};
}

Json to_json(const Outcome& o) {
    const SequenceMeasures& a = o.all;
    Json frames = Json::array();
    for (const FrameMeasures& f : o.frames)
        frames.push_back(frame_json(f));
    return {{"motion", a.motion},
            {"frames", a.frames},
            {"tde", spread(a.tde)},
            {"source_tde", spread(a.source_tde)},
            {"tde_floor", spread(a.tde_floor)},
            {"tde_at_floor", spread(a.tde_at_floor)},
            {"tde_over_floor", number(a.tde_over_floor)},
            {"sharpness_kept", spread(a.sharpness_kept)},
            {"rms_contrast_kept", spread(a.rms_contrast_kept)},
            {"drift_px", a.drift ? Json(a.drift->mean_px) : Json()},
            {"tiv", a.tiv},
            {"source_tiv", a.source_tiv},
            {"tiv_relative", a.tiv_relative},
            {"outside_differing_px", a.outside_differing},
            {"outside_max", a.outside_max},
            {"warnings", o.warnings},
            {"per_frame", std::move(frames)}};
}

std::string line(const char* name, const Spread& s) {
    if (s.frames == 0) return std::string(name) + "  not measured\n";
    char text[160];
    std::snprintf(text, sizeof text, "%s  mean %.3f, %.3f to %.3f\n", name, s.mean, s.least,
                  s.largest);
    return text;
}

std::string to_text(const Outcome& o) {
    const SequenceMeasures& a = o.all;
    std::string text =
        std::to_string(a.frames) + " frames, measured with motion: " + a.motion + "\n";
    text += line("TDE of the result  ", a.tde) + line("TDE of the source  ", a.source_tde) +
            line("TDE floor          ", a.tde_floor) + line("TDE at the floor's ", a.tde_at_floor) +
            line("sharpness kept     ", a.sharpness_kept) +
            line("RMS contrast kept  ", a.rms_contrast_kept);
    char more[400];
    if (a.tde_over_floor) {
        std::snprintf(more, sizeof more, "TDE over floor       %.3f\n", *a.tde_over_floor);
        text += more;
    }
    if (a.drift) {
        std::snprintf(more, sizeof more, "drift                %.3f px\n", a.drift->mean_px);
        text += more;
    }
    std::snprintf(more, sizeof more,
                  "TIV                  %.3f (source %.3f), relative %.6f\noutside the matte    "
                  "%lld pixels differ\n",
                  a.tiv, a.source_tiv, a.tiv_relative, static_cast<long long>(a.outside_differing));
    return text + more;
}

}  // namespace

int measure_command(const MeasureCommandOptions& options) {
    use_threads(options.threads);
    const auto outcome = Measurer(options).run();
    if (!outcome) return report_error(outcome.error());
    for (const std::string& warning : outcome->warnings)
        print_warning(warning);
    print(stdout, options.json ? to_json(*outcome).dump(2) + "\n" : to_text(*outcome));
    return 0;
}

}  // namespace weft
