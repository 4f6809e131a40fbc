#include "app/measure/light_measure.h"

#include <algorithm>
#include <cmath>

#include "app/measure/measure_job.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"
#include "engine/lighting/shading_lookup.h"
#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"
#include "engine/metrics/region.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_light.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {
namespace {

constexpr float kGrey = 0.35f;     // reflectance of the grey on which light is shown
constexpr int kRim_px = 2;         // excluded edge of the matte: mixed pixels do not show the light
constexpr float kOutside = 0.05f;  // display code outside the region

// The project for estimating light: without its light passes, which would override the estimate.
Project without_passes(const Project& project, const std::vector<int>& frames) {
    Project out = project;
    out.settings.frames = format_frame_list(frames);
    out.regions.front() = out.regions.front().with([](Region& r) {
        r.light = LightParams{};
        r.finish.grain = r.finish.focus = 0;
        r.finish.shutter_deg = 0;
    });
    return out;
}

ImageF1 full_size(const Shading& shading) {
    ImageF1 out(shading.full);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        std::vector<float> scratch, row(static_cast<std::size_t>(out.width()));
        for (int y = y0; y < y1; ++y) {
            shading_row(shading, 0, y, scratch, row);
            std::copy(row.begin(), row.end(), out.row(y));
        }
    });
    return out;
}

// A picture with the colour that `colour` makes of linear light inside the matte.
template <class Colour>
ImageF3 picture_of(const Matte& matte, const Colour& colour) {
    ImageF3 out(matte.size());
    parallel_rows(matte.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < matte.width(); ++x) {
                float* p = out.pixel(x, y);
                p[0] = p[1] = p[2] = kOutside;
                if (matte.row(y)[x] >= kInsideCoverage) colour(x, y, p);
            }
        }
    });
    return out;
}

ImageF3 light_picture(const Matte& matte, const ImageF1& light, float reference) {
    return picture_of(matte, [&](int x, int y, float* p) {
        p[0] = p[1] = p[2] = linear_to_srgb(kGrey * light.row(y)[x] / reference);
    });
}

ImageF3 reflectance_picture(const Matte& matte, const ImageF3& linear, const ImageF1& light,
                            float reference) {
    return picture_of(matte, [&](int x, int y, float* p) {
        for (int c = 0; c < 3; ++c) {
            const float paint = linear.pixel(x, y)[c] * reference / light.row(y)[x];
            p[c] = std::isfinite(paint) ? linear_to_srgb(std::clamp(paint, 0.0f, 1.0f)) : 0.0f;
        }
    });
}

// Places three pictures per row.
ImageF3 sheet_of(const LightMeter::Pictures& pictures) {
    constexpr int kColumns = 3;
    const Size one = pictures.front().second.size();
    const int rows = (static_cast<int>(pictures.size()) + kColumns - 1) / kColumns;
    ImageF3 sheet(Size{kColumns * one.width, rows * one.height});
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        const int x0 = static_cast<int>(k % kColumns) * one.width;
        const int y0 = static_cast<int>(k / kColumns) * one.height;
        const ImageF3& picture = pictures[k].second;
        for (int y = 0; y < one.height; ++y)
            std::copy_n(picture.row(y), 3 * one.width, sheet.pixel(x0, y0 + y));
    }
    return sheet;
}

}  // namespace

Expected<std::shared_ptr<LightMeter>> LightMeter::open(const Project& project,
                                                       const std::vector<int>& frames,
                                                       const AnalysisCacheOptions& cache,
                                                       const CancelToken& cancel,
                                                       std::vector<std::string>& warnings) {
    const std::shared_ptr<LightMeter> out(new LightMeter());
    OpenShotOptions open;
    open.textures = false;
    open.files = open_fingerprints(cache);
    WEFT_TRY(shot, open_shot(without_passes(project, frames), open));
    out->shot_ = shot;
    WEFT_TRY(store, open_analysis_cache(*shot, cache, warnings));
    out->store_ = store;
    WEFT_CHECK_OK(analyse_shot(*shot->source, shot->plan, *store, cancel, {}));
    WEFT_TRY(to_working, make_color_transform({"srgb"}, shot->spaces.working));
    out->working_from_display_ = to_working;
    const LightParams& light = project.regions.front()->light;
    const std::string& pass = light.lighting.empty() ? light.albedo : light.lighting;
    if (!pass.empty()) {
        WEFT_TRY(pattern, SequencePattern::parse(pass));
        out->truth_is_still_ = pattern.is_single();
        Project with_pass = project;
        with_pass.settings.frames = format_frame_list(frames);
        with_pass.regions.front() = with_pass.regions.front().with([](Region& r) {
            r.light.source = LightSource::kPlate;
            r.light.form = LightForm::kGain;
        });
        WEFT_TRY(truth_shot, open_shot(with_pass, open));
        out->truth_shot_ = truth_shot;
    }
    const int reference = shot->plan.regions.front().reference_frames.front();
    WEFT_TRY(bytes, store->get({0, reference, AnalysisKind::kShading}));
    WEFT_TRY(shading, decode_shading(bytes));
    WEFT_TRY(matte, out->visible(reference));
    out->reference_ = median_shading(shading, matte);
    return out;
}

bool LightMeter::has_truth() const {
    return truth_shot_ != nullptr;
}

Expected<Matte> LightMeter::visible(int frame) const {
    return visible_matte(*shot_, frame);
}

Expected<ImageF1> LightMeter::estimated(int frame) const {
    WEFT_TRY(bytes, store_->get({0, frame, AnalysisKind::kShading}));
    WEFT_TRY(shading, decode_shading(bytes));
    return full_size(shading);
}

Expected<std::optional<ImageF1>> LightMeter::truth(int frame) const {
    using Found = Expected<std::optional<ImageF1>>;
    const int reference = shot_->plan.regions.front().reference_frames.front();
    if (!truth_shot_ || (truth_is_still_ && frame != reference)) return Found(std::nullopt);
    WEFT_TRY(plate, truth_shot_->source->plate(frame));
    WEFT_TRY(working, working_plate(*truth_shot_->source, truth_shot_->plan, frame, *plate));
    WEFT_TRY(shading, region_shading(*truth_shot_->source, truth_shot_->plan.regions.front(),
                                     *store_, 0, frame, working));
    return Found(full_size(*shading));
}

Status LightMeter::add(int frame) {
    WEFT_TRY(real, truth(frame));
    if (!real) return {};
    WEFT_TRY(mine, estimated(frame));
    WEFT_TRY(matte, visible(frame));
    const Matte inside = eroded_inside(matte, kRim_px);
    LightMeasures::Frame at{frame, compare_shading(mine, *real, inside)};
    edges_.add(mine, *real, inside);
    sum_.correlation.add(at.agreement.correlation);
    if (at.agreement.pixels > 0) {
        sum_.error_levels.add(at.agreement.error_levels);
        sum_.true_deviation_levels.add(at.agreement.true_deviation_levels);
    }
    sum_.frames.push_back(at);
    return {};
}

LightMeasures LightMeter::summary() const {
    LightMeasures out = sum_;
    out.edges = edges_.summary();
    return out;
}

Expected<LightMeter::Pictures> LightMeter::pictures(int frame, const ImageF3& result) const {
    WEFT_TRY(plate, shot_->source->plate(frame));
    WEFT_TRY(matte, visible(frame));
    WEFT_TRY(phi, estimated(frame));
    const ImageF3 before = transformed(*plate, *shot_->plan.working_from_plate);
    const ImageF3 after = transformed(result, *working_from_display_);
    const Shading seen =
        estimate_shading(after, matte, shading_options(shot_->plan, shot_->source->size()));
    const ImageF1 after_light = full_size(seen);
    const float after_reference = median_shading(seen, matte);
    Pictures out;
    out.emplace_back("before", transformed(*plate, *shot_->plan.display_from_plate));
    out.emplace_back("before_shading", light_picture(matte, phi, reference_));
    out.emplace_back("before_reflectance", reflectance_picture(matte, before, phi, reference_));
    out.emplace_back("after", result);
    out.emplace_back("after_shading", light_picture(matte, after_light, after_reference));
    out.emplace_back("after_reflectance",
                     reflectance_picture(matte, after, after_light, after_reference));
    WEFT_TRY(real, truth(frame));
    if (real) {
        Shading exact{*real, 1, real->size()};
        const float exact_reference = median_shading(exact, matte);
        out.emplace_back("true_shading", light_picture(matte, *real, exact_reference));
        out.emplace_back("true_reflectance",
                         reflectance_picture(matte, before, *real, exact_reference));
        out.emplace_back("shading_difference", picture_of(matte, [&](int x, int y, float* p) {
                             const float a = linear_to_srgb(kGrey * phi.row(y)[x] / reference_);
                             const float b =
                                 linear_to_srgb(kGrey * real->row(y)[x] / exact_reference);
                             p[0] = p[1] = p[2] = std::clamp(0.5f + 4.0f * (a - b), 0.0f, 1.0f);
                         }));
    }
    return out;
}

Status write_light_pictures(const std::string& folder, int frame,
                            const LightMeter::Pictures& pictures, const WriteRule& rule) {
    WriteOptions write;
    write.rule = rule;
    const auto path = [&](const std::string& name) {
        char number[16];
        std::snprintf(number, sizeof number, "%05d", frame);
        return folder + "/" + name + "." + number + ".png";
    };
    WEFT_CHECK_OK(make_folder(folder, rule));
    for (const auto& [name, picture] : pictures)
        WEFT_CHECK_OK(write_image(path(name), picture, {}, write));
    return write_image(path("sheet"), sheet_of(pictures), {}, write);
}

}  // namespace weft
