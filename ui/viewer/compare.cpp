#include "ui/viewer/compare.h"

#include <algorithm>

#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

using With = CompareState::With;

// "folder/render_v001/####.png" → "render_v001".
std::string version_name(const std::string& pattern) {
    const std::size_t end = pattern.find_last_of('/');
    if (end == std::string::npos) return pattern;
    const std::size_t begin = pattern.find_last_of('/', end - 1);
    return pattern.substr(begin + 1, end - begin - 1);
}

// The file of a frame: the last run of # is its number.
std::string frame_file(const std::string& pattern, int frame) {
    const std::size_t last = pattern.find_last_of('#');
    if (last == std::string::npos) return pattern;
    std::size_t first = last;
    while (first > 0 && pattern[first - 1] == '#')
        --first;
    std::string number = std::to_string(frame < 0 ? -frame : frame);
    const std::size_t digits = last - first + 1;
    if (number.size() < digits) number.insert(0, digits - number.size(), '0');
    if (frame < 0) number.insert(0, "-");
    return pattern.substr(0, first) + number + pattern.substr(last + 1);
}

// The finished renders of this shot, the newest first, each output once.
std::vector<std::string> versions(const Ctx& c) {
    std::vector<std::string> out;
    for (auto job = c.view.jobs.rbegin(); job != c.view.jobs.rend(); ++job)
        if (job->state == JobState::kDone && job->plate == c.view.plate.path &&
            std::find(out.begin(), out.end(), job->output) == out.end())
            out.push_back(job->output);
    return out;
}

}  // namespace

PicturePtr compared_picture(Ctx& c) {
    const CompareState& with = c.state.compare_with;
    switch (with.with) {
        case With::kPlate:
            break;
        case With::kVersion: {
            const Size size = c.view.plate.size;
            return c.textures.thumbnail(frame_file(with.pattern, c.view.frame),
                                        std::max(size.width, size.height));
        }
        case With::kStored:
            return with.frame == c.view.frame ? with.stored : nullptr;
    }
    return c.view.plate_picture;
}

std::string compared_name(const Ctx& c) {
    const CompareState& with = c.state.compare_with;
    switch (with.with) {
        case With::kPlate:
            break;
        case With::kVersion:
            return version_name(with.pattern);
        case With::kStored:
            return "Stored, frame " + std::to_string(with.frame);
    }
    return "Plate";
}

void store_result(Ctx& c) {
    if (!c.view.result_picture) return;
    c.state.compare_with = {With::kStored, {}, c.view.result_picture, c.view.frame};
}

void compare_choice(Ctx& c, float width) {
    const Theme& t = c.theme;
    CompareState& with = c.state.compare_with;
    ImGui::InvisibleButton("##Compare with", {width, t.px(26)});
    c.note("Compare with");
    ImGui::PushFont(t.small);
    const std::string text = fitted("vs " + compared_name(c), width - t.px(6));
    ImGui::PopFont();
    text_in(*ImGui::GetWindowDrawList(), t.small, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
            with.with == With::kPlate ? t.quiet : t.text, text.c_str());
    tooltip(c, "What wipe, difference, side by side and T compare the result with");
    if (ImGui::IsItemClicked()) ImGui::OpenPopup("##compare");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(8), t.px(6)});
    if (ImGui::BeginPopup("##compare")) {
        const PanelName within(c, "Compare with");
        if (ImGui::MenuItem("Plate", nullptr, with.with == With::kPlate)) with.with = With::kPlate;
        c.note("Plate");
        for (const std::string& pattern : versions(c)) {
            const bool on = with.with == With::kVersion && with.pattern == pattern;
            if (ImGui::MenuItem(version_name(pattern).c_str(), nullptr, on)) {
                with.with = With::kVersion;
                with.pattern = pattern;
            }
            c.note(version_name(pattern));
        }
        if (with.stored) {
            const std::string name = "Stored, frame " + std::to_string(with.frame);
            if (ImGui::MenuItem(name.c_str(), nullptr, with.with == With::kStored))
                with.with = With::kStored;
            c.note("Stored");
        }
        ImGui::Separator();
        const std::string key = c.commands.key_of("view.store");
        if (ImGui::MenuItem("Store this result", key.c_str(), false,
                            c.view.result_picture != nullptr))
            store_result(c);
        c.note("Store this result");
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
}

}  // namespace weft::ui
