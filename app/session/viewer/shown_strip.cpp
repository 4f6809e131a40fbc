#include "app/session/viewer/shown_strip.h"

namespace weft {

StripQuery ShownStrip::query() const {
    const Playback& playback = use_.playback;
    StripQuery out;
    out.document = use_.document.version();
    out.kind = strip_.kind();
    out.over_time = strip_.over_time();
    out.textures = strip_.textures();
    out.region = use_.selection.region;
    const auto [first, last] = playback.range();
    if (out.kind == StripKind::kKeyframes)
        out.frames = strip_frames(playback.frames(), first, last, playback.marked());
    else if (out.is_sheet())
        out.frames = sheet_frames(playback.frames(), first, last);
    else
        out.frame = playback.frame();
    return out;
}

void ShownStrip::build(const Region* region) {
    const StripQuery question = query();
    if (strip_.asked(question)) return;
    strip_.ask(question,
               {use_.preview.subject(), region && region->enabled && !region->matte->empty(),
                use_.document.folder()});
}

void ShownStrip::update(bool painting, StripView& shown) {
    shown.kind = strip_.kind();
    shown.over_time = strip_.over_time();
    shown.columns = 0;
    shown.cards.clear();
    const Region* region = use_.selection.of(use_.document.project());
    // Suggestions bring their texture along.
    const bool something =
        use_.preview.has_subject() || (strip_.kind() == StripKind::kSuggested && region &&
                                       region->enabled && !region->matte->empty());
    const bool possible =
        use_.plate.reader() && something && (region || strip_.kind() == StripKind::kKeyframes);
    if (strip_.kind() == StripKind::kNone || !possible) {
        if (strip_.clear()) use_.preview.ask();
        return;
    }
    if (!use_.document.trying() && !painting && use_.playback.direction() == 0) build(region);
    if (strip_.update()) use_.preview.ask();
    const auto cards = strip_.cards();
    if (!cards) return;
    shown.columns = cards->columns;
    for (const CardRequest& request : cards->requests)
        shown.cards.push_back(card(request));
}

StripCard ShownStrip::card(const CardRequest& request) const {
    const PreviewReading& reading = use_.preview.reading();
    StripCard out{request.label, request.note, request.frame, nullptr, {}, request.current};
    if (const auto made = reading.cards.find(request.key); made != reading.cards.end()) {
        out.picture = made->second.picture;
        out.error = made->second.error;
        out.provisional = made->second.provisional;
    } else if (reading.view.state == PreviewView::State::kFailed) {
        out.error = reading.view.error;
    }
    return out;
}

std::vector<CardRequest> ShownStrip::requests() const {
    const auto cards = strip_.cards();
    return cards ? cards->requests : std::vector<CardRequest>();
}

std::optional<Action> ShownStrip::choice(int card) const {
    const auto cards = strip_.cards();
    if (!cards || card < 0 || card >= static_cast<int>(cards->choices.size())) return std::nullopt;
    return cards->choices[static_cast<std::size_t>(card)];
}

}  // namespace weft
