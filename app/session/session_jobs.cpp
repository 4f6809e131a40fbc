// Submits renders and measures their results.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "app/base/background.h"
#include "app/preview/preview_flicker.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/session/session_measuring.h"
#include "app/shot/matte_movies.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "engine/metrics/matte_chatter.h"
#include "engine/metrics/region.h"
#include "engine/metrics/sequence_measure.h"
#include "engine/metrics/tde.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Inputs of the measuring thread, independent of the session.
struct MeasuringInputs {
    std::shared_ptr<const FrameReader> plate;
    std::string result_pattern;
    std::function<Expected<Matte>(int)> matte;
    std::function<Expected<LatticeField>(int before, int now)> track;
};

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

Status measure_all(const MeasuringInputs& in, Measuring& shared) {
    WEFT_TRY(result, open_plate(in.result_pattern, {}));
    WEFT_TRY(files, SequencePattern::parse(in.result_pattern));
    std::vector<int> frames;
    for (const int frame : result->frames())
        if (std::binary_search(in.plate->frames().begin(), in.plate->frames().end(), frame))
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
        WEFT_TRY(before, in.plate->read(frame));
        WEFT_TRY(matte, in.matte(frame));
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
            if (const auto field = in.track(kept.frame, frame)) {
                const TemporalError least =
                    carried_tde(kept.result, dense_flow(*field), motion,
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

}  // namespace

void Session::submit(const SubmitJob& action) {
    if (!open_ || !reader_) {
        notify(NoticeKind::kWarning, "Open a plate before rendering.");
        return;
    }
    if (has_errors(validate(document()))) {
        notify(NoticeKind::kError, validate(document()).front().text());
        return;
    }
    end_stroke();
    Project project = resolve_paths(history_.current(), project_dir(path_));
    if (!path_.empty()) project.name = fs::path(path_).stem().string();
    auto request = render_request(action, std::move(project), reader_->frames());
    if (!request) {
        notify(NoticeKind::kError, request.error().text());
        return;
    }
    if (!may_render_to(request->project)) return;
    file_tasks_.start([this, request = std::move(*request)]() -> Finish {
        // Painted mattes must be on disk before the renderer reads them.
        shelf_.flush();
        const auto id = jobs_.submit(request);
        return [this, request, id] {
            if (!id) {
                notify(NoticeKind::kError, id.error().text());
                return;
            }
            notify(NoticeKind::kInfo,
                   "Rendering " + std::to_string(request.frames.size()) + " frames to " +
                       fs::path(request.project.output.path).parent_path().filename().string() +
                       ".");
        };
    });
}

void Session::watch_jobs() {
    for (const JobDesk::Ended& job : jobs_.poll()) {
        if (job.failed)
            notify(NoticeKind::kError, "Render failed. " + job.error);
        else
            notify(NoticeKind::kGood, "Rendered: " + job.label + ".");
    }
    view_.jobs = jobs_.jobs();
}

// It ends in the background, because it may be reading a large frame.
void Session::end_measuring() {
    if (!measuring_) return;
    measuring_->cancelled = true;
    shutdowns_.push_back(
        in_background([old = std::exchange(measuring_, nullptr)]() mutable { old.reset(); }));
}

void Session::measure(const std::string& pattern) {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !reader_) {
        notify(NoticeKind::kWarning, "Select a region to measure.");
        return;
    }
    end_measuring();
    measuring_ = std::make_shared<Measuring>();
    measuring_->report.state = QualityReport::State::kMeasuring;
    measuring_->report.pattern = pattern;
    MeasuringInputs in{reader_, pattern, {}, {}};
    const MatteSource source =
        *resolve_paths(document(), project_dir(path_))
             .regions[find_region(document(), std::to_string(selected_)).value_or(0)]
             ->matte;
    const Size size = reader_->size();
    in.matte = [this, source, size, plate = reader_, drawn = drawn_,
                id = region->id](int frame) -> Expected<Matte> {
        if (!source.shape.empty()) return drawn->matte(source.shape, source.select.invert, frame);
        if (source.files.empty()) return preview_.propagated_matte(id, 0, frame);
        WEFT_TRY(files, matte_files(source.files, *plate));
        return files.read(frame, source.select, size);
    };
    in.track = [this, id = region->id](int before, int now) {
        return preview_.track(id, before, now);
    };
    measuring_->thread = std::thread([in, shared = measuring_.get()] {
        lower_thread_priority();
        const Status done = measure_all(in, *shared);
        const std::lock_guard lock(shared->mutex);
        shared->report.state = done ? QualityReport::State::kDone : QualityReport::State::kFailed;
        if (!done) shared->report.error = done.error().text();
    });
}

}  // namespace weft
