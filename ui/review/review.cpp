// Quality of the result frame by frame, next to the plate's.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/base/icons.h"
#include "ui/review/review.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

using ReportRow = QualityReport::Row;

// The newest finished render of this shot, or null.
const JobView* newest_render(const Ctx& c) {
    const JobView* found = nullptr;
    for (const JobView& job : c.view.jobs)
        if (job.state == JobState::kDone && job.plate == c.view.plate.path) found = &job;
    return found;
}

// `from`: first row with a value.
void graph(Ctx& c, ImVec2 size, const char* title, float ReportRow::*value, float ReportRow::*plate,
           std::size_t from = 0) {
    const Theme& t = c.theme;
    const auto& rows = c.view.report.rows;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, t.field, t.radius);
    text_in(list, t.strong, {at.x + t.px(10), at.y + t.px(4)}, {at.x + size.x, at.y + t.px(24)},
            t.text, title, 0);
    float most = 1;
    for (const ReportRow& row : rows)
        most = std::max({most, row.*value, row.*plate});
    const float x0 = at.x + t.px(40), x1 = at.x + size.x - t.px(12);
    const float y0 = at.y + size.y - t.px(14), y1 = at.y + t.px(30);
    const auto x_of = [&](std::size_t k) {
        return x0 + (x1 - x0) * static_cast<float>(k) /
                        static_cast<float>(std::max<std::size_t>(1, rows.size() - 1));
    };
    const auto y_of = [&](float v) { return y0 + (y1 - y0) * v / most; };
    for (const float v : {0.0f, most * 0.5f, most}) {
        list.AddLine({x0, y_of(v)}, {x1, y_of(v)}, faded(t.off, 0.35f));
        text_in(list, t.small, {at.x, y_of(v) - t.px(8)}, {x0 - t.px(6), y_of(v) + t.px(8)},
                t.quiet, number_text(static_cast<double>(v), most < 10 ? 1 : 0).c_str(), 1);
    }
    const auto line = [&](float ReportRow::*which, ImU32 color, float width) {
        std::vector<ImVec2> points;
        for (std::size_t k = from; k < rows.size(); ++k)
            points.push_back({x_of(k), y_of(rows[k].*which)});
        list.AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, width);
    };
    line(plate, t.off, t.px(1.5f));
    line(value, t.accent_hover, t.px(2));
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k].frame == c.view.frame)
            list.AddLine({x_of(k), y1}, {x_of(k), y0}, faded(t.text, 0.6f));
    ImGui::PushID(title);
    ImGui::InvisibleButton("##graph", size);
    ImGui::PopID();
    c.note(title);
    if (ImGui::IsItemActive() && !rows.empty()) {
        const float u = std::clamp((ImGui::GetIO().MousePos.x - x0) / (x1 - x0), 0.0f, 1.0f);
        const auto k =
            static_cast<std::size_t>(std::lround(u * static_cast<float>(rows.size() - 1)));
        if (rows[k].frame != c.view.frame) c.emit(GoToFrame{rows[k].frame});
    }
    tooltip(c, "Blue: the result. Grey: the plate, over the same pixels. Drag to scrub");
}

// Heat value of a frame; below 0: not known.
struct Heat {
    const char* name;
    const char* tip;
    std::vector<float> values;  // by index into the plate's frames
};

std::vector<Heat> heats_of(const Ctx& c) {
    std::vector<Heat> out{
        {"Flicker",
         "How much more the result changes from frame to frame than the plate, or than its "
         "texture would if it moved unchanged",
         {}},
        {"Seams", "How much of the seams shows, and is not hidden by the texture's own edges", {}},
        {"Drift", "How different the surface looks from its reference frame", {}},
        {"Matte", "How far the matte's edge departs from the picture's motion", {}},
        {"Pops",
         "Sudden steps of sharpness, light, grain or place that the plate does not have",
         {}}};
    // Edge motion of this many px is the worst on the scale.
    constexpr float kWorstChatter_px = 4;
    // A step that counts as a pop is in the middle of the scale.
    constexpr float kWorstPop = 2;
    for (const FrameMarks& mark : c.view.marks) {
        out[0].values.push_back(flicker_heat(mark.flicker, mark.flicker_plate, mark.flicker_floor));
        out[1].values.push_back(mark.seam / kWorstSeams);
        out[2].values.push_back(mark.drift);
        out[3].values.push_back(mark.chatter / kWorstChatter_px);
        out[4].values.push_back(mark.pop / kWorstPop);
    }
    return out;
}

// One strip per measure, dark where the value is good. A click goes to the frame.
void heat_strips(Ctx& c) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float row = t.px(14), gap = t.px(3), x0 = at.x + t.px(62), x1 = at.x + width;
    const std::vector<Heat> heats = heats_of(c);
    const float height = static_cast<float>(heats.size()) * (row + gap) - gap;
    const float step = (x1 - x0) / static_cast<float>(std::max<std::size_t>(1, v.marks.size()));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::InvisibleButton("##strips", {width, height});
    c.note("Heat strips");
    const float mouse = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemActive() && !v.plate.frames.empty()) {
        const auto k = static_cast<std::size_t>(
            std::clamp((mouse - x0) / step, 0.0f, static_cast<float>(v.plate.frames.size() - 1)));
        if (v.plate.frames[k] != v.frame) c.emit(GoToFrame{v.plate.frames[k]});
    }
    float y = at.y;
    for (const Heat& heat : heats) {
        const bool known = std::any_of(heat.values.begin(), heat.values.end(),
                                       [](float value) { return value >= 0; });
        text_in(list, t.small, {at.x, y}, {x0, y + row}, known ? t.text : t.off, heat.name, 0);
        list.AddRectFilled({x0, y}, {x1, y + row}, t.field, t.px(2));
        for (std::size_t k = 0; k < heat.values.size(); ++k) {
            if (heat.values[k] < 0) continue;
            const float left = x0 + step * static_cast<float>(k);
            list.AddRectFilled({left, y}, {left + step, y + row},
                               heat_color(std::clamp(heat.values[k], 0.0f, 1.0f)));
        }
        if (ImGui::IsMouseHoveringRect({at.x, y}, {x1, y + row}) && ImGui::IsItemHovered())
            ImGui::SetTooltip("%s. Dark is good. Click to go to the frame", heat.tip);
        y += row + gap;
    }
    for (std::size_t k = 0; k < v.plate.frames.size(); ++k) {
        if (v.plate.frames[k] != v.frame) continue;
        const float x = x0 + step * (static_cast<float>(k) + 0.5f);
        list.AddLine({x, at.y - t.px(2)}, {x, at.y + height + t.px(2)}, t.text, t.px(1.5f));
    }
    ImGui::Dummy({0, t.px(2)});
}

// A frame with its measure.
struct Worst {
    int frame = 0;
    float badness = 0;
    std::string text;
};

std::vector<Worst> worst_of(const Ctx& c, int by) {
    const auto number = [](float value, int places) {
        return number_text(static_cast<double>(value), places);
    };
    const auto worst = [&](const FrameMarks& mark) -> std::optional<Worst> {
        switch (by) {
            case 0:
                if (mark.flicker < 0) return std::nullopt;
                return Worst{
                    0, mark.flicker - std::max(mark.flicker_plate, mark.flicker_floor),
                    number(mark.flicker, 2) + (mark.flicker_floor < 0
                                                   ? ", plate " + number(mark.flicker_plate, 2)
                                                   : ", at best " + number(mark.flicker_floor, 2))};
            case 1: {
                if (mark.seam < 0) return std::nullopt;
                std::string text = number(100 * mark.seam, 0) + "% of them shows";
                if (mark.seam_motion >= 0) text += ", moved " + number(mark.seam_motion, 1) + " px";
                return Worst{0, mark.seam, text};
            }
            case 2:
                if (mark.drift < 0) return std::nullopt;
                return Worst{0, mark.drift, "drift " + number(100 * mark.drift, 0) + "%"};
            case 3:
                if (mark.chatter < 0) return std::nullopt;
                return Worst{0, mark.chatter, "edge off by " + number(mark.chatter, 2) + " px"};
            default:
                if (mark.pop < 0) return std::nullopt;
                return Worst{0, mark.pop, mark.pop_text + (mark.pop >= 1 ? ", a pop" : "")};
        }
    };
    std::vector<Worst> out;
    for (std::size_t k = 0; k < c.view.marks.size(); ++k) {
        std::optional<Worst> one = worst(c.view.marks[k]);
        if (!one) continue;
        one->frame = c.view.plate.frames[k];
        out.push_back(std::move(*one));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Worst& a, const Worst& b) { return a.badness > b.badness; });
    constexpr std::size_t kShown = 6;
    if (out.size() > kShown) out.resize(kShown);
    return out;
}

// Path of a measured frame; empty: none.
std::string picture_of(const Ctx& c, int frame) {
    for (const ReportRow& row : c.view.report.rows)
        if (row.frame == frame) return row.file;
    return {};
}

// The worst frames of the render, two in a row.
void worst_pictures(Ctx& c, const std::vector<Worst>& worst) {
    const Theme& t = c.theme;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - t.gap) / 2);
    const Size plate = c.view.plate.size;
    const float picture_h = std::floor(
        plate.empty() ? width * 0.5625f
                      : width * std::clamp(static_cast<float>(plate.height) /
                                               static_cast<float>(std::max(1, plate.width)),
                                           0.3f, 1.0f));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t k = 0; k < worst.size(); ++k) {
        const Worst& one = worst[k];
        if (k % 2 == 1) ImGui::SameLine(0, t.gap);
        ImGui::PushID(one.frame);
        if (ImGui::InvisibleButton("##worst", {width, picture_h + t.px(34)}))
            c.emit(GoToFrame{one.frame});
        ImGui::PopID();
        c.note("Worst " + std::to_string(one.frame));
        const ImVec2 at = ImGui::GetItemRectMin();
        const ImVec2 end(at.x + width, at.y + picture_h);
        const bool here = one.frame == c.view.frame, over = ImGui::IsItemHovered();
        list.AddRectFilled(at, end, t.field, t.radius);
        const std::string file = picture_of(c, one.frame);
        const PicturePtr picture =
            file.empty() ? nullptr : c.textures.thumbnail(file, static_cast<int>(width));
        if (const ImTextureID texture = c.pictures.texture(picture))
            list.AddImageRounded(texture, at, end, {0, 0}, {1, 1}, IM_COL32_WHITE, t.radius);
        if (here || over) list.AddRect(at, end, here ? t.accent : t.quiet, t.radius, 0, t.px(2));
        text_in(list, t.small, {at.x, end.y + t.px(1)}, {end.x, end.y + t.px(17)}, t.text,
                ("Frame " + std::to_string(one.frame)).c_str(), 0);
        ImGui::PushFont(t.small);
        text_in(list, t.small, {at.x, end.y + t.px(15)}, {end.x, end.y + t.px(31)}, t.quiet,
                fitted(one.text, width).c_str(), 0);
        ImGui::PopFont();
    }
}

void worst_frames(Ctx& c) {
    if (!section(c, "Worst frames")) return;
    const PanelName panel(c, "Worst");
    segments(c, "By", {"Flicker", "Seams", "Drift", "Matte", "Pops"}, c.state.worst_by);
    const std::vector<Worst> worst = worst_of(c, c.state.worst_by);
    if (worst.empty()) {
        static constexpr const char* kMissing[] = {
            "Flicker is estimated as the preview fills its frames, and measured on a render.",
            "Seams are measured as the preview fills its frames.",
            "Drift is measured once the shot is analysed.",
            "The matte's edge is measured as the preview fills its frames.",
            "Pops are measured as the preview fills its frames."};
        wrapped(c, kMissing[c.state.worst_by], c.theme.quiet);
    }
    if (c.view.report.state == QualityReport::State::kDone) {
        worst_pictures(c, worst);
        section_gap(c);
        return;
    }
    for (const Worst& one : worst) {
        const std::string label = "Frame " + std::to_string(one.frame) + ":  " + one.text;
        if (button(c, label.c_str(),
                   {.look = one.frame == c.view.frame ? Look::kNormal : Look::kQuiet, .width = -1}))
            c.emit(GoToFrame{one.frame});
        c.note("Worst " + std::to_string(one.frame));
    }
    section_gap(c);
}

}  // namespace

void review_panel(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Report", size, t.panel, false, t.px(10));
    const QualityReport& report = c.view.report;
    const ImVec2 origin = ImGui::GetWindowPos();
    ImGui::GetWindowDrawList()->AddLine(origin, {origin.x + size.x, origin.y}, t.line);
    if (!c.view.marks.empty()) heat_strips(c);
    switch (report.state) {
        case QualityReport::State::kNone:
            empty_state(c, icons::kReview, "Not measured yet",
                        "Render the shot, then measure it here: flicker, brightness and sharpness "
                        "of every frame beside the plate's own.");
            break;
        case QualityReport::State::kFailed:
            empty_state(c, icons::kAlert, "Measuring failed", report.error.c_str());
            break;
        case QualityReport::State::kMeasuring:
            heading(c, "Measuring");
            progress_bar(
                c,
                report.total ? static_cast<float>(report.done) / static_cast<float>(report.total)
                             : 0,
                std::to_string(report.done) + " of " + std::to_string(report.total) + " frames");
            break;
        case QualityReport::State::kDone: {
            const ImVec2 room = ImGui::GetContentRegionAvail();
            const float third = std::floor((room.x - 2 * t.gap) / 3);
            graph(c, {third, room.y}, "Flicker, 8-bit steps a frame", &ReportRow::flicker,
                  &ReportRow::flicker_plate, 1);
            ImGui::SameLine(0, t.gap);
            graph(c, {third, room.y}, "Brightness, 8-bit steps", &ReportRow::brightness,
                  &ReportRow::brightness_plate);
            ImGui::SameLine(0, t.gap);
            graph(c, {third, room.y}, "Sharpness, % of the first frame", &ReportRow::sharpness,
                  &ReportRow::sharpness_plate);
            break;
        }
    }
    end_panel(c);
}

void review_inspector(Ctx& c) {
    const Theme& t = c.theme;
    if (section(c, "Compare")) {
        const PanelName panel(c, "Compare");
        for (const char* id :
             {"view.plate", "view.wipe", "view.difference", "view.side", "view.four"}) {
            const Command* command = c.commands.find(id);
            const bool on = command->checked(c);
            if (button(c, command->name.c_str(),
                       {.icon = command->icon,
                        .look = on ? Look::kPrimary : Look::kNormal,
                        .command = id,
                        .width = -1}))
                command->run(c);
        }
        quiet(c, "Hold ` to see the plate");
        section_gap(c);
    }
    if (section(c, "Measure")) {
        const PanelName panel(c, "Measure");
        const JobView* job = newest_render(c);
        if (!job) {
            wrapped(c, "Render the shot first; its frames are measured against the plate.",
                    t.quiet);
            if (button(c, "Go to render", {.icon = icons::kRocket, .width = -1}))
                set_workspace(c.state, Workspace::kJobs);
        } else {
            info_row(c, "Of", job->output);
            const bool busy = c.view.report.state == QualityReport::State::kMeasuring;
            if (button(c, "Measure",
                       {.icon = icons::kReview,
                        .look = Look::kPrimary,
                        .enabled = !busy && c.view.selected_region() != nullptr,
                        .tip = "Flicker of the selected region, compensated for its motion",
                        .width = -1}))
                c.emit(MeasureResult{job->output});
        }
        section_gap(c);
    }
    worst_frames(c);
}

}  // namespace weft::ui
