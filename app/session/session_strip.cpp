// The strip of small results.
#include "app/project/codec/project_file.h"
#include "app/session/session.h"

namespace weft {

StripQuery Session::strip_query() const {
    StripQuery out;
    out.document = document_version_;
    out.kind = strip_.kind();
    out.over_time = strip_.over_time();
    out.textures = strip_.textures();
    out.region = selected_;
    const auto [first, last] = playback_.range();
    if (out.kind == StripKind::kKeyframes)
        out.frames = strip_frames(playback_.frames(), first, last, playback_.marked());
    else if (out.is_sheet())
        out.frames = sheet_frames(playback_.frames(), first, last);
    else
        out.frame = playback_.frame();
    return out;
}

// Requests the cards together with the picture, and sorts finished ones into their order.
void Session::show_strip() {
    StripView& shown = view_.strip;
    shown.kind = strip_.kind();
    shown.over_time = strip_.over_time();
    shown.columns = 0;
    shown.cards.clear();
    const Region* region = region_by_id(document(), selected_);
    const bool possible =
        reader_ && view_.result_wanted && (region || strip_.kind() == StripKind::kKeyframes);
    if (strip_.kind() == StripKind::kNone || !possible) {
        request_pending_ |= strip_.clear();
        return;
    }
    if (!tried_ && !painting_.active() && playback_.direction() == 0) {
        if (const StripQuery question = strip_query(); !strip_.asked(question)) {
            bool any = false;
            strip_.ask(question,
                       {project_to_preview(any),
                        region && region->enabled && !region->matte->empty(), project_dir(path_)});
        }
    }
    request_pending_ |= strip_.update();
    const auto cards = strip_.cards();
    if (!cards) return;
    shown.columns = cards->columns;
    for (const CardRequest& request : cards->requests) {
        StripCard card{request.label, request.note, request.frame, nullptr, {}, request.current};
        if (const auto made = preview_reading_.cards.find(request.key);
            made != preview_reading_.cards.end()) {
            card.picture = made->second.picture;
            card.error = made->second.error;
            card.provisional = made->second.provisional;
        } else if (view_.preview.state == PreviewView::State::kFailed) {
            card.error = view_.preview.error;
        }
        shown.cards.push_back(std::move(card));
    }
}

void Session::choose_from_strip(int card) {
    const auto cards = strip_.cards();
    if (!cards || card < 0 || card >= static_cast<int>(cards->choices.size())) return;
    if (const auto& choice = cards->choices[static_cast<std::size_t>(card)]) act(Action(*choice));
}

}  // namespace weft
