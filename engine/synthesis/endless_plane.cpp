#include "engine/synthesis/endless_plane.h"

#include <algorithm>
#include <new>

#include "engine/core/rng.h"
#include "engine/synthesis/grow_canvas.h"

namespace weft {
namespace {

constexpr int kLargestHalf = 36;
constexpr int kSamplesPerTile = 3;
constexpr int kLargestSample = 200;  // A larger one is used in windows of this size.
constexpr int kKept = 4;             // Texels on either side of a corner that every strip keeps.
constexpr int kFurthest = 1 << 30;

int floor_div(int a, int b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

Expected<std::unique_ptr<EndlessPlane>> EndlessPlane::make(ImageU8x3 sample,
                                                           const PlaneOptions& options,
                                                           const CancelToken& cancel) {
    WEFT_CHECK_OK(check_sample(sample.size(), options.overlap_px));
    try {
        std::unique_ptr<EndlessPlane> plane(new EndlessPlane(std::move(sample), options));
        if (!plane->grow_strips(cancel)) return growth_stopped(cancel);
        return plane;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, "Not enough memory for a texture plane.");
    }
}

EndlessPlane::EndlessPlane(ImageU8x3 sample, const PlaneOptions& options)
    : sample_(std::move(sample)),
      options_(options),
      atlas_(std::make_unique<SampleAtlas>(sample_.view())) {
    const int side = std::min(sample_.width(), sample_.height());
    half_ = std::min(kLargestHalf, side * 3 / 8);
    tile_px_ = kSamplesPerTile * std::min(side, kLargestSample);
    Rng rng(options.seed, options.region, options.frame, ~std::uint64_t{0});
    const auto room = [&](int px) { return static_cast<std::uint64_t>(px - 2 * half_ + 1); };
    corner_ = {static_cast<int>(rng.below(room(sample_.width()))),
               static_cast<int>(rng.below(room(sample_.height())))};
}

void EndlessPlane::show(Canvas& canvas, Vec2i at, Vec2i from) const {
    canvas.set(at, sample_.pixel(from.x, from.y), from);
}

PlaneOptions EndlessPlane::part_options(Size size, std::uint64_t number) const {
    PlaneOptions o = options_;
    o.size = size;
    o.tileable = false;
    o.guide.reset();
    o.orientations = {};
    // A frame has no first placement to align with; the costs keep it aligned.
    o.align = false;
    o.region = mix64(options_.region) + number;
    return o;
}

bool EndlessPlane::grow_strips(const CancelToken& cancel) {
    for (const bool upright : {false, true}) {
        for (int kind = 0; kind < 2; ++kind) {
            auto strip = grow_strip(upright, kind, cancel);
            if (!strip) return false;
            strips_[upright][static_cast<std::size_t>(kind)] =
                std::make_unique<Canvas>(std::move(*strip));
        }
    }
    return true;
}

// A strip runs from the middle of one corner to the middle of the next, and on to their ends.
std::optional<Canvas> EndlessPlane::grow_strip(bool upright, int kind,
                                               const CancelToken& cancel) const {
    const int length = tile_px_ + 2 * half_, width = 2 * half_;
    const auto turned = [upright](int along, int across) {
        return upright ? Vec2i{across, along} : Vec2i{along, across};
    };
    const Vec2i size = turned(length, width);
    Canvas canvas({size.x, size.y}, false);
    for (const int start : {0, tile_px_}) {
        for (int along = 0; along < width; ++along) {
            for (int across = 0; across < width; ++across) {
                const Vec2i at = turned(start + along, across);
                show(canvas, at, corner_ + turned(along, across));
                if (along >= half_ - kKept && along < half_ + kKept) canvas.lock(at);
            }
        }
    }
    PlaneStats stats;
    const PlaneOptions o =
        part_options(canvas.size(), 100 + 2 * static_cast<std::uint64_t>(upright) +
                                        static_cast<std::uint64_t>(kind));
    if (!grow_canvas(*atlas_, o, {}, canvas, stats, cancel, {})) return std::nullopt;
    return canvas;
}

// Near a corner the strip nearer to a texel shows; in the corner itself they all show the same.
Canvas EndlessPlane::frame_of(const Borders& b) const {
    const int t = tile_px_, m = half_;
    Canvas canvas({t, t}, false);
    const auto copy = [&](bool upright, int kind, Vec2i from, Vec2i at) {
        const std::int32_t* s =
            strips_[upright][static_cast<std::size_t>(kind)]->source().pixel(from.x, from.y);
        show(canvas, at, {s[0], s[1]});
    };
    for (int y = 0; y < t; ++y) {
        for (int x = 0; x < t; ++x) {
            const int to_side = std::min(x, t - 1 - x), to_end = std::min(y, t - 1 - y);
            if (std::min(to_side, to_end) >= m) continue;
            if (to_end <= to_side) {
                const bool top = y < t / 2;
                copy(false, top ? b.top : b.bottom, {m + x, top ? m + y : y - (t - m)}, {x, y});
            } else {
                const bool left = x < t / 2;
                copy(true, left ? b.left : b.right, {left ? m + x : x - (t - m), m + y}, {x, y});
            }
            if (to_side == 0 || to_end == 0) canvas.lock({x, y});
        }
    }
    return canvas;
}

EndlessPlane::Borders EndlessPlane::borders_at(int tile_x, int tile_y) const {
    const auto kind = [&](std::uint64_t direction, int x, int y) {
        const std::uint64_t place = static_cast<std::uint64_t>(static_cast<std::uint32_t>(x))
                                        << 32 |
                                    static_cast<std::uint32_t>(y);
        return static_cast<int>(Rng(options_.seed, options_.region, direction, place).below(2));
    };
    return {kind(1, tile_x, tile_y), kind(1, tile_x, tile_y + 1), kind(2, tile_x, tile_y),
            kind(2, tile_x + 1, tile_y)};
}

Expected<const EndlessPlane::Part*> EndlessPlane::tile(const Borders& b,
                                                       const CancelToken& cancel) const {
    const auto index = static_cast<std::size_t>(b.top + 2 * b.bottom + 4 * b.left + 8 * b.right);
    Tile& tile = tiles_[index];
    const std::lock_guard lock(tile.mutex);
    if (!tile.part) {
        Canvas canvas = frame_of(b);
        PlaneStats stats;
        if (!grow_canvas(*atlas_, part_options(canvas.size(), index), {}, canvas, stats, cancel,
                         {})) {
            return growth_stopped(cancel);
        }
        tile.part =
            std::make_unique<Part>(Part{std::move(canvas.pixels()), std::move(canvas.source())});
        bytes_ += tile.part->pixels.size_bytes() + tile.part->source.size_bytes();
    }
    return tile.part.get();
}

Expected<EndlessPlane::Part> EndlessPlane::read(const Recti& rect,
                                                const CancelToken& cancel) const {
    if (rect.empty() || rect.x0 < -kFurthest || rect.y0 < -kFurthest || rect.x1 > kFurthest ||
        rect.y1 > kFurthest) {
        return fail(ErrorCode::kUsage, "The requested part is empty or beyond ±2^30 texels.");
    }
    try {
        Part out{ImageU8x3(rect.size()), Image<std::int32_t, 2>(rect.size())};
        const int t = tile_px_;
        for (int ty = floor_div(rect.y0, t); ty * t < rect.y1; ++ty) {
            for (int tx = floor_div(rect.x0, t); tx * t < rect.x1; ++tx) {
                WEFT_TRY(part, tile(borders_at(tx, ty), cancel));
                const Recti here = rect.intersected({tx * t, ty * t, (tx + 1) * t, (ty + 1) * t});
                for (int y = here.y0; y < here.y1; ++y) {
                    const int fx = here.x0 - tx * t, fy = y - ty * t;
                    std::copy_n(part->pixels.pixel(fx, fy), 3 * here.width(),
                                out.pixels.pixel(here.x0 - rect.x0, y - rect.y0));
                    std::copy_n(part->source.pixel(fx, fy), 2 * here.width(),
                                out.source.pixel(here.x0 - rect.x0, y - rect.y0));
                }
            }
        }
        return out;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, "Not enough memory for this part of a texture plane.");
    }
}

std::size_t EndlessPlane::bytes() const {
    return bytes_;
}

}  // namespace weft
