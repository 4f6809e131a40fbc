#pragma once
// The whole interface: one full-window root, its parts divided by bars that can be moved.

#include <functional>
#include <string>
#include <vector>

#include "app/base/frame_clock.h"
#include "ui/ctx.h"

namespace weft {

/// Draws into the current ImGui context. Knows no window and no files; one thread.
class Shell {
  public:
    Shell(EditorSettings& settings, PictureHost& pictures);

    /// Draws a frame between ImGui::NewFrame() and Render() and returns what the artist asked for.
    std::vector<Action> draw(const SessionView& view);
    /// Sets the theme for a scale and loads its fonts; before NewFrame().
    void set_look(bool dark, bool grey_surround, float scale);
    [[nodiscard]] const Theme& theme() const { return theme_; }
    [[nodiscard]] UiState& state() { return state_; }
    [[nodiscard]] Commands& commands() { return commands_; }
    [[nodiscard]] TextureShelf& textures() { return textures_; }
    /// Where everything was drawn in the last frame; only when record_items(true) was called.
    [[nodiscard]] const std::vector<DrawnItem>& items() const { return items_; }
    void record_items(bool on) { recording_ = on; }
    /// Where draw() notes what it spends its time on; null: nowhere.
    void set_clock(FrameClock* clock) { clock_ = clock; }
    /// Something asked for by the window: files that were dropped on it, its close button.
    void open_dropped(const std::string& path, const SessionView& view);
    void ask_to_leave();
    /// Whether something moves by itself here (thumbnails that are awaited).
    [[nodiscard]] bool waiting() const { return folders_.busy() || state_.drawer.large_pending; }

    std::function<std::string(int)> job_log;
    std::function<void(int)> dismiss_notice;
    std::function<void(const std::vector<Action>&)> act_now;  ///< As Ctx::act_now.

  private:
    void part(const char* name) {
        if (clock_) clock_->enter(name);
    }
    void layout(Ctx& c);
    /// A bar that divides; returns the new size of the part that it belongs to.
    void splitter(Ctx& c, const char* name, ImVec2 min, ImVec2 size, bool vertical, float& value,
                  float sign, float least, float most, float standard);

    EditorSettings& settings_;
    PictureHost& pictures_;
    Theme theme_;
    UiState state_;
    Commands commands_;
    TextureShelf textures_;
    FolderLister folders_;
    std::vector<Action> actions_, dropped_;
    std::vector<DrawnItem> items_;
    bool recording_ = false;
    FrameClock* clock_ = nullptr;
};

}  // namespace weft
