#pragma once
// The whole interface: one full-window root, divided by movable splitters.

#include <functional>
#include <string>
#include <vector>

#include "app/base/frame_clock.h"
#include "ui/base/ctx.h"

namespace weft {

/// Draws into the current ImGui context; independent of windows and files. Belongs to one thread.
class Shell {
  public:
    Shell(EditorSettings& settings, PictureHost& pictures);

    /// Draws a frame between ImGui::NewFrame() and Render(), and returns the user's actions.
    std::vector<Action> draw(const SessionView& view);
    /// Sets the theme and scale and loads the fonts; call it before NewFrame().
    void set_look(bool dark, bool grey_surround, float scale);
    [[nodiscard]] const Theme& theme() const { return theme_; }
    [[nodiscard]] UiState& state() { return state_; }
    [[nodiscard]] Commands& commands() { return commands_; }
    [[nodiscard]] TextureShelf& textures() { return textures_; }
    /// Places of the widgets in the last frame; only after record_items(true).
    [[nodiscard]] const std::vector<DrawnItem>& items() const { return items_; }
    void record_items(bool on) { recording_ = on; }
    /// Clock that records the time of draw(); null: none.
    void set_clock(FrameClock* clock) { clock_ = clock; }
    /// Events of the window: dropped files, the close button.
    void open_dropped(const std::string& path, const SessionView& view);
    void ask_to_leave();
    /// Returns true while something changes without input (thumbnails being loaded).
    [[nodiscard]] bool waiting() const { return folders_.busy(); }

    std::function<std::string(int)> job_log;
    std::function<void(int)> dismiss_notice;
    std::function<void(NoticeKind, std::string)> notify;
    std::function<void(const std::vector<Action>&)> act_now;  ///< Passed on as Ctx::act_now.

  private:
    void part(const char* name) {
        if (clock_) clock_->enter(name);
    }
    void layout(Ctx& c);
    /// A splitter; returns the new size of its panel.
    void splitter(Ctx& c, const char* name, ImVec2 min, ImVec2 size, bool vertical, float& value,
                  float sign, float least, float most, float standard);

    EditorSettings& settings_;
    PictureHost& pictures_;
    Theme theme_;
    UiState state_;
    Commands commands_;
    TextureShelf textures_;
    FolderLister folders_;
    FramesOnDisk written_;
    std::vector<Action> actions_, dropped_;
    std::vector<DrawnItem> items_;
    bool recording_ = false;
    FrameClock* clock_ = nullptr;
};

}  // namespace weft
