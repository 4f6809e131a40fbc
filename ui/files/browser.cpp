// The file browser for shots, textures and output paths: a sequence is one entry with a thumbnail.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "ui/base/icons.h"
#include "ui/files/browser_paths.h"
#include "ui/files/files.h"
#include "ui/widgets/floating_window.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

using Purpose = BrowserState::Purpose;

const char* title_of(Purpose purpose) {
    switch (purpose) {
        case Purpose::kOpen:
            return "Open a shot or a project";
        case Purpose::kSaveProject:
            return "Save the project";
        case Purpose::kTexture:
            return "Choose a texture";
        case Purpose::kMatte:
            return "Choose the matte's files";
        case Purpose::kHoldout:
            return "Choose the holdout's files";
        case Purpose::kMotion:
            return "Choose the motion's files";
        case Purpose::kOutput:
            return "Choose where to write";
        case Purpose::kTextureFolder:
            return "Add a folder of textures";
        case Purpose::kPlate:
            return "Find the plate's frames";
        case Purpose::kTrack:
            return "Choose a planar track";
        case Purpose::kShapeTrack:
            return "Choose a track for the shape";
        case Purpose::kExportMattes:
            return "Choose where the mattes go";
        case Purpose::kSimilar:
            return "Choose a picture to find textures like it";
        case Purpose::kCollect:
            return "Choose where the collected project goes";
        case Purpose::kRelink:
            return "Choose the folder to search for missing files";
        case Purpose::kNone:
            break;
    }
    return "";
}

bool wants_folder(Purpose purpose) {
    return purpose == Purpose::kSaveProject || purpose == Purpose::kOutput ||
           purpose == Purpose::kTextureFolder || purpose == Purpose::kExportMattes ||
           purpose == Purpose::kCollect || purpose == Purpose::kRelink;
}

void add_holdout(Ctx& c, const std::string& files) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    std::vector<MatteSource> holdouts = *region->holdouts;
    holdouts.emplace_back();
    holdouts.back().files = files;
    c.edit(SetHoldouts{RegionRef{region->id, {}}, holdouts});
}

void accept(Ctx& c, const std::string& path) {
    BrowserState& b = c.state.browser;
    const RegionRef ref{c.view.selected, {}};
    switch (b.purpose) {
        case Purpose::kOpen:
            c.emit(OpenAny{path});
            break;
        case Purpose::kSaveProject:
            c.emit(SaveAs{path});
            break;
        case Purpose::kTexture:
            c.emit(ApplyTexture{path, 0});
            break;
        case Purpose::kMatte: {
            MatteSource matte;
            matte.files = path;
            c.edit(SetMatte{ref, matte});
            break;
        }
        case Purpose::kHoldout:
            add_holdout(c, path);
            break;
        case Purpose::kMotion:
            c.edit(SetRegionParameter{ref, "motion.files", path});
            break;
        case Purpose::kSimilar:
            c.state.drawer.similar_key = "file " + path;
            c.state.drawer.similar_file = path;
            c.textures.find_similar(c.state.drawer.similar_key, path);
            break;
        case Purpose::kPlate:
            c.edit(SetProjectParameter{"plate.path", path});
            break;
        case Purpose::kTrack:
            c.edit(SetRegionParameter{ref, "motion.track", path});
            break;
        case Purpose::kShapeTrack:
            c.emit(FollowShape{c.view.painted_source().shape.follow, path, false});
            break;
        case Purpose::kExportMattes:
            if (const Region* region = c.view.selected_region())
                c.emit(ExportMattes{joined(path, region->name + "_matte.####.png")});
            break;
        case Purpose::kOutput:
            c.state.output.output = output_in(path, c.state.output.output);
            break;
        case Purpose::kCollect:
            c.emit(CollectProject{path});
            break;
        case Purpose::kRelink:
            c.emit(RelinkFiles{path});
            break;
        case Purpose::kTextureFolder:
            c.state.adding.folder = path;
            c.state.adding.open = true;
            c.state.adding.asked = false;
            break;
        case Purpose::kNone:
            break;
    }
    b.purpose = Purpose::kNone;
}

void places(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::BeginChild("##places", size);
    std::set<std::string> listed;  // several projects may lie in one folder
    const auto place = [&](const char* name, const char* icon, const std::string& path) {
        if (path.empty() || !listed.insert(path).second) return;
        ImGui::PushID(path.c_str());
        const bool pressed = ImGui::InvisibleButton("##place", {-FLT_MIN, t.row});
        ImGui::PopID();
        c.note(name);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (c.state.browser.folder == path)
            list.AddRectFilled(min, max, faded(t.accent, 0.28f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        icon_in(c, list, {min.x + t.px(2), min.y}, {min.x + t.px(26), max.y}, t.quiet, icon);
        text_in(list, t.regular, {min.x + t.px(32), min.y}, max, t.text,
                fitted(name, max.x - min.x - t.px(36)).c_str(), 0);
        if (pressed) c.state.browser.folder = path;
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(2)});
    place("Home", icons::kHome, home());
    place("Computer", icons::kMonitor, "/");
    place("Temporary", icons::kClock, "/tmp");
    if (!c.view.path.empty()) place("This project", icons::kFolder, parent_of(c.view.path));
    for (const std::string& recent : c.settings.recent) {
        const std::string folder = parent_of(recent);
        const std::size_t slash = folder.find_last_of('/');
        place(folder.substr(slash + 1).c_str(), icons::kHistory, folder);
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

const char* icon_of(EntryKind kind) {
    switch (kind) {
        case EntryKind::kFolder:
            return icons::kFolder;
        case EntryKind::kSequence:
            return icons::kFilm;
        case EntryKind::kMovie:
            return icons::kMovie;
        case EntryKind::kPicture:
            return icons::kFileImage;
        case EntryKind::kProject:
            return icons::kLayers;
        case EntryKind::kOther:
            break;
    }
    return icons::kFile;
}

// Returns the double-clicked entry, or null.
const FolderEntry* entries(Ctx& c, const std::vector<FolderEntry>& all, ImVec2 size) {
    const Theme& t = c.theme;
    BrowserState& b = c.state.browser;
    const FolderEntry* chosen = nullptr;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, t.field);
    ImGui::BeginChild("##entries", size, true);
    ImGui::PopStyleColor();
    if (all.empty())
        empty_state(c, icons::kFolderOpen, "Nothing here",
                    "This folder has no images, movies or projects.");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGuiListClipper clipper;
    const float row_h = t.px(40);
    clipper.Begin(static_cast<int>(all.size()), row_h);
    while (clipper.Step()) {
        for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
            const FolderEntry& entry = all[static_cast<std::size_t>(k)];
            ImGui::PushID(k);
            const bool pressed = ImGui::InvisibleButton("##entry", {-FLT_MIN, row_h});
            ImGui::PopID();
            c.note(entry.name);
            const bool hovered = ImGui::IsItemHovered();
            const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
            ImDrawList& list = *ImGui::GetWindowDrawList();
            if (b.selected == k)
                list.AddRectFilled(min, max, faded(t.accent, 0.28f), t.radius);
            else if (hovered)
                list.AddRectFilled(min, max, t.hover, t.radius);
            const ImVec2 a(min.x + t.px(6), min.y + t.px(4)), z(min.x + t.px(62), max.y - t.px(4));
            const PicturePtr thumb =
                entry.preview.empty()
                    ? nullptr
                    : c.textures.thumbnail(entry.preview, static_cast<int>(t.px(64)));
            const ImTextureID id = thumb ? c.pictures.texture(thumb) : nullptr;
            if (id) {
                const float w = static_cast<float>(thumb->size.width),
                            h = static_cast<float>(thumb->size.height);
                const float scale = std::min((z.x - a.x) / w, (z.y - a.y) / h);
                const float x = std::floor((a.x + z.x - w * scale) / 2),
                            y = std::floor((a.y + z.y - h * scale) / 2);
                list.AddImage(id, {x, y}, {x + w * scale, y + h * scale});
            } else {
                icon_in(c, list, a, z, entry.kind == EntryKind::kFolder ? t.warn : t.quiet,
                        icon_of(entry.kind));
            }
            text_in(list, t.regular, {min.x + t.px(72), min.y}, {max.x - t.px(200), max.y}, t.text,
                    fitted(entry.name, max.x - min.x - t.px(290)).c_str(), 0);
            text_in(list, t.small, min, {max.x - t.px(12), max.y}, t.quiet, entry.detail.c_str(),
                    1);
            if (pressed) b.selected = k;
            if (hovered && ImGui::IsMouseDoubleClicked(0)) chosen = &entry;
        }
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    return chosen;
}

// The folder to list: while one types, the one before, since each key would read another one.
const std::string& listed_path(BrowserState& b) {
    constexpr double kRest_s = 0.3;
    const bool typing = ImGui::GetIO().WantTextInput && b.typed_at_s > 0 &&
                        ImGui::GetTime() - b.typed_at_s < kRest_s && !ImGui::IsKeyPressed(257);
    if (!typing || b.listed.empty()) b.listed = from_home(b.folder);
    return b.listed;
}

// Of what begins like the typed name, Enter takes the first.
bool selects_match(Ctx& c) {
    int& selected = c.state.browser.selected;
    if (c.folders.completes() && selected < 0) selected = 0;
    return c.folders.completes();
}

// Where it is: the folder's field takes any path. `focused`: what is typed at once goes there.
void folder_row(Ctx& c, bool focused) {
    const Theme& t = c.theme;
    BrowserState& b = c.state.browser;
    if (icon_button(c, icons::kArrowUp, "Up one folder", false, nullptr, true, t.row)) {
        b.folder = parent_of(b.folder);
        b.selected = -1;
    }
    ImGui::SameLine();
    if (icon_button(c, icons::kRefresh, "Reload folder", false, nullptr, true, t.row))
        c.folders.refresh();
    ImGui::SameLine();
    const std::string before = b.folder;
    if (focused) ImGui::SetKeyboardFocusHere();
    input(c, "Folder", b.folder, wants_folder(b.purpose) ? "Folder" : "Folder, or a file", -1);
    if (b.folder != before) {
        b.typed_at_s = ImGui::GetTime();
        b.selected = -1;
        b.open_typed = false;
    }
}

// The name to save under. Returns true as it is left: Enter there saves, and in the folder's field
// only goes to the folder.
bool name_field(Ctx& c, float width, bool opened) {
    // What is typed at once replaces the proposed name, as in every save dialog.
    if (opened) ImGui::SetKeyboardFocusHere();
    input(c, "Name", c.state.browser.name, "name.weft, or a path", width);
    return ImGui::IsItemDeactivated();
}

}  // namespace

void file_browser(Ctx& c) {
    BrowserState& b = c.state.browser;
    if (b.purpose == Purpose::kNone) return;
    const Theme& t = c.theme;
    if (b.folder.empty()) {
        b.folder = !c.view.path.empty()         ? parent_of(c.view.path)
                   : !c.settings.recent.empty() ? parent_of(c.settings.recent.front())
                                                : home();
    }
    const bool opened = std::exchange(b.just_opened, false);
    if (opened) {
        b.selected = -1;
        c.folders.refresh();
        if (b.purpose == Purpose::kSaveProject) {
            b.name = c.view.title + ".weft";
            b.folder = folder_to_save(c);
        }
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 size(std::min(t.px(880), screen.x - t.px(32)),
                      std::min(t.px(580), screen.y - t.px(32)));
    ImGui::SetNextWindowFocus();
    begin_floating(t, "##browser",
                   {std::floor((screen.x - size.x) / 2), std::floor((screen.y - size.y) / 2)}, size,
                   {t.px(16), t.px(14)});
    const PanelName panel(c, "Browser");
    ImGui::PushFont(t.title);
    ImGui::TextUnformatted(title_of(b.purpose));
    ImGui::PopFont();
    ImGui::SetCursorPos({t.px(16), t.px(48)});
    folder_row(c, opened && b.purpose != Purpose::kSaveProject);
    const bool among = b.purpose == Purpose::kSaveProject && saves_among_frames(c, b);
    const float body = size.y - t.px(48 + 34 + 56 + (among ? 36 : 0));
    ImGui::SetCursorPos({t.px(16), t.px(84)});
    places(c, {t.px(170), body});
    ImGui::SetCursorPos({t.px(198), t.px(84)});
    const std::vector<FolderEntry>* all = c.folders.entries(listed_path(b));
    // What is typed may be a file, which is then opened.
    const std::string& typed = c.folders.file();
    const FolderEntry* chosen = nullptr;
    const FolderEntry* selected = nullptr;
    const bool completes = all && selects_match(c);
    if (all) {
        chosen = entries(c, *all, {size.x - t.px(214), body});
        if (b.selected >= 0 && b.selected < static_cast<int>(all->size()))
            selected = &(*all)[static_cast<std::size_t>(b.selected)];
    } else {
        ImGui::BeginChild("##waiting", {size.x - t.px(214), body}, true);
        const std::string& error = c.folders.error();
        empty_state(c, error.empty() ? icons::kTimer : icons::kFolder,
                    error.empty() ? "Reading the folder…" : "Nothing to list", error.c_str());
        ImGui::EndChild();
    }
    if (among) {
        ImGui::SetCursorPos({t.px(16), size.y - t.px(84)});
        banner(c, icons::kAlert, t.warn,
               "This folder holds the plate's frames. Choose another one for the project.");
    }
    ImGui::SetCursorPos({t.px(16), size.y - t.px(42)});
    const bool folder = wants_folder(b.purpose);
    const bool named =
        b.purpose == Purpose::kSaveProject && name_field(c, size.x - t.px(260), opened);
    ImGui::SetCursorPos({size.x - t.px(226), size.y - t.px(42)});
    bool cancel = button(c, "Cancel", {.width = t.px(96)});
    ImGui::SameLine();
    const bool can = folder ? b.purpose != Purpose::kSaveProject || (!b.name.empty() && !among)
                            : selected != nullptr || !typed.empty();
    const char* verb = b.purpose == Purpose::kSaveProject ? "Save"
                       : folder                           ? "Use this folder"
                                                          : "Open";
    const bool go = button(c, verb, {.look = Look::kPrimary, .enabled = can, .width = t.px(106)});
    const bool enter = ImGui::IsKeyPressed(257) && can && (named || !ImGui::GetIO().WantTextInput);
    // It may still have to be looked up.
    b.open_typed = !folder && (b.open_typed || ImGui::IsKeyPressed(257)) &&
                   (!all || !typed.empty() || completes);
    cancel |= ImGui::IsKeyPressed(256);
    ImGui::End();
    const bool takes = !folder && (go || enter || (completes && b.open_typed));
    const FolderEntry* use = chosen ? chosen : takes ? selected : nullptr;
    if (use) b.open_typed = false;
    if (use && use->kind == EntryKind::kFolder) {
        b.folder = use->path;
        b.selected = -1;
    } else if (use && !folder) {
        accept(c, use->path);
    } else if (!folder && !selected && !typed.empty() && (go || b.open_typed)) {
        b.open_typed = false;
        accept(c, typed);
    } else if ((go || enter) && folder) {
        std::string path = b.folder;
        if (b.purpose == Purpose::kSaveProject) path = path_to_save(b);
        accept(c, path);
    }
    if (cancel) b.purpose = Purpose::kNone;
}

}  // namespace weft::ui
