#include "app/session/jobs/measured_result.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/preview/preview_flicker.h"
#include "engine/media/image_files.h"
#include "engine/media/plates.h"
#include "engine/media/sequence_pattern.h"
#include "engine/metrics/matte_chatter.h"
#include "engine/metrics/region.h"
#include "engine/metrics/sequence_measure.h"
#include "engine/metrics/tde.h"

namespace weft {
namespace {

// Mean absolute luma difference to the right and lower neighbour, where both pixels are inside.
double mean_step(ViewF3 picture, ViewU8x1 matte) {
    const auto luma = [&](int x, int y) {
        const float* p = picture.pixel(x, y);
        return 0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) +
               0.0722 * static_cast<double>(p[2]);
    };
    constexpr std::uint8_t kInside = 200;
    double sum = 0;
    std::int64_t count = 0;
    for (int y = 0; y + 1 < picture.height(); ++y)
        for (int x = 0; x + 1 < picture.width(); ++x) {
            if (matte.at(x, y) < kInside || matte.at(x + 1, y) < kInside ||
                matte.at(x, y + 1) < kInside)
                continue;
            const double here = luma(x, y);
            sum += std::abs(luma(x + 1, y) - here) + std::abs(luma(x, y + 1) - here);
            ++count;
        }
    return count ? sum / static_cast<double>(count) : 0;
}

// In per cent of the first value that is not zero.
float of_first(double value, double& first) {
    if (first <= 0) first = value;
    return first > 0 ? static_cast<float>(100 * value / first) : 0;
}

}  // namespace

Status measure_result(const MeasuredResult& what, SharedReport& shared) {
    WEFT_TRY(result, open_plate(what.pattern, {}));
    WEFT_TRY(files, SequencePattern::parse(what.pattern));
    std::vector<int> frames;
    for (const int frame : result->frames())
        if (std::binary_search(what.plate->frames().begin(), what.plate->frames().end(), frame))
            frames.push_back(frame);
    {
        const std::lock_guard lock(shared.mutex);
        shared.report.total = static_cast<int>(frames.size());
    }
    MeasureOptions options;
    options.measure_drift = false;
    SequenceMeasure measure(options);
    double first_step = 0, first_plate_step = 0;
    struct Kept {
        int frame = 0;
        ImageF1 result, plate;
        Matte matte;
    } kept;
    for (const int frame : frames) {
        if (shared.cancelled) return {};
        WEFT_TRY(after, result->read(frame));
        WEFT_TRY(before, what.plate->read(frame));
        WEFT_TRY(matte, what.matte(frame));
        Kept now{frame, luma_8bit(after.rgb), luma_8bit(before.rgb), matte};
        MeasureFrame step;
        step.frame = frame;
        step.result = after.rgb;
        step.source = before.rgb;
        step.matte = matte;
        FlowField motion;
        float floor = -1;
        if (!kept.matte.empty() && kept.matte.size() == matte.size()) {
            motion = measuring_motion(kept.plate, now.plate, kept.matte, matte,
                                      MeasuringEstimator::kFarneback, kChatterReachPx);
            step.motion = &motion;
            if (const auto field = what.track(kept.frame, frame)) {
                const TemporalError least =
                    warped_tde(kept.result, dense_flow(*field), motion,
                               visible_in_both(motion, kept.matte, matte, options.erode_px));
                if (least.pixels > 0) floor = static_cast<float>(least.tde);
            }
        }
        WEFT_TRY(found, measure.add(step));
        const float sharpness = of_first(mean_step(after.rgb, matte), first_step);
        const float plate_sharpness = of_first(mean_step(before.rgb, matte), first_plate_step);
        kept = std::move(now);
        const std::lock_guard lock(shared.mutex);
        ++shared.report.done;
        shared.report.rows.push_back({frame, files.path_for(frame),
                                      static_cast<float>(found.tde.value_or(0)),
                                      static_cast<float>(found.source_tde.value_or(0)),
                                      static_cast<float>(found.mean_v.value_or(0)),
                                      static_cast<float>(found.source_mean_v.value_or(0)),
                                      sharpness, plate_sharpness, floor});
    }
    return {};
}

}  // namespace weft
