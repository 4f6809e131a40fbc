#include "app/session/mattes/matte_strokes.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/mattes/matte_layer.h"

namespace weft {

void MatteStrokes::prepare(const SessionView& shown) {
    if (!use_.target.is_ready()) return;
    const MattePlace place = use_.target.place();
    const auto& views = place.layer == 0  ? shown.mattes
                        : place.layer > 0 ? shown.holdouts
                                          : shown.zones;
    const auto here = std::find_if(views.begin(), views.end(), [&](const RegionMatteView& view) {
        return view.region == place.region && view.layer == place.layer;
    });
    if (here == views.end() || here->kind == RegionMatteView::Kind::kLoading ||
        here->kind == RegionMatteView::Kind::kUnreached)
        return;
    use_.painting.prepare(here->keep, use_.target.size());
}

void MatteStrokes::begin(const BeginStroke& action) {
    end();
    if (!use_.document.is_open() || !use_.target.may_paint()) return;
    counts_ = action.kind == StrokeKind::kConfirm ? Counts::kAsRight
              : action.kind == StrokeKind::kHere  ? Counts::kPart
                                                  : Counts::kAll;
    const bool confirms = counts_ == Counts::kAsRight;
    if (confirms && !may_confirm()) return;
    MattePlace place = use_.target.place();
    const PaintBase base = use_.target.base(place, counts_);
    if (base.state == PaintBase::State::kUnreached) return use_.target.refuse(base, place);
    use_.playback.stop();
    Brush brush = action.brush;
    brush.aspect = use_.target.aspect();
    if (confirms) {
        place.confirmed = true;
        brush.opacity = 1;
        brush.pressure_opacity = false;
    }
    use_.painting.begin(place, use_.target.size(), brush);
    update();
    use_.painting.move_to(action.at, action.pressure);
}

bool MatteStrokes::may_confirm() const {
    const MatteSource& source = use_.target.source();
    if (source.keyframes.empty()) {
        use_.notices.add(
            NoticeKind::kWarning,
            "Paint a keyframe first. Then confirm edges on the frames it is propagated to.");
        return false;
    }
    if (!PaintTarget::counts_as_whole(source, use_.target.place().frame)) return true;
    use_.notices.add(
        NoticeKind::kInfo,
        "This frame is a keyframe or frozen: its whole matte counts as right already.");
    return false;
}

void MatteStrokes::update() {
    if (!use_.painting.waits() || use_.changes.busy()) return;
    PaintBase base = use_.target.base(use_.painting.place(), counts_);
    if (base.state == PaintBase::State::kReading) return;
    if (base.state != PaintBase::State::kReady) {
        use_.target.refuse(base, use_.painting.place());
        return use_.painting.cancel();
    }
    part_ = std::move(base.part);
    use_.painting.begin_on(base.before);
}

ChangeLabels MatteStrokes::labels(const MattePlace& place) const {
    const Region* region = region_by_id(use_.document.project(), place.region);
    return {"Paint " + (region ? layer_name(*region, place.layer) : std::string()),
            counts_ == Counts::kAsRight ? "Confirm edge of " : "Correct "};
}

void MatteStrokes::end() {
    if (const auto waiting = use_.painting.take_waiting())
        return use_.changes.paint(*waiting, counts_, labels(waiting->place));
    const auto done = use_.painting.end();
    if (!done) return;
    use_.changes.forget_undone();
    use_.kept.keep_change({done->matte, done->stroke->covered()}, part_, done->place,
                          labels(done->place));
}

}  // namespace weft
