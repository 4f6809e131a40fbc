// The timeline: transport, ruler, keyframes, cache, and confidence and quality strips.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/timeline/frame_scale.h"
#include "ui/timeline/timeline.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

enum class Mark { kDiamond, kTriangle, kHollow, kBar };

void draw_mark(const Theme& t, ImDrawList& list, Mark mark, ImVec2 at, float r, ImU32 color) {
    const ImVec2 top(at.x, at.y - r), right(at.x + r, at.y), low(at.x, at.y + r);
    const ImVec2 left(at.x - r, at.y);
    if (mark == Mark::kDiamond) list.AddQuadFilled(top, right, low, left, color);
    if (mark == Mark::kTriangle)
        list.AddTriangleFilled(top, {at.x + r, at.y + r}, {at.x - r, at.y + r}, color);
    if (mark == Mark::kHollow) list.AddQuad(top, right, low, left, color, t.px(1.5f));
    if (mark == Mark::kBar)
        list.AddRectFilled({at.x - r, at.y - t.px(2)}, {at.x + r, at.y + t.px(2)}, color);
}

const char* mode_name(PlayMode mode) {
    return mode == PlayMode::kLoop ? "Loop" : mode == PlayMode::kPingPong ? "Ping-pong" : "Once";
}
const char* mode_icon(PlayMode mode) {
    return mode == PlayMode::kLoop       ? icons::kSync
           : mode == PlayMode::kPingPong ? icons::kCompare
                                         : icons::kStepForward;
}

void transport(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::SetCursorScreenPos({origin.x + t.px(8), origin.y + t.px(3)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(2), 0});
    const bool on = v.plate.state == PlateView::State::kOpen;
    const auto tool = [&](const char* id, const char* icon, const char* name, bool active = false) {
        if (icon_button(c, icon, name, active, id, on, t.px(26))) c.commands.run(id, c);
        ImGui::SameLine();
    };
    tool("time.first", icons::kSkipPrevious, "First frame");
    tool("time.previous_key", icons::kChevronLeft, "Previous keyframe");
    tool("time.previous", icons::kStepBack, "Previous frame");
    tool("time.play", v.playing ? icons::kPause : icons::kPlay, v.playing ? "Pause" : "Play",
         v.playing != 0);
    tool("time.next", icons::kStepForward, "Next frame");
    tool("time.next_key", icons::kChevronRight, "Next keyframe");
    tool("time.last", icons::kSkipNext, "Last frame");
    tool("time.mode", mode_icon(v.play_mode), mode_name(v.play_mode));
    tool("time.keys", icons::kKeyframe, c.state.keys.open ? "Hide keys" : "Show keys",
         c.state.keys.open);
    ImGui::PopStyleVar();
    float x = ImGui::GetItemRectMax().x + t.px(14);
    const auto say = [&](const std::string& text, ImU32 color) {
        const ImVec2 end(x + t.px(400), origin.y + size.y);
        text_in(list, t.regular, {x, origin.y}, end, color, text.c_str(), 0);
        x += ImGui::CalcTextSize(text.c_str()).x + t.px(14);
    };
    if (!on) return;
    say(std::to_string(v.frame), t.text);
    say(number_text(v.plate.fps, v.plate.fps == std::floor(v.plate.fps) ? 0 : 3) + " fps", t.quiet);
    if (v.mark_in || v.mark_out) {
        say("Marked " + std::to_string(v.mark_in.value_or(v.plate.frames.front())) + "–" +
                std::to_string(v.mark_out.value_or(v.plate.frames.back())),
            t.accent_hover);
    }
    // The legend of the rows, right-aligned.
    float right = origin.x + size.x - t.px(12);
    const auto legend = [&](const char* text, ImU32 color, Mark shape) {
        const float w = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text).x;
        right -= w;
        if (right < x + t.px(30)) return;
        text_in(list, t.small, {right, origin.y}, {right + w, origin.y + size.y}, t.quiet, text, 0);
        const ImVec2 at(right - t.px(10), origin.y + size.y * 0.5f);
        const float r = t.px(4);
        draw_mark(t, list, shape, at, r, color);
        right -= t.px(30);
    };
    const auto known = [&](auto&& has) { return std::any_of(v.marks.begin(), v.marks.end(), has); };
    if (!v.to_correct.empty()) legend("Correct", t.bad, Mark::kTriangle);
    if (known([](const FrameMarks& m) { return m.flicker >= 0; }))
        legend("Flicker", heat_color(0.7f), Mark::kBar);
    if (known([](const FrameMarks& m) { return m.seam >= 0; }))
        legend("Seams", heat_color(0.6f), Mark::kBar);
    if (known([](const FrameMarks& m) { return m.drift >= 0; }))
        legend("Drift", heat_color(0.5f), Mark::kBar);
    legend("Result", t.good, Mark::kBar);
    legend("Plate in memory", faded(t.accent, 0.8f), Mark::kBar);
    legend("Reference frame", t.warn, Mark::kTriangle);
    if (known([](const FrameMarks& m) { return m.confirmed; }))
        legend("Confirmed in part", t.good, Mark::kHollow);
    legend("Painted matte", t.text, Mark::kDiamond);
}

int nice_step(float frames_per_label) {
    int step = 1;
    for (const int candidate : {1, 2, 5, 10, 20, 25, 50, 100, 200, 250, 500, 1000, 2000, 5000})
        if (static_cast<float>(step = candidate) >= frames_per_label) break;
    return step;
}

// The frame of the plate's range that is under the mouse.
int frame_under(const Ctx& c, const FrameScale& scale) {
    const std::vector<int>& frames = c.view.plate.frames;
    const double at = scale.at(ImGui::GetIO().MousePos.x);
    return static_cast<int>(std::lround(
        std::clamp(at, static_cast<double>(frames.front()), static_cast<double>(frames.back()))));
}

void ruler(Ctx& c, ImDrawList& list, const FrameScale& scale, float top, float bottom) {
    const Theme& t = c.theme;
    const int step = nice_step(t.px(56) / scale.frame_width());
    const int minor = std::max(1, step / 5);
    const int last = static_cast<int>(std::ceil(scale.last));
    for (int f = static_cast<int>(std::floor(scale.first / minor)) * minor; f <= last; f += minor) {
        if (f < scale.first || f > scale.last) continue;
        const float x = std::floor(scale.x_of(f)) + 0.5f;
        const bool labelled = f % step == 0;
        list.AddLine({x, bottom - t.px(labelled ? 7 : 4)}, {x, bottom}, labelled ? t.quiet : t.off);
        if (!labelled) continue;
        const std::string text = std::to_string(f);
        const float w = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text.c_str()).x;
        const float left = std::clamp(x - w * 0.5f, scale.x0 - t.px(8), scale.x1 + t.px(8) - w);
        list.AddText(t.small, t.small->FontSize, {std::floor(left), top}, t.quiet, text.c_str());
    }
}

void tracks(Ctx& c, ImDrawList& list, const FrameScale& scale, float top, float bottom) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const float half = std::max(t.px(1), scale.frame_width() * 0.5f);
    const float cache_y = top, cache_h = t.px(4);
    // Keyframes below the bars; suggested keyframes below them if there is room.
    const float keys_y = std::min(top + t.px(18), bottom - t.px(6));
    list.AddRectFilled({scale.x0 - half, cache_y}, {scale.x1 + half, cache_y + cache_h},
                       faded(t.field, 1.0f));
    bool confident = false;
    const auto run = [&](auto&& has, float y, float h, ImU32 color) {
        // Merges neighbouring frames into one bar.
        for (std::size_t k = 0; k < v.marks.size(); ++k) {
            if (!has(v.marks[k])) continue;
            const std::size_t from = k;
            while (k + 1 < v.marks.size() && has(v.marks[k + 1]))
                ++k;
            list.AddRectFilled({scale.x_of(v.plate.frames[from]) - half, y},
                               {scale.x_of(v.plate.frames[k]) + half, y + h}, color);
        }
    };
    run([](const FrameMarks& m) { return m.plate; }, cache_y, cache_h, faded(t.accent, 0.8f));
    run([](const FrameMarks& m) { return m.result; }, cache_y + cache_h + t.px(1), cache_h, t.good);
    run([](const FrameMarks& m) { return m.failed; }, cache_y, 2 * cache_h, t.bad);
    const float heat_y = bottom - t.px(8);
    for (std::size_t k = 0; k < v.marks.size(); ++k) {
        const FrameMarks& mark = v.marks[k];
        const float x = std::floor(scale.x_of(v.plate.frames[k])) + 0.5f;
        if (mark.confidence >= 0) {
            confident = true;
            // Dark where confidence is high, light where it is low.
            list.AddRectFilled({x - half, heat_y}, {x + half, heat_y + t.px(6)},
                               heat_color(1.0f - mark.confidence));
        }
        const float r = t.px(5);
        if (mark.reference) draw_mark(t, list, Mark::kTriangle, {x, keys_y}, r, t.warn);
        if (mark.confirmed) draw_mark(t, list, Mark::kHollow, {x, keys_y}, r, t.good);
        if (mark.matte_key) draw_mark(t, list, Mark::kDiamond, {x, keys_y}, r, t.text);
    }
    // A thin strip for each known measure, from the bottom up.
    float strip_y = confident ? heat_y - t.px(5) : heat_y + t.px(1);
    const float strip_h = t.px(4);
    const auto strip = [&](auto&& value_of) {
        bool any = false;
        for (std::size_t k = 0; k < v.marks.size(); ++k) {
            const float value = value_of(v.marks[k]);
            if (value < 0) continue;
            any = true;
            const float x = scale.x_of(v.plate.frames[k]);
            list.AddRectFilled({x - half, strip_y}, {x + half, strip_y + strip_h},
                               heat_color(std::clamp(value, 0.0f, 1.0f)));
        }
        if (any) strip_y -= strip_h + t.px(1);
    };
    strip([](const FrameMarks& m) { return m.drift; });
    strip([](const FrameMarks& m) { return m.seam / kWorstSeams; });
    strip([](const FrameMarks& m) {
        return flicker_heat(m.flicker, m.flicker_plate, m.flicker_floor);
    });
    // Suggested keyframes.
    for (const CorrectionHint& hint : v.to_correct) {
        const float x = std::floor(scale.x_of(hint.frame)) + 0.5f, y = top - t.px(1);
        list.AddTriangleFilled({x - t.px(4), y - t.px(6)}, {x + t.px(4), y - t.px(6)}, {x, y},
                               t.bad);
    }
}

}  // namespace

void timeline(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Timeline", size, t.panel, false, 0);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(origin, {origin.x + size.x, origin.y}, t.line);
    transport(c, {size.x, t.px(32)});
    const SessionView& v = c.view;
    const float top = origin.y + t.px(34), bottom = origin.y + size.y - t.px(6);
    const ImVec2 field_min(origin.x + t.px(8) + key_names_width(c), top);
    const ImVec2 field_max(origin.x + size.x - t.px(8), bottom);
    list.AddRectFilled(field_min, field_max, t.field, t.radius);
    if (v.plate.frames.empty()) {
        text_in(list, t.regular, field_min, field_max, t.off, "The plate's frames appear here");
        end_panel(c);
        return;
    }
    const FrameScale scale = frame_scale(c, field_min.x, field_max.x);
    list.PushClipRect(field_min, field_max, true);
    const float half = std::max(t.px(1), scale.frame_width() * 0.5f);
    if (v.mark_in || v.mark_out) {
        const float a = scale.x_of(v.mark_in.value_or(v.plate.frames.front())) - half;
        const float b = scale.x_of(v.mark_out.value_or(v.plate.frames.back())) + half;
        list.AddRectFilled({a, top}, {b, bottom}, faded(t.accent, 0.13f));
        for (const float x : {a, b})
            list.AddRectFilled({x - t.px(1), top}, {x + t.px(1), bottom}, t.accent);
    }
    const bool compact = bottom - top < t.px(50);
    const float below = top + t.px(compact ? 21 : 26);
    ruler(c, list, scale, top + t.px(compact ? 1 : 3), below);
    tracks(c, list, scale, below + t.px(compact ? 1 : 2), bottom);
    ImGui::SetCursorScreenPos(field_min);
    ImGui::InvisibleButton("##scrub", {field_max.x - field_min.x, field_max.y - field_min.y});
    c.note("Scrub");
    if (ImGui::IsItemActive()) {
        const int frame = frame_under(c, scale);
        if (frame != v.frame) c.emit(GoToFrame{frame});
    }
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
        const float x = scale.x_of(frame_under(c, scale));
        list.AddLine({x, top}, {x, bottom}, faded(t.text, 0.25f));
    }
    // The playhead.
    const float x = std::floor(scale.x_of(v.frame)) + 0.5f;
    list.AddLine({x, top}, {x, bottom}, t.text, t.px(1.5f));
    list.AddTriangleFilled({x - t.px(6), top}, {x + t.px(6), top}, {x, top + t.px(8)}, t.text);
    list.PopClipRect();
    end_panel(c);
}

}  // namespace weft::ui
