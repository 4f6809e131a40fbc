#pragma once
// The session with its user interface, driven frame by frame by a window or a script.

#include <memory>
#include <string>

#include "app/editor/editor.h"
#include "app/editor/gl_pictures.h"
#include "app/session/session.h"
#include "ui/shell/shell.h"

namespace weft {

/// Processor time of the interface per frame, without OpenGL drawing.
struct FrameTimes {
    double last_ms = 0, worst_ms = 0, sum_ms = 0;  ///< Wall-clock time.
    double cpu_worst_ms = 0, cpu_sum_ms = 0;       ///< CPU time of this thread.
    int frames = 0;
};

/// Needs a current OpenGL and a current ImGui context. Belongs to one thread.
class EditorApp {
  public:
    explicit EditorApp(const EditorOptions& options);
    ~EditorApp();

    /// Errors: shaders that do not compile.
    [[nodiscard]] Status start();
    /// Draws the interface. Call it between NewFrame() of the backends and rendering.
    void frame(double now_s);
    /// Reloads the fonts if the scale has changed; returns true if it did.
    bool update_look(double monitor_scale);

    [[nodiscard]] Session& session() { return *session_; }
    [[nodiscard]] Shell& shell() { return *shell_; }
    [[nodiscard]] GlPictures& pictures() { return pictures_; }
    [[nodiscard]] const EditorSettings& settings() const { return settings_; }
    /// Returns true while the next frames are to show something that is in progress.
    [[nodiscard]] bool waits() const;
    /// As Session's.
    [[nodiscard]] bool works_long() const;
    /// Neither of them.
    [[nodiscard]] bool idle() const;
    [[nodiscard]] std::uint64_t changes() const;
    [[nodiscard]] bool wants_to_leave() { return shell_->state().leave; }
    [[nodiscard]] const FrameTimes& times() const { return times_; }
    /// Clock of the current frame. Enabled in debug builds, and when WEFT_WATCHDOG is set.
    [[nodiscard]] FrameClock& clock() { return clock_; }
    /// Reports to stderr which part delayed a slow frame.
    void watch() const;
    void reset_times() { times_ = {}; }
    void close();

  private:
    EditorOptions options_;
    std::string settings_path_;
    EditorSettings settings_, saved_settings_;
    GlPictures pictures_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<Shell> shell_;
    double scale_ = 0;
    bool dark_ = true, grey_ = false;
    double settings_checked_s_ = 0;
    FrameTimes times_;
    FrameClock clock_;
};

}  // namespace weft
