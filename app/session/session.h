#pragma once
// An editing session of one shot: the document with its history, pictures, mattes, preview and
// jobs. Takes actions and publishes a view.

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>

#include "app/base/background.h"
#include "app/base/background_tasks.h"
#include "app/base/editor_settings.h"
#include "app/base/frame_clock.h"
#include "app/base/recovery.h"
#include "app/exchange/save_document.h"
#include "app/mattes/edged_matte.h"
#include "app/mattes/matte_painting.h"
#include "app/preview/plate_opener.h"
#include "app/preview/plate_player.h"
#include "app/preview/playback.h"
#include "app/project/history.h"
#include "app/session/action.h"
#include "app/session/collect_run.h"
#include "app/session/job_desk.h"
#include "app/session/session_view.h"
#include "app/session/strip.h"
#include "app/shot/drawn_mattes.h"
#include "engine/media/write_rule.h"

namespace weft {

struct Measuring;

struct SessionOptions {
    std::string program;          ///< The weft program that renders jobs.
    std::string assets;           ///< Folder that has demo/demo.weft.
    std::string state_folder;     ///< See editor_state_folder().
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    std::string trust_file;       ///< File of the TrustList; empty: no project file is trusted.
    AnalysisCacheOptions cache;
    std::size_t plate_budget_bytes = std::size_t{640} << 20;
    bool offer_recovery = true;
};

/// Belongs to one thread and never blocks it: files are read and frames rendered in the background.
class Session {
  public:
    explicit Session(SessionOptions options, EditorSettings* settings = nullptr);
    ~Session();

    void act(const Action& action);
    /// The same for strokes within a frame: view().mattes is updated at once, the rest by update().
    void act_now(const std::vector<Action>& actions);
    /// Collects the workers' results and advances time. `now_s`: a monotonic clock.
    void update(double now_s);
    /// State at the last update().
    [[nodiscard]] const SessionView& view() const { return view_; }
    /// Returns true if something is in progress, so that the window must keep drawing.
    [[nodiscard]] bool busy() const;
    /// Increases with every change that a worker reports; wakes a sleeping window.
    [[nodiscard]] std::uint64_t changes() const;
    void dismiss(int notice);
    void notify(NoticeKind kind, std::string text);
    /// Clock that records the time of update() and act(); null: none.
    void set_clock(FrameClock* clock) { clock_ = clock; }
    /// Waits until painted mattes are on disk and file tasks are done. For tests and for closing.
    void flush();
    [[nodiscard]] std::string job_log(int id) const { return jobs_.log_tail(id); }
    /// Write rule of files that the user names (exported mattes, a script's images): they may
    /// replace files, but no input of the document. Checks the files of the document.
    [[nodiscard]] WriteRule export_rule() const;
    /// Closes normally: the document is not offered for recovery. What is still being collected is
    /// given up.
    void close_cleanly();
    /// The options of the constructor.
    [[nodiscard]] const SessionOptions& options() const { return options_; }

  private:
    struct Actor;  // carries out each action
    using Finish = BackgroundTasks::Finish;

    // ---- the document (session_document.cpp) ----
    [[nodiscard]] const Project& document() const { return tried_ ? *tried_ : history_.current(); }
    [[nodiscard]] Project resolved() const;
    void edit(const Edit& edit, bool commit);
    void commit(Project project, std::string label);
    void start_document(Project project, std::string path);
    void open_project(const std::string& path);
    void open_demo();
    void open_any(const std::string& path);
    void recover(bool accept);
    void find_more_recoverable();
    void document_changed();
    void open_plate_in_background();
    void take_plate();
    void remember_recent(const std::string& path);
    void end_player();
    /// Waits for its result in the background and drops it.
    template <class Work, class Future>
    void abandon(std::optional<Work>& work, Future&& future) {
        if (!work) return;
        shutdowns_.push_back(in_background([one = future(*work)]() mutable { one.wait(); }));
        work.reset();
    }

    /// Drops a matte that is being worked out. Returns true if there was one.
    bool abandon_change();

    // ---- the document's files (session_files.cpp) ----
    /// `new_only`: as DocumentSave has it.
    void save(const std::string& path, const std::optional<SaveAnswer>& answer = {},
              bool new_only = false);
    void ask_about(const DocumentSave& what, const DocumentSaved& found);
    void answer_save(const AnswerSave& answer);
    void take_saved(const DocumentSave& what, const DocumentSaved& done, std::uint64_t serial);
    void save_version();
    void saved_as(const Project& written, const std::string& path, const MovedFiles& moved);
    [[nodiscard]] bool is_plate_folder(const std::string& folder) const;
    void collect(const std::string& folder);
    void cancel_collect();
    void look_for_missing_files();
    void relink(const std::string& folder);
    void find_render_folder();

    /// A file task that ends in the document in which it began; its end is dropped if another
    /// document has been opened meanwhile.
    template <class Work>
    void start_for_document(Work&& work) {
        file_tasks_.start(
            [this, id = document_id_, work = std::forward<Work>(work)]() mutable -> Finish {
                return [this, id, finish = work()] {
                    if (id == document_id_ && finish) finish();
                };
            });
    }

    // ---- untrusted projects (session_trust.cpp) ----
    void update_trust(bool from_file);
    void offer_trust();
    void answer_trust(bool trust);
    [[nodiscard]] bool may_render_to(const Project& chosen);
    void trust_saved();

    // ---- frames ----
    void go_to(int frame);
    void step_keyframe(int direction);

    // ---- mattes (session_mattes.cpp) ----
    /// `place`: several frames of a layer are shown at the same time, each in its own place.
    [[nodiscard]] RegionMatteView matte_of(const Region& region, int layer, int frame,
                                           int place = 0);
    [[nodiscard]] const Region* painted_region() const {
        return region_by_id(document(), selected_);
    }
    [[nodiscard]] MattePlace painted_place() const {
        return {selected_, layer_, playback_.frame()};
    }
    static void show_stroke(const MattePainting::Shown& stroke, RegionMatteView& out);
    [[nodiscard]] bool may_paint();
    /// Null: an empty matte. Nothing: not loaded yet.
    [[nodiscard]] std::optional<MattePtr> matte_to_paint_on();
    void prepare_stroke();
    void begin_stroke(const BeginStroke& action);
    void begin_painting(const BeginStroke& action);
    void end_stroke();
    void keep_matte(MattePtr matte, const MattePlace& place, const std::string& label,
                    const std::optional<RotoShape>& shape = {});
    void change_matte(std::function<Matte(const Matte&)> change, std::string label,
                      bool here_only = false);
    void take_changed_matte();
    /// Returns true if a matte is being changed; then `action` follows, if the artist is still
    /// there.
    template <class T>
    bool follows_change(const T& action) {
        if (!changing_) return false;
        after_change_ = [this, action, place = painted_place()] {
            if (place == painted_place()) act(action);
        };
        return true;
    }
    void paint_instead();
    [[nodiscard]] std::string beside_project(const std::string& path) const;

    // ---- confirmed parts of mattes (session_confirmed.cpp) ----
    struct Confirming {
        MattePtr matte;  ///< Of the whole frame, as it is shown.
        MattePtr area;   ///< What is confirmed of it.
    };
    /// Null: nothing is confirmed there, or it is still being read.
    [[nodiscard]] MattePtr confirmed_matte(const MatteSource& source, int frame);
    [[nodiscard]] MattePtr confirmed_area(const Region& region, int layer, int frame);
    [[nodiscard]] std::optional<Confirming> confirming_here();
    void begin_confirming(const BeginStroke& action);
    /// Whether a change of the painted frame counts where it is made only: not of a keyframe.
    [[nodiscard]] bool counts_in_part(bool here_only) const;
    void keep_here(MattePtr matte, const Matte& changed, const Confirming& before,
                   const MattePlace& place, const std::string& what);
    void keep_confirmed(const Confirming& now, const MattePlace& place, const std::string& what);
    void show_confirmed();
    void mark_confirmed();

    // ---- segmented and drawn mattes (session_shapes.cpp) ----
    void scribble(const ScribbleSelect& action);
    void set_shape(const RotoShape& shape);
    void follow_shape(const FollowShape& action);
    void track_shape(const FollowShape& action, const RotoShape& shape, int frame);
    void detach_shape();
    /// Its shape over time, with the track's whole path.
    [[nodiscard]] KeyedShape absolute_shape(const MatteSource& source) const;
    [[nodiscard]] std::pair<std::string, MatteShelf::Reader> drawn_matte(const MatteSource& source,
                                                                         int frame) const;
    void commit_layer(const Region& region, int layer, const MatteSource& matte,
                      const std::string& label);
    void show_shape();

    // ---- writing mattes (session_matte_files.cpp), scale by line (session_placing.cpp) ----
    enum class MatteEdges : std::uint8_t { kAsShown, kNone };
    void write_mattes(const std::string& pattern, MatteEdges edges,
                      std::function<void(const std::vector<int>&)> then);
    void export_mattes(const std::string& pattern);
    void freeze_mattes(bool frozen);
    void scale_by_line(const ScaleByLine& action);

    // ---- view transform (session_color.cpp) ----
    void look_for_screens();
    void choose_screen(const ScreenName& name, bool remember);

    // ---- the strip (session_strip.cpp) ----
    void show_strip();
    [[nodiscard]] StripQuery strip_query() const;
    void choose_from_strip(int card);
    void copy_keyframe(int from, int to);
    [[nodiscard]] std::string new_matte_path(RegionId region, int frame);

    // ---- preview, jobs ----
    [[nodiscard]] bool awaits_dragged_picture() const;
    void request_preview();
    void carry_mattes();
    /// The document with only regions enabled that can be shown, at preview quality.
    [[nodiscard]] Project project_to_preview(bool& any) const;
    void apply_texture(const std::string& path, RegionId region);
    void apply_textures(const ApplyTextures& action);
    void use_larger_original(RegionId region);
    void pick_cryptomatte(const PickCryptomatte& action);
    [[nodiscard]] std::string texture_folder() const;
    void fetch_texture(const std::string& path, RegionId region);
    void take_texture();
    void submit(const SubmitJob& action);
    void watch_jobs();
    void measure(const std::string& pattern);
    void end_measuring();

    // ---- the view (session_view.cpp) ----
    void show_document();
    void show_plate();
    void show_marks();
    void show_mattes();
    void show_onion_skin();
    void show_result();

    SessionOptions options_;
    EditorSettings* settings_;
    EditorSettings own_settings_;
    SessionView view_;

    bool open_ = false;
    bool untrusted_ = false;  // the document came from an untrusted folder
    std::string path_;
    std::optional<ProjectOnDisk> on_disk_;  // what path_ held when it was opened or last saved
    History history_;
    std::optional<Project> tried_;
    std::optional<double> dragged_at_s_;  // of the last request, if it was for `tried_`
    std::uint64_t document_id_ = 0;       // counts the documents that were opened
    std::uint64_t document_version_ = 1, shown_version_ = 0, requested_version_ = 0;
    std::vector<RecoveredProject> recoverable_;
    double look_for_recovery_s_ = 1;  // time of the next look; see find_more_recoverable()

    // Destroyed in reverse order: a member's thread may use the members above it.
    Preview preview_;
    MatteShelf shelf_;
    RecoveryWriter recovery_;
    JobDesk jobs_;

    PlateOpener opener_;
    std::shared_ptr<const FrameReader> reader_;
    std::shared_ptr<const DrawnMattes> drawn_;  // there is one while there is a reader
    std::shared_ptr<PlatePlayer> player_;
    PlatePlayer::Reading plate_reading_;
    PreviewReading preview_reading_;
    /// Destructions that may block, each in a thread of its own.
    std::vector<std::future<void>> shutdowns_;
    BackgroundTasks file_tasks_;
    std::optional<CollectRun> collecting_;

    Playback playback_;
    double now_s_ = 0, first_update_s_ = -1;

    RegionId selected_ = 0, solo_ = 0;
    int layer_ = 0;    // of the selected region, as in SelectMatteLayer
    Zone begun_zone_;  // what a stroke beyond the last zone adds
    std::set<RegionId> locked_;
    MattePainting painting_;
    std::optional<Confirming> confirming_;  // before the stroke, if it counts in part only
    bool mattes_unwritten_ = false;         // as of the last update
    struct Shown {
        EdgedMatte edged;
        MattePtr matte;  // as the view shows it
        std::uint64_t version = 0;
    };
    std::map<std::tuple<RegionId, int, int>, Shown> shown_mattes_;  // by region, layer and place
    std::map<std::string, std::uint64_t> missed_mattes_;  // name → matte_version() when it failed
    struct Changing {
        std::future<Matte> matte;
        MattePlace place;
        std::string label;
        std::optional<RotoShape> shape;  // shape that the matte is drawn from
        std::optional<Confirming> part;  // before the change, if it counts in part only
    };
    std::optional<Changing> changing_;
    /// A scribble or shape that came while the one before was worked out; the newest counts.
    std::function<void()> after_change_;
    int matte_serial_ = 0;
    struct Fetching {
        std::future<Expected<std::string>> path;
        RegionId region = 0;
    };
    std::optional<Fetching> fetching_;  // library texture being copied

    int read_frame_ = 0;
    Strip strip_;
    bool stages_ = false, onion_skin_ = false;
    std::optional<LayerKind> shown_layer_;
    ScreenName wanted_screen_;  // shown or being prepared
    Overlay overlay_ = Overlay::kNone;
    Quality preview_quality_ = Quality::kDraft;
    bool request_pending_ = false;
    PicturePtr last_result_;
    int last_result_frame_ = 0;

    std::vector<Notice> notices_;
    int last_notice_ = 0;
    std::shared_ptr<Measuring> measuring_;
    FrameClock* clock_ = nullptr;
};

}  // namespace weft
