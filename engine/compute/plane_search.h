#pragma once
// The placement search on a device that keeps the texture and the growing plane between placements.

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

/// What stays the same while one plane grows. Views are read when the search is opened, not later.
struct PlaneSearchSetup {
    Size canvas;
    bool torus = false;             ///< Positions wrap; else what lies outside is never filled.
    std::vector<ViewU8x3> samples;  ///< All that may be asked for.
    ViewU8x3 guide;                 ///< As large as the canvas, or empty.
    ViewU8x1 guide_known;           ///< 0 where the guide is unknown.
    std::uint32_t fill_weight = 1, guide_weight = 0;
};

/// One search: the window of a sample over a block of the canvas, at every translation t ∈ [lo,
/// hi], t being where the window's origin lies in the block. The cost of t sums the filled (and the
/// guided) pixels of the block where the window reaches.
struct PlaneSearchRequest {
    Recti block;     ///< On the canvas; may reach over its borders, on a torus by one turn at most.
    int sample = 0;  ///< Index into PlaneSearchSetup::samples.
    Recti window;    ///< Within that sample.
    Vec2i lo{0, 0}, hi{0, 0};
    /// One byte per translation, row by row: 0 does not take part. Empty, or all 0: all do.
    std::span<const std::uint8_t> allowed;
    /// How much worse than the best a good translation may be.
    std::uint32_t good_numerator = 130, good_denominator = 100;
    bool want_costs = false;  ///< For tests and measurements, as is:
    bool want_time = false;

    [[nodiscard]] std::size_t count() const {
        return hi.x < lo.x || hi.y < lo.y ? 0
                                          : static_cast<std::size_t>(hi.x - lo.x + 1) *
                                                static_cast<std::size_t>(hi.y - lo.y + 1);
    }
};

/// Translations by index, row by row. Integers: the same on every backend.
struct PlaneSearchResult {
    std::size_t best = 0;  ///< Of equal ones the lowest index.
    SearchCost best_cost;
    std::vector<std::uint32_t> good;  ///< Ascending; those within the factor of the best.
    std::vector<SearchCost> costs;    ///< All of them, if wanted.
    double device_ms = 0;             ///< Of the device's own clock, transfers included, if wanted.
};

/// One plane's search. Not thread-safe. After an error it may be used no more: go on with the CPU's
/// search, which finds the same.
class PlaneSearch {
  public:
    virtual ~PlaneSearch() = default;
    /// Tells what the canvas shows now in `rect`, which lies inside it; `filled` is 0 or 1. At
    /// first nothing is filled.
    virtual Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) = 0;
    /// Errors: Usage when the request contradicts the setup; NoSpace; NoBackend when the device is
    /// lost.
    virtual Expected<PlaneSearchResult> find(const PlaneSearchRequest& request) = 0;
};

}  // namespace weft
