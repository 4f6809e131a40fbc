#include "app/preview/preview_health.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "app/preview/preview_impl.h"
#include "engine/core/luma.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

constexpr float kLostPattern = 0.35f;
constexpr int kStep_px = 4;              // sampling step in the small picture
constexpr std::size_t kMostFrames = 96;  // frames of a shot that are measured for the strips

}  // namespace

ImageF1 small_pattern(const ImageF3& plate, const ColorTransform& display_from_plate, int factor) {
    const Matte luma = make_views(shrunk(plate, factor), display_from_plate).luma;
    const cv::Mat codes(luma.height(), luma.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(luma.data()));
    cv::Mat value, around;
    codes.convertTo(value, CV_32F);
    cv::boxFilter(value, around, CV_32F, {17, 17});
    ImageF1 out(luma.size());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = value.at<float>(y, x) / (around.at<float>(y, x) + 6.0f);
    return out;
}

float pattern_drift(const ImageF1& now, const ImageF1& reference, const LatticeField& ref_from_cur,
                    const Matte& matte, int factor) {
    double sum = 0;
    std::int64_t count = 0;
    const auto scale = static_cast<float>(factor);
    for (int y = kStep_px; y + kStep_px < now.height(); y += kStep_px) {
        for (int x = kStep_px; x + kStep_px < now.width(); x += kStep_px) {
            const Vec2 p((static_cast<float>(x) + 0.5f) * scale,
                         (static_cast<float>(y) + 0.5f) * scale);
            const int mx = std::min(matte.width() - 1, static_cast<int>(p.x));
            const int my = std::min(matte.height() - 1, static_cast<int>(p.y));
            if (matte.at(mx, my) < 128) continue;
            const Vec2 q = (p + ref_from_cur.at(p)) / scale;
            const int u = static_cast<int>(std::floor(q.x)), v = static_cast<int>(std::floor(q.y));
            if (u < 1 || v < 1 || u + 1 >= reference.width() || v + 1 >= reference.height())
                continue;
            float difference = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    difference += std::abs(now.at(x + dx, y + dy) - reference.at(u + dx, v + dy));
            sum += static_cast<double>(std::min(1.0f, difference / 9.0f / kLostPattern));
            ++count;
        }
    }
    return count == 0 ? -1.0f : static_cast<float>(sum / static_cast<double>(count));
}

float mean_stretch(const LatticeField& ref_from_cur, const Matte& matte) {
    double sum = 0;
    std::int64_t count = 0;
    const int step = std::max(8, ref_from_cur.spacing());
    const auto reach = static_cast<float>(step) * 0.5f;
    for (int y = step / 2; y < matte.height(); y += step) {
        for (int x = step / 2; x < matte.width(); x += step) {
            if (matte.at(x, y) < 128) continue;
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const auto slope = [&](Vec2 along) {
                const Vec2 d =
                    ref_from_cur.at(p + along * reach) - ref_from_cur.at(p - along * reach);
                return along + d / (2 * reach);
            };
            const Vec2 a = slope({1, 0}), b = slope({0, 1});
            const float area = std::sqrt(std::max(1e-6f, std::abs(a.x * b.y - a.y * b.x)));
            sum += static_cast<double>(std::max(area, 1 / area));
            ++count;
        }
    }
    return count == 0 ? -1.0f : static_cast<float>(sum / static_cast<double>(count));
}

// Measures drift and stretch of the analysed frames, or of as many as a strip can show.
void Preview::Impl::collect_health(const OpenedShot& work, const CancelToken& token) {
    const Shot& shot = *work.shot;
    const std::vector<int>& all = shot.plate->frames();
    const std::size_t stride =
        std::max<std::size_t>(1, (all.size() + kMostFrames - 1) / kMostFrames);
    const int factor = std::max(1, shot.source->size().width / 480);
    const ZonedAnalysis placed(*shot.source, shot.plan, *work.store);
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        const RegionId id = shot.project.regions[shot.region_index[k]]->id;
        const int index = static_cast<int>(k);
        auto reference = shot.source->plate(plan.reference_frames.front());
        if (!reference || plan.temporal == TemporalMode::kNone) continue;
        const ImageF1 before = small_pattern(**reference, *shot.plan.display_from_plate, factor);
        for (std::size_t i = 0; i < all.size(); i += stride) {
            const AnalysisKey key{index, all[i], AnalysisKind::kCoords};
            if (!work.store->has(key)) continue;
            if (token.cancelled()) return;
            const auto bytes = placed.get(key);
            const auto field =
                bytes ? decode_lattice(*bytes) : tl::unexpected<Error>(bytes.error());
            auto matte = extent_matte(*shot.source, shot.plan, *work.store, index, all[i]);
            auto plate = shot.source->plate(all[i]);
            if (!field || !matte || !plate) continue;
            FrameHealth found;
            found.stretch = mean_stretch(*field, *matte);
            found.drift =
                pattern_drift(small_pattern(**plate, *shot.plan.display_from_plate, factor), before,
                              *field, *matte, factor);
            const auto shared = guarded.lock();
            if (shared->wanted_analysis != work.analysis) return;
            FrameHealth& kept = shared->healths[id][all[i]];
            kept.drift = found.drift;
            kept.stretch = found.stretch;
            changed(*shared);
        }
    }
}

}  // namespace weft
