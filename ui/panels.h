#pragma once
// The panels. Each draws itself into its place from the session's view and emits actions.

#include <array>
#include <optional>

#include "ui/ctx.h"

namespace weft::ui {

void top_bar(Ctx& c, ImVec2 size);
void status_bar(Ctx& c, ImVec2 size);
void tool_strip(Ctx& c, ImVec2 size);
void viewer(Ctx& c, ImVec2 size);
void timeline(Ctx& c, ImVec2 size);
/// Rows of keys, or curves, of the selected region.
void keys_panel(Ctx& c, ImVec2 size);
/// The keys of the keyboard that belong to it while it has the focus. Returns true if one was used.
bool keys_area_shortcut(Ctx& c);
void inspector(Ctx& c, ImVec2 size);
void texture_drawer(Ctx& c, ImVec2 size);
void review_panel(Ctx& c, ImVec2 size);
void strip_panel(Ctx& c, ImVec2 size);
void jobs_page(Ctx& c, ImVec2 size);
/// Calibrates the estimate with the times of finished jobs.
void learn_from_jobs(Ctx& c);
void welcome(Ctx& c, ImVec2 size);

// Parts of the inspector.
void region_list(Ctx& c);
/// The menu of the right mouse button on the last item, the region's row.
void region_menu(Ctx& c, const Region& region);
void begin_renaming(Ctx& c, const Region& region);
void mask_inspector(Ctx& c);
void texture_inspector(Ctx& c);
void motion_inspector(Ctx& c);
/// Makes this frame a reference frame of the selected region, beside those it has.
void add_reference_frame(Ctx& c);
void light_inspector(Ctx& c);
void review_inspector(Ctx& c);
/// The texture's colour, opacity and blend mode.
void grade_section(Ctx& c, const Region& region);
void keep_section(Ctx& c, const Region& region);
/// Suggested keyframes; `mattes_only`: those of the matte only.
void hints_section(Ctx& c, bool mattes_only);
void holdouts_section(Ctx& c, const Region& region);
void light_zones_section(Ctx& c, const Region& region);
void motion_zones_section(Ctx& c, const Region& region);
/// Size, hardness and opacity of the brush.
void brush_rows(Ctx& c);
void propagation_section(Ctx& c, const Region& region);
void shape_controls(Ctx& c);
void corrections_section(Ctx& c, const Region& region);
void lamps_controls(Ctx& c, const Region& region);
/// What shows the surface's form, and the tools to draw it.
void form_section(Ctx& c, const Region& region);
/// The (first) reference frame of a region; empty while it is not known.
[[nodiscard]] std::optional<int> reference_of(const Ctx& c, const Region& region);
void provenance_section(Ctx& c, const Region& region);
/// Placeholder when no region is selected.
void no_region(Ctx& c);

/// Corners around the selected region on this frame, for a corner pin; none without a matte.
[[nodiscard]] std::optional<std::array<Vec2, 4>> corners_around_region(Ctx& c);
/// Moves the texture by the arrow keys while the transform tool is in hand. Returns true if one was
/// pressed.
bool nudge_texture(Ctx& c);
/// The grid warp of the region, or the one that would be laid over its corner pin or matte; none
/// without either.
[[nodiscard]] std::optional<GridWarp> warp_shown(Ctx& c, const Region& region);
/// Moves the selected points of a grid warp by the arrow keys. Returns true if one was pressed.
bool nudge_warp(Ctx& c);
/// The grid warp: its size, fall-off and keys.
void warp_section(Ctx& c, const Region& region);

// Floating windows.
void notices(Ctx& c);
void command_palette(Ctx& c);
void shortcut_sheet(Ctx& c);
void settings_window(Ctx& c);
/// The window for adding a folder of textures: import it, or browse it only.
void adding_window(Ctx& c);
void shot_window(Ctx& c);
void history_window(Ctx& c);
void about_window(Ctx& c);
void file_browser(Ctx& c);
void leave_question(Ctx& c);
void save_question(Ctx& c);
void tour(Ctx& c);

/// The inspector's section for temporal parameters.
void time_section(Ctx& c, const Region& region);
/// The control of one parameter of a region, from its table entry.
void region_parameter(Ctx& c, const Region& region, std::string_view key,
                      const char* label = nullptr);
/// The control of an animatable parameter; `keys` is the key of its keyframes.
void keyed_parameter(Ctx& c, const Region& region, std::string_view key, std::string_view keys,
                     const char* label = nullptr);
/// A parameter of the matte that is edited, the region's own, a holdout or a zone; with its keys
/// unless `keys` is empty.
void matte_parameter(Ctx& c, const Region& region, std::string_view key,
                     std::string_view keys = {});
/// A colour space control: built-in spaces or those of the OpenColorIO config. `usual`: the meaning
/// of an empty value.
void space_parameter(Ctx& c, std::string_view key, const char* label, const char* usual);
void project_parameter(Ctx& c, std::string_view key, const char* label = nullptr);
/// The label of a parameter by its full key, such as "Scale"; empty if it has none.
[[nodiscard]] std::string_view parameter_label(std::string_view key);
/// The same, or the readable key of a parameter without a label: "placement.corners_px" →
/// "Corners".
[[nodiscard]] std::string readable_label(std::string_view key);
/// The label of a choice: "Locked to the surface" for "locked"; without a label, its name.
[[nodiscard]] std::string choice_label(std::string_view key, std::string_view name);

}  // namespace weft::ui
