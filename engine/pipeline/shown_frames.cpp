#include "engine/pipeline/shown_frames.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

constexpr int kBrief = 3;     // frames that may be of another scene
constexpr int kLongest = 96;  // frames that show nothing at the beginning of a sweep
constexpr float kWhole = 1;   // the largest spread that there is

}  // namespace

// A shot may begin with black.
Expected<ShownFrames::Seen> ShownFrames::begin(Seen frame, const Peek& peek) {
    const FrameLook first = look_at(frame.views->followed());
    seen_ = std::move(frame);
    look_ = first;
    usual_ = first.spread;
    if (!shows_nothing(first, kWhole)) return seen_;
    for (int ahead = 1; ahead <= kLongest; ++ahead) {
        WEFT_TRY(later, peek(ahead));
        if (!later.views) break;
        const FrameLook look = look_at(later.views->followed());
        if (!shows_nothing(first, look.spread)) continue;
        seen_ = std::move(later);
        look_ = look;
        usual_ = look.spread;
        seen_ahead_ = ahead;
        break;
    }
    return seen_;
}

// Whether the scene of before comes back soon.
Expected<bool> ShownFrames::is_brief(const Peek& peek) const {
    for (int ahead = 1; ahead <= kBrief; ++ahead) {
        WEFT_TRY(later, peek(ahead));
        if (!later.views) return false;
        const FrameLook then = look_at(later.views->followed());
        if (!shows_nothing(then, usual_) && !is_another_scene(look_, then)) return true;
    }
    return false;
}

Expected<ShownFrames::Seen> ShownFrames::next(Seen frame, const Peek& peek) {
    if (!seen_.views) return begin(std::move(frame), peek);
    if (seen_ahead_ > 0) {
        --seen_ahead_;
        return seen_;
    }
    const FrameLook look = look_at(frame.views->followed());
    if (shows_nothing(look, usual_)) return seen_;
    const bool other = is_another_scene(look_, look);
    if (other) {
        WEFT_TRY(brief, is_brief(peek));
        if (brief) return seen_;
    }
    seen_ = frame;
    look_ = look;
    usual_ = std::max(usual_, look.spread);
    frame.cut = other;
    return frame;
}

bool are_neighbours(const PlateViews& a, const PlateViews& b) {
    const FrameLook here = look_at(a.followed()), there = look_at(b.followed());
    return !shows_nothing(here, kWhole) && !shows_nothing(there, kWhole) &&
           !is_another_scene(here, there);
}

}  // namespace weft
