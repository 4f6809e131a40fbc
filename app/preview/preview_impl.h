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
#include "app/preview/preview.h"
#include "app/preview/preview_overlay.h"
#include "app/preview/preview_scenes.h"
#include "app/preview/proxy_shot.h"
#include "app/shot/shot.h"
#include "engine/compute/backend.h"
#include "engine/core/cancel.h"

namespace weft {

/// An opened project.
struct OpenedShot {
    std::shared_ptr<const Shot> shot;
    std::shared_ptr<AnalysisCache> store;
    std::string pixels, analysis;  ///< Keys of the opened project.
};
using OpenedPtr = std::shared_ptr<const OpenedShot>;

/// Number of frames that must still be analysed for these frames.
[[nodiscard]] int steps_to(const OpenedShot& opened, std::vector<int> frames);

/// The layer number under which the analysis stores the matte of a layer (matte_layer.h): painted
/// holdouts are counted among themselves. Nothing: not stored.
[[nodiscard]] std::optional<int> stored_layer(const Region& region, int layer);

/// The track of a region's texture, before_from_now, in plate pixels. Error: not analysed, or the
/// region's mode has no track.
[[nodiscard]] Expected<LatticeField> track_between(const OpenedShot& opened, std::size_t region,
                                                   int before, int now);

struct Preview::Impl {
    using Clock = std::chrono::steady_clock;

    Impl(AnalysisCacheOptions cache_options, std::string library, std::size_t budget);
    ~Impl();

    // ---- the rendering thread (preview_render.cpp, preview_cards.cpp) ----
    void render_loop();
    bool step();
    bool step_frame(const PreviewRequest& now);
    bool step_fill(const PreviewRequest& now, const std::string& pixels);
    bool step_flicker(const PreviewRequest& now);
    bool step_card(const PreviewRequest& now);
    [[nodiscard]] Status analyse_card(OpenedShot& of, const CardRequest& request,
                                      const CancelToken& cancel);
    [[nodiscard]] Expected<std::shared_ptr<const Shot>> open(const Project& project,
                                                             const PaintedMattes& painted);
    void note_written(const PreviewRequest& now);
    bool open_shot_of(const PreviewRequest& wanted, const std::string& pixels);
    bool render(const PreviewRequest& wanted, int frame, int factor);
    void keep(const PreviewRequest& wanted, int frame, PreviewFrame made, double seconds);
    bool grow(const OpenedShot& of);
    bool draw_overlay(const PreviewRequest& wanted);
    bool ready(int frame);
    [[nodiscard]] Expected<PreviewFrame> pictures_of(int frame, bool stages, int factor,
                                                     std::optional<LayerKind> layer);
    [[nodiscard]] Expected<PicturePtr> card_picture(const OpenedShot& of,
                                                    const CardRequest& request);
    [[nodiscard]] PicturePtr picture_of(const Shot& shot, const ImageF3& pixels) const;
    [[nodiscard]] int factor_of(const Shot& shot, std::int64_t pixels) const;
    void set_state(PreviewView::State state, std::string error = {});

    // ---- the analysis thread (preview_analysis.cpp) ----
    void analyse_loop();
    void analyse(const OpenedPtr& opened, const std::vector<int>& frames, const CancelToken& token);
    void collect_confidence(const OpenedShot& opened);
    void collect_health(const OpenedShot& opened, const CancelToken& token);

    /// The open shot and the index of the region in it; null if it has none.
    [[nodiscard]] std::pair<OpenedPtr, std::size_t> find_opened(RegionId region) const;

    // State shared by the window's thread and the two workers.
    struct Shared {
        bool stop = false, paused = false;
        std::uint64_t signals = 0;
        // The request.
        std::optional<PreviewRequest> wanted;
        std::string wanted_pixels, wanted_analysis;
        Clock::time_point refine_at;  // time to refine to full size
        // The results.
        OpenedPtr opened;
        std::string failed_pixels;  // key of a project that could not be opened or rendered
        std::map<int, PreviewFrame> frames;
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
        std::string analysing_key;
        CancelToken analysis_cancel, grow_cancel, card_cancel;
    };
    void changed(Shared& of) { of.shown.changes = ++changes; }
    void signal(Shared& of) {
        ++of.signals;
        wake.notify_all();
    }

    const AnalysisCacheOptions cache;
    const std::string texture_library;
    const std::size_t budget_bytes;
    const std::shared_ptr<const Backend> backend;

    Guarded<Shared> guarded;
    std::condition_variable wake;  // uses the lock of `guarded`
    std::atomic<std::uint64_t> mattes = 0, changes = 0;

    // Used by the rendering thread only.
    OpenedPtr current;        // Shared::opened, which only this thread sets
    std::string overlay_key;  // key of the drawn overlay
    PreviewScenes scenes;
    OverlayMaker overlays;
    std::set<int> ready_frames;
    std::set<int> compared;  // frames whose flicker was measured
    bool refine_pending = false;
    OpenedPtr unwritten;  // opened while its mattes were not on disk
    std::shared_ptr<const ColorTransform> srgb_from_out, linear_from_out;
    std::shared_ptr<const CachedReader> reader;  // reads the plate `reader_of`
    Plate reader_of;
    std::unique_ptr<ProxyPlates> proxies;
    const std::shared_ptr<VisibilityCache> visibility = std::make_shared<VisibilityCache>();
    // for cards that the picture's analysis does not serve
    std::shared_ptr<AnalysisCache> card_store;
    std::string card_analysis;

    std::thread renderer, analyser;
};

}  // namespace weft
