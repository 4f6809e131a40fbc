#include "app/session/jobs/measurement.h"

#include <mutex>
#include <thread>
#include <utility>

#include "app/base/background.h"
#include "app/preview/propagation_key.h"
#include "app/session/jobs/measured_result.h"
#include "app/shot/matte_movies.h"

namespace weft {
namespace {

std::function<Expected<Matte>(int)> mattes_of(const Project& absolute, const Region& region,
                                              const ShownPlate& plate, const Preview& preview) {
    return
        [&preview, source = *region.matte, plate = plate.reader(), drawn = plate.drawn(),
         id = region.id, key = propagation_key(absolute, region, 0)](int frame) -> Expected<Matte> {
            if (!source.shape.empty())
                return drawn->matte(source.shape, source.select.invert, frame);
            if (source.files.empty()) return preview.propagated_matte({id, 0, frame, key});
            WEFT_TRY(files, matte_files(source.files, *plate));
            return files.read(frame, source.select, plate->size());
        };
}

}  // namespace

struct Measurement::Running {
    SharedReport shared;
    std::thread thread;
    ~Running() {
        shared.cancelled = true;
        if (thread.joinable()) thread.join();
    }
};

void Measurement::start(const std::string& pattern) {
    const Project absolute = use_.document.resolved();
    const Region* region = use_.selection.of(absolute);
    if (!region || !use_.plate.reader()) {
        use_.notices.add(NoticeKind::kWarning, "Select a region to measure.");
        return;
    }
    end();
    running_ = std::make_shared<Running>();
    running_->shared.report.state = QualityReport::State::kMeasuring;
    running_->shared.report.pattern = pattern;
    MeasuredResult what;
    what.plate = use_.plate.reader();
    what.pattern = pattern;
    what.matte = mattes_of(absolute, *region, use_.plate, use_.preview);
    what.track = [&preview = use_.preview, id = region->id](int before, int now) {
        return preview.track(id, before, now);
    };
    running_->thread = std::thread([what, &shared = running_->shared] {
        lower_thread_priority();
        const Status done = measure_result(what, shared);
        const std::lock_guard lock(shared.mutex);
        shared.report.state = done ? QualityReport::State::kDone : QualityReport::State::kFailed;
        if (!done) shared.report.error = done.error().text();
    });
}

void Measurement::end() {
    if (!running_) return;
    running_->shared.cancelled = true;
    use_.shutdowns.end(std::exchange(running_, nullptr));
    busy_ = false;
}

void Measurement::show(SessionView& view) {
    if (running_) {
        const std::lock_guard lock(running_->shared.mutex);
        view.report = running_->shared.report;
    }
    busy_ = running_ && view.report.state == QualityReport::State::kMeasuring;
}

}  // namespace weft
