#include "app/session/viewer/preview_desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

// The indices first … last, those next to `at` first; while playing, in the order of playback.
std::vector<int> fill_order(int at, int first, int last, bool playing) {
    std::vector<int> out;
    for (int k = at; k <= last; ++k)
        out.push_back(k);
    for (int k = first; k < at; ++k)
        out.push_back(k);
    if (!playing)
        std::stable_sort(out.begin(), out.end(),
                         [&](int a, int b) { return std::abs(a - at) < std::abs(b - at); });
    return out;
}

const PicturePtr& final_of(const PreviewFrame& frame) {
    return frame.stages[static_cast<std::size_t>(Stage::kFinal)];
}

}  // namespace

Project PreviewDesk::subject() const {
    Project project = use_.document.resolved();
    project.settings.quality = quality_;
    const RegionId solo = use_.selection.solo;
    for (Leaf<Region>& region : project.regions) {
        const bool hidden = !region->enabled || (solo != 0 && solo != region->id);
        const bool unready = region->matte->empty() ||
                             (region->texture.sample.empty() && region->texture.plane.empty());
        if (hidden || unready) region = region.with([](Region& r) { r.enabled = false; });
    }
    return project;
}

// Painted mattes are propagated to the other frames before a texture is chosen.
void PreviewDesk::propagate_mattes() {
    Project project = use_.document.resolved();
    project.settings.quality = quality_;
    for (Leaf<Region>& region : project.regions) {
        const bool waits = region->enabled && !region->matte->keyframes.empty() &&
                           region->texture.sample.empty() && region->texture.plane.empty();
        region = region.with([&](Region& r) { r.enabled = waits; });
    }
    use_.preview.propagate(project, use_.shelf.unwritten(), use_.playback.frame());
}

// While a setting is dragged, the next request waits for the picture of the one before. It would
// cancel that one, and nothing would be seen until the mouse rests.
bool PreviewDesk::awaits_dragged_picture(double now_s) const {
    constexpr double kPatienceS = 2;
    return use_.document.trying() && !final_of(reading_.frame) && dragged_at_s_ &&
           now_s - *dragged_at_s_ < kPatienceS && !failed_;
}

PreviewRequest PreviewDesk::request_for(Project subject,
                                        const std::vector<CardRequest>& cards) const {
    const Playback& playback = use_.playback;
    const auto& frames = playback.frames();
    PreviewRequest request;
    request.document = use_.document.id();
    request.project = std::move(subject);
    request.frame = playback.frame();
    request.range = frames;
    request.painted = use_.shelf.unwritten();
    request.stages = stages_;
    request.layer = layer_;
    request.overlay = overlay_;
    request.overlay_region = use_.selection.region;
    request.cards = cards;
    request.files = files_;
    request.interactive = playback.direction() != 0;
    // The marked range, or else this many frames around the playhead.
    constexpr int kAround = 24;
    const auto [first, last] = playback.range();
    const int at = playback.index();
    const int before = playback.direction() != 0 ? 0 : kAround / 4;
    const int from = playback.marked() ? first : std::max(first, at - before);
    const int to = playback.marked() ? last : std::min(last, at + kAround);
    for (const int k : fill_order(std::clamp(at, from, to), from, to, request.interactive))
        request.fill.push_back(frames[static_cast<std::size_t>(k)]);
    return request;
}

void PreviewDesk::request(double now_s, const std::vector<CardRequest>& cards) {
    if (!pending_ || awaits_dragged_picture(now_s)) return;
    if (!use_.plate.reader()) {
        pending_ = false;
        return;
    }
    propagate_mattes();
    Project shown = subject();
    has_subject_ = std::any_of(shown.regions.begin(), shown.regions.end(),
                               [](const Leaf<Region>& region) { return region->enabled; });
    // The first texture of a shot is chosen from such cards: their own region is shown in them.
    const bool for_cards = !has_subject_ && !cards.empty();
    if (for_cards) shown = cards.front().project;
    if (!has_subject_ && !for_cards) {
        pending_ = false;
        use_.preview.clear();
        reading_ = {};
        return;
    }
    PreviewRequest request = request_for(std::move(shown), cards);
    if (for_cards) {
        request.range = {request.frame};
        request.fill.clear();
        request.stages = false;
        request.overlay = Overlay::kNone;
    }
    if (!use_.preview.try_request(request)) return;  // retried in the next frame
    pending_ = false;
    dragged_at_s_ = use_.document.trying() ? std::optional(now_s) : std::nullopt;
    reading_.frame = {};
    reading_.rendered.clear();
}

void PreviewDesk::forget() {
    use_.preview.forget(use_.document.id());
    reading_ = {};
    last_result_.reset();
    last_result_frame_ = 0;
    stages_ = false;
    layer_.reset();
    overlay_ = Overlay::kNone;
}

void PreviewDesk::read() {
    const int frame = use_.playback.frame();
    if (!use_.preview.try_read(frame, use_.selection.region, use_.selection.layer, reading_) &&
        frame != read_frame_)
        reading_.frame = {};
    // With a texture that was only suggested.
    if (!has_subject_) reading_.frame = {};
    read_frame_ = frame;
    failed_ = reading_.view.state == PreviewView::State::kFailed;
    if (const PicturePtr& final = final_of(reading_.frame)) {
        last_result_ = final;
        last_result_frame_ = frame;
    }
}

void PreviewDesk::show(SessionView& view) const {
    view.preview = reading_.view;
    view.analysis_paused = reading_.paused;
    view.preview_quality = quality_;
    view.overlay = overlay_;
    view.stages_shown = stages_;
    view.layer = layer_;
    view.stages = reading_.frame;
    view.result_current = final_of(reading_.frame) && !reading_.frame.provisional;
    // An older result of this frame stays until the new one is ready, and is marked as outdated.
    view.result_wanted = has_subject_;
    view.result_picture =
        has_subject_ && last_result_frame_ == read_frame_ ? last_result_ : nullptr;
    view.overlay_picture = reading_.overlay;
    if (view.overlay_picture && view.overlay_picture->frame != read_frame_)
        view.overlay_picture.reset();
}

}  // namespace weft
