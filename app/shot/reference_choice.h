#pragma once
// Which frame a region's texture is placed on when nobody has said.

#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "app/project/project.h"
#include "app/shot/painted_mattes.h"
#include "engine/core/hash.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Scores of mattes that were looked at before, by file and time stamp. Thread-safe.
class VisibilityCache {
  public:
    [[nodiscard]] std::optional<double> find(const Hash128& files) const;
    void keep(const Hash128& files, double score);
    [[nodiscard]] std::size_t size() const;

  private:
    mutable std::mutex mutex_;
    std::map<Hash128, double> scores_;
};

/// Where mattes are looked at, beside their files. Both may be null.
struct MatteLooks {
    MatteLooks(VisibilityCache* known = nullptr,  // NOLINT(google-explicit-constructor)
               const PaintedMattes* unwritten = nullptr)
        : memory(known), painted(unwritten) {}
    VisibilityCache* memory;
    const PaintedMattes* painted;
};

struct ReferenceChoice {
    int frame = 0;
    int first = 0;      ///< The first frame that has a matte.
    bool shown = true;  ///< False: no frame that was looked at shows the surface.
};

/// Frames to choose from, both included.
struct ReferenceRange {
    int first = std::numeric_limits<int>::min(), last = std::numeric_limits<int>::max();
};

/// The first frame, or the first painted one, unless the surface shows much better later
/// (first_well_shown()): judged by mattes and holdouts on nine frames of the range, on up to 33 if
/// the first is no good, and on up to 257 while all are empty. It depends on the files alone, not
/// on the frames to render, so every part of a shot on every machine has the same reference.
/// Errors: those of the patterns; MissingFrames when no frame of the plate
/// has a matte.
[[nodiscard]] Expected<ReferenceChoice> choose_reference(const Region& region,
                                                         const FrameReader& plate,
                                                         const MatteLooks& looks,
                                                         ReferenceRange range = {});

/// Returns true if the matte of files on this frame, less its holdouts, is empty. False for painted
/// mattes and for files that cannot be read.
[[nodiscard]] bool shows_nothing(const Region& region, const FrameReader& plate, int frame,
                                 const MatteLooks& looks);

}  // namespace weft
