// Suggested keyframes: a list; a click goes to the frame.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/mask/mask.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

std::string percent(float part) {
    return number_text(100.0 * static_cast<double>(part), 0) + "%";
}

std::string text_of(const CorrectionHint& hint) {
    const std::string frame = "Frame " + std::to_string(hint.frame) + ": ";
    switch (hint.kind) {
        case CorrectionHint::Kind::kMatte:
            return frame + "confidence " + percent(hint.value);
        case CorrectionHint::Kind::kDrift:
            return frame + "drift " + percent(hint.value);
        case CorrectionHint::Kind::kStretch:
            return frame + "stretch × " + number_text(static_cast<double>(hint.value), 1);
    }
    return frame;
}

const char* tip_of(CorrectionHint::Kind kind) {
    switch (kind) {
        case CorrectionHint::Kind::kMatte:
            return "Go to this frame and paint a keyframe: it improves this frame and its "
                   "neighbours";
        case CorrectionHint::Kind::kDrift:
            return "Go to this frame and check for sliding; pin the texture, or add a reference "
                   "frame";
        case CorrectionHint::Kind::kStretch:
            return "Go to this frame; another reference frame restores the texture's shape";
    }
    return "";
}

// The best ones; the timeline marks all of them.
constexpr std::size_t kShown = 3;

}  // namespace

std::string no_hints_text(const SessionView& view) {
    const bool known =
        std::any_of(view.marks.begin(), view.marks.end(),
                    [](const FrameMarks& mark) { return mark.confidence >= 0 || mark.drift >= 0; });
    return known ? "No frame needs a keyframe." : "No suggestions until the shot is analysed.";
}

void hints_section(Ctx& c, bool mattes_only) {
    const SessionView& v = c.view;
    std::vector<CorrectionHint> shown;
    for (const CorrectionHint& hint : v.to_correct)
        if (!mattes_only || hint.kind == CorrectionHint::Kind::kMatte) shown.push_back(hint);
    if (!section(c, "Suggested keyframes", true)) return;
    const PanelName panel(c, "Hints");
    if (shown.size() > kShown) shown.resize(kShown);
    // They go with every change and come back with the analysis: what is below stays where it is.
    const float top = ImGui::GetCursorPosY();
    const float row = c.theme.row + ImGui::GetStyle().ItemSpacing.y;
    if (shown.empty()) wrapped(c, no_hints_text(v), c.theme.quiet);
    for (const CorrectionHint& hint : shown) {
        ImGui::PushID(hint.frame);
        const std::string label = text_of(hint) + "##hint" + std::to_string(hint.frame);
        if (button(c, label.c_str(),
                   {.icon = hint.kind == CorrectionHint::Kind::kMatte   ? icons::kBrush
                            : hint.kind == CorrectionHint::Kind::kDrift ? icons::kPin
                                                                        : icons::kReference,
                    .look = hint.frame == v.frame ? Look::kNormal : Look::kQuiet,
                    .tip = tip_of(hint.kind),
                    .width = -1}))
            c.emit(GoToFrame{hint.frame});
        c.note("Hint " + std::to_string(hint.frame));
        ImGui::PopID();
    }
    ImGui::SetCursorPosY(top + static_cast<float>(kShown) * row);
    section_gap(c);
}

}  // namespace weft::ui
