#pragma once
// Chooses the default reference frame of a region.

#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "app/project/project.h"
#include "app/shot/painted_mattes.h"
#include "engine/core/geometry.h"
#include "engine/core/hash.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Caches visibility scores of mattes by file and time stamp. Thread-safe.
class VisibilityCache {
  public:
    [[nodiscard]] std::optional<double> find(const Hash128& files) const;
    void keep(const Hash128& files, double score);
    [[nodiscard]] std::size_t size() const;

  private:
    mutable std::mutex mutex_;
    std::map<Hash128, double> scores_;
};

/// Helpers for reading mattes. Both may be null.
struct MatteLooks {
    MatteLooks(VisibilityCache* known = nullptr,  // NOLINT(google-explicit-constructor)
               const PaintedMattes* unwritten = nullptr)
        : memory(known), painted(unwritten) {}
    VisibilityCache* memory;
    const PaintedMattes* painted;
};

struct ReferenceChoice {
    int frame = 0;
    int first = 0;      ///< First frame with a matte.
    bool shown = true;  ///< False: the surface is visible on no examined frame.
};

/// Range of frames to choose from, inclusive.
struct ReferenceRange {
    int first = std::numeric_limits<int>::min(), last = std::numeric_limits<int>::max();
};

/// Returns the first frame, or the first painted one, unless the surface is much more visible later
/// (first_well_shown()). Examines mattes and holdouts on nine frames of the range, on up to 33 if
/// the first is unsuitable, and on up to 257 while all are empty. The choice depends only on the
/// files, not on the frames to render, so all parts of a shot use the same reference on every
/// machine. Errors: those of the patterns; MissingFrames when no frame of the plate has a matte.
[[nodiscard]] Expected<ReferenceChoice> choose_reference(const Region& region,
                                                         const FrameReader& plate,
                                                         const MatteLooks& looks,
                                                         ReferenceRange range = {});

/// The box of the matte on a frame, without its holdouts: where the surface could be seen. The
/// whole picture where the matte is not a file or cannot be read.
[[nodiscard]] Recti surface_box(const Region& region, const FrameReader& plate, int frame,
                                const MatteLooks& looks);

/// Returns true if the matte minus its holdouts is empty on this frame. Returns false for painted
/// mattes and for files that cannot be read.
[[nodiscard]] bool shows_nothing(const Region& region, const FrameReader& plate, int frame,
                                 const MatteLooks& looks);

}  // namespace weft
