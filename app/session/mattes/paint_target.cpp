#include "app/session/mattes/paint_target.h"

#include <algorithm>
#include <memory>
#include <string>

#include "app/mattes/matte_layer.h"

namespace weft {

const MatteSource& PaintTarget::source() const {
    return layer_source(*region(), use_.selection.layer);
}

bool PaintTarget::is_ready() const {
    return region() && use_.plate.reader() && use_.playback.direction() == 0 &&
           !use_.selection.is_locked() && !source().by_frame() && source().select.crypto.empty();
}

bool PaintTarget::may_paint() const {
    const auto warn = [&](const std::string& text) {
        use_.notices.refuse(text);
        return false;
    };
    const Region* painted = region();
    if (!painted) return warn("Add a region first; then paint its matte.");
    if (use_.selection.is_locked())
        return warn("'" + painted->name + "' is locked. Unlock it to paint.");
    const std::string layer = "'" + layer_name(*painted, use_.selection.layer) + "'";
    if (!source().files.empty() || !source().select.crypto.empty())
        return warn("The matte of " + layer +
                    " comes from files. Choose 'Paint instead' to make it your own.");
    if (!source().shape.empty())
        return warn("The matte of " + layer +
                    " is drawn from a shape. Change the shape, or choose 'Surface' under Follow to "
                    "paint keyframes.");
    if (!use_.plate.reader()) return warn("The plate is not open yet.");
    return true;
}

bool PaintTarget::counts_as_whole(const MatteSource& source, int frame) {
    return source.keyframes.contains(frame) ||
           std::find(source.frozen.begin(), source.frozen.end(), frame) != source.frozen.end();
}

PaintBase PaintTarget::base(const MattePlace& place, Counts counts) const {
    const Region* of = region_by_id(use_.document.project(), place.region);
    if (!of || !use_.plate.reader()) return {};
    const MatteSource& source = layer_source(*of, place.layer);
    const bool whole = source.keyframes.empty() || counts_as_whole(source, place.frame);
    if (counts == Counts::kAsRight && whole) return {};
    if (counts != Counts::kAll && !whole) return part_base(*of, place, counts);
    ShownMattes::Base found = use_.shown.base_of(*of, place.layer, place.frame);
    if (found.matte || (found.reached && !found.reading))
        return {PaintBase::State::kReady, std::move(found.matte), {}};
    return {found.reached ? PaintBase::State::kReading : PaintBase::State::kUnreached, {}, {}};
}

PaintBase PaintTarget::part_base(const Region& of, const MattePlace& place, Counts counts) const {
    ShownMattes::Base found = use_.shown.base_of(of, place.layer, place.frame);
    if (!found.matte)
        return {found.reached ? PaintBase::State::kReading : PaintBase::State::kUnreached, {}, {}};
    ConfirmedMatte part{std::move(found.matte), {}, std::move(found.depends_on)};
    part.area = layer_source(of, place.layer).confirmed.contains(place.frame)
                    ? use_.shown.confirmed_area(of, place.layer, place.frame)
                    : std::make_shared<const Matte>(size());
    if (!part.area) {
        std::string error = use_.shown.confirmed_error(of, place.layer, place.frame);
        const auto state = error.empty() ? PaintBase::State::kReading : PaintBase::State::kNone;
        return {state, {}, {}, std::move(error)};
    }
    MattePtr before = counts == Counts::kAsRight ? part.area : part.matte;
    return {PaintBase::State::kReady, std::move(before), std::move(part)};
}

void PaintTarget::refuse(const PaintBase& base, const MattePlace& place) const {
    const std::string frame = std::to_string(place.frame);
    if (!base.error.empty())
        use_.notices.add(NoticeKind::kError,
                         "Cannot read what is confirmed on frame " + frame + ". " + base.error);
    if (base.state == PaintBase::State::kUnreached)
        use_.notices.refuse("The matte has not been propagated to frame " + frame +
                            " yet. Wait for it, or begin with an empty one: 'Clear matte on "
                            "this frame' in the menu Region.");
}

}  // namespace weft
