#pragma once
// The parts of the window. Each draws itself into the place it is given, from the session's view,
// and emits actions.

#include "ui/ctx.h"

namespace weft::ui {

void top_bar(Ctx& c, ImVec2 size);
void status_bar(Ctx& c, ImVec2 size);
void tool_strip(Ctx& c, ImVec2 size);
void viewer(Ctx& c, ImVec2 size);
void timeline(Ctx& c, ImVec2 size);
void inspector(Ctx& c, ImVec2 size);
void texture_drawer(Ctx& c, ImVec2 size);
void review_panel(Ctx& c, ImVec2 size);
void strip_panel(Ctx& c, ImVec2 size);
void jobs_page(Ctx& c, ImVec2 size);
/// Takes what finished jobs tell of this machine's speed into the settings.
void learn_from_jobs(Ctx& c);
void welcome(Ctx& c, ImVec2 size);

// Parts of the inspector.
void region_list(Ctx& c);
void mask_inspector(Ctx& c);
void texture_inspector(Ctx& c);
void motion_inspector(Ctx& c);
void light_inspector(Ctx& c);
void review_inspector(Ctx& c);
void keep_section(Ctx& c, const Region& region);
/// The frames on which a correction would help most; `mattes_only`: of the matte alone.
void hints_section(Ctx& c, bool mattes_only);
void holdouts_section(Ctx& c, const Region& region);
void zones_section(Ctx& c, const Region& region);
void propagation_section(Ctx& c, const Region& region);
void shape_controls(Ctx& c);
void corrections_section(Ctx& c, const Region& region);
void lamps_controls(Ctx& c, const Region& region);
void provenance_section(Ctx& c, const Region& region);
/// What stands where a region is wanted and none is selected.
void no_region(Ctx& c);

// What floats over the rest.
void notices(Ctx& c);
void command_palette(Ctx& c);
void shortcut_sheet(Ctx& c);
void settings_window(Ctx& c);
/// How a folder of textures is added: into the library, or only shown.
void adding_window(Ctx& c);
void shot_window(Ctx& c);
void history_window(Ctx& c);
void about_window(Ctx& c);
void file_browser(Ctx& c);
void leave_question(Ctx& c);
void tour(Ctx& c);

/// The inspector's section of how the texture goes through time.
void time_section(Ctx& c, const Region& region);
/// Sliders, choices and texts of one parameter of a region, from its entry in the table.
void region_parameter(Ctx& c, const Region& region, std::string_view key,
                      const char* label = nullptr);
/// The same for one that may change over time: `keys` is the key of its text of keys.
void keyed_parameter(Ctx& c, const Region& region, std::string_view key, std::string_view keys,
                     const char* label = nullptr);
/// A colour space: built in, or one of the OpenColorIO config's. `usual`: what an empty one means.
void space_parameter(Ctx& c, std::string_view key, const char* label, const char* usual);
void project_parameter(Ctx& c, std::string_view key, const char* label = nullptr);
/// The label of a parameter's slider by its full key: "Scale"; empty where it has none.
[[nodiscard]] std::string_view parameter_label(std::string_view key);
/// A choice in an artist's words: "Locked to the surface" for "locked"; else the name itself.
[[nodiscard]] std::string choice_label(std::string_view key, std::string_view name);

}  // namespace weft::ui
