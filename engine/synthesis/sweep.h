#pragma once
// The first sweep: placements row by row until every texel is filled.

#include <atomic>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/core/rng.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/device_search.h"
#include "engine/synthesis/patch_seam.h"
#include "engine/synthesis/placement_memory.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/plane_structure.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/sweep_axis.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Grows one canvas. The plane is divided into bands that every patch fills over their full height.
/// In each band the next patch covers the leftmost unfilled column and reaches back over the filled
/// texels to its left and above. A patch sees the bands above only where they are finished beyond
/// its reach, so several bands can grow at once with the result of growing one after another.
class Sweep {
  public:
    /// `device` belongs to the canvas and is updated with every patch.
    Sweep(const SampleAtlas& atlas, const PlaneOptions& options, const PlaneStructure& structure,
          Canvas& canvas, DeviceSearch& device);
    ~Sweep();

    /// Fills the canvas with up to thread_count() threads; false if cancelled. Adds to the stage
    /// times (shares of the wall clock), placements and peak bytes.
    [[nodiscard]] bool run(PlaneStats& stats, const CancelToken& cancel,
                           const ProgressFn& progress);

    /// Lays the same patches in the same order into an empty canvas, with another ε of the
    /// gradient-normalised cost. False if cancelled. Adds to the peak bytes only.
    [[nodiscard]] bool cut_again(Canvas& canvas, float gradient_floor, PlaneStats& stats,
                                 const CancelToken& cancel);

    /// The lattice that all patches lie on; empty where there is none, or patches are too small.
    [[nodiscard]] const PlaneLattice& lattice() const { return lattice_; }

  private:
    // A window of a page that one search covers.
    struct Place {
        std::size_t page = 0;
        Recti window;  ///< In the atlas.
        const SweepAxis *x = nullptr, *y = nullptr;
        std::unique_ptr<PlacementSearch> search;
    };
    struct Band {
        int y0 = 0, y1 = 0;
        int block_y0 = 0;
        std::vector<Placed> placed;  ///< Never reallocated while the sweep runs.
        std::atomic<int> count{0};
        /// This band no longer reads or writes left of it.
        std::atomic<int> done_x{std::numeric_limits<int>::min()};
        double search_s = 0, seam_s = 0, busy_s = 0;
        std::size_t peak_bytes = 0;
    };
    struct GuideBlock {
        ImageU8x3 pixels;
        Image<std::uint8_t, 1> known;
    };
    // One placement that was found.
    struct Choice {
        Block block;
        Vec2i origin{0, 0};
        Recti window;  ///< On the canvas.
    };

    void make_axes();
    void make_places();
    void make_bands();
    void grow_band(std::size_t index);
    [[nodiscard]] bool column_filled(const Band& band, int x) const;
    void lay_band_again(std::size_t index, Canvas& canvas, float gradient_floor);
    template <class GrowBand>
    void for_each_band(GrowBand grow);
    void wait_for(std::size_t index, int x);
    int lay(std::size_t index, int x);
    [[nodiscard]] Choice choose(std::size_t index, int x, Rng& rng);
    [[nodiscard]] Shortlist find(const Place& place, const Block& block,
                                 const PlacementMemory& earlier);
    [[nodiscard]] Block next_block(const Band& band, int x) const;
    [[nodiscard]] GuideBlock copy_guide(const Recti& rect) const;
    [[nodiscard]] PlacementMemory memory(std::size_t index, const Recti& block) const;
    [[nodiscard]] std::vector<Vec2i> forbidden(const Block& block, Vec2i to_canvas,
                                               const PlacementMemory& memory) const;
    void forbid_off_lattice(Vec2i to_canvas, Image<std::uint8_t, 1>& bad) const;
    void forbid_misaligned(const Recti& block, Vec2i to_canvas, const PlacementMemory& memory,
                           Image<std::uint8_t, 1>& bad) const;
    void forbid_thin_contacts(const Block& block, Image<std::uint8_t, 1>& bad) const;

    const SampleAtlas& atlas_;
    const PlaneOptions& options_;
    Canvas& canvas_;
    DeviceSearch& device_;
    PlaneLattice lattice_;
    TexturePeriod period_;  ///< Without a lattice.
    SweepAxis x_, y_;       ///< Of the smallest page; all others fit it.
    std::vector<Place> places_;
    std::deque<Band> bands_;
    std::atomic<bool> stopped_{false};
    const CancelToken* cancel_ = nullptr;
};

}  // namespace weft
