// The state line below the picture: what it shows and what is in progress.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/viewer/compare.h"
#include "ui/viewer/overlays.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

struct State {
    std::string text;
    ImU32 color;
    const char* icon = nullptr;
    float part = -1;  // progress of the pending work, 0–1
    const char* tip = nullptr;
    std::string brief = {};  // instead of the text where there is no room for it
};

void add_progress(const PreviewView& preview, State& to) {
    if (preview.total <= 0) return;
    to.part = static_cast<float>(preview.done) / static_cast<float>(preview.total);
    std::string progress = percent_text(preview.done, preview.total);
    if (preview.seconds_left > 0) progress += ", " + time_text(preview.seconds_left) + " left";
    const std::size_t first = to.text.find("  ·  ");
    to.brief = to.text.substr(0, first) + "  ·  " + progress;
    to.text += " " + progress;
}

State provisional_state(const Ctx& c) {
    const SessionView& v = c.view;
    State out{"Provisional", c.theme.warn, icons::kTimer};
    out.tip = "From this frame alone. The clip's light is still being measured.";
    if (v.analysis_paused) {
        out.text += "  ·  analysis paused";
        out.icon = icons::kPause;
    } else if (v.preview.state == PreviewView::State::kAnalysing) {
        out.text += "  ·  analysing";
        add_progress(v.preview, out);
    } else if (v.preview.state == PreviewView::State::kGrowing) {
        out.text += "  ·  synthesizing the texture";
    }
    return out;
}

// Nothing of the last change can be shown yet: the plate is, or the result of before.
State waiting_state(const Ctx& c) {
    const SessionView& v = c.view;
    const Theme& t = c.theme;
    const bool outdated = v.result_picture != nullptr;
    switch (v.preview.state) {
        case PreviewView::State::kOpening:
            return {outdated ? "Updating…" : "Plate  ·  Preparing the result…", t.warn,
                    icons::kTimer};
        case PreviewView::State::kAnalysing: {
            if (v.analysis_paused)
                return {
                    outdated ? "Outdated result  ·  Analysis paused" : "Plate  ·  Analysis paused",
                    t.warn, icons::kPause};
            State out{outdated ? "Updating…  ·  Analysing" : "Plate  ·  Analysing", t.warn,
                      icons::kTimer};
            add_progress(v.preview, out);
            return out;
        }
        case PreviewView::State::kGrowing:
            return {"Synthesizing the texture…", t.warn, icons::kTimer};
        default:
            return {"Updating…", t.warn, icons::kTimer};
    }
}

// A mask is painted over the plate, while the result is worked out.
State plate_state(const Ctx& c) {
    State out{"Plate", c.theme.text};
    const PreviewView& preview = c.view.preview;
    if (preview.analysing && preview.total > 0) {
        out.text += "  ·  analysing";
        add_progress(preview, out);
    } else if (c.view.analysis_paused && !c.view.result_current) {
        out.text += "  ·  analysis paused";
    } else if (!c.view.result_current && preview.state != PreviewView::State::kFailed) {
        out.text += "  ·  preparing the result…";
    }
    return out;
}

State state_of_picture(const Ctx& c) {
    const SessionView& v = c.view;
    const Theme& t = c.theme;
    if (!v.frame_error.empty()) return {v.frame_error, t.bad, icons::kAlert};
    if (v.matte_busy) return {"Updating matte…", t.warn, icons::kTimer};
    if (c.state.viewer.hold_original) return {"Plate", t.text};
    if (c.state.viewer.compare == Compare::kPlate) return {compared_name(c), t.text};
    if (v.result_wanted && paints_over_plate(c)) return plate_state(c);
    if (!v.result_wanted) {
        std::string what = "Plate";
        if (const Region* region = v.selected_region())
            if (const auto found = v.unready.find(region->id); found != v.unready.end())
                what += "  ·  " + found->second;
        if (v.project.regions.empty())
            what += c.state.workspace == Workspace::kMask ? "  ·  Paint over a surface to start"
                                                          : "  ·  Add a region to start";
        return {what, t.text};
    }
    if (v.preview.state == PreviewView::State::kFailed)
        return {"Plate  ·  No result", t.bad, icons::kAlert};
    if (v.result_current && v.layer && c.state.viewer.compare == Compare::kResult)
        return {"Layer for compositing: " + std::string(info_of(*v.layer).name), t.good,
                icons::kLayers};
    if (v.result_current && !v.stages.approximate) {
        std::string what = v.preview_quality == Quality::kDraft ? "Result, draft" : "Result";
        if (v.stages.proxy > 1)
            what += ", 1/" + std::to_string(v.stages.proxy) + " size while working";
        if (v.preview.analysing && v.preview.total > 0)
            what += "  ·  analysing " + percent_text(v.preview.done, v.preview.total);
        return {what, t.good, icons::kCheck};
    }
    if (v.stages.provisional) return provisional_state(c);
    return waiting_state(c);
}

}  // namespace

// The state line: what the picture shows and what is in progress.
void draw_state(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    const State state = state_of_picture(c);
    float x = min.x + t.px(10);
    if (state.icon) {
        icon_in(c, list, {x, min.y}, {x + t.px(18), max.y}, state.color, state.icon);
        x += t.px(24);
    }
    // Errors may use the whole bar except its controls.
    const float room =
        std::max(t.px(60), max.x - x - view_controls_width(c, max.x - min.x) - t.px(12));
    ImGui::PushFont(t.small);
    const bool brief = !state.brief.empty() && ImGui::CalcTextSize(state.text.c_str()).x > room;
    const std::string shown = fitted(brief ? state.brief : state.text, room);
    ImGui::PopFont();
    text_in(list, t.small, {x, min.y}, {x + room, max.y}, state.color, shown.c_str(), 0);
    c.note("State: " + state.text, {x, min.y}, {x + room, max.y});
    c.note("State shown: " + shown, {x, min.y}, {x + room, max.y});
    const bool hovered = ImGui::IsMouseHoveringRect(min, {x + room, max.y});
    if (hovered && state.tip)
        ImGui::SetTooltip("%s", state.tip);
    else if (hovered && shown != state.text)
        ImGui::SetTooltip("%s", state.text.c_str());
    if (state.part < 0) return;
    const float y = max.y - t.px(5), w = std::min(room, t.px(220));
    list.AddRectFilled({x, y}, {x + w, y + t.px(3)}, t.field, t.px(2));
    list.AddRectFilled({x, y}, {x + w * state.part, y + t.px(3)}, t.warn, t.px(2));
}

}  // namespace weft::ui
