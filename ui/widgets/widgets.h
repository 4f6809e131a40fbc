#pragma once
// The controls of the panels. Each records its place by its label for scripts and tests.

#include <cfloat>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/base/ctx.h"

namespace weft::ui {

enum class Look : std::uint8_t { kNormal, kPrimary, kQuiet, kDanger };

struct ButtonOptions {
    const char* icon = nullptr;
    Look look = Look::kNormal;
    bool enabled = true;
    const char* tip = nullptr;
    const char* command = nullptr;  ///< The tooltip shows its shortcut.
    float width = 0;                ///< 0: width of the text; −1: rest of the row.
};
bool button(Ctx& c, const char* label, const ButtonOptions& options = {});
/// A square icon button; `name` is its label and tooltip.
bool icon_button(Ctx& c, const char* icon, const char* name, bool active = false,
                 const char* command = nullptr, bool enabled = true, float side = 0);
/// A segmented control. Returns true if `value` changed.
bool segments(Ctx& c, const char* name, const std::vector<const char*>& labels, int& value,
              float width = 0);
bool checkbox(Ctx& c, const char* label, bool& value, const char* tip = nullptr);

enum class Change : std::uint8_t { kNone, kTrying, kDone };

struct SliderSpec {
    const char* label = "";
    const char* unit = "";
    const char* tip = "";
    double min = 0, max = 1, standard = 0;
    int decimals = 2;
    bool logarithmic = false;
    bool integer = false;
    bool enabled = true;
    /// Range of typed values; empty (min > max): as the slider.
    double typed_min = 1, typed_max = 0;
};
/// A slider row with a label and a reset dot; double-click to type.
Change slider(Ctx& c, const SliderSpec& spec, double& value);
/// A choice row. Returns true if it changed.
bool choice(Ctx& c, const char* label, const std::vector<std::string>& names, int& value,
            const char* tip = nullptr, int standard = -1);
/// A text row; kDone when editing is finished.
Change text_row(Ctx& c, const char* label, std::string& value, const char* hint,
                const char* tip = nullptr);
/// A text field of the given width. `hint` is shown while it is empty.
bool input(Ctx& c, const char* name, std::string& value, const char* hint, float width,
           const char* icon = nullptr);
/// A row with read-only text.
void info_row(Ctx& c, const char* label, const std::string& value, const char* tip = nullptr);

/// A collapsible heading; open at first unless stated otherwise.
bool section(Ctx& c, const char* title, bool open_at_first = true);
void section_gap(Ctx& c);
void heading(Ctx& c, const char* text);
void quiet(Ctx& c, const char* text);  ///< One line, shortened with … if it does not fit.
void wrapped(Ctx& c, const std::string& text, ImU32 color);
/// The same in the room of at least so many lines, for a text that comes and goes: what is below
/// stays where it is.
void wrapped_in(Ctx& c, const std::string& text, ImU32 color, int lines);
/// Placeholder of an empty panel: an icon, what is missing, what to do.
void empty_state(Ctx& c, const char* icon, const char* title, const char* what_to_do);
/// The same while no region is selected.
void no_region(Ctx& c);
/// A coloured line with an icon, for a state that needs attention.
void banner(Ctx& c, const char* icon, ImU32 color, const std::string& text);
void progress_bar(Ctx& c, float fraction, const std::string& label, float width = -1,
                  float height = 0);
bool chip(Ctx& c, const char* label, bool active);
void tooltip(Ctx& c, const char* text, const char* command = nullptr);

/// Shortens `text` to `width` with … at its end, or in its middle (paths).
[[nodiscard]] std::string fitted(const std::string& text, float width, bool middle = false);
void text_in(ImDrawList& list, ImFont* font, ImVec2 min, ImVec2 max, ImU32 color, const char* text,
             float align_x = 0.5f);
/// Draws an icon centred in a rectangle.
void icon_in(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max, ImU32 color, const char* icon);
/// "1:02" or "3 h 12 min".
[[nodiscard]] std::string time_text(double seconds);
/// "33%": steps of work are not frames, so their number tells nobody anything. `total` above 0.
[[nodiscard]] std::string percent_text(int done, int total);
[[nodiscard]] std::string bytes_text(double bytes);
/// A label without its "##" suffix, which only distinguishes widgets.
[[nodiscard]] std::string visible(const char* label);
[[nodiscard]] std::string number_text(double value, int decimals);

/// A child window with a background. Call end_panel() afterwards. The name prefixes its items.
bool begin_panel(Ctx& c, const char* name, ImVec2 size, ImU32 surface, bool scrolls = true,
                 float padding = -1);
void end_panel(Ctx& c);

/// Restores the context's panel name at the end of a scope.
class PanelName {
  public:
    PanelName(Ctx& c, std::string name) : c_(c), before_(c.panel) { c.panel = std::move(name); }
    ~PanelName() { c_.panel = before_; }
    PanelName(const PanelName&) = delete;
    PanelName& operator=(const PanelName&) = delete;

  private:
    Ctx& c_;
    std::string before_;
};

}  // namespace weft::ui
