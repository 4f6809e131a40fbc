#pragma once
// What walks along surfaces found, kept for walks over the same frames again.

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "engine/core/hash.h"
#include "engine/pipeline/surface_track.h"

namespace weft {

/// A pin, or another reference, changes where a walk leads from its frame on. It changes nothing of
/// the walk up to there, and not what two neighbouring frames say of the step between them, which
/// takes most of the time. Both are named by the content of all that they depend on, so none is
/// ever stale. What was not used for the longest time goes first. Thread-safe.
class WalkMemory {
  public:
    /// `most_bytes`: as estimated from the sizes of frames and lattices.
    explicit WalkMemory(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    [[nodiscard]] std::optional<WalkStep> find_step(const Hash128& key);
    /// `frame`, `previous`: the numbers of the frames.
    void keep_step(const Hash128& key, int frame, int previous, const WalkStep& step);
    /// Whether steps between the two frames are kept: likely the next one is, too.
    [[nodiscard]] bool expects(int frame, int previous) const;

    /// A walk as it was after a step; null if it is not kept.
    [[nodiscard]] std::shared_ptr<const SurfaceTrack> find_track(const Hash128& key);
    void keep_track(const Hash128& key, std::shared_ptr<const SurfaceTrack> track);

    /// How often anything was found.
    [[nodiscard]] int times_found() const;

  private:
    struct Step {
        WalkStep step;
        std::pair<int, int> frames;
    };
    struct Kept {
        Hash128 key;
        std::variant<Step, std::shared_ptr<const SurfaceTrack>> what;
        std::size_t bytes = 0;
    };

    const Kept* use(const Hash128& key);
    void add(Kept kept);
    void drop_oldest();

    mutable std::mutex mutex_;
    std::list<Kept> kept_;  // the one that was used last in front
    std::map<Hash128, std::list<Kept>::iterator> by_key_;
    std::multiset<std::pair<int, int>> frames_;  // of the steps
    const std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    int times_found_ = 0;
};

}  // namespace weft
