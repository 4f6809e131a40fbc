// The render page: settings, estimate and jobs.
#include <algorithm>
#include <cmath>

#include "app/render/render_estimate.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? std::string(".") : path.substr(0, slash);
}

constexpr const char* kExtensions[] = {"png", "exr", "tif", "jpg"};

void fill_defaults(Ctx& c) {
    ExportState& e = c.state.output;
    const Output& own = c.view.project.output;
    std::string proposed = c.view.render_folder + "/####." + kExtensions[e.format];
    if (!own.path.empty())
        proposed = own.path.starts_with('/') || c.view.path.empty()
                       ? own.path
                       : folder_of(c.view.path) + "/" + own.path;
    // What the user typed stays; a proposal follows the project's name.
    if (e.output.empty() || e.output == e.proposed) e.output = proposed;
    e.proposed = std::move(proposed);
}

std::vector<int> frames_of(const Ctx& c) {
    const ExportState& e = c.state.output;
    const auto& all = c.view.plate.frames;
    std::vector<int> out;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool inside = (!c.view.mark_in || all[k] >= *c.view.mark_in) &&
                            (!c.view.mark_out || all[k] <= *c.view.mark_out);
        if (e.range == 0 || (e.range == 1 && inside) ||
            (e.range == 2 && k % static_cast<std::size_t>(std::max(1, e.step)) == 0))
            out.push_back(all[k]);
    }
    return out;
}

void set_extension(std::string& path, const char* extension) {
    const std::size_t dot = path.find_last_of('.');
    const std::size_t slash = path.find_last_of('/');
    if (dot != std::string::npos && (slash == std::string::npos || dot > slash)) path.erase(dot);
    path += std::string(".") + extension;
}

// "render_v001" → "render_v002".
void version_up(std::string& path) {
    const std::size_t at = path.rfind("_v");
    if (at == std::string::npos) return;
    std::size_t end = at + 2;
    while (end < path.size() && path[end] >= '0' && path[end] <= '9')
        ++end;
    if (end == at + 2 || end - at > 8) return;
    std::string number = std::to_string(std::stoi(path.substr(at + 2, end - at - 2)) + 1);
    while (number.size() < end - at - 2)
        number.insert(number.begin(), '0');
    path.replace(at + 2, end - at - 2, number);
}

RenderEstimate estimate_of(const Ctx& c, const std::vector<int>& frames, Quality quality) {
    const SessionView& v = c.view;
    EstimateInputs in;
    in.size = v.plate.size;
    in.frames = frames.size();
    in.quality = quality;
    in.extension = kExtensions[c.state.output.format];
    in.threads = static_cast<unsigned>(thread_count());
    in.speed = c.settings.render_speed;
    count_regions(v.project, in);
    in.layers = !c.state.output.layers.empty();
    // The preview's analysis is reused by a render of the same quality.
    const bool analysed = v.preview_quality == quality && v.result_current && !v.preview.analysing;
    in.analysed =
        analysed || frames.empty() ? 0 : analysed_frames(v.project, frames.front(), frames.back());
    return estimate_render(in);
}

// Draws the estimate of the render. Returns its seconds.
double estimate(Ctx& c, const std::vector<int>& frames) {
    const SessionView& v = c.view;
    const Theme& t = c.theme;
    const Quality quality = v.project.settings.quality;
    const RenderEstimate now = estimate_of(c, frames, quality);
    const Quality other = quality == Quality::kDraft ? Quality::kFinal : Quality::kDraft;
    const bool known = !frames.empty() && !v.plate.size.empty();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float w = ImGui::GetContentRegionAvail().x, h = t.px(80), third = w / 3;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + w, at.y + h}, t.field, t.radius);
    const std::string values[] = {"about " + time_text(now.seconds),
                                  bytes_text(static_cast<double>(now.memory_bytes)),
                                  bytes_text(static_cast<double>(now.disk_bytes))};
    constexpr const char* kNames[] = {"Time", "Memory", "Disk"};
    for (int k = 0; k < 3; ++k) {
        const float x = at.x + third * static_cast<float>(k);
        text_in(list, t.small, {x, at.y + t.px(8)}, {x + third, at.y + t.px(24)}, t.quiet,
                kNames[k]);
        text_in(list, t.strong, {x, at.y + t.px(26)}, {x + third, at.y + t.px(50)}, t.text,
                known ? values[k].c_str() : "–");
    }
    const std::string instead = (other == Quality::kDraft ? "Draft: about " : "Final: about ") +
                                time_text(estimate_of(c, frames, other).seconds);
    if (known)
        text_in(list, t.small, {at.x, at.y + t.px(54)}, {at.x + w, at.y + t.px(72)}, t.quiet,
                instead.c_str());
    ImGui::Dummy({w, h});
    return now.seconds;
}

// Layers for compositing and their files.
void layer_choice(Ctx& c) {
    const Theme& t = c.theme;
    ExportState& e = c.state.output;
    if (!section(c, "Layers for compositing", false)) return;
    const PanelName panel(c, "Layers");
    const float left = ImGui::GetCursorPosX();
    const float third = std::floor(ImGui::GetContentRegionAvail().x / 3);
    int column = 0;
    for (const LayerInfo& layer : kLayers) {
        const auto at = std::find(e.layers.begin(), e.layers.end(), layer.kind);
        bool on = at != e.layers.end();
        if (column > 0) ImGui::SameLine(left + third * static_cast<float>(column));
        if (checkbox(c, layer.name.data(), on, layer.help.data())) {
            if (on)
                e.layers.push_back(layer.kind);
            else
                e.layers.erase(at);
        }
        column = (column + 1) % 3;
    }
    const bool exr = std::string_view(kExtensions[e.format]) == "exr";
    if (e.layers.empty()) return section_gap(c);
    if (exr) {
        int apart = e.layers_apart ? 1 : 0;
        if (segments(c, "Where", {"In the frames", "Separate files"}, apart))
            e.layers_apart = apart == 1;
    } else {
        quiet(c, "Written as EXR files to a folder 'layers' beside the frames");
    }
    ImGui::Dummy({0, t.px(2)});
    section_gap(c);
}

void take_layers(const ExportState& e, SubmitJob& job) {
    job.layers = e.layers;
    const bool exr = std::string_view(kExtensions[e.format]) == "exr";
    if (!job.layers.empty() && (!exr || e.layers_apart))
        job.layers_path = folder_of(job.output) + "/layers/####.exr";
}

// The reason why it cannot be rendered, with the region's name if it concerns a region.
std::string in_words(const Ctx& c, const Issue& problem) {
    for (const Leaf<Region>& region : c.view.project.regions)
        if (const auto found = c.view.unready.find(region->id); found != c.view.unready.end())
            return region->name + " is not ready. " + found->second + ".";
    return problem.what + ". " + problem.what_to_do + ".";
}

// Before the render is asked for: afterwards it would only fail.
void existing_frames_notice(Ctx& c, const std::vector<int>& frames) {
    const ExportState& e = c.state.output;
    const int there = count_existing(frames, c.written.of(e.output, ImGui::GetTime()));
    if (there == 0) return;
    const std::string what =
        std::to_string(there) + " of " + std::to_string(frames.size()) + " frames exist already. ";
    if (e.existing == 0)
        banner(c, icons::kAlert, c.theme.warn,
               what + "Skip or overwrite them, or version up (the arrow beside the path).");
    else
        banner(c, icons::kInformation, c.theme.warn,
               what + (e.existing == 1 ? "They stay as they are." : "They will be overwritten."));
    c.note("Existing: " + std::to_string(there));
}

void export_card(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Export", size, t.panel, true, t.px(16));
    ImGui::PushFont(t.title);
    ImGui::TextUnformatted("Render");
    ImGui::PopFont();
    ImGui::Dummy({0, t.px(4)});
    fill_defaults(c);
    ExportState& e = c.state.output;
    quiet(c, "Frames");
    segments(c, "Frames", {"Whole shot", "Marked range", "Every nth"}, e.range);
    if (e.range == 1 && !c.view.mark_in && !c.view.mark_out)
        banner(c, icons::kInformation, t.warn,
               "Set in and out points with I and O on the timeline.");
    if (e.range == 2) {
        double step = e.step;
        if (slider(c,
                   {.label = "Every",
                    .unit = "frames",
                    .min = 2,
                    .max = 50,
                    .standard = 10,
                    .decimals = 0,
                    .integer = true},
                   step) != Change::kNone)
            e.step = static_cast<int>(step);
    }
    ImGui::Dummy({0, t.px(6)});
    quiet(c, "Format");
    if (segments(c, "Format", {"PNG", "EXR", "TIFF", "JPEG"}, e.format))
        set_extension(e.output, kExtensions[e.format]);
    ImGui::Dummy({0, t.px(6)});
    quiet(c, "To");
    const float buttons = t.px(2 * 28 + 8);
    input(c, "Output", e.output, "folder/####.png", ImGui::GetContentRegionAvail().x - buttons);
    ImGui::SameLine();
    if (icon_button(c, icons::kFolderOpen, "Choose a folder", false, nullptr, true, t.row)) {
        c.state.browser.purpose = BrowserState::Purpose::kOutput;
        c.state.browser.just_opened = true;
    }
    ImGui::SameLine(0, t.px(4));
    if (icon_button(c, icons::kArrowUp, "Version up", false, nullptr, true, t.row))
        version_up(e.output);
    checkbox(c, "Write review movie", e.with_movie, "An .mp4 of the result for review");
    layer_choice(c);
    ImGui::Dummy({0, t.px(4)});
    quiet(c, "If files exist");
    segments(c, "Existing", {"Fail", "Skip", "Overwrite"}, e.existing);
    ImGui::Dummy({0, t.px(6)});
    project_parameter(c, "settings.quality", "Quality");
    project_parameter(c, "output.depth", "Depth");
    ImGui::Dummy({0, t.px(6)});
    const std::vector<int> frames = frames_of(c);
    existing_frames_notice(c, frames);
    const double seconds = estimate(c, frames);
    ImGui::Dummy({0, t.px(4)});
    const Issue* problem = nullptr;
    for (const Issue& issue : c.view.issues)
        if (issue.severity == Severity::kError && !problem) problem = &issue;
    // The output is set here, so it may be missing in the document.
    const bool ready = problem == nullptr || problem->where.find("output") != std::string::npos;
    const bool no_plate = c.view.plate.state == PlateView::State::kFailed;
    if (!ready)
        banner(c, icons::kAlert, t.bad, in_words(c, *problem));
    else if (no_plate)
        banner(c, icons::kAlert, t.bad, "Cannot open the plate. " + c.view.plate.error);
    const std::string label = "Render " + std::to_string(frames.size()) + " frames";
    if (button(c, (label + "##submit").c_str(),
               {.icon = icons::kRocket,
                .look = Look::kPrimary,
                .enabled = ready && !frames.empty(),
                .width = -1})) {
        SubmitJob job;
        job.frames = format_frame_list(frames);
        job.output = e.output;
        if (e.with_movie) job.movie = folder_of(e.output) + ".mp4";
        job.overwrite = e.existing == 2;
        job.skip_existing = e.existing == 1;
        job.estimated_s = seconds;
        take_layers(e, job);
        c.emit(job);
    }
    c.note("Render frames");
    end_panel(c);
}

const char* state_name(JobState state) {
    switch (state) {
        case JobState::kWaiting:
            return "Waiting";
        case JobState::kRunning:
            return "Rendering";
        case JobState::kPaused:
            return "Paused";
        case JobState::kDone:
            return "Done";
        case JobState::kCancelled:
            return "Cancelled";
        case JobState::kFailed:
            return "Failed";
    }
    return "";
}

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

void job_row(Ctx& c, const JobView& job) {
    const Theme& t = c.theme;
    ImGui::PushID(job.id);
    const PanelName name(c, "Job " + std::to_string(job.id));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float w = ImGui::GetContentRegionAvail().x, h = t.px(92);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + w, at.y + h}, t.raised, t.radius);
    const ImVec2 thumb_max(at.x + t.px(132), at.y + h - t.px(8));
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
    text_in(list, t.strong, {x, at.y + t.px(10)}, {right - t.px(150), at.y + t.px(28)}, t.text,
            fitted(job.label, right - t.px(170) - x).c_str(), 0);
    ImGui::PushFont(t.small);
    text_in(list, t.small, {x, at.y + t.px(29)}, {right, at.y + t.px(45)}, t.quiet,
            fitted(job.output, right - x, true).c_str(), 0);
    const float part =
        job.total > 0 ? static_cast<float>(job.done) / static_cast<float>(job.total) : 0;
    const float bar_y = at.y + t.px(50);
    list.AddRectFilled({x, bar_y}, {right, bar_y + t.px(6)}, t.field, t.px(3));
    if (part > 0)
        list.AddRectFilled({x, bar_y}, {x + (right - x) * part, bar_y + t.px(6)},
                           state_color(t, job.state), t.px(3));
    std::string line = state_name(job.state);
    if (job.state == JobState::kRunning && job.stage == "analyse") line = "Analysing";
    if (job.state == JobState::kRunning && job.stage.empty()) line = "Starting";
    if (!job.error.empty()) {
        line += ". " + job.error;
    } else {
        if (job.total > 0)
            line += "  " + std::to_string(job.done) + " of " + std::to_string(job.total);
        if (job.left_s > 0) line += "   " + time_text(job.left_s) + " left";
        if (job.frames_per_minute > 0)
            line += "   " + number_text(job.frames_per_minute, 1) + " frames a minute";
        const bool done = job.state == JobState::kDone;
        if (job.elapsed_s > 0)
            line += std::string(done ? "   in " : "   ") + time_text(job.elapsed_s) +
                    (done ? "" : " elapsed");
    }
    text_in(list, t.small, {x, at.y + t.px(61)}, {right, at.y + t.px(80)},
            state_color(t, job.state), fitted(line, right - x).c_str(), 0);
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

}  // namespace

void jobs_page(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float left = std::min(t.px(400), size.x * 0.42f);
    export_card(c, {left, size.y});
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
    for (auto job = c.view.jobs.rbegin(); job != c.view.jobs.rend(); ++job)
        job_row(c, *job);
    end_panel(c);
}

void learn_from_jobs(Ctx& c) {
    for (const JobView& job : c.view.jobs) {
        if (job.state != JobState::kDone || job.estimated_s <= 0 ||
            c.state.calibrated_jobs.contains(job.id))
            continue;
        c.state.calibrated_jobs.insert(job.id);
        c.settings.render_speed =
            calibrated_speed(c.settings.render_speed, job.estimated_s, job.elapsed_s);
    }
}

}  // namespace weft::ui
