#pragma once
// An endless plane, assembled on demand from tiles (Wang tiles; Cohen et al. 2003) whose borders
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

/// There are two kinds of vertical and two kinds of horizontal border; a tile is identified by its
/// four borders, so there are 16. Each border is a strip that is grown by itself, around a corner
/// that all tiles share. A tile is grown into the frame of its strips, whose outermost texels stay.
/// The seed and the place determine which kind lies where, so any part of the plane can be read at
/// any time, in any order, with the same result. A tile is grown when it is first read.
/// Thread-safe.
class EndlessPlane {
  public:
    /// Ignores the options' size, tiling, guide and orientations. Errors: those of grow_plane().
    static Expected<std::unique_ptr<EndlessPlane>> make(ImageU8x3 sample,
                                                        const PlaneOptions& options,
                                                        const CancelToken& cancel = {});

    struct Part {
        ImageU8x3 pixels;
        Image<std::int32_t, 2> source;  ///< The sample pixel that each texel shows.
    };
    /// The texels of `rect`, anywhere within ±2^30. Errors: NoSpace; cancelled, while tiles are
    /// grown.
    [[nodiscard]] Expected<Part> read(const Recti& rect, const CancelToken& cancel = {}) const;

    [[nodiscard]] int tile_px() const { return tile_px_; }
    /// Memory of the tiles grown so far: at most 16 tiles of 11 bytes per texel.
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
    Vec2i corner_{0, 0};  ///< Top left, in the sample, of the part that all corners show.
    std::array<std::array<std::unique_ptr<Canvas>, 2>, 2> strips_;  ///< [upright][kind]
    mutable std::array<Tile, 16> tiles_;
    mutable std::atomic<std::size_t> bytes_{0};
};

}  // namespace weft
