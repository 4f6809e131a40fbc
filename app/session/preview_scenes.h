#pragma once
// Internal to the preview: the regions made ready for rendering, kept from one request to the next.

#include <string>
#include <vector>

#include "app/session/shot.h"
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
    [[nodiscard]] const std::vector<RegionScene>& scenes() const { return scenes_; }

  private:
    struct Keys {
        std::string exact;    // all that the scene depends on
        std::string texture;  // the same but for the size of its plane
        bool operator==(const Keys&) const = default;
    };
    [[nodiscard]] static std::vector<Keys> keys_of(const Shot& shot, const std::string& analysis);

    std::vector<RegionScene> scenes_;
    std::vector<Keys> keys_;
    bool exact_ = false;
};

}  // namespace weft
