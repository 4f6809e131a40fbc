#include "app/shot/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/motion/optical_flow.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

float median_of(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The luma at a place between pixels; the border continues.
float luma_at(ViewU8x1 luma, float x, float y) {
    const float right = static_cast<float>(luma.width() - 1),
                bottom = static_cast<float>(luma.height() - 1);
    const float fx = std::clamp(x, 0.0f, right), fy = std::clamp(y, 0.0f, bottom);
    const int i = static_cast<int>(fx), j = static_cast<int>(fy);
    const int i1 = std::min(i + 1, luma.width() - 1), j1 = std::min(j + 1, luma.height() - 1);
    const float u = fx - static_cast<float>(i), v = fy - static_cast<float>(j);
    const auto at = [&](int a, int b) { return static_cast<float>(luma.row(b)[a]); };
    return (1 - v) * ((1 - u) * at(i, j) + u * at(i1, j)) +
           v * ((1 - u) * at(i, j1) + u * at(i1, j1));
}

bool says_nothing_moves(const FlowField& flow) {
    bool any = false;
    for (int y = 0; y < flow.d.height(); ++y) {
        for (int x = 0; x < flow.d.width(); ++x) {
            if (flow.valid.row(y)[x] == 0) continue;
            const float* d = flow.d.pixel(x, y);
            if (d[0] != 0 || d[1] != 0) return false;
            any = true;
        }
    }
    return any;
}

struct Checked {
    int frame = 0;
    MotionFit fit;
};

class RegionCheck {
  public:
    RegionCheck(const Shot& shot, std::size_t index)
        : shot_(shot), index_(index), plan_(shot.plan.regions[index]) {}

    // Up to four frames on which a matte is at hand, spread over those whose motion is used.
    [[nodiscard]] std::vector<int> frames() const {
        const FrameSpan span = analysed_span(shot_.plan, plan_);
        std::vector<int> all;
        for (int frame = span.first; frame <= span.last; ++frame) {
            const bool last = plan_.motion_forward ? frame == span.last : frame == span.first;
            const auto& keys = plan_.matte_keys;
            const bool matte =
                keys.empty() || std::find(keys.begin(), keys.end(), frame) != keys.end();
            if (!last && matte) all.push_back(frame);
        }
        constexpr std::size_t kMost = 4;
        if (all.size() <= kMost) return all;
        std::vector<int> some;
        for (std::size_t k = 0; k < kMost; ++k)
            some.push_back(all[k * (all.size() - 1) / (kMost - 1)]);
        return some;
    }

    [[nodiscard]] std::optional<MotionFit> on(int frame) const {
        const ShotSource& source = *shot_.source;
        const int region = static_cast<int>(index_);
        const auto motion = source.motion(region, frame);
        const auto matte = plan_.matte_keys.empty() ? source.matte(region, frame)
                                                    : source.matte_key(region, frame);
        const auto cur = source.plate(frame);
        const auto other = source.plate(plan_.motion_forward ? frame + 1 : frame - 1);
        if (!motion || !matte || !cur || !other) return std::nullopt;
        const ColorTransform& display = *shot_.plan.display_from_plate;
        return compare_motion(*motion, make_views(**cur, display).luma,
                              make_views(**other, display).luma, *matte);
    }

  private:
    const Shot& shot_;
    std::size_t index_;
    const RegionPlan& plan_;
};

Error nothing_moves(const Region& region, const Checked& at) {
    return {ErrorCode::kUnreadable,
            fmt::format("The motion {} is zero everywhere on frame {}, but the surface moves by "
                        "{:.1f} px there.",
                        region.motion.files, at.frame, at.fit.estimated_px),
            fmt::format("Blender writes such a pass where motion blur is on: render it without, or "
                        "leave the files out{}, so that the motion is estimated.",
                        by({{setting::kMotion}})),
            {}};
}

std::string other_motion(const Region& region, const std::vector<Checked>& wrong) {
    std::vector<int> frames;
    frames.reserve(wrong.size());
    for (const Checked& at : wrong)
        frames.push_back(at.frame);
    const MotionFit& fit = wrong.front().fit;
    return fmt::format(
        "Region '{}': the motion {} contradicts the picture on {}: it says {:.1f} px, the picture "
        "shows {:.1f} px, {:.1f} px apart. Check its direction, convention and layer{}, or leave "
        "it out.",
        region.name, region.motion.files, frames_text(frames), fit.given_px, fit.estimated_px,
        fit.apart_px,
        by({{setting::kMotionDirection}, {setting::kMotionConvention}, {setting::kMotionLayer}}));
}

}  // namespace

bool MotionFit::contradicted() const {
    constexpr float kLeast_px = 0.5f, kShare = 0.3f, kBetter = 0.6f, kNoise_levels = 1.5f;
    return apart_px > kLeast_px + kShare * estimated_px && given_error > kNoise_levels &&
           estimated_error < kBetter * given_error;
}

std::optional<MotionFit> compare_motion(const FlowField& other_from_cur, ViewU8x1 cur,
                                        ViewU8x1 other, ViewU8x1 matte) {
    const FlowField shown = estimate_flow(cur, other, FlowQuality::kDraft);
    std::vector<float> given, estimated, apart;
    double given_error = 0, estimated_error = 0;
    for (int y = 0; y < cur.height(); ++y) {
        for (int x = 0; x < cur.width(); ++x) {
            if (matte.row(y)[x] < 255 || other_from_cur.valid.row(y)[x] == 0) continue;
            const float *d = other_from_cur.d.pixel(x, y), *e = shown.d.pixel(x, y);
            given.push_back(std::hypot(d[0], d[1]));
            estimated.push_back(std::hypot(e[0], e[1]));
            apart.push_back(std::hypot(d[0] - e[0], d[1] - e[1]));
            const auto level = static_cast<float>(cur.row(y)[x]);
            const float px = static_cast<float>(x), py = static_cast<float>(y);
            given_error += std::abs(luma_at(other, px + d[0], py + d[1]) - level);
            estimated_error += std::abs(luma_at(other, px + e[0], py + e[1]) - level);
        }
    }
    const auto pixels =
        static_cast<std::size_t>(cur.width()) * static_cast<std::size_t>(cur.height());
    if (given.size() < std::max<std::size_t>(64, pixels / 100)) return std::nullopt;
    const auto count = static_cast<double>(given.size());
    return MotionFit{median_of(given),
                     median_of(estimated),
                     median_of(apart),
                     static_cast<float>(given_error / count),
                     static_cast<float>(estimated_error / count),
                     says_nothing_moves(other_from_cur)};
}

Expected<std::vector<std::string>> check_motion(const Shot& shot) {
    std::vector<std::string> warnings;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        if (!plan.true_motion || plan.temporal == TemporalMode::kNone) continue;
        const Region& region = *shot.project.regions[shot.region_index[k]];
        const RegionCheck check(shot, k);
        std::vector<Checked> wrong;
        std::size_t looked = 0;
        for (const int frame : check.frames()) {
            const auto fit = check.on(frame);
            if (!fit) continue;
            ++looked;
            if (!fit->contradicted()) continue;
            if (fit->still) return tl::unexpected(nothing_moves(region, {frame, *fit}));
            wrong.push_back({frame, *fit});
        }
        // One frame alone may be a flash, or a blur that the motion does not explain.
        if (!wrong.empty() && 2 * wrong.size() > looked)
            warnings.push_back(other_motion(region, wrong));
    }
    return warnings;
}

}  // namespace weft
