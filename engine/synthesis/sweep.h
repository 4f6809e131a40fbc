#pragma once
// The first sweep: placements in scanline order until every texel is filled.

#include <chrono>
#include <optional>
#include <unordered_set>
#include <vector>

#include "engine/core/rng.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/patch_seam.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// One axis of the placements. A block starts `overlap` before the first unfilled pixel and the
/// sample's window may lie on it at t ∈ [lo, hi], so that it reaches back over what is there by
/// min_overlap … overlap and fills all but `hi` px of the rest.
struct SweepAxis {
    int overlap = 0, min_overlap = 0;
    int block = 0;
    int window = 0;  ///< Of a larger sample only a window takes part in one search.
    int lo = 0, hi = 0;
    std::vector<int> window_starts;
};

/// `plane_px` bounds the block on a torus, which must not meet itself. `overlap_px` is clamped to
/// half the sample.
[[nodiscard]] SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px);

/// Adds up the wall-clock time that a scope takes.
class StageTimer {
  public:
    explicit StageTimer(double& total_s) : total_s_(total_s) {}
    ~StageTimer() {
        total_s_ +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    double& total_s_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Grows one canvas. Not thread-safe.
class Sweep {
  public:
    Sweep(ViewU8x3 sample, const PlaneOptions& options, Canvas& canvas, PlaneStats& stats);

    /// Lays one patch over the first unfilled pixel. False when there is none.
    bool step();

  private:
    // One placement that was found: the whole sample's origin on the canvas.
    struct Choice {
        Block block;
        Vec2i origin{0, 0};
        Recti window;  ///< The part of the sample that was searched.
    };
    struct GuideBlock {
        ImageU8x3 pixels;
        Image<std::uint8_t, 1> known;
    };

    [[nodiscard]] Choice choose(Vec2i first_unfilled, Rng& rng);
    [[nodiscard]] Block next_block(Vec2i first_unfilled) const;
    [[nodiscard]] GuideBlock copy_guide(const Recti& rect) const;
    [[nodiscard]] std::vector<Vec2i> forbidden(const Block& block, Vec2i to_canvas) const;
    [[nodiscard]] std::vector<Vec2i> congruent(Vec2i to_canvas) const;
    [[nodiscard]] Vec2i pick(const Shortlist& list, Vec2i to_canvas, Rng& rng) const;
    [[nodiscard]] bool repeats_a_step(Vec2i origin) const;
    void remember(Vec2i origin);

    ViewU8x3 sample_;
    const PlaneOptions& options_;
    Canvas& canvas_;
    PlaneStats& stats_;
    SweepAxis x_, y_;
    std::vector<std::optional<PlacementSearch>> searches_;  ///< One for each window.
    std::vector<Vec2i> origins_;              ///< Where the whole sample's origin was laid.
    std::unordered_set<std::int64_t> steps_;  ///< From a placement to its neighbours.
};

}  // namespace weft
