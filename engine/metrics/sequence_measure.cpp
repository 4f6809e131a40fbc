#include "engine/metrics/sequence_measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/metrics/matte_chatter.h"
#include "engine/metrics/region.h"
#include "engine/metrics/sequence_diff.h"
#include "engine/metrics/sharpness.h"
#include "engine/metrics/tde.h"

namespace weft {
namespace {

Status check_size(const char* what, int frame, Size got, Size expected) {
    if (got == expected) return {};
    return fail(ErrorCode::kUnreadable,
                std::string(what) + " of frame " + std::to_string(frame) + " is " + size_text(got) +
                    " but the first result is " + size_text(expected) + ".",
                "Give files of one size.");
}

Matte owned(ViewU8x1 m) {
    Matte out(m.size());
    for (int y = 0; y < m.height(); ++y)
        std::copy_n(m.row(y), m.width(), out.row(y));
    return out;
}

ImageF3 owned(ViewF3 picture) {
    ImageF3 out(picture.size());
    for (int y = 0; y < picture.height(); ++y)
        std::copy_n(picture.row(y), 3 * picture.width(), out.row(y));
    return out;
}

void round_to_8bit(ImageF3& encoded) {
    parallel_rows(encoded.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int i = 0; i < 3 * encoded.width(); ++i) {
                float& v = encoded.row(y)[i];
                v = std::floor(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f) / 255.0f;
            }
        }
    });
}

std::optional<double> value_of(const TemporalError& e) {
    if (e.pixels == 0) return std::nullopt;
    return e.tde;
}

}  // namespace

void Spread::add(const std::optional<double>& v) {
    if (!v) return;
    ++frames;
    least = frames == 1 ? *v : std::min(least, *v);
    largest = frames == 1 ? *v : std::max(largest, *v);
    mean += (*v - mean) / static_cast<double>(frames);
}

// What is kept of one frame until the next.
struct Kept {
    ImageF1 result, source, ideal;
    ImageF3 result_rgb, source_rgb;  // For the grain.
    Matte matte;
    Matte ideal_region;  // Where the ideal is known; empty without one.
};

struct SequenceMeasure::State {
    MeasureOptions options;
    std::unique_ptr<IdealTexture> texture;
    std::optional<MotionChain> chain;
    ImageF1 first_result;
    Kept before;
    FlowField estimated;  // The last motion that was not given.
    SequenceMeasures total;
    IlluminationVariance light;
    GrainSpectrumMeter grain, source_grain;
    std::vector<PopSteps> steps;
    std::int64_t outside_pixels = 0;
    double outside_sum = 0;

    Status check(const MeasureFrame& f) const;
    void name_motion(const std::string& name);
    void measure_outside(const MeasureFrame& f, FrameMeasures& out);
    Expected<FrameMeasures> add(const MeasureFrame& f);
    void measure_ideal(const MeasureFrame& f, Kept& now, FrameMeasures& out) const;
    void render_ideal(const MeasureFrame& f, Kept& now) const;
    void measure_step(const FlowField& motion, MotionDirection direction, const Kept& now,
                      FrameMeasures& out);
    [[nodiscard]] bool chained() const { return options.measure_drift || texture != nullptr; }
};

Status SequenceMeasure::State::check(const MeasureFrame& f) const {
    const Size s = total.frames == 0 ? f.result.size() : before.result.size();
    WEFT_CHECK_OK(check_size("The result", f.frame, f.result.size(), s));
    WEFT_CHECK_OK(check_size("The plate", f.frame, f.source.size(), s));
    WEFT_CHECK_OK(check_size("The matte", f.frame, f.matte.size(), s));
    if (f.motion != nullptr) {
        WEFT_CHECK_OK(check_size("The motion", f.frame, f.motion->size(), s));
    }
    if (f.ref_from_cur != nullptr) {
        WEFT_CHECK_OK(check_size("The placement field", f.frame, f.ref_from_cur->size(), s));
    }
    return {};
}

void SequenceMeasure::State::name_motion(const std::string& name) {
    if (total.motion.find(name) != std::string::npos) return;
    total.motion += total.motion.empty() ? name : " and " + name;
}

void SequenceMeasure::State::measure_outside(const MeasureFrame& f, FrameMeasures& out) {
    const FrameDiff d = *diff_outside(f.result, f.source, f.matte);  // Sizes were checked.
    double mean = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        out.outside_max = std::max(out.outside_max, 255.0 * d.max_abs[c]);
        mean += 255.0 * d.mean_abs[c] / 3.0;
    }
    out.outside_mean = mean;
    out.outside_pixels = d.pixels;
    out.outside_differing = d.differing;
    outside_sum += mean * static_cast<double>(d.pixels);
    outside_pixels += d.pixels;
    total.outside_max = std::max(total.outside_max, out.outside_max);
    total.outside_differing += d.differing;
    total.outside_mean = outside_pixels > 0 ? outside_sum / static_cast<double>(outside_pixels) : 0;
}

void SequenceMeasure::State::measure_ideal(const MeasureFrame& f, Kept& now,
                                           FrameMeasures& out) const {
    if (f.twin != nullptr) {
        now.ideal = f.twin->state_->before.ideal;
        now.ideal_region = f.twin->state_->before.ideal_region;
    } else {
        render_ideal(f, now);
    }
    const SharpnessKept kept = sharpness_kept(now.result, now.ideal, now.ideal_region);
    out.sharpness_pixels = kept.pixels;
    if (kept.pixels == 0) return;
    out.sharpness_kept = kept.laplacian;
    out.rms_contrast_kept = kept.contrast;
}

void SequenceMeasure::State::render_ideal(const MeasureFrame& f, Kept& now) const {
    FlowField ref = f.ref_from_cur != nullptr ? *f.ref_from_cur : chain->ref_from_cur();
    now.ideal_region = both_inside(eroded_inside(f.matte, 0), ref.valid);
    ref.valid = now.ideal_region;
    const TextureMapping& mapping = options.ideal->mapping;
    if (options.quantise_ideal) {
        ImageF3 rgb = texture->render(ref, mapping);
        round_to_8bit(rgb);
        now.ideal = luma_8bit(rgb);
    } else {
        now.ideal = texture->render_luma(ref, mapping);
    }
}

void SequenceMeasure::State::measure_step(const FlowField& motion, MotionDirection direction,
                                          const Kept& now, FrameMeasures& out) {
    // A forward field is judged in the earlier frame's pixels, a backward one in the later's.
    const bool forward = direction == MotionDirection::kForward;
    const Kept& from = forward ? before : now;
    const Kept& to = forward ? now : before;
    const Matte visible = visible_in_both(motion, from.matte, to.matte, options.erode_px);
    const TemporalError e = measure_tde(from.result, to.result, motion, visible);
    out.tde = value_of(e);
    out.tde_pixels = e.pixels;
    out.source_tde = value_of(measure_tde(from.source, to.source, motion, visible));
    out.matte_chatter_px = matte_chatter_px(motion, from.matte, to.matte);
    if (options.measure_grain) {
        grain.add(from.result_rgb, to.result_rgb, motion, visible, forward);
        source_grain.add(from.source_rgb, to.source_rgb, motion, visible, forward);
    }
    if (options.measure_pops) {
        out.steps = pop_steps(
            {out.frame, from.result, to.result, from.source, to.source, &motion, visible, forward});
        steps.push_back(*out.steps);
    }
    if (texture == nullptr) return;
    const Matte known = both_inside(
        visible, visible_in_both(motion, from.ideal_region, to.ideal_region, options.erode_px));
    const TemporalError floor = measure_tde(from.ideal, to.ideal, motion, known);
    out.tde_floor = value_of(floor);
    out.floor_pixels = floor.pixels;
    out.tde_at_floor = value_of(measure_tde(from.result, to.result, motion, known));
}

Expected<FrameMeasures> SequenceMeasure::State::add(const MeasureFrame& f) {
    WEFT_CHECK_OK(check(f));
    FrameMeasures out;
    out.frame = f.frame;
    out.region_pixels = count_set(eroded_inside(f.matte, 0));
    measure_outside(f, out);

    Kept now;
    now.result = luma_8bit(f.result);
    now.source = luma_8bit(f.source);
    now.matte = owned(f.matte);
    if (options.measure_grain) now.result_rgb = owned(f.result), now.source_rgb = owned(f.source);
    const bool first = total.frames == 0;
    const FlowField* motion = f.motion;
    MotionDirection direction = f.direction;
    if (!first && motion == nullptr) {
        if (f.twin == nullptr) {
            estimated = measuring_motion(before.source, now.source, before.matte, now.matte,
                                         options.estimator, kChatterReachPx);
        }
        motion = f.twin != nullptr ? &f.twin->state_->estimated : &estimated;
        direction = MotionDirection::kForward;
        name_motion(name_of(options.estimator));
    } else if (!first) {
        name_motion(direction == MotionDirection::kForward ? "given (forward)"
                                                           : "given (backward)");
    }
    if (first) {
        first_result = now.result;
        if (chained()) chain.emplace(now.matte, options.erode_px);
    } else if (chained() && direction == MotionDirection::kForward) {
        chain->advance(*motion, now.matte);
    } else if (chained()) {
        chain->advance_inverse(*motion, now.matte);
    }
    if (texture != nullptr) measure_ideal(f, now, out);
    if (!first) measure_step(*motion, direction, now, out);

    out.mean_v = mean_value(f.result, f.matte);
    out.source_mean_v = mean_value(f.source, f.matte);
    if (out.mean_v && out.source_mean_v) light.add(*out.mean_v, *out.source_mean_v);
    total.tde.add(out.tde);
    total.source_tde.add(out.source_tde);
    total.tde_floor.add(out.tde_floor);
    total.tde_at_floor.add(out.tde_at_floor);
    total.sharpness_kept.add(out.sharpness_kept);
    total.rms_contrast_kept.add(out.rms_contrast_kept);
    total.matte_chatter_px.add(out.matte_chatter_px);
    ++total.frames;
    before = std::move(now);
    return out;
}

SequenceMeasure::SequenceMeasure(MeasureOptions options) : state_(std::make_unique<State>()) {
    state_->options = std::move(options);
    if (const auto& ideal = state_->options.ideal)
        state_->texture = std::make_unique<IdealTexture>(ideal->plane, ideal->filter);
}

SequenceMeasure::~SequenceMeasure() = default;
SequenceMeasure::SequenceMeasure(SequenceMeasure&&) noexcept = default;
SequenceMeasure& SequenceMeasure::operator=(SequenceMeasure&&) noexcept = default;

Expected<FrameMeasures> SequenceMeasure::add(const MeasureFrame& frame) {
    return state_->add(frame);
}

SequenceMeasures SequenceMeasure::summary() const {
    SequenceMeasures out = state_->total;
    out.tiv = state_->light.tiv();
    out.source_tiv = state_->light.source_tiv();
    out.tiv_relative = state_->light.tiv_relative();
    out.grain = state_->grain.spectrum();
    out.source_grain = state_->source_grain.spectrum();
    out.pops = find_pops(state_->steps);
    if (out.tde_floor.frames > 0 && out.tde_floor.mean > 0)
        out.tde_over_floor = out.tde_at_floor.mean / out.tde_floor.mean;
    if (state_->options.measure_drift && out.frames >= 2) {
        const FlowField ref = state_->chain->ref_from_cur();
        const ImageF1 expected = moved(state_->first_result, ref);
        const ResidualMotion d = residual_motion(expected, state_->before.result, ref.valid);
        if (d.patches > 0) out.drift = d;
    }
    return out;
}

}  // namespace weft
