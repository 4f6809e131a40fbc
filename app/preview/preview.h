#pragma once
// Results on the screen while the artist works: the shot's analysis in one background thread, the
// frames rendered from it in another. The newest request wins; what is shown is what a render
// writes (smaller at first, where the plate is large), or nothing.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/preview_flicker.h"
#include "app/project/project.h"
#include "app/render/analysis_cache.h"
#include "app/textures/provenance.h"
#include "engine/core/cancel.h"

namespace weft {

/// The steps of the way to a frame, as the four-up view shows them.
enum class Stage : std::uint8_t { kTexture, kLit, kFinal };
inline constexpr int kStageCount = 3;

/// What is drawn over the picture to judge the work by.
enum class Overlay : std::uint8_t {
    kNone,
    kGrid,
    kStretch,
    kLight,
    kSeams,
    kMotion,
    kConfidence,  ///< How far the surface looks different from the reference frame, where it came
                  ///< from.
    kSourceMap    ///< Which piece of the sample each pixel shows.
};

/// A small result beside the picture: another frame, or this one with another setting.
struct CardRequest {
    std::string label;
    std::string note;  ///< More about it, for whoever draws it.
    Project project;   ///< As in PreviewRequest.
    int frame = 0;
    RegionId around = 0;   ///< Only the part of the frame where this region is; 0: all of it.
    std::string key;       ///< Of its pixels; see strip_key().
    bool current = false;  ///< The setting that the region has.
};

/// Where a CardRequest stands.
struct StripCard {
    std::string label, note;
    int frame = 0;
    PicturePtr picture;    ///< Null while it is being made.
    std::string error;     ///< Why it cannot be.
    bool current = false;  ///< As CardRequest::current.
};

struct PreviewRequest {
    Project project;  ///< With absolute paths, and only the regions that can be shown.
    int frame = 0;
    std::vector<int> range;          ///< Frames to be analysed; empty: only what `frame` needs.
    std::vector<int> fill;           ///< Frames to be rendered when idle, in this order.
    bool stages = false;             ///< Also the pictures before the final one.
    std::optional<LayerKind> layer;  ///< Also this layer for compositing of `frame`.
    Overlay overlay = Overlay::kNone;
    RegionId overlay_region = 0;
    std::vector<CardRequest> cards;  ///< To be made when the frame is rendered.
    PaintedMattes painted;           ///< Mattes of the project that may not be on the disk yet.
    bool interactive = false;        ///< Something is moving: no time for full size.
};

struct PreviewFrame {
    std::array<PicturePtr, kStageCount> stages;  ///< By Stage; only the final one may be rendered.
    /// The texture was grown for another scale; the right one is being made.
    bool approximate = false;
    int proxy = 1;  ///< By how much the pictures are smaller than the plate.
    std::optional<LayerKind> layer_kind;
    PicturePtr layer;  ///< As PreviewRequest::layer, on the screen's terms.
    /// The final picture as it was rendered small, kept when it is refined: neighbours are compared
    /// at one size.
    PicturePtr small;
    std::shared_ptr<const SeamPoints> seams;  ///< Of the picture that is compared.
    [[nodiscard]] const PicturePtr& comparable() const {
        return small ? small : stages[static_cast<std::size_t>(Stage::kFinal)];
    }
};

/// A value in 0–255 for each pixel of the overlay's region, with a matte of where it holds.
struct OverlayPicture {
    Overlay kind = Overlay::kNone;
    int frame = 0;
    std::uint64_t id = 0;
    Matte value, where;
    Matte marked;  ///< Of kSourceMap: 255 where the texture is kept, 128 where it was made again.
    float low = 0, high = 1;  ///< What 0 and 255 stand for.
    std::string unit;
    struct Arrow {
        Vec2 at, to;
    };
    std::vector<Arrow> arrows;                     ///< Motion since the reference frame, in pixels.
    std::shared_ptr<const Provenance> provenance;  ///< Of kSourceMap.
};

/// How a frame of a region fares, as far as it is known (below 0: not).
struct FrameHealth {
    // As in FrameMarks.
    float drift = -1, stretch = -1, seam = -1, seam_motion = -1;
    float flicker = -1, flicker_plate = -1, flicker_floor = -1, chatter = -1;
};

struct PreviewView {
    enum class State : std::uint8_t { kIdle, kOpening, kAnalysing, kGrowing, kRendering, kFailed };
    State state = State::kIdle;  ///< Of the wanted frame.
    std::string error;
    bool analysing = false;  ///< In the background, whatever the wanted frame waits for.
    int done = 0, total = 0;
    double seconds_left = 0;  ///< 0: not known yet.
    std::vector<std::string> warnings;
    std::map<RegionId, int> references;  ///< The frame that each region's texture is placed on.
    std::uint64_t changes = 0;           ///< Grows with every news.
    double frame_seconds = 0;            ///< What the last frame of full size took to render.
    double first_seconds = 0;            ///< What the last picture of the wanted frame took.
};

/// What the preview has to show, as of the last Preview::try_read() that succeeded.
struct PreviewReading {
    PreviewView view;
    bool paused = false;
    PreviewFrame frame;         ///< Of the newest request's content only.
    std::vector<int> rendered;  ///< The frames that are rendered, likewise; ascending.
    std::shared_ptr<const OverlayPicture> overlay;
    /// How sure the propagation was, by frame; empty for mattes that come from files.
    std::map<int, float> confidence;
    std::map<int, FrameHealth> health;       ///< Of the region, by frame.
    std::map<std::string, StripCard> cards;  ///< Those that are made, by CardRequest::key.
};

/// Thread-safe. The window's thread asks with try_request() and try_read(), which never wait: a
/// worker of low priority may be interrupted while it holds the lock, for as long as a busy machine
/// likes.
class Preview {
  public:
    /// `texture_library`: for textures "db:ID"; empty: the user's own.
    explicit Preview(AnalysisCacheOptions cache, std::string texture_library = {},
                     std::size_t budget_bytes = std::size_t{384} << 20);
    ~Preview();

    /// False, and nothing happens, when a worker is at its books just now.
    bool try_request(const PreviewRequest& request);
    /// Forgets the shot and stops all work.
    void clear();
    /// Stops the analysis until the next request that changes it, or resume().
    void pause();
    void resume();

    /// Pictures of `frame`, confidence of `region`'s matte or of its holdout `layer` − 1. False,
    /// and `reading` stays, likewise.
    bool try_read(int frame, RegionId region, int layer, PreviewReading& reading) const;
    /// Grows with everything that try_read() would tell.
    [[nodiscard]] std::uint64_t changes() const;
    /// Reads a propagated matte (`layer` 0) or holdout; to be called in the background. Error: not
    /// propagated yet.
    [[nodiscard]] Expected<Matte> propagated_matte(RegionId region, int layer, int frame) const;
    /// How the texture was carried, before_from_now, in plate pixels; to be called in the
    /// background. Error: not analysed yet, or the region's mode carries nothing.
    [[nodiscard]] Expected<LatticeField> track(RegionId region, int before, int now) const;
    /// Changes whenever propagated mattes may have changed.
    [[nodiscard]] std::uint64_t matte_version() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What a frame's pixels depend on, as text: equal for projects that give the same pixels.
[[nodiscard]] std::string pixel_key(const Project& project);
/// The same for the analysis.
[[nodiscard]] std::string analysis_key(const Project& project);
/// The same for a card.
[[nodiscard]] std::string strip_key(const CardRequest& request);

}  // namespace weft
