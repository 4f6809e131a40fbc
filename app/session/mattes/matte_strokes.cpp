#include "app/session/mattes/matte_strokes.h"

#include <algorithm>
#include <string>

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
    if (here == views.end() || here->kind == RegionMatteView::Kind::kLoading) return;
    use_.painting.prepare(here->keep, use_.target.size());
}

void MatteStrokes::begin(const BeginStroke& action, bool busy) {
    end();
    before_.reset();
    if (!use_.document.is_open() || !use_.target.may_paint(busy)) return;
    if (action.kind == StrokeKind::kConfirm)
        begin_confirming(action);
    else
        begin_painting(action);
}

void MatteStrokes::begin_painting(const BeginStroke& action) {
    const auto matte = use_.target.matte();
    if (!matte) return;
    if (use_.target.counts_in_part(action.kind == StrokeKind::kHere) &&
        !(before_ = use_.target.confirmed()))
        return;
    use_.playback.stop();
    use_.painting.begin(use_.target.place(), *matte, use_.target.size(), action.brush);
    use_.painting.move_to(action.at, action.pressure);
}

void MatteStrokes::begin_confirming(const BeginStroke& action) {
    if (use_.target.source().keyframes.empty())
        return use_.notices.add(
            NoticeKind::kWarning,
            "Paint a keyframe first. Then confirm edges on the frames it is propagated to.");
    if (use_.target.counts_as_whole())
        return use_.notices.add(
            NoticeKind::kInfo,
            "This frame is a keyframe or frozen: its whole matte counts as right already.");
    before_ = use_.target.confirmed();
    if (!before_) return;
    use_.playback.stop();
    MattePlace place = use_.target.place();
    place.confirmed = true;
    Brush brush = action.brush;
    brush.opacity = 1;
    brush.pressure_opacity = false;
    use_.painting.begin(place, before_->area, use_.target.size(), brush);
    use_.painting.move_to(action.at, action.pressure);
}

void MatteStrokes::end() {
    const auto done = use_.painting.end();
    const Region* region =
        done ? region_by_id(use_.document.project(), done->place.region) : nullptr;
    if (!region) return;
    if (done->place.confirmed)
        return use_.kept.keep_confirmed({before_->matte, done->matte}, done->place,
                                        "Confirm edge of ");
    if (before_)
        return use_.kept.keep_part(done->matte, done->stroke->covered(), *before_, done->place,
                                   "Correct ");
    use_.kept.keep(done->matte, done->place,
                   "Paint " + layer_name(*region, done->place.layer) + " on frame " +
                       std::to_string(done->place.frame));
}

}  // namespace weft
