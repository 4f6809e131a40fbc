#include "app/session/mattes/scribble_trial.h"

#include <chrono>
#include <memory>
#include <utility>

#include "app/base/background.h"

namespace weft {

void ScribbleTrial::ask(const ScribbleSelect& lines) {
    if (lines.keep.empty() && lines.drop.empty()) return end();
    settling_ = false;
    wanted_ = lines;
    if (!running_) start();
}

void ScribbleTrial::settle() {
    wanted_.reset();
    settling_ = true;
}

void ScribbleTrial::end() {
    if (running_) use_.shutdowns.end(std::move(running_->made));
    running_.reset();
    wanted_.reset();
    made_.reset();
    settling_ = false;
}

void ScribbleTrial::start() {
    const ScribbleSelect lines = *std::exchange(wanted_, std::nullopt);
    const PicturePtr picture = use_.plate.picture();
    if (!picture || !use_.target.is_ready()) return;
    const MattePlace place = use_.target.place();
    PaintBase base = use_.target.base(place, lines.here_only ? Counts::kPart : Counts::kAll);
    if (base.state != PaintBase::State::kReady) return;
    if (!base.before) base.before = std::make_shared<const Matte>(use_.target.size());
    MattePtr begins = use_.changes.scribble_base(place, base.before, lines);
    running_ = Running{
        place, at_hand([lines, picture, before = std::move(base.before), from = std::move(begins)] {
            return scribbled(*from, *before, *picture, lines);
        })};
}

void ScribbleTrial::take() {
    const bool elsewhere = (running_ && running_->place != use_.target.place()) ||
                           (made_ && place_ != use_.target.place());
    if (elsewhere || (settling_ && !use_.changes.busy())) return end();
    if (!running_ || running_->made.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    place_ = running_->place;
    made_ = std::make_shared<const Matte>(running_->made.get());
    version_ = next_picture_id();
    running_.reset();
    if (wanted_) start();
}

void ScribbleTrial::show(SessionView& view) const {
    if (!made_) return;
    for (auto* mattes : {&view.mattes, &view.holdouts, &view.zones})
        for (RegionMatteView& one : *mattes) {
            if (MattePlace{one.region, one.layer, one.frame} != place_) continue;
            one.kind = RegionMatteView::Kind::kPainted;
            one.pixels = made_->view();
            one.version = version_;
        }
}

}  // namespace weft
