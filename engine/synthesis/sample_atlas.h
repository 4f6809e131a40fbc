#pragma once
// Everything that a plane may show: every sample in every allowed orientation, in one picture.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Allowed orientations of a sample besides upright.
struct Orientations {
    bool rotations = false;  ///< By quarter turns.
    bool mirror = false;     ///< Left and right swapped.
};

/// The pages lie below one another with a gap of one row, so that pixels of different pages are
/// never neighbours. A single upright sample is not copied, and its positions in the atlas are its
/// own. Thread-safe once constructed; valid as long as the samples' pixels.
class SampleAtlas {
  public:
    /// An orientation is the number of quarter turns (counter-clockwise), plus 4 if the sample was
    /// mirrored first.
    struct Page {
        Recti rect;
        int sample = 0;
        int orientation = 0;
    };
    /// A pixel of an original sample.
    struct Place {
        int sample = 0, orientation = 0;
        Vec2i at{0, 0};
    };

    explicit SampleAtlas(const std::vector<ViewU8x3>& samples, Orientations allowed = {});
    explicit SampleAtlas(ViewU8x3 sample) : SampleAtlas(std::vector<ViewU8x3>{sample}) {}
    SampleAtlas(const SampleAtlas&) = delete;
    SampleAtlas& operator=(const SampleAtlas&) = delete;

    [[nodiscard]] ViewU8x3 pixels() const { return view_; }
    [[nodiscard]] const std::vector<Page>& pages() const { return pages_; }
    [[nodiscard]] const Page& page_of(Vec2i at) const {
        return pages_[page_of_row_[static_cast<std::size_t>(at.y)]];
    }
    /// The pixel at `at`; outside the page of `owner`, the nearest pixel of that page.
    [[nodiscard]] const std::uint8_t* continued(Vec2i at, Vec2i owner) const {
        const Recti& r = page_of(owner).rect;
        return view_.pixel(at.x < r.x0    ? r.x0
                           : at.x >= r.x1 ? r.x1 - 1
                                          : at.x,
                           at.y < r.y0    ? r.y0
                           : at.y >= r.y1 ? r.y1 - 1
                                          : at.y);
    }
    [[nodiscard]] Place place_of(Vec2i at) const;
    /// The inverse; the place must be one of the atlas.
    [[nodiscard]] Vec2i position_of(const Place& place) const;

  private:
    ImageU8x3 stacked_;
    ViewU8x3 view_;
    std::vector<Page> pages_;
    std::vector<Size> sample_sizes_;
    std::vector<std::uint16_t> page_of_row_;
};

}  // namespace weft
