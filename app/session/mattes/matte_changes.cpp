#include "app/session/mattes/matte_changes.h"

#include <chrono>
#include <memory>
#include <utility>

#include "app/base/background.h"
#include "app/mattes/matte_layer.h"
#include "app/mattes/paint.h"
#include "app/mattes/scribble_matte.h"
#include "engine/mask/confirmed_part.h"
#include "engine/mask/shape_matte.h"

namespace weft {
namespace {

constexpr int kLongestSide = 1 << 20;  // of the picture in which is selected: as it is

Matte drawn_lines(const std::vector<std::vector<Vec2>>& lines, Size size) {
    Matte out(size);
    Brush pen;
    pen.radius_px = 3;
    pen.hardness = 1;
    for (const auto& line : lines) {
        Stroke stroke(std::make_shared<const Matte>(out), pen);
        for (const Vec2 point : line)
            (void)stroke.move_to(point, 1, out);
    }
    return out;
}

}  // namespace

bool MatteChanges::may_change() const {
    return use_.document.is_open() && use_.target.may_paint(busy());
}

bool MatteChanges::follows(std::function<void()> again) {
    if (!changing_) return false;
    after_ = [this, again = std::move(again), place = use_.target.place()] {
        if (place == use_.target.place()) again();
    };
    return true;
}

void MatteChanges::change(std::function<Matte(const Matte&)> change, std::string label,
                          bool here_only) {
    use_.end_stroke();
    if (!may_change()) return;
    auto before = use_.target.matte();
    if (!before) return;
    std::optional<ConfirmedMatte> part;
    if (use_.target.counts_in_part(here_only) && !(part = use_.target.confirmed())) return;
    changing_.emplace();
    changing_->part = std::move(part);
    changing_->place = use_.target.place();
    changing_->label = std::move(label);
    changing_->matte =
        in_background([change = std::move(change), matte = std::move(*before),
                       size = use_.target.size()] { return change(matte ? *matte : Matte(size)); });
}

void MatteChanges::flood(const FloodSelect& action) {
    const PicturePtr picture = use_.plate.picture();
    if (!picture) return;
    change(
        [action, picture](const Matte& before) {
            return flood_select(before, shrink(*picture, kLongestSide), action.at, action.tolerance,
                                action.subtract);
        },
        action.subtract ? "Subtract colour" : "Add colour", action.here_only);
}

void MatteChanges::scribble(const ScribbleSelect& action) {
    const PicturePtr picture = use_.plate.picture();
    if (!picture || action.keep.empty() || follows([this, action] { scribble(action); })) return;
    change(
        [action, picture](const Matte& before) {
            return segment_scribbles(before, shrink(*picture, kLongestSide),
                                     drawn_lines(action.keep, before.size()),
                                     drawn_lines(action.drop, before.size()));
        },
        "Scribble", action.here_only);
}

void MatteChanges::set_shape(const RotoShape& shape) {
    constexpr std::size_t kLeast = 3;
    if (shape.points.size() < kLeast || follows([this, shape] { set_shape(shape); })) return;
    use_.end_stroke();
    const MattePlace place = use_.target.place();
    const Region* region = use_.target.region();
    if (use_.document.is_open() && region && !use_.selection.is_locked() &&
        !use_.target.source().shape.empty()) {
        MatteSource matte = use_.target.source();
        auto& keys = matte.shape.keys;
        if (keys.begin()->second.points.size() != shape.points.size()) keys.clear();
        keys[place.frame] = shape;
        return use_.kept.commit_layer(*region, place.layer, matte,
                                      "Shape on frame " + std::to_string(place.frame));
    }
    if (!may_change()) return;
    changing_.emplace();
    changing_->place = place;
    changing_->label = "Shape";
    changing_->shape = shape;
    changing_->matte =
        in_background([shape, size = use_.target.size()] { return matte_of_shape(shape, size); });
}

void MatteChanges::paint_instead() {
    if (!use_.target.region() || !use_.plate.reader() ||
        (use_.target.source().files.empty() && use_.target.source().select.crypto.empty()))
        return;
    const RegionMatteView shown = use_.target.shown();
    if (!shown.keep) {
        use_.notices.add(NoticeKind::kWarning,
                         "The matte of this frame is still being read. Try again in a moment.");
        return;
    }
    use_.kept.keep_instead(shown.keep, use_.target.place());
}

bool MatteChanges::abandon() {
    const bool any = busy();
    if (any) use_.shutdowns.end(std::move(changing_->matte));
    changing_.reset();
    after_ = nullptr;
    return any;
}

void MatteChanges::take() {
    if (!changing_ ||
        changing_->matte.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Changing done = std::move(*changing_);
    changing_.reset();
    const auto matte = std::make_shared<const Matte>(done.matte.get());
    if (done.part)
        use_.kept.keep_part(matte, changed_area(*done.part->matte, *matte), *done.part, done.place,
                            done.label + ", ");
    else
        use_.kept.keep(matte, done.place,
                       done.label + " on frame " + std::to_string(done.place.frame), done.shape);
    if (const auto next = std::exchange(after_, nullptr)) next();
}

}  // namespace weft
