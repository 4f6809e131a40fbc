#include "app/editor/frame_pace.h"

#include <algorithm>

namespace weft {
namespace {

constexpr double kRest_s = 0.1, kPassing_s = 0.5;
constexpr double kAtHand_s = 1.0 / 120, kWaiting_s = 1.0 / 30;
constexpr double kAfterEvent_s = 0.25;
// What workers change is shown ten times a second; then once more, since ImGui lays out anew a
// frame later what has changed its size.
constexpr double kChanged_s = 0.1;
constexpr int kSettle = 3;

}  // namespace

bool FramePace::rests(const WindowMoment& moment) const {
    return left_ == 0 && !moment.busy && !moment.at_hand;
}

double FramePace::wait_s(const WindowMoment& moment) const {
    if (rests(moment)) return kRest_s;
    const bool quick = moment.at_hand || moment.now_s - event_s_ < kAfterEvent_s;
    return std::max(0.0, drawn_s_ + (quick ? kAtHand_s : kWaiting_s) - moment.now_s);
}

bool FramePace::draws(const WindowMoment& moment) {
    if (moment.event) event_s_ = moment.now_s;
    const bool changed = moment.changes != seen_;
    if (moment.event || moment.busy || moment.at_hand) {
        left_ = kSettle;
        seen_ = moment.changes;
    } else if (left_ == 0 && (changed || settles_) && moment.now_s - drawn_s_ >= kChanged_s) {
        left_ = 1;
        settles_ = changed;
        seen_ = moment.changes;
    }
    if (left_ == 0 && moment.passing && moment.now_s - drawn_s_ >= kPassing_s) left_ = 1;
    if (left_ == 0) return false;
    --left_;
    drawn_s_ = moment.now_s;
    return true;
}

}  // namespace weft
