// The dialog for saving over a file that another program has changed.
#include <algorithm>

#include "ui/files/files.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/sheet.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

std::string setting_of(const MergeConflict& conflict) {
    if (conflict.key.empty())
        return conflict.region.empty() ? "All settings of the project"
                                       : "All settings of " + conflict.region;
    std::string text =
        conflict.key == "regions" ? "Order of the layers" : readable_label(conflict.key);
    if (!conflict.region.empty()) text = conflict.region + ": " + text;
    if (conflict.frame) text += ", frame " + std::to_string(*conflict.frame);
    return text;
}

void row(Ctx& c, ImFont* font, ImU32 color, const std::string& setting, const std::string& mine,
         const std::string& theirs) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, gap = t.px(10);
    const float first = std::floor(width * 0.4f), other = std::floor(width * 0.3f);
    ImGui::InvisibleButton("##row", {width, t.row});
    c.note(setting);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\nMine: %s\nThe file's: %s", setting.c_str(), mine.c_str(),
                          theirs.c_str());
    float x = at.x;
    ImGui::PushFont(font);
    for (const auto& [text, share] :
         {std::pair(&setting, first), std::pair(&mine, other), std::pair(&theirs, other)}) {
        text_in(*ImGui::GetWindowDrawList(), font, {x, at.y}, {x + share, at.y + t.row}, color,
                fitted(*text, share - gap).c_str(), 0);
        x += share;
    }
    ImGui::PopFont();
}

void conflict_table(Ctx& c, const std::vector<MergeConflict>& conflicts, float height) {
    const Theme& t = c.theme;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, t.field);
    ImGui::BeginChild("##conflicts", {0, height}, true);
    ImGui::PopStyleColor();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    row(c, t.small, t.quiet, "Setting", "Mine", "The file's");
    for (std::size_t k = 0; k < conflicts.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        row(c, t.regular, t.text, setting_of(conflicts[k]), conflicts[k].mine, conflicts[k].theirs);
        ImGui::PopID();
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

}  // namespace

void save_question(Ctx& c) {
    // "Save as a copy…" asks for the name in front of it.
    if (!c.view.save_question || c.state.browser.purpose != BrowserState::Purpose::kNone) return;
    const SaveQuestion& question = *c.view.save_question;
    const Theme& t = c.theme;
    const float rows =
        t.row * (1 + static_cast<float>(std::min<std::size_t>(question.conflicts.size(), 9)));
    const float table = rows + t.px(20);
    bool open = true;
    begin_sheet(c, "The file was changed by another program", {t.px(680), table + t.px(190)}, open);
    wrapped(c,
            question.path.substr(question.path.find_last_of('/') + 1) +
                " was saved by another program since it was opened here. These settings were "
                "changed in both; everything else is merged. What is replaced is kept beside the "
                "project.",
            t.text);
    ImGui::Dummy({0, t.px(8)});
    conflict_table(c, question.conflicts, table);
    ImGui::Dummy({0, t.px(8)});
    if (button(c, "Keep mine", {.look = Look::kPrimary})) c.emit(AnswerSave{MergeSide::kMine});
    ImGui::SameLine();
    if (button(c, "Take the file's")) c.emit(AnswerSave{MergeSide::kTheirs});
    ImGui::SameLine();
    if (button(c, "Save as a copy…")) c.commands.run("file.save_as", c);
    ImGui::SameLine();
    if (button(c, "Cancel") || !open) c.emit(AnswerSave{});
    end_sheet(c);
}

}  // namespace weft::ui
