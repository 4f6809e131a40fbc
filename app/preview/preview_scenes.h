#pragma once
// Internal to the preview: the regions made ready for rendering, kept from one request to the next.

#include <list>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Not thread-safe: belongs to the preview's rendering thread.
class PreviewScenes {
  public:
    /// Makes the scenes fit the shot without growing anything, so that a placement can be dragged:
    /// planes grown for another scale are placed anew. False when some texture was never grown.
    [[nodiscard]] bool adopt(const Shot& shot, const std::string& analysis);
    /// The scenes are exactly those that a render would make.
    [[nodiscard]] bool exact() const { return exact_; }
    /// Makes one scene that is missing or not exact. Errors: those of growing, and cancellation.
    [[nodiscard]] Status grow_one(const Shot& shot, const AnalysisStore& store,
                                  const std::string& analysis, const CancelToken& cancel);
    [[nodiscard]] std::vector<RegionScene>& scenes() { return scenes_; }

  private:
    // Scenes that are not needed just now are kept for a while: one goes back and forth between
    // settings, and the cards of a strip take turns with the picture.
    static constexpr std::size_t kBankBytes = std::size_t{300} << 20;
    struct Keys {
        std::string exact;    // all that the scene depends on
        std::string texture;  // the same but for the size of its plane
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
    std::list<Kept> bank_;  // the latest used first
    bool exact_ = false;
};

}  // namespace weft
