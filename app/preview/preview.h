#pragma once
// Interactive results: one background thread analyses the shot, another renders frames from the
// analysis. The newest request wins. The picture equals what a render writes, except that a large
// plate is shown at reduced size first, and that a provisional picture is shown while the frame is
// being analysed.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/cache/analysis_cache.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/preview_flicker.h"
#include "app/preview/surface_places.h"
#include "app/project/project.h"
#include "app/textures/provenance.h"
#include "engine/core/cancel.h"
#include "engine/core/quad.h"
#include "engine/metrics/pops.h"

namespace weft {

/// The stages of a frame, as the four-up view shows them.
enum class Stage : std::uint8_t { kTexture, kLit, kFinal };
inline constexpr int kStageCount = 3;

/// Diagnostic overlays.
enum class Overlay : std::uint8_t {
    kNone,
    kGrid,
    kStretch,
    kLight,
    kSeams,
    kMotion,
    kConfidence,       ///< Appearance change of the surface since the reference frame.
                       ///< from.
    kSourceMap,        ///< Which part of the sample each pixel shows.
    kChecker,          ///< A checker laid like the texture, to see the form.
    kCircles,          ///< A grid of circles, likewise.
    kLightConfidence,  ///< How surely light and paint of the old surface were told apart.
    kNormals           ///< The normals of the form found, as colours.
};

/// Request for a card of the strip: a small result of another frame or with another setting.
struct CardRequest {
    std::string label;
    std::string note;  ///< Further text for the panel.
    Project project;   ///< As in PreviewRequest.
    int frame = 0;
    RegionId around = 0;   ///< Crops to this region; 0: the whole frame.
    std::string key;       ///< Identifies its pixels; see strip_key().
    bool current = false;  ///< It shows the region's current setting.
};

/// The state of a CardRequest.
struct StripCard {
    std::string label, note;
    int frame = 0;
    PicturePtr picture;    ///< Null until it is rendered.
    std::string error;     ///< Error message; empty: none.
    bool current = false;  ///< Copied from CardRequest::current.
    /// From its frame alone, or with a quickly synthesized texture; the exact one is in progress.
    bool provisional = false;
};

struct PreviewRequest {
    Project project;             ///< With absolute paths, and only regions that can be shown.
    std::uint64_t document = 0;  ///< Which opened document it is; see Preview::forget().
    int frame = 0;
    std::vector<int> range;          ///< Frames to analyse; empty: only those that `frame` needs.
    std::vector<int> fill;           ///< Frames to render when idle, in this order.
    bool stages = false;             ///< Also render the earlier stages.
    std::optional<LayerKind> layer;  ///< Also render this layer of `frame`.
    Overlay overlay = Overlay::kNone;
    RegionId overlay_region = 0;
    std::vector<CardRequest> cards;  ///< Cards to render after the frame.
    PaintedMattes painted;           ///< Painted mattes that may not be on disk yet.
    std::uint64_t files = 0;         ///< Another number: files of textures were written anew.
    bool interactive = false;        ///< During playback: do not refine to full size.
};

struct PreviewFrame {
    /// By Stage; null except for the final one unless requested.
    std::array<PicturePtr, kStageCount> stages;
    /// The texture was synthesized for another scale, or quickly for this frame; the exact one is
    /// in progress.
    bool approximate = false;
    /// From this frame alone, because the analysis that it needs is in progress. Never counted
    /// among PreviewReading::rendered.
    bool provisional = false;
    bool partial = false;  ///< Regions are missing of which nothing is known yet.
    int proxy = 1;         ///< Reduction factor of the pictures relative to the plate.
    std::optional<LayerKind> layer_kind;
    PicturePtr layer;  ///< PreviewRequest::layer, converted for display.
    /// Of the regions whose texture is locked to the surface; not of a provisional picture.
    std::map<RegionId, std::shared_ptr<const SurfacePlaces>> places;
    /// The final picture at reduced size, kept after refining, so that neighbouring frames are
    /// compared at one size.
    PicturePtr small;
    std::shared_ptr<const SeamPoints> seams;  ///< Seams in `small`.
    [[nodiscard]] const PicturePtr& comparable() const {
        return small ? small : stages[static_cast<std::size_t>(Stage::kFinal)];
    }
};

/// An overlay: a value of 0–255 per pixel, with a matte of where it is valid.
struct OverlayPicture {
    Overlay kind = Overlay::kNone;
    int frame = 0;
    std::uint64_t id = 0;
    Matte value, where;
    Matte marked;             ///< For kSourceMap: 255 in locked patches, 128 in regenerated ones.
    float low = 0, high = 1;  ///< The values that 0 and 255 stand for.
    std::string unit;
    struct Arrow {
        Vec2 at, to;
    };
    std::vector<Arrow> arrows;                     ///< Motion since the reference frame, px.
    std::shared_ptr<const Provenance> provenance;  ///< For kSourceMap.
    /// For kNormals: colours over the picture, and the field of view by which they are seen; null
    /// where the form is flat.
    PicturePtr colours;
};

/// Quality measures of a region on a frame; below 0: not known.
struct FrameHealth {
    // As in FrameMarks.
    float drift = -1, stretch = -1, seam = -1, seam_motion = -1;
    float flicker = -1, flicker_plate = -1, flicker_floor = -1, chatter = -1;
    std::optional<PopSteps> steps = {};  ///< From the frame before; `frame` is not set.
};

struct PreviewView {
    enum class State : std::uint8_t { kIdle, kOpening, kAnalysing, kGrowing, kRendering, kFailed };
    State state = State::kIdle;  ///< State of the requested frame.
    std::string error;
    /// The background analysis is running, whatever the state of the requested frame.
    bool analysing = false;
    int done = 0, total = 0;
    double seconds_left = 0;  ///< Estimated time of the analysis, s; 0: not known yet.
    std::vector<std::string> warnings;
    std::map<RegionId, int> references;  ///< The reference frame of each region.
    /// What each region's sample was taken for: "Periodic: …".
    std::map<RegionId, std::string> samples;
    /// What each region's form was found from; flat ones and those not yet found are left out.
    std::map<RegionId, std::string> forms;
    /// The regions where light and paint cannot be told apart on too much of the surface, and what
    /// is to be done about it.
    std::map<RegionId, std::string> lights;
    /// Where a form is a plane: corners of a rectangle on it, on the reference frame as the corners
    /// of a placement count.
    std::map<RegionId, Quad<float>> planes;
    std::uint64_t changes = 0;  ///< Increases with every change.
    double frame_seconds = 0;   ///< Render time of the last full-size frame, s.
    /// Time from the request to the first picture of its frame, provisional or not, s.
    double first_seconds = 0;
};

/// Which propagated matte is meant.
struct WantedMatte {
    RegionId region = 0;
    int layer = 0;  ///< 0: the region's matte, above: holdouts, below: zones (matte_layer.h).
    int frame = 0;
    std::string key;  ///< Its propagation_key(): another document's matte is none.
    enum class Walk : std::uint8_t {
        kAll,     ///< Final.
        kForward  ///< From the keyframe before only, while the walk from the next one is not done.
    };
    Walk walk = Walk::kAll;
};

/// The preview's results at the last successful Preview::try_read().
struct PreviewReading {
    PreviewView view;
    bool paused = false;
    PreviewFrame frame;         ///< Matches the newest request's content only.
    std::vector<int> rendered;  ///< Rendered frames of that content, ascending; not provisional.
    std::shared_ptr<const OverlayPicture> overlay;
    /// Confidence of matte propagation, by frame; empty for mattes from files.
    std::map<int, float> confidence;
    std::map<int, FrameHealth> health;       ///< Quality of the region, by frame.
    std::map<std::string, StripCard> cards;  ///< Finished cards, by CardRequest::key.
};

/// Thread-safe. The window's thread uses try_request() and try_read(), which never block: a
/// low-priority worker that holds the lock may be preempted for a long time on a busy machine.
class Preview {
  public:
    /// `texture_library`: the library of textures "db:ID"; empty: the user's own.
    explicit Preview(AnalysisCacheOptions cache, std::string texture_library = {},
                     std::size_t budget_bytes = std::size_t{384} << 20);
    ~Preview();

    /// Returns false and does nothing while a worker holds the lock.
    bool try_request(const PreviewRequest& request);
    /// Propagates the painted mattes of regions without a texture (MattePropagator::propagate()).
    /// Never blocks.
    void propagate(const Project& project, const PaintedMattes& painted, int frame);
    /// Closes the shot and stops all work except propagate().
    void clear();
    /// The same when another document is opened: nothing of the one before is reported any more,
    /// also where plate, region ids and frames are the same. Later requests are for `document`.
    void forget(std::uint64_t document);
    /// Pauses the analysis until resume(), or until a request changes it.
    void pause();
    void resume();
    /// Whether a render is paused: the analysis that it may have begun is not waited for.
    void set_render_paused(bool paused);

    /// Reads pictures of `frame` and the confidence of `region`'s matte (`layer` 0) or of its
    /// holdout `layer` − 1. Returns false and leaves `reading` unchanged while a worker holds the
    /// lock.
    bool try_read(int frame, RegionId region, int layer, PreviewReading& reading) const;
    /// Increases with every change that try_read() would report.
    [[nodiscard]] std::uint64_t changes() const;
    /// Slow: call it in the background. Error: not propagated yet, or only in another state of the
    /// document.
    [[nodiscard]] Expected<Matte> propagated_matte(const WantedMatte& wanted) const;
    /// The frames of the plate with that matte, whatever `wanted.frame` is. Slow: call it in the
    /// background.
    [[nodiscard]] std::vector<int> reached(const WantedMatte& wanted) const;
    /// The track of the texture, before_from_now, in plate pixels. Slow: call it in the background.
    /// Error: not analysed yet, or the region's mode has no track.
    [[nodiscard]] Expected<LatticeField> track(RegionId region, int before, int now) const;
    /// Changes when propagated mattes may have changed.
    [[nodiscard]] std::uint64_t matte_version() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// A key of everything that a frame's pixels depend on: equal keys give equal pixels.
[[nodiscard]] std::string pixel_key(const Project& project);
/// A key of everything that the analysis depends on.
[[nodiscard]] std::string analysis_key(const Project& project);
/// A key of everything that a card's pixels depend on.
[[nodiscard]] std::string strip_key(const CardRequest& request);

}  // namespace weft
