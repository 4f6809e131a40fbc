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

bool PaintTarget::may_paint(bool busy) const {
    const auto warn = [&](const std::string& text) {
        use_.notices.add(NoticeKind::kWarning, text);
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
    if (busy) return warn("Updating matte…");
    return true;
}

std::optional<MattePtr> PaintTarget::matte() const {
    const RegionMatteView seen = shown();
    if (seen.keep) return seen.keep;
    if (seen.kind == RegionMatteView::Kind::kLoading &&
        source().keyframes.contains(use_.playback.frame())) {
        use_.notices.add(NoticeKind::kWarning,
                         "This keyframe is still being read. Try again in a moment.");
        return std::nullopt;
    }
    return nullptr;
}

bool PaintTarget::counts_as_whole() const {
    const MatteSource& painted = source();
    const int frame = use_.playback.frame();
    return painted.keyframes.contains(frame) ||
           std::find(painted.frozen.begin(), painted.frozen.end(), frame) != painted.frozen.end();
}

bool PaintTarget::counts_in_part(bool here_only) const {
    return here_only && !source().keyframes.empty() && !counts_as_whole();
}

std::optional<ConfirmedMatte> PaintTarget::confirmed() const {
    const auto later = [&](const char* what) {
        use_.notices.add(NoticeKind::kWarning, std::string(what) + " Try again in a moment.");
        return std::nullopt;
    };
    ConfirmedMatte out{shown().keep, {}};
    if (!out.matte) return later("The matte of this frame is still being propagated.");
    const int frame = use_.playback.frame();
    if (!source().confirmed.contains(frame)) {
        out.area = std::make_shared<const Matte>(size());
        return out;
    }
    out.area = use_.shown.confirmed_area(*region(), use_.selection.layer, frame);
    if (!out.area) return later("What is confirmed on this frame is still being read.");
    return out;
}

}  // namespace weft
