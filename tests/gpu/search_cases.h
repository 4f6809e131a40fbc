#pragma once
// Placement searches that every implementation must answer alike, and the plain one that says what
// is right.

#include <memory>
#include <string>
#include <vector>

#include "engine/compute/plane_search.h"

namespace weft::test {

/// One search with everything that it needs.
struct SearchCase {
    std::string name;
    Size canvas{64, 64};
    bool torus = false;
    ImageU8x3 pixels;  ///< Of the canvas.
    Image<std::uint8_t, 1> filled;
    std::vector<ImageU8x3> samples;
    ImageU8x3 guide;  ///< Empty: none.
    Image<std::uint8_t, 1> guide_known;
    std::uint32_t fill_weight = 1, guide_weight = 0;
    PlaneSearchRequest request;  ///< Its `allowed` shows `allowed`.
    std::vector<std::uint8_t> allowed;

    [[nodiscard]] PlaneSearchSetup setup() const;
};

/// All of them are small enough for the emulated pixel-level strategy.
[[nodiscard]] std::vector<SearchCase> search_cases();

/// Grows a plane with `search`, block after block in scanline order, laying the best every time.
/// Returns what it found, up to the first error.
[[nodiscard]] std::vector<PlaneSearchResult> grow_with(PlaneSearch& search,
                                                       const PlaneSearchSetup& setup);
/// A setup for that: two samples, and a guide if wanted. The pictures live in `owner`.
[[nodiscard]] PlaneSearchSetup growing(SearchCase& owner, bool torus, bool guided);

/// By the definition, one pixel at a time.
[[nodiscard]] std::unique_ptr<PlaneSearch> make_plain_search(const PlaneSearchSetup& setup);

enum class SynthesisMethod { kDirect, kFft };
/// engine/synthesis behind the same interface. The factor of good ones is its own, 1.1.
[[nodiscard]] std::unique_ptr<PlaneSearch> make_synthesis_search(const PlaneSearchSetup& setup,
                                                                 SynthesisMethod method);

}  // namespace weft::test
