#pragma once
// An editing session of one shot: the document with its history, pictures, mattes, preview and
// jobs. Takes actions and publishes a view.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/base/editor_settings.h"
#include "app/base/frame_clock.h"
#include "app/session/action.h"
#include "app/session/session_view.h"
#include "engine/media/write_rule.h"

namespace weft {

struct SessionOptions {
    std::string program;          ///< The weft program that renders jobs.
    std::string assets;           ///< Folder that has demo/demo.weft.
    std::string state_folder;     ///< See editor_state_folder().
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    std::string trust_file;       ///< File of the TrustList; empty: no project file is trusted.
    std::vector<PaintProgram> paint_programs;  ///< To choose from, the most suitable first.
    AnalysisCacheOptions cache;
    std::size_t plate_budget_bytes = std::size_t{640} << 20;
    bool offer_recovery = true;
};

/// Belongs to one thread and never blocks it: files are read and frames rendered in the background.
class Session {
  public:
    explicit Session(SessionOptions options, EditorSettings* settings = nullptr);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void act(const Action& action);
    /// The same for strokes within a frame: view().mattes is updated at once, the rest by update().
    void act_now(const std::vector<Action>& actions);
    /// Collects the workers' results and advances time. `now_s`: a monotonic clock.
    void update(double now_s);
    /// State at the last update().
    [[nodiscard]] const SessionView& view() const;
    /// Returns true if something is in progress, so that the window must keep drawing.
    [[nodiscard]] bool busy() const;
    /// Returns true while something goes on for minutes and is followed by update(), such as a
    /// measurement: a frame now and then shows how far it has come.
    [[nodiscard]] bool works_long() const;
    /// Increases with every change that a worker reports; wakes a sleeping window.
    [[nodiscard]] std::uint64_t changes() const;
    void dismiss(int notice);
    void notify(NoticeKind kind, std::string text);
    /// Clock that records the time of update() and act(); null: none.
    void set_clock(FrameClock* clock);
    /// Waits until painted mattes are on disk and file tasks are done. For tests and for closing.
    void flush();
    [[nodiscard]] std::string job_log(int id) const;
    /// Write rule of files that the user names (exported mattes, a script's images): they may
    /// replace files, but no input of the document. Checks the files of the document.
    [[nodiscard]] WriteRule export_rule() const;
    /// Closes normally: the document is not offered for recovery. What is still being collected is
    /// given up.
    void close_cleanly();
    /// The options of the constructor.
    [[nodiscard]] const SessionOptions& options() const;

  private:
    class Parts;  // app/session/session_parts.h
    std::unique_ptr<Parts> parts_;
};

}  // namespace weft
