#pragma once
// Internal to the preview: what its two threads share.

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

/// A project opened for work.
struct OpenedShot {
    std::shared_ptr<const Shot> shot;
    std::shared_ptr<AnalysisCache> store;
    std::string pixels, analysis;  ///< The keys of what was opened.
};
using OpenedPtr = std::shared_ptr<const OpenedShot>;

/// Frames of analysis still to be done for these frames.
[[nodiscard]] int steps_to(const OpenedShot& opened, std::vector<int> frames);

/// The layer under which the analysis keeps a matte (0) or the holdout `layer` − 1: it counts the
/// painted ones. Below 0: there is none.
[[nodiscard]] int stored_layer(const Region& region, int layer);

/// How a region's texture was carried: before_from_now, in plate pixels. Error: not analysed, or
/// nothing is carried in the region's mode.
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

    // ---- the analysing thread (preview_analysis.cpp) ----
    void analyse_loop();
    void analyse(const OpenedPtr& opened, const std::vector<int>& frames, const CancelToken& token);
    void collect_confidence(const OpenedShot& opened);
    void collect_health(const OpenedShot& opened, const CancelToken& token);

    /// The shot that is open and the region's place in it; null when it has none.
    [[nodiscard]] std::pair<OpenedPtr, std::size_t> find_opened(RegionId region) const;

    // What the window's thread and the two workers share.
    struct Shared {
        bool stop = false, paused = false;
        std::uint64_t signals = 0;
        // What is wanted.
        std::optional<PreviewRequest> wanted;
        std::string wanted_pixels, wanted_analysis;
        Clock::time_point refine_at;  // when there is time for full size
        // What there is.
        OpenedPtr opened;
        std::string failed_pixels;  // what could not be opened or rendered
        std::map<int, PreviewFrame> frames;
        std::size_t frame_bytes = 0;
        std::shared_ptr<const OverlayPicture> overlay;
        std::map<std::string, StripCard> cards;
        /// By region and layer.
        std::map<std::pair<RegionId, int>, std::map<int, float>> confidences;
        std::map<RegionId, std::map<int, FrameHealth>> healths;
        PreviewView shown;
        // What is to be analysed.
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
    std::condition_variable wake;  // with the lock of `guarded`
    std::atomic<std::uint64_t> mattes = 0, changes = 0;

    // Of the rendering thread alone.
    OpenedPtr current;        // as Shared::opened, which only this thread sets
    std::string overlay_key;  // what the overlay was drawn for
    PreviewScenes scenes;
    OverlayMaker overlays;
    std::set<int> ready_frames;
    std::set<int> compared;  // frames whose flicker was looked at
    bool refine_pending = false;
    OpenedPtr unwritten;  // was opened with mattes that were not on the disk
    std::shared_ptr<const ColorTransform> srgb_from_out, linear_from_out;
    std::shared_ptr<const CachedReader> reader;  // of the plate `reader_of`
    Plate reader_of;
    std::unique_ptr<ProxyPlates> proxies;
    const std::shared_ptr<VisibilityCache> visibility = std::make_shared<VisibilityCache>();
    std::shared_ptr<AnalysisCache> card_store;  // of cards that the picture's does not serve
    std::string card_analysis;

    std::thread renderer, analyser;
};

}  // namespace weft
