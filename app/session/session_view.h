#pragma once
// What the panels see of a session: plain values and shared immutable ones, made new by
// Session::update().

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/mattes/matte_shelf.h"
#include "app/mattes/roto_shape.h"
#include "app/preview/preview.h"
#include "app/project/project.h"
#include "app/project/validate.h"
#include "app/session/action.h"
#include "app/session/child_jobs.h"
#include "app/session/where_to_correct.h"

namespace weft {

enum class NoticeKind : std::uint8_t { kGood, kInfo, kWarning, kError };

/// A message to the artist. Errors stay until they are dismissed.
struct Notice {
    int id = 0;
    NoticeKind kind = NoticeKind::kInfo;
    std::string text;
    double at_s = 0;  ///< On the session's clock.
};

struct PlateView {
    enum class State : std::uint8_t { kNone, kOpening, kOpen, kFailed };
    State state = State::kNone;
    std::string path, error, space, depth;
    Size size;
    double fps = 24;
    double pixel_aspect = 1;  ///< Width of a pixel over its height, as the files say.
    std::vector<int> frames;
    std::size_t cached_bytes = 0, budget_bytes = 0;
};

/// What a frame has, for the timeline.
struct FrameMarks {
    bool plate = false, result = false, failed = false;
    bool matte_key = false, reference = false;  ///< Of the selected region.
    float confidence = -1;                      ///< Of its matte; below 0: not known.
    // Below 0: not known.
    float drift = -1;    ///< How far the surface looks different from the reference, 0–1.
    float stretch = -1;  ///< How far the texture is drawn out or squeezed: 1 not at all.
    float seam = -1;     ///< How much the seams stand out, 0–1.
    /// How far seams moved on the texture since the frame before, in plate pixels.
    float seam_motion = -1;
    /// Mean change of a surface point since the frame before, in 8-bit steps, and the plate's own:
    /// of the measured render, else of the preview.
    float flicker = -1, flicker_plate = -1;
    /// What the flicker would be if the texture were carried without any change: the most of it is
    /// how well the measuring motion knows the surface.
    float flicker_floor = -1;
    float chatter = -1;  ///< How far the matte's edge moved otherwise than the picture, in pixels.
};

/// A region's matte on the current frame.
struct RegionMatteView {
    RegionId region = 0;
    int layer = 0;  ///< As SelectMatteLayer::layer.
    enum class Kind : std::uint8_t { kNone, kLoading, kPainted, kPropagated, kFile, kFailed };
    Kind kind = Kind::kNone;
    ViewU8x1 pixels;            ///< Valid until the next update().
    MattePtr keep;              ///< Owns `pixels`, but for a matte that is being painted.
    std::uint64_t version = 0;  ///< Another number: other pixels.
    Recti changed;              ///< Since the version before; only while painting.
    std::string error;
};

struct RecoveryOffer {
    std::string project_path;  ///< Empty: of a shot that was never saved.
    std::string when;          ///< "today at 14:02"
};

/// A project from a folder that is not trusted would write outside of it.
struct TrustOffer {
    std::string folder;  ///< The project's.
    std::string output;  ///< The first path outside.
};

/// Quality over time, from measuring a finished render.
struct QualityReport {
    enum class State : std::uint8_t { kNone, kMeasuring, kDone, kFailed };
    State state = State::kNone;
    std::string pattern, error;
    int done = 0, total = 0;
    struct Row {
        int frame = 0;
        std::string file;  ///< The picture that was measured.
        /// Mean change of a surface point to the next frame, and mean brightness, in codes.
        float flicker = 0, flicker_plate = 0, brightness = 0, brightness_plate = 0;
        /// Mean step between neighbouring pixels of the region, in per cent of its first frame's.
        float sharpness = 0, sharpness_plate = 0;
        float flicker_floor = -1;  ///< As in FrameMarks.
    };
    std::vector<Row> rows;
};

struct StripView {
    StripKind kind = StripKind::kNone;
    std::vector<StripCard> cards;
    bool over_time = false;  ///< As ShowStrip::over_time.
    int columns = 0;         ///< Of a contact sheet, whose rows are settings; 0: no sheet.
};

struct SessionView {
    double now_s = 0;
    bool open = false;  ///< There is a document.
    Project project;    ///< As it stands, with what is being tried.
    std::string path, title;
    bool modified = false, saving = false;
    PlateView plate;

    int frame = 0;
    int playing = 0;  ///< As Play::direction.
    double play_fps = 0;
    std::optional<int> mark_in, mark_out;
    std::vector<FrameMarks> marks;  ///< By index into plate.frames.

    std::vector<CorrectionHint> to_correct;  ///< Of the selected region, ascending frames.

    RegionId selected = 0, solo = 0;
    std::vector<RegionId> locked;
    std::vector<RegionMatteView> mattes;    ///< Of all regions, bottom up.
    std::vector<RegionMatteView> holdouts;  ///< Of the selected region.
    int matte_layer = 0;                    ///< As SelectMatteLayer::layer.
    bool painting = false, matte_busy = false;
    std::optional<RotoShape> shape;  ///< Of the selected region here, or the last one before.
    std::vector<int> shape_frames;   ///< Frames on which it was drawn.
    StripView strip;

    PicturePtr plate_picture, result_picture;
    bool result_current = false;  ///< result_picture is of this frame and these settings.
    bool result_wanted = false;   ///< There is something to render.
    PreviewFrame stages;
    std::string frame_error, frame_file;
    PreviewView preview;
    bool analysis_paused = false;
    Quality preview_quality = Quality::kDraft;
    std::optional<LayerKind> layer;  ///< As ShowLayer::layer.
    Overlay overlay = Overlay::kNone;
    std::shared_ptr<const OverlayPicture> overlay_picture;
    bool stages_shown = false;

    std::vector<ScreenName> screens;           ///< Of the OpenColorIO config; its default first.
    std::vector<std::string> color_spaces;     ///< … and its spaces.
    ScreenName screen_name{"", kScreenSrgb};   ///< As ChooseScreen::name.
    std::shared_ptr<const ScreenView> screen;  ///< Null: a built-in one.

    std::vector<std::string> history;
    std::size_t history_position = 0;
    std::string undo_label, redo_label;
    std::vector<Issue> issues;
    std::map<RegionId, std::string> unready;  ///< Why a region cannot be shown yet.

    std::vector<JobView> jobs;
    std::vector<Notice> notices;
    std::optional<RecoveryOffer> recovery;
    std::optional<TrustOffer> trust;
    QualityReport report;
    std::vector<std::string> recent;  ///< Project files, the newest first.
    std::string backend = "CPU";

    [[nodiscard]] const Region* selected_region() const { return region_by_id(project, selected); }
    /// What is being painted: a matte or a holdout; empty for a holdout that is to be begun.
    [[nodiscard]] MatteSource painted_source() const {
        const Region* region = selected_region();
        if (!region) return {};
        if (matte_layer == 0) return *region->matte;
        const auto at = static_cast<std::size_t>(matte_layer) - 1;
        return at < region->holdouts->size() ? (*region->holdouts)[at] : MatteSource{};
    }
    [[nodiscard]] bool is_locked(RegionId id) const {
        return std::find(locked.begin(), locked.end(), id) != locked.end();
    }
};

}  // namespace weft
