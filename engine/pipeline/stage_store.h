#pragma once
// Storage for results that do not depend on the order of frames: planes and motion.

#include <optional>

#include "engine/core/fields.h"
#include "engine/core/hash.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Thread-safe. Neither function fails: what cannot be stored is computed again.
class StageStore {
  public:
    virtual ~StageStore() = default;
    [[nodiscard]] virtual std::optional<TexturePlane> plane(const Hash128& key) const = 0;
    virtual void keep_plane(const Hash128& key, const TexturePlane& plane) = 0;
    /// The estimated motion prev_from_cur with its consistency, if it is stored.
    [[nodiscard]] virtual std::optional<FlowField> motion(int current, int previous) const = 0;
    virtual void keep_motion(int current, int previous, const FlowField& motion) = 0;
};

/// Hash of all that a grown plane depends on. The backend is left out: it does not change the
/// plane.
[[nodiscard]] Hash128 plane_key(const std::vector<ImageU8x3>& samples, const PlaneOptions& options);

}  // namespace weft
