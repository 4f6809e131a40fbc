#pragma once
// Internal to the preview: prepared regions, kept between requests.

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Not thread-safe; belongs to the preview's rendering thread.
class PreviewScenes {
  public:
    /// Adapts the scenes to the shot without synthesis, so that a placement can be dragged: planes
    /// made for another scale are reused. Returns false if some texture was never synthesized.
    [[nodiscard]] bool adopt(const Shot& shot, const std::string& analysis);
    /// Returns true if the scenes are exactly those of a render.
    [[nodiscard]] bool exact() const { return exact_; }
    /// Prepares one scene that is missing or inexact. Errors: those of synthesis, and cancellation.
    [[nodiscard]] Status grow_one(const Shot& shot, const AnalysisStore& store,
                                  const std::string& analysis, const CancelToken& cancel);
    [[nodiscard]] std::vector<RegionScene>& scenes() { return scenes_; }

    /// Scenes for a first picture of one frame, of the regions that are `shown`; the others are
    /// empty. Where the plane is not there, a quick one is synthesized: not refined, and as large
    /// as what the frame shows, but of at most about `texels`; beyond that it repeats. `plan` and
    /// `store` may be those of a ProvisionalFrame of the shot. Does not change scenes(). Errors: as
    /// for grow_one().
    [[nodiscard]] Expected<std::vector<RegionScene>> quick(const Shot& shot, const ShotPlan& plan,
                                                           const AnalysisStore& store, int frame,
                                                           const std::vector<bool>& shown,
                                                           std::int64_t texels,
                                                           const CancelToken& cancel);

  private:
    // Unused scenes are kept for a while, because artists switch between settings and cards
    // alternate with the picture.
    static constexpr std::size_t kBankBytes = std::size_t{300} << 20;
    struct Keys {
        std::string exact;    // key of everything that the scene depends on
        std::string texture;  // the same without the plane's size
        std::string plane;    // key of everything that the plane depends on
        bool operator==(const Keys&) const = default;
    };
    struct Kept {
        Keys keys;
        RegionScene scene;
    };
    struct KeptPlane {
        std::string key;
        RegionPlane plane;
    };
    [[nodiscard]] static std::vector<Keys> keys_of(const Shot& shot, const std::string& analysis);
    // The plane of a scene that is kept, whatever its light.
    [[nodiscard]] std::optional<RegionPlane> kept_plane(const std::string& plane_key) const;
    [[nodiscard]] Expected<RegionPlane> quick_plane(const ShotPlan& plan, std::size_t index,
                                                    const std::string& plane_key, Size shown,
                                                    const CancelToken& cancel);
    void trim();

    std::vector<RegionScene> scenes_;
    std::vector<Keys> keys_;
    std::list<Kept> bank_;             // most recently used first
    std::list<KeptPlane> quick_bank_;  // likewise
    bool exact_ = false;
};

}  // namespace weft
