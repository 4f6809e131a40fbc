#pragma once
// Carries painted mattes to the other frames of regions that have no texture yet, so that they are
// there when a texture is chosen.

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/cache/analysis_cache.h"
#include "app/project/project.h"
#include "app/shot/painted_mattes.h"
#include "app/shot/shot.h"

namespace weft {

struct WantedMatte;

/// Stores the mattes where the analysis of the region looks for them once it has a texture. The
/// newest call wins. propagate(), pause(), resume() and clear() are for one thread and never wait.
class MattePropagator {
  public:
    /// `files`: as OpenShotOptions has it.
    explicit MattePropagator(AnalysisCacheOptions cache,
                             std::shared_ptr<Fingerprints> files = nullptr)
        : cache_(std::move(cache)), files_(std::move(files)) {}

    /// Carries the painted mattes of the enabled regions; `project` as in PreviewRequest, except
    /// that textures are not needed. Mattes between the keyframes around `frame` come first.
    /// Repeating a call does nothing. Failures are not reported: the analysis will meet them too.
    void propagate(const Project& project, const PaintedMattes& painted, int frame);
    void pause();
    void resume();
    void clear();
    /// Thread-safe, slow. Error: as Preview::propagated_matte() has it.
    [[nodiscard]] Expected<Matte> matte(const WantedMatte& wanted) const;
    /// As Preview has it. Thread-safe, slow.
    [[nodiscard]] std::vector<int> reached(const WantedMatte& wanted) const;
    /// Increases when mattes may have been propagated. Thread-safe.
    [[nodiscard]] std::uint64_t changes() const { return changes_.load(); }

  private:
    struct Propagated {
        std::shared_ptr<const Shot> shot;
        std::shared_ptr<AnalysisCache> store;
        std::uint64_t document = 0;
        Project asked;
    };
    struct Asked {
        std::uint64_t document = 0;
        std::string key;
        Project project;
        PaintedMattes painted;
        int frame = 0;
    };
    void start();
    void work(const Asked& asked, const CancelToken& cancel);

    const AnalysisCacheOptions cache_;
    const std::shared_ptr<Fingerprints> files_;
    std::shared_ptr<const Asked> asked_;  // null: nothing to propagate
    bool paused_ = false;
    std::atomic<std::uint64_t> changes_{0};
    std::atomic<std::uint64_t> document_{0};  // how many there were: mattes of others are not shown
    Published<Propagated> propagated_;
    LatestWorker<std::string, bool> worker_;  // destroyed first
};

}  // namespace weft
