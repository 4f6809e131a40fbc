#pragma once
// Internal to the keys area: its rows, its selection, and the edits that a drag makes.

#include <optional>
#include <string>
#include <vector>

#include "app/project/key_rows.h"
#include "ui/timeline/frame_scale.h"

namespace weft::ui {

inline constexpr float kKeyRadius = 5;  ///< Of a key that is drawn, unscaled px.

/// "Matte", "Light strength", "Zone 2 value".
[[nodiscard]] std::string row_name(const KeyRowId& row);
/// A curve: one of the numbers of a row.
struct KeyCurve {
    KeyRowId row;
    std::size_t which = 0;
    ImU32 color = 0;
    std::string name;
};
/// The curves of the region's rows, in their order.
[[nodiscard]] std::vector<KeyCurve> key_curves(const Region& region,
                                               const std::vector<KeyRow>& rows);
[[nodiscard]] bool is_curve_shown(const Ctx& c, const KeyRowId& row);

/// A key by the way that follows: a diamond, a circle (smooth) or a square (hold).
void key_glyph(ImDrawList& list, ImVec2 at, float radius, KeyInterpolation after, ImU32 color,
               ImU32 edge);

/// By how many frames the keys may be moved towards `by`: within the plate, and mattes, shapes,
/// references and corrections only to frames that it has.
[[nodiscard]] int allowed_move(const Ctx& c, const KeySet& keys, int by);

/// Shows what a drag makes of the region, one step of the history when it is kept.
void try_region(Ctx& c, const Region& before, const Region& after);
void keep_region(Ctx& c, const Region& before, const Region& after, const std::string& label);

/// A press on a key: selects, with Shift adds or removes. Begins a drag.
void press_key(Ctx& c, const Region& region, const KeyRef& key, std::size_t which);
/// What the drag of keys makes of the region as it was.
[[nodiscard]] Region dragged_region(const Ctx& c);
/// The button was let go: keeps the drag, and a press without a drag selects.
void end_key_drag(Ctx& c);
/// A press beside the keys: begins a box; a selection without Shift is left.
void press_beside(Ctx& c);
/// Ends the box with the keys that lie in it.
void end_box(Ctx& c, const KeySet& inside);
/// The box so far, drawn.
struct ScreenBox {
    ImVec2 min, max;
    [[nodiscard]] bool holds(ImVec2 p) const {
        return p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y;
    }
};
[[nodiscard]] ScreenBox drag_box(const Ctx& c);
void draw_box(Ctx& c, ImDrawList& list);

/// The menu of the right button, on a key or beside them.
void open_key_menu(Ctx& c, const std::optional<KeyRef>& key);
void key_menu(Ctx& c, const Region& region);
void set_interpolation(Ctx& c, const Region& region, KeyInterpolation after);
void copy_keys(Ctx& c, const Region& region);
void paste_keys(Ctx& c, const Region& region);
void delete_keys(Ctx& c, const Region& region);

/// The two views. `field`: the place beside the names.
void key_sheet(Ctx& c, const Region& region, const std::vector<KeyRow>& rows, ImVec2 min,
               ImVec2 max);
void key_curve_view(Ctx& c, const Region& region, const std::vector<KeyRow>& rows, ImVec2 min,
                    ImVec2 max);
/// Shows all keys: the whole shot, and in the curves all values.
void fit_keys(Ctx& c);

}  // namespace weft::ui
