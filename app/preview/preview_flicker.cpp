#include "app/preview/preview_flicker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "app/preview/preview_impl.h"
#include "engine/color/color_space.h"
#include "engine/metrics/matte_chatter.h"
#include "engine/metrics/region.h"
#include "engine/metrics/sequence_measure.h"
#include "engine/metrics/tde.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/render_frame.h"

namespace weft {
namespace {

// Approximate size of the compared pictures.
constexpr std::int64_t kComparedPixels = 130'000;

float plain(const std::optional<double>& value) {
    return value ? static_cast<float>(*value) : -1.0f;
}

}  // namespace

SeamPoints seam_points(const RenderedFrame& frame) {
    SeamPoints out;
    if (!frame.layers) return out;
    const ImageF1& seam = frame.layers->seam;
    for (int y = 0; y < seam.height(); ++y)
        for (int x = 0; x < seam.width(); ++x)
            if (seam.at(x, y) > 0.5f)
                out.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    return out;
}

float seam_motion_px(const SeamPoints& before, const SeamPoints& now, const FlowField& motion,
                     int scale) {
    if (now.empty()) return -1;
    const int width = motion.size().width * scale, height = motion.size().height * scale;
    cv::Mat seams(height, width, CV_8U, cv::Scalar(255)), distance;
    for (const auto& [x, y] : now)
        if (x < width && y < height) seams.at<std::uint8_t>(y, x) = 0;
    cv::distanceTransform(seams, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    RowSum sum;
    for (const auto& [x, y] : before) {
        const int u = x / scale, v = y / scale;
        if (u >= motion.size().width || v >= motion.size().height || motion.valid.at(u, v) == 0)
            continue;
        const auto along = [&](int at, int c) {
            return at +
                   static_cast<int>(std::lround(motion.d.at(u, v, c) * static_cast<float>(scale)));
        };
        const int tx = along(x, 0), ty = along(y, 1);
        if (tx < 0 || ty < 0 || tx >= width || ty >= height) continue;
        sum.add(static_cast<double>(distance.at<float>(ty, tx)));
    }
    constexpr std::int64_t kLeast = 16;
    return sum.count < kLeast ? -1.0f : static_cast<float>(sum.mean());
}

Steadiness measure_steadiness(const FramePair& pair) {
    const FlowField motion =
        measuring_motion(luma_8bit(pair.before.plate), luma_8bit(pair.now.plate), pair.before.matte,
                         pair.now.matte, MeasuringEstimator::kFarneback, kChatterReachPx);
    MeasureOptions options;
    options.measure_drift = false;
    // Pixels at the edge of small pictures mix two surfaces.
    options.erode_px = 1;
    options.measure_pops = true;
    SequenceMeasure measure(options);
    Steadiness out;
    for (const FramePair::Frame* frame : {&pair.before, &pair.now}) {
        MeasureFrame step;
        step.result = frame->result;
        step.source = frame->plate;
        step.matte = frame->matte;
        step.motion = &motion;
        const auto found = measure.add(step);
        if (!found) return {};
        out.flicker = plain(found->tde);
        out.flicker_plate = plain(found->source_tde);
        out.chatter = plain(found->matte_chatter_px) * pair.plate_scale;
        out.steps = found->steps;
    }
    if (!pair.before_from_now.empty()) {
        const Matte visible =
            visible_in_both(motion, pair.before.matte, pair.now.matte, options.erode_px);
        const TemporalError floor =
            warped_tde(luma_8bit(pair.before.result), pair.before_from_now, motion, visible);
        if (floor.pixels > 0) out.flicker_floor = static_cast<float>(floor.tde);
    }
    if (pair.before.seams && pair.now.seams) {
        // Measures whether seams stay on the texture; whether the texture stays on the surface is
        // drift.
        FlowField inside = pair.before_from_now;
        if (!inside.empty()) inside.valid = eroded_inside(pair.now.matte, options.erode_px);
        const float moved =
            inside.empty()
                ? seam_motion_px(*pair.before.seams, *pair.now.seams, motion, pair.seam_scale)
                : seam_motion_px(*pair.now.seams, *pair.before.seams, inside, pair.seam_scale);
        if (moved >= 0)
            out.seam_motion = moved * pair.plate_scale / static_cast<float>(pair.seam_scale);
    }
    return out;
}

ImageF3 encoded_small(const Picture& picture, int factor) {
    ImageF3 out(picture.size);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const Vec3 v = picture.at(x, y);
            std::copy_n(&v.x, 3, out.pixel(x, y));
        }
    return factor > 1 ? shrunk(out, factor) : out;
}

FlowField dense_flow(const LatticeField& field) {
    FlowField out(field.full_size());
    out.d = field.dense(rect_of(field.full_size()));
    return out;
}

Expected<LatticeField> track_between(const OpenedShot& opened, std::size_t region, int before,
                                     int now) {
    const ZonedAnalysis placed(*opened.shot->source, opened.shot->plan, *opened.store);
    const auto ref_from = [&](int frame) -> Expected<LatticeField> {
        WEFT_TRY(bytes, placed.get({static_cast<int>(region), frame, AnalysisKind::kCoords}));
        return decode_lattice(bytes);
    };
    WEFT_TRY(ref_from_before, ref_from(before));
    WEFT_TRY(ref_from_now, ref_from(now));
    return compose(ref_from_now, inverse(ref_from_before));
}

// Compares the next pair of rendered neighbouring frames. Returns false if there is none.
bool Preview::Impl::step_flicker(const PreviewRequest& now) {
    if (now.interactive) return false;
    const Shot& shot = *current->shot;
    const std::vector<int>& all = shot.plate->frames();
    int before = 0, frame = 0;
    PicturePtr first, second;
    FramePair pair;
    {
        const auto shared = guarded.lock();
        for (auto it = shared->frames.begin(); !second && it != shared->frames.end(); ++it) {
            const auto at = std::lower_bound(all.begin(), all.end(), it->first);
            if (at == all.begin() || at == all.end() || compared.contains(it->first)) continue;
            const auto previous = shared->frames.find(*std::prev(at));
            if (previous == shared->frames.end() || previous->second.approximate ||
                it->second.approximate)
                continue;
            first = previous->second.comparable();
            second = it->second.comparable();
            if (!first || !second || first->size != second->size) {
                second.reset();
                continue;
            }
            before = previous->first;
            frame = it->first;
            pair.before.seams = previous->second.seams;
            pair.now.seams = it->second.seams;
        }
    }
    if (!second) return false;
    compared.insert(frame);
    const int proxy = (shot.source->size().width + second->size.width - 1) / second->size.width;
    const int factor = std::max(proxy, proxy_factor(shot.source->size(), kComparedPixels));
    pair.seam_scale = factor / proxy;
    pair.plate_scale = static_cast<float>(factor);
    for (const auto& [of, picture, to] :
         {std::tuple(before, first, &pair.before), std::tuple(frame, second, &pair.now)}) {
        const auto plate = shot.source->plate(of);
        if (!plate) return true;
        to->plate = shrunk(transformed(**plate, *shot.plan.display_from_plate), factor);
        to->result = encoded_small(*picture, pair.seam_scale);
    }
    for (std::size_t k = 0; k < shot.region_index.size(); ++k) {
        const auto matte_of = [&](int of) -> Expected<Matte> {
            const int region = static_cast<int>(k);
            WEFT_TRY(extent, extent_matte(*shot.source, shot.plan, *current->store, region, of));
            WEFT_TRY(holdout, holdout_matte(*shot.source, shot.plan, *current->store, region, of));
            return shrunk(without_holdout(extent, holdout), factor);
        };
        auto there = matte_of(before), here = matte_of(frame);
        if (!there || !here) continue;
        const auto track = track_between(*current, k, before, frame);
        pair.before_from_now = track ? dense_flow(shrunk(*track, factor)) : FlowField();
        pair.before.matte = std::move(*there);
        pair.now.matte = std::move(*here);
        const Steadiness found = measure_steadiness(pair);
        const auto shared = guarded.lock();
        if (shared->wanted_pixels != current->pixels) return true;
        FrameHealth& health =
            shared->healths[shot.project.regions[shot.region_index[k]]->id][frame];
        health.flicker = found.flicker;
        health.flicker_plate = found.flicker_plate;
        health.flicker_floor = found.flicker_floor;
        health.chatter = found.chatter;
        health.seam_motion = found.seam_motion;
        health.steps = found.steps;
        changed(*shared);
    }
    return true;
}

}  // namespace weft
