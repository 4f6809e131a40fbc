#include "app/session/preview_overlay.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/synthesis_inputs.h"
#include "engine/synthesis/plane_energy.h"

namespace weft {
namespace {

std::uint8_t code(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// How far a coordinate is from the nearest line of a grid, in pixels of the plate.
float line_cover(float uv, float step, float texels_per_px) {
    const float to_line = std::abs(uv / step - std::round(uv / step)) * step;
    return std::clamp(1.5f - to_line / std::max(texels_per_px, 1e-4f), 0.0f, 1.0f);
}

struct Jacobian {
    float xx, xy, yx, yy;  // d(u, v) / d(x, y)
    [[nodiscard]] float along_u() const { return std::hypot(xx, xy); }
    [[nodiscard]] float along_v() const { return std::hypot(yx, yy); }
    [[nodiscard]] float area() const { return std::abs(xx * yy - xy * yx); }
};

Jacobian jacobian(const ImageF2& uv, int x, int y) {
    const int x1 = std::min(x + 1, uv.width() - 1), y1 = std::min(y + 1, uv.height() - 1);
    const int x0 = std::max(0, x1 - 1), y0 = std::max(0, y1 - 1);
    return {uv.pixel(x1, y)[0] - uv.pixel(x0, y)[0], uv.pixel(x, y1)[0] - uv.pixel(x, y0)[0],
            uv.pixel(x1, y)[1] - uv.pixel(x0, y)[1], uv.pixel(x, y1)[1] - uv.pixel(x, y0)[1]};
}

// A grid of the sample's size over the surface.
void draw_grid(const TextureCoords& coords, Size sample, OverlayPicture& out) {
    out.unit = "sample";
    const auto step_u = static_cast<float>(std::max(8, sample.width / 4));
    const auto step_v = static_cast<float>(std::max(8, sample.height / 4));
    parallel_rows(out.value.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.value.width(); ++x) {
                if (out.where.at(x, y) == 0) continue;
                const Jacobian j = jacobian(coords.uv, x, y);
                const float* uv = coords.uv.pixel(x, y);
                out.value.at(x, y) = code(std::max(line_cover(uv[0], step_u, j.along_u()),
                                                   line_cover(uv[1], step_v, j.along_v())));
            }
        }
    });
}

// How much larger the texture is here than it was placed: linear magnification of a texel.
void draw_stretch(const TextureCoords& coords, OverlayPicture& out) {
    out.low = 0;
    out.high = 3;
    out.unit = "px per texel";
    for (int y = 0; y < out.value.height(); ++y) {
        for (int x = 0; x < out.value.width(); ++x) {
            if (out.where.at(x, y) == 0) continue;
            const float area = jacobian(coords.uv, x, y).area();
            out.value.at(x, y) = code(1.0f / std::sqrt(std::max(area, 1e-6f)) / out.high);
        }
    }
}

Status draw_light(const AnalysisStore& store, int region, int frame, float reference,
                  OverlayPicture& out) {
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kShading}));
    WEFT_TRY(shading, decode_shading(bytes));
    out.low = 0;
    out.high = 2;
    out.unit = "x the reference";
    for (int y = 0; y < out.value.height(); ++y) {
        for (int x = 0; x < out.value.width(); ++x) {
            const int sx = std::min(x / shading.downscale, shading.value.width() - 1);
            const int sy = std::min(y / shading.downscale, shading.value.height() - 1);
            out.value.at(x, y) =
                code(shading.value.at(sx, sy) / std::max(reference, 1e-6f) / out.high);
        }
    }
    return {};
}

// Where pieces of the sample meet in the plane, by how much they differ there.
Status draw_seams(const Shot& shot, int region, const TextureCoords& coords,
                  const CancelToken& cancel, OverlayPicture& out) {
    const RegionPlan& plan = shot.plan.regions[static_cast<std::size_t>(region)];
    out.unit = "difference at the seam";
    out.high = 64;
    if (plan.texture->is_plane) return {};
    PlaneOptions options =
        plane_options(plan, shot.plan.seed, plane_size(plan.placement, shot.source->size()));
    options.tileable = true;
    WEFT_TRY(plane, grow_texture(plan, options, cancel));
    const int width = plane.source.width(), height = plane.source.height();
    const std::vector<ImageU8x3> samples = synthesis_samples(plan);
    const SampleAtlas atlas({samples.begin(), samples.end()}, plan.orientations);
    const Image<std::int32_t, 2> source = atlas_positions(atlas, plane);
    Matte energy(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // Seams that cost next to nothing are to be seen as well.
            const PlaneEnergy here = texel_energy(atlas, source, {x, y}, true);
            const double shown = here.length_px > 0 ? 48 + here.energy : 0;
            energy.at(x, y) = static_cast<std::uint8_t>(std::min(255.0, shown));
        }
    }
    const auto wrap = [](float v, int n) {
        const int k = static_cast<int>(std::floor(v)) % n;
        return k < 0 ? k + n : k;
    };
    for (int y = 0; y < out.value.height(); ++y) {
        for (int x = 0; x < out.value.width(); ++x) {
            if (out.where.at(x, y) == 0) continue;
            const float* uv = coords.uv.pixel(x, y);
            const int u = wrap(uv[0], width), v = wrap(uv[1], height);
            out.value.at(x, y) = std::max(energy.at(u, v), energy.at((u + 1) % width, v));
        }
    }
    return {};
}

void draw_motion(const LatticeField& ref_from_cur, OverlayPicture& out) {
    const int step = std::max(16, out.where.width() / 40);
    out.unit = "px since the reference frame";
    for (int y = step / 2; y < out.where.height(); y += step) {
        for (int x = step / 2; x < out.where.width(); x += step) {
            if (out.where.at(x, y) < 128) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            out.arrows.push_back({at, at + ref_from_cur.at(at)});
        }
    }
}

}  // namespace

Expected<OverlayPicture> make_overlay(Overlay kind, const Shot& shot, const AnalysisStore& store,
                                      const RegionScene& scene, int region, int frame,
                                      const CancelToken& cancel) {
    const Size size = shot.source->size();
    OverlayPicture out;
    out.kind = kind;
    out.frame = frame;
    out.id = next_picture_id();
    WEFT_TRY(extent, extent_matte(*shot.source, shot.plan, store, region, frame));
    WEFT_TRY(holdout, holdout_matte(*shot.source, shot.plan, region, frame));
    out.where = without_holdout(extent, holdout);
    out.value = Matte(size);
    if (kind == Overlay::kLight) {
        WEFT_CHECK_OK(draw_light(store, region, frame, scene.reference_shading, out));
        return out;
    }
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(bytes));
    const TextureCoords coords =
        texture_coords(ref_from_cur, scene.plane_from_plate, rect_of(size));
    const ImageF3& sample = shot.plan.regions[static_cast<std::size_t>(region)].texture->pixels;
    switch (kind) {
        case Overlay::kGrid:
            draw_grid(coords, sample.size(), out);
            break;
        case Overlay::kStretch:
            draw_stretch(coords, out);
            break;
        case Overlay::kSeams:
            WEFT_CHECK_OK(draw_seams(shot, region, coords, cancel, out));
            break;
        case Overlay::kMotion:
            draw_motion(ref_from_cur, out);
            break;
        case Overlay::kLight:
        case Overlay::kNone:
            break;
    }
    return out;
}

}  // namespace weft
