#include "engine/pipeline/paper_walker.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "engine/core/parallel.h"
#include "engine/core/setting.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

constexpr int kLargestPaper = 8192;

// Bilinear lookup in texels (centres at half); false outside.
bool lookup(const ImageU8x3& image, Vec2 u, Vec3& out) {
    const float gx = u.x - 0.5f, gy = u.y - 0.5f;
    if (!(gx >= 0 && gy >= 0 && gx < static_cast<float>(image.width() - 1) &&
          gy < static_cast<float>(image.height() - 1))) {
        return false;
    }
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const float fx = gx - static_cast<float>(x), fy = gy - static_cast<float>(y);
    const std::uint8_t *a = image.pixel(x, y), *b = image.pixel(x, y + 1);
    for (int c = 0; c < 3; ++c) {
        const float top = static_cast<float>(a[c]) + fx * static_cast<float>(a[c + 3] - a[c]);
        const float low = static_cast<float>(b[c]) + fx * static_cast<float>(b[c + 3] - b[c]);
        out[c] = top + fy * (low - top);
    }
    return true;
}

}  // namespace

Expected<FramePlane> frame_plane(const PlanePlacement& placement, Size plate) {
    WEFT_TRY(mapping, texture_mapping(placement));
    const auto [low, high] = mapping.bounds_of(rect_of(plate));
    const Vec2 extent = high - low;
    if (!(extent.x < kLargestPaper && extent.y < kLargestPaper)) {
        return fail(
            ErrorCode::kUsage,
            "The placement needs a texture of more than 8192 texels per side for every frame.",
            "Raise the scale, or use the locked mode, which repeats its plane" +
                by({{setting::kTemporalMode, "locked"}}) + ".");
    }
    const Vec2i origin(static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)));
    return FramePlane{origin,
                      {static_cast<int>(std::ceil(high.x)) - origin.x + 1,
                       static_cast<int>(std::ceil(high.y)) - origin.y + 1}};
}

PaperWalker::PaperWalker(const RegionPlan& region, std::uint64_t seed, Size plate,
                         const Backend* backend)
    : region_(region),
      seed_(seed),
      backend_(backend),
      plane_(frame_plane(region.placement, plate)) {
    if (plane_) mapping_ = *texture_mapping(region.placement);
}

Expected<ImageU8x3> PaperWalker::start(int frame, const CancelToken& cancel) {
    if (!plane_) return tl::unexpected<Error>(plane_.error());
    WEFT_TRY(picture, synthesise(frame, nullptr, cancel));
    last_ = picture;
    return picture;
}

Expected<ImageU8x3> PaperWalker::advance(int frame, const LatticeField& prev_from_cur,
                                         const CancelToken& cancel) {
    const Warped previous = warp(prev_from_cur);
    WEFT_TRY(picture, synthesise(frame, &previous, cancel));
    // eq. 4
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (!previous.known.at(x, y)) continue;
            std::uint8_t* p = picture.pixel(x, y);
            const std::uint8_t* q = previous.picture.pixel(x, y);
            for (int c = 0; c < 3; ++c) {
                const float mixed = region_.blend * static_cast<float>(p[c]) +
                                    (1 - region_.blend) * static_cast<float>(q[c]);
                p[c] = static_cast<std::uint8_t>(mixed + 0.5f);
            }
        }
    }
    last_ = picture;
    return picture;
}

Expected<ImageU8x3> PaperWalker::synthesise(int frame, const Warped* previous,
                                            const CancelToken& cancel) const {
    PlaneOptions options = plane_options(region_, seed_, plane_->size, backend_);
    options.mode = PlaneMode::kSynthesize;  // As the paper does.
    options.frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame));
    if (previous) options.guide = PlaneGuide{previous->picture, previous->known, region_.weight};
    WEFT_TRY(plane, grow_texture(region_, options, cancel));
    return std::move(plane.pixels);
}

PaperWalker::Warped PaperWalker::warp(const LatticeField& prev_from_cur) const {
    Warped out{ImageU8x3(plane_->size), Matte(plane_->size)};
    const TextureMapping::Inverse inverse = mapping_.inverse();
    const Vec2 origin(plane_->origin);
    parallel_rows(plane_->size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < plane_->size.width; ++x) {
                const Vec2 texel = origin + Vec2(x, y) + 0.5f;
                const Vec2 here = inverse.pixel(texel);
                const Vec2 before = mapping_.texel(here + prev_from_cur.at(here));
                Vec3 colour;
                if (!lookup(last_, before - origin, colour)) continue;
                out.known.at(x, y) = 255;
                for (int c = 0; c < 3; ++c) {
                    out.picture.at(x, y, c) = static_cast<std::uint8_t>(colour[c] + 0.5f);
                }
            }
        }
    });
    return out;
}

}  // namespace weft
