#include "app/session/preview_strip.h"

#include <algorithm>
#include <chrono>

#include "app/session/background.h"

namespace weft {

PreviewStrip::PreviewStrip(AnalysisCacheOptions cache)
    : preview_(std::move(cache), std::size_t{64} << 20) {}

void PreviewStrip::want(std::vector<Wish> wishes) {
    std::vector<std::string> keys;
    std::vector<StripCard> cards;
    for (const Wish& wish : wishes) {
        keys.push_back(std::to_string(wish.frame) + " " + pixel_key(wish.project));
        StripCard card{wish.label, wish.frame, nullptr, {}};
        const auto old = std::find(keys_.begin(), keys_.end(), keys.back());
        if (old != keys_.end())
            card.picture = cards_[static_cast<std::size_t>(old - keys_.begin())].picture;
        cards.push_back(std::move(card));
    }
    if (keys != keys_ || at_ < 0) {
        at_ = -1;
        requested_ = false;
        if (wishes.empty()) preview_.clear();
    }
    wishes_ = std::move(wishes);
    keys_ = std::move(keys);
    cards_ = std::move(cards);
}

bool PreviewStrip::busy() const {
    return shrinking_.valid() || std::any_of(cards_.begin(), cards_.end(), [](const StripCard& c) {
               return !c.picture && c.error.empty();
           });
}

void PreviewStrip::take() {
    if (shrinking_.valid()) {
        if (shrinking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        const PicturePtr picture = shrinking_.get();
        for (std::size_t k = 0; k < keys_.size(); ++k)
            if (keys_[k] == shrinking_key_) cards_[k].picture = picture;
        at_ = -1;
    }
    if (at_ < 0 || !requested_) return;
    const auto index = static_cast<std::size_t>(at_);
    if (!preview_.try_read(wishes_[index].frame, 0, reading_)) return;
    const PicturePtr& final = reading_.frame.stages[static_cast<std::size_t>(Stage::kFinal)];
    if (final && !reading_.frame.approximate) {
        shrinking_key_ = keys_[index];
        shrinking_ = in_background([final] { return make_picture(shrink(*final, kLongest_px)); });
    } else if (reading_.view.state == PreviewView::State::kFailed) {
        cards_[index].error = reading_.view.error;
        at_ = -1;
    }
}

void PreviewStrip::update(bool may_begin) {
    take();
    if (shrinking_.valid()) return;
    if (at_ < 0) {
        if (!may_begin) return;
        const auto next = std::find_if(cards_.begin(), cards_.end(), [](const StripCard& c) {
            return !c.picture && c.error.empty();
        });
        if (next == cards_.end()) return;
        at_ = static_cast<int>(next - cards_.begin());
        requested_ = false;
    }
    if (requested_) return;
    PreviewRequest request;
    request.project = wishes_[static_cast<std::size_t>(at_)].project;
    request.frame = wishes_[static_cast<std::size_t>(at_)].frame;
    requested_ = preview_.try_request(request);
}

}  // namespace weft
