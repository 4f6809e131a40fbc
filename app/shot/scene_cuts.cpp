#include "app/shot/scene_cuts.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

constexpr float kOverOthers = 3.0f;  // multiple of the median change
constexpr int kBrief = 3;            // frames after which a scene may come back

using Looks = std::map<int, FrameLook>;

float usual_spread(const Looks& looks) {
    float most = 0;
    for (const auto& [frame, look] : looks)
        most = std::max(most, look.spread);
    return most;
}

// Whether the scene of `before` is back within a few frames after `at`.
bool comes_back(const FrameLook& before, Looks::const_iterator at, const Looks& looks) {
    int frame = at->first;
    for (int k = 0; k < kBrief; ++k) {
        if (++at == looks.end() || at->first != ++frame) return false;
        if (!may_be_cut(change_between(before, at->second))) return true;
    }
    return false;
}

}  // namespace

void CutWatch::look_at(int frame, ViewF3 plate, bool display_encoded) {
    {
        const std::lock_guard lock(mutex_);
        if (looks_.contains(frame)) return;
    }
    const FrameLook look = weft::look_at(plate, display_encoded);
    const std::lock_guard lock(mutex_);
    looks_.emplace(frame, look);
}

std::vector<int> CutWatch::cuts() const {
    const std::lock_guard lock(mutex_);
    struct Step {
        int frame;
        LookChange change;
    };
    const float usual = usual_spread(looks_);
    std::vector<Step> steps;
    const FrameLook* shown = nullptr;
    int last = 0;
    for (auto at = looks_.begin(); at != looks_.end(); ++at) {
        if (shown && at->first != last + 1) shown = nullptr;  // what lies between was not read
        last = at->first;
        if (shows_nothing(at->second, usual)) continue;
        if (shown) {
            const LookChange change = change_between(*shown, at->second);
            if (may_be_cut(change) && comes_back(*shown, at, looks_)) continue;
            steps.push_back({at->first, change});
        }
        shown = &at->second;
    }
    if (steps.empty()) return {};
    std::vector<float> places;
    for (const Step& step : steps)
        places.push_back(step.change.place);
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>((places.size() - 1) / 2);
    std::nth_element(places.begin(), middle, places.end());
    const float median = places.size() > 2 ? *middle : 0.0f;
    std::vector<int> out;
    for (const Step& step : steps) {
        if (may_be_cut(step.change) && step.change.place > kOverOthers * median)
            out.push_back(step.frame);
    }
    return out;
}

}  // namespace weft
