#pragma once
// A shot looked at smaller: the same analysis and the same render_frame at a fraction of the
// pixels, for a first answer within a second.

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "app/shot/shot.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// By how much a plate is to be shrunk (1, 2, 4 or 8) so that it has at most about `pixels`.
[[nodiscard]] int proxy_factor(Size plate, std::int64_t pixels);

/// Means over blocks of factor × factor; the last row and column may be of smaller blocks.
[[nodiscard]] ImageF3 shrunk(const ImageF3& picture, int factor);
[[nodiscard]] Matte shrunk(const Matte& matte, int factor);
/// The same field over a frame 1/factor as large; its spacing must be a multiple of `factor`.
[[nodiscard]] LatticeField shrunk(const LatticeField& field, int factor);
[[nodiscard]] Shading shrunk(const Shading& shading, int factor);

/// Shrunk plates of one reader, kept within a budget. Thread-safe.
class ProxyPlates {
  public:
    explicit ProxyPlates(std::size_t budget_bytes) : budget_bytes_(budget_bytes) {}
    [[nodiscard]] Expected<std::shared_ptr<const ImageF3>> plate(const ShotSource& source,
                                                                 int frame, int factor);

  private:
    const std::size_t budget_bytes_;
    std::mutex mutex_;
    std::map<std::pair<int, int>, std::shared_ptr<const ImageF3>> kept_;  // by factor and frame
    std::size_t bytes_ = 0;
};

/// What render_frame() needs to render a shot at 1/factor. Grain, focus and shutter are left out:
/// they are of full size by nature. Refers to the shot, the store and the plates, which must
/// outlive it. Immutable once made.
class ProxyShot {
  public:
    /// Whether every region's mode can be shown smaller; the others make a picture of full size.
    [[nodiscard]] static bool possible(const Shot& shot);
    ProxyShot(const Shot& shot, const AnalysisStore& store, ProxyPlates& plates, int factor);
    ~ProxyShot();
    [[nodiscard]] const ShotSource& source() const { return *source_; }
    [[nodiscard]] const AnalysisStore& store() const { return *store_; }
    [[nodiscard]] const ShotPlan& plan() const { return plan_; }

  private:
    ShotPlan plan_;
    std::unique_ptr<ShotSource> source_;
    std::unique_ptr<AnalysisStore> store_;
};

/// The scenes as a proxy needs them. Their planes are those of `scenes`, shared; seams between
/// tracks, which are of full size, are left out.
[[nodiscard]] std::vector<RegionScene> proxy_scenes(const std::vector<RegionScene>& scenes,
                                                    int factor);

}  // namespace weft
