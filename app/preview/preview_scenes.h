#pragma once
// Internal to the preview: prepared regions, kept between requests.

#include <list>
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

  private:
    // Unused scenes are kept for a while, because artists switch between settings and cards
    // alternate with the picture.
    static constexpr std::size_t kBankBytes = std::size_t{300} << 20;
    struct Keys {
        std::string exact;    // key of everything that the scene depends on
        std::string texture;  // the same without the plane's size
        bool operator==(const Keys&) const = default;
    };
    struct Kept {
        Keys keys;
        RegionScene scene;
    };
    [[nodiscard]] static std::vector<Keys> keys_of(const Shot& shot, const std::string& analysis);
    void trim();

    std::vector<RegionScene> scenes_;
    std::vector<Keys> keys_;
    std::list<Kept> bank_;  // most recently used first
    bool exact_ = false;
};

}  // namespace weft
