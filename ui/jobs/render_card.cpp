// What to render, where to, and what that takes.
#include "ui/jobs/render_card.h"

#include <algorithm>
#include <cmath>

#include "app/base/output_problem.h"
#include "app/render/render_estimate.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"
#include "ui/base/icons.h"
#include "ui/jobs/folder_of.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr const char* kExtensions[] = {"png", "exr", "tif", "jpg"};

// "bedroom_v001" for the folder "bedroom_render_v001": a frame says what it is of wherever it is
// copied to.
std::string frame_name(const Ctx& c) {
    std::string name = c.view.title;
    std::replace_if(
        name.begin(), name.end(), [](char at) { return at == '/' || at == '#' || at == '%'; }, '_');
    const std::size_t version = c.view.render_folder.rfind("_v");
    return version == std::string::npos ? name : name + c.view.render_folder.substr(version);
}

void fill_defaults(Ctx& c) {
    ExportState& e = c.state.output;
    const Output& own = c.view.project.output;
    std::string proposed =
        c.view.render_folder + "/" + frame_name(c) + ".####." + kExtensions[e.format];
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

std::string movie_of(const ExportState& e) {
    return folder_of(e.output) + ".mp4";
}

void set_extension(std::string& path, const char* extension) {
    const std::size_t dot = path.find_last_of('.');
    const std::size_t slash = path.find_last_of('/');
    if (dot != std::string::npos && (slash == std::string::npos || dot > slash)) path.erase(dot);
    path += std::string(".") + extension;
}

// "render_v001/wall_v001" → "render_v002/wall_v002".
void version_up(std::string& path) {
    const std::size_t at = path.rfind("_v");
    if (at == std::string::npos) return;
    std::size_t end = at + 2;
    while (end < path.size() && path[end] >= '0' && path[end] <= '9')
        ++end;
    if (end == at + 2 || end - at > 8) return;
    const std::string before = path.substr(at, end - at);
    std::string number = std::to_string(std::stoi(before.substr(2)) + 1);
    while (number.size() < before.size() - 2)
        number.insert(number.begin(), '0');
    for (std::size_t found = path.find(before); found != std::string::npos;
         found = path.find(before, found + 1))
        path.replace(found, before.size(), "_v" + number);
}

// What the analysis of so many frames will take at the pace of the preview's, which is of another
// quality or has done a part of it already; 0: its pace is not known.
double analysis_left_s(const SessionView& v, std::size_t frames, bool same_quality) {
    const PreviewView& now = v.preview;
    if (!now.analysing || now.seconds_left <= 0 || now.done >= now.total) return 0;
    const double whole = same_quality ? 1 : static_cast<double>(now.total) / (now.total - now.done);
    const double share = static_cast<double>(frames) / static_cast<double>(v.plate.frames.size());
    return now.seconds_left * whole * std::min(1.0, share);
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
    in.analysed = analysed || frames.empty()
                      ? 0
                      : analysed_frames(v.project, frames.front(), frames.back(),
                                        {v.plate.frames.front(), v.plate.frames.back() + 1});
    in.analysis_s = analysis_left_s(v, in.analysed, v.preview_quality == quality);
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

void range_choice(Ctx& c) {
    ExportState& e = c.state.output;
    quiet(c, "Frames");
    segments(c, "Frames", {"Whole shot", "Marked range", "Every nth"}, e.range);
    if (e.range == 1 && !c.view.mark_in && !c.view.mark_out)
        banner(c, icons::kInformation, c.theme.warn,
               "Set in and out points with I and O on the timeline.");
    if (e.range != 2) return;
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

void file_choice(Ctx& c) {
    const Theme& t = c.theme;
    ExportState& e = c.state.output;
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
    checkbox(c, "Write review movie", e.with_movie,
             ("An .mp4 of the result for review: " + movie_of(e)).c_str());
    layer_choice(c);
    ImGui::Dummy({0, t.px(4)});
    quiet(c, "If files exist");
    segments(c, "Existing", {"Fail", "Skip", "Overwrite"}, e.existing);
}

// What keeps the project from being rendered; empty: nothing does.
std::string project_problem(const Ctx& c) {
    if (const auto& forms = c.view.form_problems; !forms.empty()) {
        const Region* region = region_by_id(c.view.project, forms.begin()->first);
        const std::string of = region ? "Form of " + region->name + ": " : std::string();
        return of + forms.begin()->second;
    }
    const auto problem =
        std::find_if(c.view.issues.begin(), c.view.issues.end(),
                     [](const Issue& issue) { return issue.severity == Severity::kError; });
    // The output is set here, so it may be missing in the document.
    const bool ready =
        problem == c.view.issues.end() || problem->where.find("output") != std::string::npos;
    return ready ? std::string() : in_words(c, *problem);
}

// Below the button, which would move from under the mouse as the first frames are written.
void render_notices(Ctx& c, const std::vector<int>& frames,
                    const std::optional<std::string>& output, const std::string& project) {
    if (output) {
        banner(c, icons::kAlert, c.theme.bad, *output);
        c.note("Output problem");
    } else {
        existing_frames_notice(c, frames);
    }
    if (!project.empty()) {
        banner(c, icons::kAlert, c.theme.bad, project);
        c.note(c.view.form_problems.empty() ? "Project problem" : "Form problem");
    } else if (c.view.plate.state == PlateView::State::kFailed) {
        banner(c, icons::kAlert, c.theme.bad, "Cannot open the plate. " + c.view.plate.error);
    }
}

SubmitJob job_of(const ExportState& e, const std::vector<int>& frames, double seconds) {
    SubmitJob job;
    job.frames = format_frame_list(frames);
    job.output = e.output;
    if (e.with_movie) job.movie = movie_of(e);
    job.overwrite = e.existing == 2;
    job.skip_existing = e.existing == 1;
    job.estimated_s = seconds;
    take_layers(e, job);
    return job;
}

}  // namespace

void render_card(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    const auto gap = [&](float px) { ImGui::Dummy({0, t.px(px)}); };
    begin_panel(c, "Export", size, t.panel, true, t.px(16));
    ImGui::PushFont(t.title);
    ImGui::TextUnformatted("Render");
    ImGui::PopFont();
    gap(4);
    fill_defaults(c);
    range_choice(c);
    gap(6);
    file_choice(c);
    gap(6);
    project_parameter(c, "settings.quality", "Quality");
    project_parameter(c, "output.depth", "Depth");
    gap(6);
    const std::vector<int> frames = frames_of(c);
    const std::optional<std::string> output_wrong =
        output_problem(c.state.output.output, frames.size());
    const std::string project_wrong = project_problem(c);
    const double seconds = estimate(c, frames);
    gap(4);
    const std::string label = "Render " + std::to_string(frames.size()) + " frames";
    if (button(c, (label + "##submit").c_str(),
               {.icon = icons::kRocket,
                .look = Look::kPrimary,
                .enabled = project_wrong.empty() && !output_wrong && !frames.empty(),
                .width = -1}))
        c.emit(job_of(c.state.output, frames, seconds));
    c.note("Render frames");
    gap(4);
    render_notices(c, frames, output_wrong, project_wrong);
    end_panel(c);
}

}  // namespace weft::ui
