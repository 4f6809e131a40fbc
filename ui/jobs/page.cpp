// The Jobs page: a render's settings, and the queue.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ui/base/icons.h"
#include "ui/jobs/folder_of.h"
#include "ui/jobs/job_words.h"
#include "ui/jobs/jobs.h"
#include "ui/jobs/problem.h"
#include "ui/jobs/render_card.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrap.h"

namespace weft::ui {
namespace {

ImU32 state_color(const Theme& t, JobState state) {
    switch (state) {
        case JobState::kDone:
            return t.good;
        case JobState::kFailed:
            return t.bad;
        case JobState::kPaused:
        case JobState::kCancelled:
            return t.warn;
        case JobState::kRunning:
            return t.accent_hover;
        case JobState::kWaiting:
            break;
    }
    return t.quiet;
}

void job_buttons(Ctx& c, const JobView& job, ImVec2 right_top) {
    const Theme& t = c.theme;
    std::vector<std::pair<const char*, const char*>> shown;  // icon, name
    if (job.problem.known() && shows(c, job)) shown.emplace_back(icons::kTarget, kShowProblem);
    if (job.state == JobState::kWaiting) {
        shown.emplace_back(icons::kChevronUp, "Earlier");
        shown.emplace_back(icons::kChevronDown, "Later");
    }
    const bool over = job.state == JobState::kDone || job.state == JobState::kFailed ||
                      job.state == JobState::kCancelled;
    if (job.state == JobState::kRunning) shown.emplace_back(icons::kPause, "Pause");
    if (job.state == JobState::kPaused) shown.emplace_back(icons::kPlay, "Resume");
    if (!over) shown.emplace_back(icons::kStop, "Cancel");
    if (job.state == JobState::kFailed || job.state == JobState::kCancelled)
        shown.emplace_back(icons::kRefresh, "Retry");
    shown.emplace_back(icons::kConsole, "Log");
    shown.emplace_back(icons::kFolderOpen, "Show folder");
    if (job.state == JobState::kDone) shown.emplace_back(icons::kReview, "Review");
    if (over) shown.emplace_back(icons::kClose, "Remove");
    const float side = t.px(28);
    float x = right_top.x - side * static_cast<float>(shown.size());
    for (const auto& [icon, name] : shown) {
        ImGui::SetCursorScreenPos({x, right_top.y});
        const std::string_view what = name;
        // The frames of another shot are not compared with this plate.
        const bool other_shot = what == "Review" && job.plate != c.view.plate.path;
        if (icon_button(c, icon, other_shot ? "Review (open its shot first)" : name,
                        what == "Log" && c.state.open_log == job.id, nullptr, !other_shot)) {
            if (what == kShowProblem) show_problem(c, job.problem);
            if (what == "Earlier") c.emit(CommandJob{job.id, JobCommand::kEarlier});
            if (what == "Later") c.emit(CommandJob{job.id, JobCommand::kLater});
            if (what == "Pause") c.emit(CommandJob{job.id, JobCommand::kPause});
            if (what == "Resume") c.emit(CommandJob{job.id, JobCommand::kResume});
            if (what == "Cancel") c.emit(CommandJob{job.id, JobCommand::kCancel});
            if (what == "Retry") c.emit(CommandJob{job.id, JobCommand::kRetry});
            if (what == "Remove") c.emit(CommandJob{job.id, JobCommand::kRemove});
            if (what == "Log") c.state.open_log = c.state.open_log == job.id ? 0 : job.id;
            if (what == "Show folder") c.pictures.reveal(folder_of(job.output));
            if (what == "Review") {
                c.emit(MeasureResult{job.output});
                set_workspace(c.state, Workspace::kReview);
            }
        }
        x += side;
    }
}

// Where the frames go, and the review movie, which lies beside their folder.
std::string files_of(const JobView& job) {
    return job.movie.empty()
               ? job.output
               : job.output + "  ·  " + std::filesystem::path(job.movie).filename().string();
}

void job_row(Ctx& c, const JobView& job) {
    const Theme& t = c.theme;
    ImGui::PushID(job.id);
    const PanelName name(c, "Job " + std::to_string(job.id));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float w = ImGui::GetContentRegionAvail().x;
    // Reasons of failures take as many lines as they need.
    ImGui::PushFont(t.small);
    const std::string line =
        wrapped_at_words(job_line(job), w - t.px(132 + 14 + 10), [](std::string_view text) {
            return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
        });
    const float line_h = std::max(t.px(19), ImGui::CalcTextSize(line.c_str()).y);
    ImGui::PopFont();
    const float h = t.px(73) + line_h;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + w, at.y + h}, t.raised, t.radius);
    const ImVec2 thumb_max(at.x + t.px(132), at.y + t.px(84));
    const ImVec2 thumb_min(at.x + t.px(8), at.y + t.px(8));
    list.AddRectFilled(thumb_min, thumb_max, t.field, t.radius);
    if (job.thumbnail)
        if (const ImTextureID id = c.pictures.texture(job.thumbnail)) {
            const float scale = std::min((thumb_max.x - thumb_min.x) / job.thumbnail->size.width,
                                         (thumb_max.y - thumb_min.y) / job.thumbnail->size.height);
            const float iw = job.thumbnail->size.width * scale,
                        ih = job.thumbnail->size.height * scale;
            const ImVec2 a((thumb_min.x + thumb_max.x - iw) * 0.5f,
                           (thumb_min.y + thumb_max.y - ih) * 0.5f);
            list.AddImage(id, a, {a.x + iw, a.y + ih});
        }
    const float x = thumb_max.x + t.px(14), right = at.x + w - t.px(10);
    text_in(list, t.strong, {x, at.y + t.px(10)}, {right - t.px(180), at.y + t.px(28)}, t.text,
            fitted(job.label, right - t.px(200) - x).c_str(), 0);
    ImGui::PushFont(t.small);
    text_in(list, t.small, {x, at.y + t.px(29)}, {right, at.y + t.px(45)}, t.quiet,
            fitted(files_of(job), right - x, true).c_str(), 0);
    c.note("Files: " + files_of(job), {x, at.y + t.px(29)}, {right, at.y + t.px(45)});
    const float part =
        job.total > 0 ? static_cast<float>(job.done) / static_cast<float>(job.total) : 0;
    const float bar_y = at.y + t.px(50);
    list.AddRectFilled({x, bar_y}, {right, bar_y + t.px(6)}, t.field, t.px(3));
    if (part > 0)
        list.AddRectFilled({x, bar_y}, {x + (right - x) * part, bar_y + t.px(6)},
                           state_color(t, job.state), t.px(3));
    text_in(list, t.small, {x, at.y + t.px(61)}, {right, at.y + t.px(61) + line_h},
            state_color(t, job.state), line.c_str(), 0);
    ImGui::PopFont();
    job_buttons(c, job, {right, at.y + t.px(4)});
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({w, h});
    if (c.state.open_log == job.id && c.job_log) {
        const std::string log = c.job_log(job.id);
        ImGui::PushStyleColor(ImGuiCol_ChildBg, t.field);
        ImGui::BeginChild("##log", {0, t.px(140)}, true);
        ImGui::PushFont(t.small);
        wrapped(c, log.empty() ? "The log is empty: no errors or warnings." : log, t.quiet);
        ImGui::PopFont();
        ImGui::EndChild();
        ImGui::PopStyleColor();
    }
    ImGui::PopID();
}

// What failed needs the artist first; then what is being done, and what waits in its order.
std::vector<const JobView*> in_order(const std::vector<JobView>& jobs) {
    std::vector<const JobView*> out;
    const auto add = [&](const JobView& job, std::initializer_list<JobState> states) {
        if (std::find(states.begin(), states.end(), job.state) != states.end()) out.push_back(&job);
    };
    for (auto job = jobs.rbegin(); job != jobs.rend(); ++job)
        add(*job, {JobState::kFailed});
    for (const JobView& job : jobs)
        add(job, {JobState::kRunning, JobState::kPaused});
    for (const JobView& job : jobs)
        add(job, {JobState::kWaiting});
    for (auto job = jobs.rbegin(); job != jobs.rend(); ++job)
        add(*job, {JobState::kDone, JobState::kCancelled});
    return out;
}

}  // namespace

void jobs_page(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float left = std::min(t.px(400), size.x * 0.42f);
    render_card(c, {left, size.y});
    ImGui::SetCursorScreenPos({at.x + left, at.y});
    begin_panel(c, "Queue", {size.x - left, size.y}, t.panel, true, t.px(16));
    ImGui::GetWindowDrawList()->AddLine({at.x + left, at.y}, {at.x + left, at.y + size.y}, t.line);
    ImGui::PushFont(t.title);
    ImGui::TextUnformatted("Queue");
    ImGui::PopFont();
    ImGui::Dummy({0, t.px(4)});
    if (c.view.jobs.empty()) {
        empty_state(c, icons::kJobs, "No renders yet",
                    "Set up a render on the left. It runs in the background: you can keep working "
                    "or close the window.");
    }
    for (const JobView* job : in_order(c.view.jobs))
        job_row(c, *job);
    end_panel(c);
}

}  // namespace weft::ui
