#pragma once
// The parts of an editing session. Internal to app/session: whoever changes a part compiles neither
// the window nor the tests of the panels again.

#include <string>
#include <utility>
#include <vector>

#include "app/mattes/matte_painting.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/session/document/document.h"
#include "app/session/document/document_files.h"
#include "app/session/document/document_opening.h"
#include "app/session/document/document_saving.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/document_trust.h"
#include "app/session/document/notices.h"
#include "app/session/document/recent_projects.h"
#include "app/session/document/selection.h"
#include "app/session/document/shutdowns.h"
#include "app/session/jobs/flat_painting.h"
#include "app/session/jobs/measurement.h"
#include "app/session/jobs/renders.h"
#include "app/session/mattes/cryptomatte_pick.h"
#include "app/session/mattes/form_check.h"
#include "app/session/mattes/kept_mattes.h"
#include "app/session/mattes/matte_changes.h"
#include "app/session/mattes/matte_export.h"
#include "app/session/mattes/matte_folder.h"
#include "app/session/mattes/matte_shapes.h"
#include "app/session/mattes/matte_strokes.h"
#include "app/session/mattes/paint_target.h"
#include "app/session/mattes/propagated_mattes.h"
#include "app/session/mattes/scribble_trial.h"
#include "app/session/mattes/shown_mattes.h"
#include "app/session/session.h"
#include "app/session/textures/texture_choices.h"
#include "app/session/textures/texture_files.h"
#include "app/session/viewer/preview_desk.h"
#include "app/session/viewer/screens.h"
#include "app/session/viewer/shown_plate.h"
#include "app/session/viewer/shown_strip.h"

namespace weft {

/// Each part has one duty and knows only the parts that it is given. This routes actions to them,
/// advances them in update(), and puts the view together from what they show.
class Session::Parts final : private DocumentFollower {
  public:
    Parts(SessionOptions options, EditorSettings* settings);
    ~Parts();

    // As in Session.
    void act(const Action& action);
    void act_now(const std::vector<Action>& actions);
    void update(double now_s);
    [[nodiscard]] const SessionView& view() const { return view_; }
    [[nodiscard]] bool busy() const;
    [[nodiscard]] bool works_long() const;
    [[nodiscard]] std::uint64_t changes() const;
    void dismiss(int notice) { notices_.dismiss(notice); }
    void notify(NoticeKind kind, std::string text) { notices_.add(kind, std::move(text)); }
    void set_clock(FrameClock* clock) { clock_ = clock; }
    void flush();
    [[nodiscard]] std::string job_log(int id) const { return renders_.log_tail(id); }
    [[nodiscard]] WriteRule export_rule() const;
    void close_cleanly();
    [[nodiscard]] const SessionOptions& options() const { return options_; }

  private:
    struct Actor;  // carries out each action

    void document_replaced() override;
    void document_changed() override;

    // ---- update() ----
    void advance(double now_s);
    void advance_mattes();
    void remember_place();
    void notice_errors();
    void show(double now_s);
    /// What a panel may have to see before the next update.
    void show_answers();
    void show_mattes();
    void enter(const char* part) {
        if (clock_) clock_->enter(part);
    }
    /// The document's plate, with its absolute path.
    [[nodiscard]] Plate plate() const;
    void end_stroke() { strokes_.end(); }
    /// What was painted is in the document, also what is still worked out.
    void end_painting() {
        end_stroke();
        changes_.finish();
    }

    SessionOptions options_;
    EditorSettings own_settings_;
    EditorSettings& settings_;
    FrameClock* clock_ = nullptr;
    SessionView view_;
    Notices notices_;
    Selection selection_;
    Playback playback_;

    // Destroyed in reverse order: a member's thread may use the members above it. What the tasks do
    // may use any; the destructor waits for them first.
    Preview preview_;
    MatteShelf shelf_;
    Document document_;
    Shutdowns shutdowns_;
    DocumentTasks tasks_;

    DocumentFiles files_;
    DocumentTrust trust_;
    DocumentSaving saving_;
    DocumentOpening opening_;

    ShownPlate plate_;
    std::optional<int> left_at_;  // the frame to go to when the plate is open
    Screens screens_;
    PreviewDesk preview_desk_;
    ShownStrip strip_;

    MattePainting painting_;
    MatteFolder matte_folder_;
    PropagatedMattes propagated_;
    ShownMattes shown_mattes_;
    PaintTarget target_;
    KeptMattes kept_mattes_;
    MatteChanges changes_;
    ScribbleTrial trial_;
    MatteStrokes strokes_;
    MatteShapes shapes_;
    MatteExport matte_export_;
    CryptomattePick cryptomatte_;
    FormCheck form_check_;

    TextureChoices textures_;
    TextureFiles texture_files_;
    FlatPainting flat_painting_;
    Renders renders_;
    Measurement measurement_;
};

}  // namespace weft
