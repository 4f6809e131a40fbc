#pragma once
// The session and its interface, put together: what a window or a script drives frame by frame.

#include <memory>
#include <string>

#include "app/editor/editor.h"
#include "app/editor/gl_pictures.h"
#include "app/session/session.h"
#include "ui/shell.h"

namespace weft {

/// What the interface itself takes of a frame, on the processor; drawing by OpenGL excluded.
struct FrameTimes {
    double last_ms = 0, worst_ms = 0, sum_ms = 0;  ///< By the clock.
    double cpu_worst_ms = 0, cpu_sum_ms = 0;       ///< This thread's own work.
    int frames = 0;
};

/// Needs a current OpenGL context and a current ImGui context. One thread.
class EditorApp {
  public:
    explicit EditorApp(const EditorOptions& options);
    ~EditorApp();

    /// Errors: shaders that do not compile.
    [[nodiscard]] Status start();
    /// Between the backends' NewFrame() and drawing: everything but OpenGL's own work.
    void frame(double now_s);
    /// Fonts are reloaded if the scale has changed; returns whether they were.
    bool update_look(double monitor_scale);

    [[nodiscard]] Session& session() { return *session_; }
    [[nodiscard]] Shell& shell() { return *shell_; }
    [[nodiscard]] GlPictures& pictures() { return pictures_; }
    [[nodiscard]] const EditorSettings& settings() const { return settings_; }
    /// Whether the window may sleep until something happens.
    [[nodiscard]] bool idle() const;
    [[nodiscard]] std::uint64_t news() const;
    [[nodiscard]] bool wants_to_leave() { return shell_->state().leave; }
    [[nodiscard]] const FrameTimes& times() const { return times_; }
    /// Of the frame that is being drawn. On in debug builds, and where WEFT_WATCHDOG is set.
    [[nodiscard]] FrameClock& clock() { return clock_; }
    /// Says on stderr which part held up a frame that took too long.
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
