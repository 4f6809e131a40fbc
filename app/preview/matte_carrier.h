#pragma once
// Carries painted mattes to the other frames of regions that have no texture yet, so that they are
// there when a texture is chosen.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "app/base/latest_worker.h"
#include "app/cache/analysis_cache.h"
#include "app/project/project.h"
#include "app/shot/painted_mattes.h"
#include "app/shot/shot.h"

namespace weft {

/// Stores the mattes where the analysis of the region looks for them once it has a texture. The
/// newest call wins. carry(), pause(), resume() and clear() are for one thread and never wait.
class MatteCarrier {
  public:
    /// `files`: as OpenShotOptions has it.
    explicit MatteCarrier(AnalysisCacheOptions cache, std::shared_ptr<Fingerprints> files = nullptr)
        : cache_(std::move(cache)), files_(std::move(files)) {}

    /// Carries the painted mattes of the enabled regions; `project` as in PreviewRequest, except
    /// that textures are not needed. Mattes between the keyframes around `frame` come first.
    /// Repeating a call does nothing. Failures are not reported: the analysis will meet them too.
    void carry(const Project& project, const PaintedMattes& painted, int frame);
    void pause();
    void resume();
    void clear();
    /// A carried matte (`layer` 0) or holdout; between two keyframes at first as it comes from the
    /// one before. Thread-safe, slow. Error: not carried yet.
    [[nodiscard]] Expected<Matte> matte(RegionId region, int layer, int frame) const;
    /// Increases when mattes may have been carried. Thread-safe.
    [[nodiscard]] std::uint64_t changes() const { return changes_.load(); }

  private:
    struct Carried {
        std::shared_ptr<const Shot> shot;
        std::shared_ptr<AnalysisCache> store;
        std::uint64_t serial = 0;  // of the Asked
    };
    struct Asked {
        std::uint64_t serial = 0;
        std::string key;
        Project project;
        PaintedMattes painted;
        int frame = 0;
    };
    void start();
    void work(const Asked& asked, const CancelToken& cancel);

    const AnalysisCacheOptions cache_;
    const std::shared_ptr<Fingerprints> files_;
    std::shared_ptr<const Asked> asked_;  // null: nothing to carry
    bool paused_ = false;
    std::atomic<std::uint64_t> changes_{0};
    std::atomic<std::uint64_t> serial_{0};  // of what was asked last: older mattes are not shown
    Published<Carried> carried_;
    LatestWorker<std::string, bool> worker_;  // destroyed first
};

}  // namespace weft
