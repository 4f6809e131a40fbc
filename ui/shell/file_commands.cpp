// The commands of files.
#include "ui/base/ctx.h"
#include "ui/base/icons.h"
#include "ui/files/files.h"
#include "ui/shell/command_parts.h"

namespace weft {
namespace {

void browse(Ctx& c, BrowserState::Purpose purpose) {
    const std::string folder = c.state.browser.folder;
    c.state.browser = {};
    c.state.browser.folder = folder;
    c.state.browser.purpose = purpose;
    c.state.browser.just_opened = true;
}

}  // namespace

Command command(const char* id, const char* category, const char* name, const char* icon,
                const char* key, std::function<void(Ctx&)> run,
                std::function<bool(const Ctx&)> enabled, std::function<bool(const Ctx&)> checked) {
    Command out;
    out.id = id;
    out.category = category;
    out.name = name;
    out.icon = icon;
    out.default_key = key;
    out.run = std::move(run);
    out.enabled = std::move(enabled);
    out.checked = std::move(checked);
    return out;
}

void add_file_commands(std::vector<Command>& out) {
    out.push_back(command("file.new", "File", "New project", icons::kFile, "Ctrl+N", [](Ctx& c) {
        ui::leave_for(c, {LeaveFor::Kind::kNew, {}});
    }));
    out.push_back(command("file.open", "File", "Open…", icons::kFolderOpen, "Ctrl+O", [](Ctx& c) {
        ui::leave_for(c, {LeaveFor::Kind::kBrowse, {}});
    }));
    out.push_back(command("file.demo", "File", "Open demo shot", icons::kFilm, "", [](Ctx& c) {
        ui::leave_for(c, {LeaveFor::Kind::kDemo, {}});
    }));
    out.push_back(command(
        "file.save", "File", "Save", icons::kSave, "Ctrl+S",
        [](Ctx& c) {
            if (c.view.path.empty())
                browse(c, BrowserState::Purpose::kSaveProject);
            else
                c.emit(Save{});
        },
        is_open));
    out.push_back(command(
        "file.save_as", "File", "Save as…", icons::kSave, "Ctrl+Shift+S",
        [](Ctx& c) { browse(c, BrowserState::Purpose::kSaveProject); }, is_open));
    out.push_back(command(
        "file.save_version", "File", "Save new version", icons::kSave, "Ctrl+Alt+S",
        [](Ctx& c) {
            if (c.view.path.empty())
                browse(c, BrowserState::Purpose::kSaveProject);
            else
                c.emit(SaveVersion{});
        },
        is_open));
    out.push_back(command(
        "file.collect", "File", "Collect files…", icons::kExport, "",
        [](Ctx& c) { browse(c, BrowserState::Purpose::kCollect); }, is_open));
    out.push_back(command(
        "file.relink", "File", "Relink missing files…", icons::kLink, "",
        [](Ctx& c) { browse(c, BrowserState::Purpose::kRelink); },
        [](const Ctx& c) { return c.view.open && !c.view.missing.empty(); }));
    out.push_back(command(
        "file.textures", "File", "Add textures…", icons::kTexture, "",
        [](Ctx& c) { browse(c, BrowserState::Purpose::kTextureFolder); }, is_open));
    out.push_back(command(
        "file.close", "File", "Close project", icons::kClose, "Ctrl+W",
        [](Ctx& c) {
            ui::leave_for(c, {LeaveFor::Kind::kClose, {}});
        },
        is_open));
    out.push_back(command("file.quit", "File", "Quit", "", "Ctrl+Q", [](Ctx& c) {
        ui::leave_for(c, {LeaveFor::Kind::kQuit, {}});
    }));
}

}  // namespace weft
