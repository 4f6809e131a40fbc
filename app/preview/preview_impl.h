#pragma once
// Internal to the preview: the state of its two threads.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/guarded.h"
#include "app/preview/matte_propagator.h"
#include "app/preview/preview.h"
#include "app/preview/preview_overlay.h"
#include "app/preview/preview_scenes.h"
#include "app/preview/proxy_shot.h"
#include "app/shot/shot.h"
#include "engine/compute/backend.h"
#include "engine/core/cancel.h"
#include "engine/pipeline/draft_analysis.h"
#include "engine/pipeline/provisional.h"
#include "engine/pipeline/walk_memory.h"

namespace weft {

/// Pixels of the first picture; larger plates are shown reduced first.
inline constexpr std::int64_t kProxyPixels = 640'000;

/// An opened project.
struct OpenedShot {
    std::shared_ptr<const Shot> shot;
    std::shared_ptr<AnalysisCache> store;
    std::string pixels, analysis;  ///< Keys of the opened project.
    std::uint64_t document = 0;    ///< As PreviewRequest::document.
    Project asked = {};            ///< What it was opened from.
};
using OpenedPtr = std::shared_ptr<const OpenedShot>;

/// What render_frame() is given for a picture of a shot. Refers to its parts.
struct Look {
    const Shot& shot;
    const AnalysisStore& store;
    const std::vector<RegionScene>& scenes;
};

/// What a frame says alone, kept for the settings that are tried next.
struct KeptProvisional {
    std::string analysis;
    int frame = 0;
    std::uint64_t visits = 0;                    // as Shared::visits when it was made
    std::shared_ptr<const AnalysisCache> known;  // which `made` refers to
    ProvisionalFrame made;
};

/// Number of frames that must still be analysed for these frames; `anew`: if nothing were yet.
[[nodiscard]] int steps_to(const OpenedShot& opened, std::vector<int> frames, bool anew = false);

/// The layer number under which the analysis stores the matte of a layer (matte_layer.h): painted
/// holdouts are counted among themselves. Nothing: not stored.
[[nodiscard]] std::optional<int> stored_layer(const Region& region, int layer);

/// A propagated matte of a shot that was opened from `asked`. Error: it is not in the store, or it
/// is that of another state of the document.
[[nodiscard]] Expected<Matte> matte_in(const Project& asked, const Shot& shot,
                                       const AnalysisStore& store, const WantedMatte& wanted);

/// The frames with that matte; none if it is that of another state of the document.
[[nodiscard]] std::vector<int> reached_in(const Project& asked, const Shot& shot,
                                          const AnalysisStore& store, const WantedMatte& wanted);

/// The track of a region's texture, before_from_now, in plate pixels. Error: not analysed, or the
/// region's mode has no track.
[[nodiscard]] Expected<LatticeField> track_between(const OpenedShot& opened, std::size_t region,
                                                   int before, int now);

struct Preview::Impl {
    using Clock = std::chrono::steady_clock;

    Impl(AnalysisCacheOptions cache_options, std::string library, std::size_t budget);
    ~Impl();

    // ---- the rendering thread (preview_render.cpp, preview_provisional.cpp, preview_cards.cpp)
    void render_loop();
    bool step();
    bool step_frame(const PreviewRequest& now);
    bool step_fill(const PreviewRequest& now, const std::string& pixels);
    bool step_flicker(const PreviewRequest& now);
    bool step_card(const PreviewRequest& now);
    bool step_quick_card(const PreviewRequest& now);
    bool put_card(const CardRequest& request, PicturePtr picture, std::string error,
                  bool provisional = false);
    [[nodiscard]] Status open_card_store(OpenedShot& of, const CardRequest& request);
    [[nodiscard]] Expected<PicturePtr> quick_card(const PreviewRequest& now,
                                                  const CardRequest& request,
                                                  const CancelToken& cancel);
    [[nodiscard]] bool grow_card(const PreviewRequest& now, const OpenedShot& of, Status& grown);
    [[nodiscard]] Status analyse_card(OpenedShot& of, const CardRequest& request,
                                      const CancelToken& cancel);
    [[nodiscard]] Expected<std::shared_ptr<const Shot>> open(const Project& project,
                                                             const PaintedMattes& painted);
    void note_written(const PreviewRequest& now);
    bool open_shot_of(const PreviewRequest& wanted, const std::string& pixels);
    bool render(const PreviewRequest& wanted, int frame, int factor);
    void keep(const PreviewRequest& wanted, int frame, PreviewFrame made, double seconds);
    void keep_provisional(const PreviewRequest& wanted, PreviewFrame made);
    bool step_provisional(const PreviewRequest& wanted);
    bool step_draft(const PreviewRequest& wanted);
    [[nodiscard]] std::vector<EarlierAnalysis> stand_ins(const OpenedShot& of) const;
    [[nodiscard]] Expected<ProvisionalFrame> provisional_of(const OpenedShot& of, int frame,
                                                            const CancelToken& cancel);
    bool shows_already(const PreviewRequest& wanted, const std::vector<bool>& shown);
    [[nodiscard]] Expected<PreviewFrame> quick_picture(const PreviewRequest& wanted, int factor,
                                                       const CancelToken& cancel);
    void release_analysis();
    void note_seam(int frame, float seam);
    void note_forms();
    void note_lights(int frame);
    [[nodiscard]] std::map<RegionId, Quad<float>> found_planes() const;
    [[nodiscard]] std::map<RegionId, std::shared_ptr<const SurfacePlaces>> places_on(int frame);
    bool grow(const OpenedShot& of);
    bool draw_overlay(const PreviewRequest& wanted);
    bool ready(int frame);
    [[nodiscard]] Expected<PreviewFrame> pictures_of(const Look& look, int frame, bool stages,
                                                     int factor, std::optional<LayerKind> layer,
                                                     float* seam);
    [[nodiscard]] Expected<PicturePtr> card_picture(const Look& look, const CardRequest& request);
    [[nodiscard]] PicturePtr picture_of(const Shot& shot, const ImageF3& pixels) const;
    [[nodiscard]] int factor_of(const Shot& shot, std::int64_t pixels) const;
    void set_state(PreviewView::State state, std::string error = {});

    // ---- the analysis thread (preview_analysis.cpp) ----
    void analyse_loop();
    void show_steps(const OpenedShot& work, int more);
    [[nodiscard]] int await_other(const OpenedPtr& work, const std::vector<int>& list, int total);
    void analyse(const OpenedPtr& opened, const std::vector<int>& frames, bool keep_walks,
                 const CancelToken& token);
    void propagate_to(const OpenedShot& opened, int frame, const CancelToken& token);
    void collect_confidence(const OpenedShot& opened);
    void collect_health(const OpenedShot& opened, const CancelToken& token);

    /// The open shot and the index of the region in it; null if it has none.
    [[nodiscard]] std::pair<OpenedPtr, std::size_t> find_opened(RegionId region) const;

    std::atomic<bool> render_paused = false;

    // Of the analysis being made, also what it takes from others, and `begun`, which was there.
    struct Round {
        int total = 0, done = 0, begun = 0;
        Clock::time_point start = Clock::now();
    };
    Round round;

    // State shared by the window's thread and the two workers.
    struct Shared {
        bool stop = false, paused = false;
        std::uint64_t signals = 0;
        // The request.
        std::optional<PreviewRequest> wanted;
        std::uint64_t document = 0;  // results of other documents are not reported
        std::string wanted_pixels, wanted_analysis;
        Clock::time_point refine_at;     // time to refine to full size
        Clock::time_point requested_at;  // of the first request for this content and frame
        bool first_shown = false;        // since then
        // The results.
        OpenedPtr opened;
        std::string failed_pixels;  // key of a project that could not be opened or rendered
        std::map<int, PreviewFrame> frames;
        // Of the frame `provisional_frame`; shown only while `frames` has no picture of it.
        std::optional<PreviewFrame> provisional;
        int provisional_frame = 0;
        std::size_t frame_bytes = 0;
        std::shared_ptr<const OverlayPicture> overlay;
        std::map<std::string, StripCard> cards;
        /// By region and layer.
        std::map<std::pair<RegionId, int>, std::map<int, float>> confidences;
        std::map<RegionId, std::map<int, FrameHealth>> healths;
        PreviewView shown;
        // The shot to analyse.
        OpenedPtr to_analyse;
        std::vector<int> analyse_frames, analyse_first;
        bool analysis_pending = false;
        // Until the first picture of every region, which it would slow down.
        bool analysis_held = false;
        std::uint64_t visits = 0;  // how often the analysis has passed the requested frame
        std::string analysing_key;
        CancelToken analysis_cancel, grow_cancel, draft_cancel, card_cancel;
    };
    void changed(Shared& of) { of.shown.changes = ++changes; }
    void begin_analysis(Shared& of, int frame, const std::vector<int>& range);
    // Measures how long the artist has waited.
    void note_first(Shared& of, int frame);
    void signal(Shared& of) {
        ++of.signals;
        wake.notify_all();
    }

    const AnalysisCacheOptions cache;
    const std::shared_ptr<Fingerprints> files;
    const std::string texture_library;
    const std::size_t budget_bytes;
    const std::shared_ptr<const Backend> backend;

    // To the frame shown: a pin or another reference walks much of the way there again.
    static constexpr std::size_t kWalkBytes = std::size_t{512} << 20;
    const std::shared_ptr<WalkMemory> walks = std::make_shared<WalkMemory>(kWalkBytes);

    Guarded<Shared> guarded;
    std::condition_variable wake;  // uses the lock of `guarded`
    std::atomic<std::uint64_t> mattes = 0, changes = 0;

    // Used by the rendering thread only.
    OpenedPtr current;        // Shared::opened, which only this thread sets
    std::string overlay_key;  // key of the drawn overlay
    PreviewScenes scenes;
    OverlayMaker overlays;
    std::set<int> ready_frames;
    std::set<int> compared;   // frames whose flicker was measured
    std::string noted_forms;  // key of the shot whose forms were noted
    bool refine_pending = false;
    std::string tried_provisional;          // key of the last provisional picture that was tried
    std::vector<bool> shown_provisionally;  // its regions
    std::optional<KeptProvisional> kept_provisional;
    OpenedPtr settled;  // the last one of the same plate whose analysis had come to an end
    std::unique_ptr<const DraftAnalysis> draft;
    std::string draft_of, tried_draft;  // its analysis; with its frame the last one that was tried
    OpenedPtr unwritten;                // opened while its mattes were not on disk
    std::shared_ptr<const ColorTransform> srgb_from_out, linear_from_out;
    std::shared_ptr<const CachedReader> reader;  // reads the plate `reader_of`
    Plate reader_of;
    std::unique_ptr<ProxyPlates> proxies;
    const std::shared_ptr<VisibilityCache> visibility = std::make_shared<VisibilityCache>();
    // for cards that the picture's analysis does not serve
    std::shared_ptr<AnalysisCache> card_store;
    std::string card_analysis;
    // by CardRequest::key, with Shared::visits at that time
    std::map<std::string, std::uint64_t> tried_cards;

    MattePropagator propagator;
    std::thread renderer, analyser;
};

}  // namespace weft
