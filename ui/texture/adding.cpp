// The user's own textures: import a folder into the library, or browse it only.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/texture/texture.h"
#include "ui/widgets/sheet.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void show_folder(Ctx& c, const std::string& folder) {
    auto& shown = c.settings.texture_folders;
    if (std::find(shown.begin(), shown.end(), folder) == shown.end()) shown.push_back(folder);
}

// Options and credits of the import.
void library_choices(Ctx& c) {
    AddingState& a = c.state.adding;
    wrapped(c,
            "Samples of 96 × 96 pixels are cut out of each picture. They are found by words, "
            "suggested for regions, and every report names their author and licence.",
            c.theme.quiet);
    ImGui::Dummy({0, c.theme.px(4)});
    text_row(c, "Author", a.author, "who made them");
    text_row(c, "Licence", a.licence, "CC0-1.0, CC-BY-4.0, own work …");
    checkbox(c, "Copy pictures into the library", a.keep_originals,
             "Large previews then work without the original folder");
}

void progress(Ctx& c, const TextureImportState& now) {
    if (now.running) {
        progress_bar(
            c, now.total > 0 ? static_cast<float>(now.done) / static_cast<float>(now.total) : 0.0f,
            now.total > 0
                ? std::to_string(now.done) + " of " + std::to_string(now.total) + " pictures"
                : std::string("Scanning the folder"));
    } else if (now.failed) {
        banner(c, icons::kAlert, c.theme.bad, now.outcome);
    } else {
        wrapped(c, now.outcome.c_str(), c.theme.text);
    }
}

}  // namespace

void adding_window(Ctx& c) {
    AddingState& a = c.state.adding;
    if (!a.open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "Add textures", {t.px(460), t.px(376)}, a.open);
    info_row(c, "Folder", a.folder);
    ImGui::Dummy({0, t.px(6)});
    if (a.asked) {
        const TextureImportState now = c.textures.importing();
        progress(c, now);
        ImGui::Dummy({0, t.px(8)});
        if (button(c, now.running ? "Continue in background" : "Close", {.look = Look::kPrimary}))
            a.open = false;
        end_sheet(c);
        return;
    }
    segments(c, "How", {"Import into library", "Browse folder only"}, a.how);
    ImGui::Dummy({0, t.px(6)});
    if (a.how == 0)
        library_choices(c);
    else
        wrapped(c, "The pictures are used in place, without importing.", t.quiet);
    ImGui::Dummy({0, t.px(8)});
    if (button(c, "Add", {.icon = icons::kPlus, .look = Look::kPrimary})) {
        if (a.how == 0) {
            c.textures.import_folder({a.folder, a.author, a.licence, a.keep_originals});
            a.asked = true;
        } else {
            show_folder(c, a.folder);
            a.open = false;
        }
    }
    end_sheet(c);
}

}  // namespace weft::ui
