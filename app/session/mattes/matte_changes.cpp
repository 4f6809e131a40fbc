#include "app/session/mattes/matte_changes.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "app/base/background.h"
#include "app/mattes/matte_layer.h"
#include "app/mattes/paint.h"
#include "app/mattes/scribble_change.h"
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

// `change` of a matte, which counts where it changes it.
ChangedMatte changed_to(const Matte& before, Matte after) {
    auto matte = std::make_shared<const Matte>(std::move(after));
    Matte where = changed_area(before, *matte);
    return {std::move(matte), std::move(where)};
}

std::function<ChangedMatte(const MattePtr&, const MattePtr&)> changed_by(
    std::function<Matte(const Matte&)> change) {
    return [change = std::move(change)](const MattePtr& before, const MattePtr&) {
        return changed_to(*before, change(*before));
    };
}

}  // namespace

Matte scribbled(const Matte& base, const Matte& before, const Picture& picture,
                const ScribbleSelect& lines) {
    const ImageU8x3 colours = shrink(picture, kLongestSide);
    const Matte keep = drawn_lines(lines.keep, before.size());
    const Matte drop = drawn_lines(lines.drop, before.size());
    return is_empty(base) ? found_by_scribbles(before, colours, keep, drop)
                          : change_by_scribbles(base, colours, keep, drop);
}

MattePtr ScribbleRun::base_of(const MattePlace& place, const MattePtr& before,
                              const ScribbleSelect& lines) const {
    if (!base_ || place != place_ || before == base_) return before;
    const auto begin_with = [](const auto& all, const auto& first) {
        return first.size() <= all.size() && std::equal(first.begin(), first.end(), all.begin());
    };
    const Hash128 hash = Hasher().image(*before).finish();
    const bool goes_on = std::any_of(made_.begin(), made_.end(), [&](const Made& one) {
        return one.matte == hash && begin_with(lines.keep, one.lines.keep) &&
               begin_with(lines.drop, one.lines.drop);
    });
    return goes_on ? base_ : before;
}

void ScribbleRun::note(const MattePlace& place, const MattePtr& base, const ScribbleSelect& lines,
                       const Matte& made) {
    const bool goes_on = base_ && place == place_ && *base == *base_;
    if (!goes_on) made_.clear();
    place_ = place;
    base_ = base;
    made_.push_back({Hasher().image(made).finish(), lines});
}

void MatteChanges::add(Change change) {
    undone_.clear();
    const bool replaces = !waiting_.empty() && change.replaces != Replaces::kNothing &&
                          waiting_.back().replaces == change.replaces &&
                          waiting_.back().place == change.place;
    if (replaces) waiting_.pop_back();
    waiting_.push_back(std::move(change));
    take();
}

void MatteChanges::change(std::function<Matte(const Matte&)> change, const std::string& label,
                          bool here_only) {
    use_.end_stroke();
    if (!use_.document.is_open() || !use_.target.may_paint()) return;
    Change made{use_.target.place(),
                here_only ? Counts::kPart : Counts::kAll,
                {label, label + ", "},
                changed_by(std::move(change))};
    add(std::move(made));
}

void MatteChanges::fill(const FillPolygon& action) {
    use_.end_stroke();
    if (!use_.document.is_open() || !use_.target.may_paint()) return;
    const std::string label = action.subtract ? "Subtract shape" : "Add shape";
    Change change{use_.target.place(),
                  action.here_only ? Counts::kPart : Counts::kAll,
                  {label, label + ", "},
                  changed_by([action](const Matte& m) {
                      return fill_polygon(m, action.points, action.subtract);
                  })};
    change.outlines = !action.subtract;
    add(std::move(change));
}

void MatteChanges::clear() {
    use_.end_stroke();
    if (!use_.document.is_open() || !use_.target.may_paint()) return;
    Change cleared{use_.target.place(),
                   Counts::kAll,
                   {"Clear matte", {}},
                   changed_by([](const Matte& m) { return Matte(m.size()); })};
    cleared.from_nothing = true;
    add(std::move(cleared));
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
    use_.end_stroke();
    if (!picture || (action.keep.empty() && action.drop.empty()) || !use_.document.is_open() ||
        !use_.target.may_paint())
        return;
    Change change{use_.target.place(),
                  action.here_only ? Counts::kPart : Counts::kAll,
                  {"Scribble", "Scribble, "},
                  [action, picture](const MattePtr& before, const MattePtr& base) {
                      if (action.keep.empty() && is_empty(*base)) return ChangedMatte{};
                      return changed_to(*before, scribbled(*base, *before, *picture, action));
                  }};
    change.replaces = Replaces::kScribble;
    change.outlines = !action.keep.empty();
    change.lines = action;
    add(std::move(change));
}

void MatteChanges::set_shape(const RotoShape& shape) {
    constexpr std::size_t kLeast = 3;
    if (shape.points.size() < kLeast) return;
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
    if (!use_.document.is_open() || !use_.target.may_paint()) return;
    Change change{place,
                  Counts::kAll,
                  {"Shape", {}},
                  changed_by([shape, aspect = use_.target.aspect()](const Matte& m) {
                      return matte_of_shape(shape, m.size(), aspect);
                  }),
                  shape,
                  true,
                  Replaces::kShape};
    add(std::move(change));
}

void MatteChanges::paint(const MattePainting::Waiting& stroke, Counts counts, ChangeLabels labels) {
    add({stroke.place, counts, std::move(labels),
         [stroke](const MattePtr& before, const MattePtr&) {
             return paint_stroke(before, stroke.brush, stroke.points);
         }});
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

bool MatteChanges::start() {
    Change& next = waiting_.front();
    PaintBase base{PaintBase::State::kReady, {}, {}};
    if (!next.from_nothing) base = use_.target.base(next.place, next.counts);
    if (base.state == PaintBase::State::kReading) return false;
    if (base.state == PaintBase::State::kUnreached && next.outlines) {
        base = {PaintBase::State::kReady, {}, {}};
        use_.notices.add(NoticeKind::kInfo,
                         "The matte had not been propagated to frame " +
                             std::to_string(next.place.frame) +
                             " yet, so this outline is a new keyframe there. Undo takes it back.");
    }
    Running begun{std::move(next), {}, std::move(base.part), {}};
    waiting_.pop_front();
    if (base.state != PaintBase::State::kReady) {
        use_.target.refuse(base, begun.change.place);
        return true;
    }
    if (!base.before) base.before = std::make_shared<const Matte>(use_.target.size());
    begun.base = begun.change.lines
                     ? run_.base_of(begun.change.place, base.before, *begun.change.lines)
                     : base.before;
    begun.made = at_hand([make = begun.change.make, before = std::move(base.before),
                          from = begun.base] { return make(before, from); });
    running_ = std::move(begun);
    return true;
}

void MatteChanges::note_scribble(const Running& done, const ChangedMatte& made) {
    if (made.matte) return run_.note(done.change.place, done.base, *done.change.lines, *made.matte);
    use_.notices.refuse(
        "Nothing is painted on frame " + std::to_string(done.change.place.frame) +
        " that a line outside could take away. Draw a line inside the surface first.");
}

void MatteChanges::keep(Running done) {
    const bool undone =
        !undone_.empty() && undone_at_ == Undone{use_.document.made(), use_.document.redos()};
    ChangedMatte made = done.made.get();
    if (done.change.lines) note_scribble(done, made);
    use_.kept.keep_change(std::move(made), done.part, done.change.place, done.change.labels,
                          done.change.shape);
    if (undone) note_undone();
}

void MatteChanges::take() {
    for (;;) {
        if (running_) {
            if (running_->made.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
                return;
            keep(std::move(*std::exchange(running_, std::nullopt)));
        }
        if (waiting_.empty() || !start()) return;
    }
}

void MatteChanges::finish() {
    while (busy()) {
        if (running_) running_->made.wait();
        take();
        if (busy() && !running_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void MatteChanges::forget() {
    if (running_) use_.shutdowns.end(std::move(running_->made));
    running_.reset();
    waiting_.clear();
    undone_.clear();
}

void MatteChanges::note_undone() {
    undone_at_ = {use_.document.made(), use_.document.redos()};
}

bool MatteChanges::take_back() {
    if (!busy()) return false;
    if (!undone_.empty() && undone_at_ != Undone{use_.document.made(), use_.document.redos()})
        undone_.clear();
    if (!waiting_.empty()) {
        undone_.push_back(std::move(waiting_.back()));
        waiting_.pop_back();
    } else {
        undone_.push_back(std::move(running_->change));
        use_.shutdowns.end(std::move(running_->made));
        running_.reset();
    }
    note_undone();
    return true;
}

bool MatteChanges::again() {
    if (undone_.empty()) return busy();  // what waits leaves nothing to redo
    const Undone now{use_.document.made(), use_.document.redos()};
    if (now.made != undone_at_.made || now.redos < undone_at_.redos) undone_.clear();
    if (undone_.empty() || now.redos > undone_at_.redos) return busy();
    waiting_.push_back(std::move(undone_.back()));
    undone_.pop_back();
    take();
    return true;
}

void MatteChanges::show(SessionView& view) const {
    view.matte_busy = busy();
    view.modified |= busy();
    if (busy())
        view.undo_label = (waiting_.empty() ? running_->change : waiting_.back()).labels.whole;
    if (!undone_.empty() && view.redo_label.empty()) view.redo_label = undone_.back().labels.whole;
}

}  // namespace weft
