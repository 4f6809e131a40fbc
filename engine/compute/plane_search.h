#pragma once
// Placement search on a device that keeps the texture and the growing plane between placements.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// Weighted sum of squared differences over the three channels, and the sum of the weights. Costs
/// are compared as ssd / max(weight, 1), exactly.
struct SearchCost {
    std::uint64_t ssd = 0;
    std::uint64_t weight = 0;
    bool operator==(const SearchCost&) const = default;
};

/// What is constant while one plane grows. Views are read when the search is opened, not later.
struct PlaneSearchSetup {
    Size canvas;
    bool torus = false;             ///< Positions wrap; otherwise pixels outside are never filled.
    std::vector<ViewU8x3> samples;  ///< All samples that requests may name.
    ViewU8x3 guide;                 ///< As large as the canvas, or empty.
    ViewU8x1 guide_known;           ///< 0 where the guide is unknown.
    std::uint32_t fill_weight = 1, guide_weight = 0;
};

/// One search: the window of a sample over a block of the canvas, at every translation t ∈ [lo,
/// hi]; t is the position of the window's origin in the block. The cost of t sums the filled (and
/// the guided) pixels of the block that the window reaches.
struct PlaneSearchRequest {
    Recti block;     ///< On the canvas; may reach over its borders, on a torus by one turn at most.
    int sample = 0;  ///< Index into PlaneSearchSetup::samples.
    Recti window;    ///< Within that sample.
    Vec2i lo{0, 0}, hi{0, 0};
    /// One byte per translation, row by row: 0 is ignored. Empty, or all 0: all count.
    std::span<const std::uint8_t> allowed;
    /// How much worse than the best a good translation may be.
    std::uint32_t good_numerator = 130, good_denominator = 100;
    bool want_costs = false;  ///< For tests and measurements, as is want_time.
    bool want_time = false;

    [[nodiscard]] std::size_t count() const {
        return hi.x < lo.x || hi.y < lo.y ? 0
                                          : static_cast<std::size_t>(hi.x - lo.x + 1) *
                                                static_cast<std::size_t>(hi.y - lo.y + 1);
    }
};

/// Translations by index, row by row. Integers: the same on every backend.
struct PlaneSearchResult {
    std::size_t best = 0;  ///< The lowest index on a tie.
    SearchCost best_cost;
    std::vector<std::uint32_t> good;  ///< Ascending; those within the factor of the best.
    std::vector<SearchCost> costs;    ///< All of them, if wanted.
    double device_ms = 0;             ///< By the device's clock, transfers included, if wanted.
};

/// The search of one plane. Not thread-safe. Unusable after an error: continue with the CPU's
/// search, which finds the same.
class PlaneSearch {
  public:
    virtual ~PlaneSearch() = default;
    /// Sends the contents of the canvas in `rect`, which lies inside it; `filled` is 0 or 1.
    /// Initially nothing is filled.
    virtual Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) = 0;
    /// Errors: Usage if the request contradicts the setup; NoSpace; NoBackend if the device is
    /// lost.
    virtual Expected<PlaneSearchResult> find(const PlaneSearchRequest& request) = 0;
};

}  // namespace weft
