#pragma once
// What a session shows to the panels: plain values and shared immutable ones, updated by
// Session::update().

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/paint_programs.h"
#include "app/base/picture.h"
#include "app/exchange/merge_project.h"
#include "app/jobs/child_jobs.h"
#include "app/mattes/matte_layer.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/preview.h"
#include "app/project/project.h"
#include "app/project/validate.h"
#include "app/session/action.h"
#include "app/session/where_to_correct.h"
#include "engine/core/hash.h"

namespace weft {

enum class NoticeKind : std::uint8_t { kGood, kInfo, kWarning, kError };

/// A message to the user. Errors stay until dismissed, refusals until something changes.
struct Notice {
    int id = 0;
    NoticeKind kind = NoticeKind::kInfo;
    std::string text;
    double at_s = 0;            ///< Time on the session's clock, s.
    bool refusal = false;       ///< Of something that cannot be done as things are,
    std::string holds_in = {};  ///< which is this state; empty: not known yet.
};

struct PlateView {
    enum class State : std::uint8_t { kNone, kOpening, kOpen, kFailed };
    State state = State::kNone;
    std::string path, error, space, depth;
    Size size;
    double fps = 24;
    double pixel_aspect = 1;  ///< Pixel aspect ratio from the files.
    std::vector<int> frames;
    int counted = 0;  ///< Frames of a movie that have been counted, while it is opened.
    std::size_t cached_bytes = 0, budget_bytes = 0;
};

/// A quarter of the seams that shows is the worst on the scale.
inline constexpr float kWorstSeams = 0.25f;

/// Data of a frame for the timeline.
struct FrameMarks {
    bool plate = false, result = false, failed = false;
    bool matte_key = false, reference = false;  ///< Of the selected region.
    float confidence = -1;                      ///< Confidence of its matte; below 0: not known.
    // Below 0: not known.
    float drift = -1;    ///< Appearance change since the reference frame, 0–1.
    float stretch = -1;  ///< Stretch or compression of the texture; 1: none.
    float seam = -1;     ///< Share of the seams that shows, as seam_visibility().
    /// Movement of seams on the texture since the previous frame, plate px.
    float seam_motion = -1;
    /// Mean change of a surface point since the previous frame, 8-bit steps, for the result and for
    /// the plate: from the measured render, otherwise from the preview.
    float flicker = -1, flicker_plate = -1;
    /// Flicker of a texture that moves unchanged: mostly the error of the measuring motion.
    float flicker_floor = -1;
    float chatter = -1;  ///< Edge motion of the matte relative to the picture, px.
    /// The sudden step since the previous frame that stands out most, as a share of what counts as
    /// a pop; 1 or more is one. Below 0: not known.
    float pop = -1;
    std::string pop_text = {};  ///< What steps, and by how much: "sharpness 12%".
    bool confirmed = false;     ///< Parts of the selected region's matte are confirmed here.
};

/// A region's matte on the current frame.
struct RegionMatteView {
    RegionId region = 0;
    int layer = 0;  ///< As SelectMatteLayer::layer.
    int frame = 0;
    enum class Kind : std::uint8_t {
        kNone,
        kLoading,
        kPainted,
        kPropagated,
        kUnreached,  ///< It has not been propagated to the frame yet.
        kFile,
        kFailed
    };
    Kind kind = Kind::kNone;
    bool outdated = false;      ///< Propagated: what was seen before the last change.
    ViewU8x1 pixels;            ///< Pixels; valid until the next update().
    MattePtr keep;              ///< The matte itself, which painting changes; null while painted.
    MattePtr edged;             ///< With its edge tools, if it has any; `pixels` shows that then.
    std::uint64_t version = 0;  ///< Changes with the pixels.
    Recti changed;              ///< Changed part since the previous version; only while painting.
    std::string error;
};

struct RecoveryOffer {
    std::string project_path;  ///< Empty: the shot was never saved.
    std::string when;          ///< "today at 14:02"
};

/// An untrusted project that would write outside its folder.
struct TrustOffer {
    std::string folder;  ///< The project's folder.
    std::string output;  ///< The first output outside it.
};

/// The project's file was changed by another program, also where the document was.
struct SaveQuestion {
    std::string path;
    Hash128 theirs;  ///< The version of the file.
    std::vector<MergeConflict> conflicts;
    std::vector<std::string> merged;  ///< As MergedProject::changed.
};

/// A surface that is being written by PaintFlat.
struct FlattenView {
    RegionId region = 0;
    std::optional<WorkStage> stage;  ///< Empty: it has not begun.
    int done = 0, total = 0;
    double left_s = 0;  ///< 0: not known.
};

/// Files being copied by CollectProject.
struct CollectView {
    std::string folder;
    std::int64_t done = 0, total = 0;  ///< Files; a total of 0 is not known yet.
};

/// Quality over time, from measuring a finished render.
struct QualityReport {
    enum class State : std::uint8_t { kNone, kMeasuring, kDone, kFailed };
    State state = State::kNone;
    std::string pattern, error;
    int done = 0, total = 0;
    struct Row {
        int frame = 0;
        std::string file;  ///< The measured image.
        /// Mean change of a surface point to the next frame, and mean brightness, in 8-bit codes.
        float flicker = 0, flicker_plate = 0, brightness = 0, brightness_plate = 0;
        /// Mean step between neighbouring pixels of the region, % of the first frame's.
        float sharpness = 0, sharpness_plate = 0;
        float flicker_floor = -1;  ///< As in FrameMarks.
    };
    std::vector<Row> rows;
};

struct StripView {
    StripKind kind = StripKind::kNone;
    std::vector<StripCard> cards;
    bool over_time = false;  ///< As ShowStrip::over_time.
    int columns = 0;         ///< Columns of a contact sheet, whose rows are settings; 0: no sheet.
};

struct SessionView {
    double now_s = 0;
    bool open = false;  ///< A document is open.
    /// Which document: another number after another one was opened, also of the same file.
    std::uint64_t document = 0;
    Project project;  ///< The document, including an edit being dragged.
    std::string path, title;
    std::vector<std::string> missing;  ///< Input files that were not found.
    std::string render_folder;         ///< Where it renders to unless another place is chosen.
    bool modified = false, saving = false;
    PlateView plate;

    int frame = 0;
    int playing = 0;  ///< As Play::direction.
    double play_fps = 0;
    PlayMode play_mode = PlayMode::kLoop;
    std::optional<int> mark_in, mark_out;
    std::vector<FrameMarks> marks;  ///< By index into plate.frames.

    /// Suggested corrections of the selected region, ascending frames.
    std::vector<CorrectionHint> to_correct;

    RegionId selected = 0, solo = 0;
    std::vector<RegionId> locked;
    std::vector<RegionMatteView> mattes;    ///< Mattes of all regions, bottom up.
    std::vector<RegionMatteView> holdouts;  ///< Of the selected region.
    std::vector<RegionMatteView> zones;     ///< Likewise.
    /// Keyframes of the painted layer before and after the frame; empty without onion skin.
    std::vector<RegionMatteView> onion;
    bool onion_skin = false;
    /// What is confirmed of the painted layer on the frame; without pixels: nothing.
    RegionMatteView confirmed;
    int matte_layer = 0;       ///< As SelectMatteLayer::layer.
    std::vector<int> reached;  ///< The frames that have the painted layer's matte, if propagated.
    Zone begun_zone;           ///< What a stroke beyond the last zone adds.
    bool painting = false, matte_busy = false;
    /// Shape of the selected region on this frame, or the last one before.
    std::optional<RotoShape> shape;
    std::vector<int> shape_frames;  ///< Frames with a drawn shape.
    StripView strip;

    PicturePtr plate_picture, result_picture;
    /// result_picture is of this frame with these settings, and not provisional.
    bool result_current = false;
    bool result_wanted = false;  ///< A region can be rendered.
    PreviewFrame stages;
    std::string frame_error, frame_file;
    PreviewView preview;
    bool analysis_paused = false;
    Quality preview_quality = Quality::kDraft;
    std::optional<LayerKind> layer;  ///< As ShowLayer::layer.
    Overlay overlay = Overlay::kNone;
    std::shared_ptr<const OverlayPicture> overlay_picture;
    bool stages_shown = false;

    std::vector<ScreenName> screens;        ///< Views of the OpenColorIO config, its default first.
    std::vector<std::string> color_spaces;  ///< Colour spaces of the config.
    ScreenName screen_name{"", kScreenSrgb};   ///< As ChooseScreen::name.
    std::shared_ptr<const ScreenView> screen;  ///< Null: a built-in view.

    std::vector<std::string> history;
    std::size_t history_position = 0;
    std::string undo_label, redo_label;
    std::vector<Issue> issues;
    std::map<RegionId, std::string> unready;  ///< Reasons why regions cannot be shown yet.
    /// Why a render would refuse a drawn form, by region.
    std::map<RegionId, std::string> form_problems;

    std::vector<JobView> jobs;
    std::vector<Notice> notices;
    std::optional<RecoveryOffer> recovery;
    std::optional<TrustOffer> trust;
    std::optional<SaveQuestion> save_question;  ///< AnswerSave answers it.
    std::optional<CollectView> collecting;
    std::optional<FlattenView> flattening;
    std::vector<std::string> saved_textures;   ///< By other programs, since the last update().
    std::vector<PaintProgram> paint_programs;  ///< The chosen one first.
    QualityReport report;
    std::vector<std::string> recent;  ///< Project files, the newest first.
    std::string backend = "CPU";

    [[nodiscard]] const Region* selected_region() const { return region_by_id(project, selected); }
    /// The layer being painted: a matte, holdout or zone; empty for one that does not exist yet.
    [[nodiscard]] MatteSource painted_source() const {
        const Region* region = selected_region();
        return region ? layer_source(*region, matte_layer) : MatteSource{};
    }
    [[nodiscard]] bool is_locked(RegionId id) const {
        return std::find(locked.begin(), locked.end(), id) != locked.end();
    }
};

}  // namespace weft
