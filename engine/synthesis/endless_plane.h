#pragma once
// A plane without end, assembled on demand from tiles (Wang tiles; Cohen et al. 2003) whose borders
// are cut like any other seam.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Two kinds of border run between tiles from left to right and two from top to bottom; a tile is
/// known by its four borders, so that there are 16. Each border is a strip grown by itself, around
/// a corner that all tiles share; a tile is grown into the frame that its strips make, whose
/// outermost texels stay. Which kind lies where is drawn from the seed and the place, so that any
/// part of the plane can be read at once, in any order, always with the same result. A tile is
/// grown when it is first read. Thread-safe.
class EndlessPlane {
  public:
    /// Of the options the size, tiling, guide and orientations take no part. Errors: those of
    /// grow_plane().
    static Expected<std::unique_ptr<EndlessPlane>> make(ImageU8x3 sample,
                                                        const PlaneOptions& options,
                                                        const CancelToken& cancel = {});

    struct Part {
        ImageU8x3 pixels;
        Image<std::int32_t, 2> source;  ///< Which sample pixel each texel shows.
    };
    /// The texels of `rect`, which may lie anywhere within ±2^30. Errors: NoSpace; cancelled, while
    /// tiles are grown.
    [[nodiscard]] Expected<Part> read(const Recti& rect, const CancelToken& cancel = {}) const;

    [[nodiscard]] int tile_px() const { return tile_px_; }
    /// What the tiles grown so far take; at most 16 tiles of 11 bytes a texel.
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Borders {
        int top, bottom, left, right;
    };
    struct Tile {
        std::mutex mutex;
        std::unique_ptr<Part> part;
    };

    EndlessPlane(ImageU8x3 sample, const PlaneOptions& options);
    [[nodiscard]] bool grow_strips(const CancelToken& cancel);
    [[nodiscard]] std::optional<Canvas> grow_strip(bool upright, int kind,
                                                   const CancelToken& cancel) const;
    [[nodiscard]] Canvas frame_of(const Borders& borders) const;
    [[nodiscard]] Borders borders_at(int tile_x, int tile_y) const;
    [[nodiscard]] Expected<const Part*> tile(const Borders& borders,
                                             const CancelToken& cancel) const;
    void show(Canvas& canvas, Vec2i at, Vec2i from) const;
    [[nodiscard]] PlaneOptions part_options(Size size, std::uint64_t number) const;

    ImageU8x3 sample_;
    PlaneOptions options_;
    std::unique_ptr<SampleAtlas> atlas_;
    int half_ = 0;  ///< Of a strip's width.
    int tile_px_ = 0;
    Vec2i corner_{0, 0};  ///< Of the sample: the upper left of the part that all corners show.
    std::array<std::array<std::unique_ptr<Canvas>, 2>, 2> strips_;  ///< [upright][kind]
    mutable std::array<Tile, 16> tiles_;
    mutable std::atomic<std::size_t> bytes_{0};
};

}  // namespace weft
