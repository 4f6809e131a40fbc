#include "app/preview/preview_overlay.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "app/preview/coords_jacobian.h"
#include "app/preview/normals_overlay.h"
#include "app/preview/preview_health.h"
#include "app/preview/surface_pattern.h"
#include "app/textures/patch_pick.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/synthesis_inputs.h"
#include "engine/synthesis/plane_energy.h"

namespace weft {
namespace {

// Coverage of the nearest grid line at a coordinate, one plate pixel wide.
float line_cover(float uv, float step, float texels_per_px) {
    const float to_line = std::abs(uv / step - std::round(uv / step)) * step;
    return std::clamp(1.5f - to_line / std::max(texels_per_px, 1e-4f), 0.0f, 1.0f);
}

// Draws a grid of the sample's size over the surface.
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

// Draws the linear magnification of texels relative to the placement, in unsqueezed pixels.
void draw_stretch(const TextureCoords& coords, PixelAspect aspect, OverlayPicture& out) {
    out.low = 0;
    out.high = 3;
    out.unit = "px per texel";
    for (int y = 0; y < out.value.height(); ++y) {
        for (int x = 0; x < out.value.width(); ++x) {
            if (out.where.at(x, y) == 0) continue;
            const float area = jacobian(coords.uv, x, y).area() / aspect.ratio();
            out.value.at(x, y) = code(1.0f / std::sqrt(std::max(area, 1e-6f)) / out.high);
        }
    }
}

// Draws the shading relative to the reference, or how surely it was told from paint.
Status draw_light(const AnalysisStore& store, int region, int frame, float reference,
                  OverlayPicture& out) {
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kShading}));
    WEFT_TRY(shading, decode_shading(bytes));
    const bool confidence = out.kind == Overlay::kLightConfidence;
    out.low = 0;
    out.high = confidence ? 1.0f : 2.0f;
    out.unit = confidence ? "told from paint" : "x the reference";
    for (int y = 0; y < out.value.height(); ++y) {
        for (int x = 0; x < out.value.width(); ++x) {
            const int sx = std::min(x / shading.downscale, shading.value.width() - 1);
            const int sy = std::min(y / shading.downscale, shading.value.height() - 1);
            if (confidence)
                out.value.at(x, y) = shading.sure.empty() ? 255 : shading.sure.at(sx, sy);
            else
                out.value.at(x, y) =
                    code(shading.value.at(sx, sy) / std::max(reference, 1e-6f) / out.high);
        }
    }
    return {};
}

int wrapped(float v, int n) {
    const int k = static_cast<int>(std::floor(v)) % n;
    return k < 0 ? k + n : k;
}

// Calls body(pixel of the frame, texel) inside the matte.
template <class Body>
void for_texels(const TextureCoords& coords, const PlaneMap& plane, OverlayPicture& out,
                Body&& body) {
    const int width = plane.source.width(), height = plane.source.height();
    parallel_rows(out.value.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.value.width(); ++x) {
                if (out.where.at(x, y) == 0) continue;
                const float* uv = coords.uv.pixel(x, y);
                out.value.at(x, y) = body(wrapped(uv[0], width), wrapped(uv[1], height));
            }
        }
    });
}

// Draws the seams of the plane by the difference of the patches.
void draw_seams(const TextureCoords& coords, const PlaneMap& plane, OverlayPicture& out) {
    out.unit = "difference at the seam";
    out.high = 64;
    const int width = plane.energy.width();
    for_texels(coords, plane, out, [&](int u, int v) {
        return std::max(plane.energy.at(u, v), plane.energy.at((u + 1) % width, v));
    });
}

// Draws each patch of the sample in its own grey.
void draw_source_map(const TextureCoords& coords, const PlaneMap& plane, OverlayPicture& out) {
    for_texels(coords, plane, out, [&](int u, int v) {
        const std::int32_t* from = plane.source.pixel(u, v);
        const auto piece =
            static_cast<std::uint32_t>((from[0] - u) * 92821 + (from[1] - v) * 68917);
        return static_cast<std::uint8_t>((piece * 2654435761u) >> 24);
    });
}

// Marks locked and regenerated patches.
void draw_amended(const TextureCoords& coords, const RegionPlan& plan, const PlaneMap& plane,
                  OverlayPicture& out) {
    const int width = plane.source.width(), height = plane.source.height();
    Matte amended(plane.source.size());
    for (const PlaneAmendment& amendment : plan.amendments) {
        const bool keep = amendment.kind == PlaneAmendment::Kind::kKeep;
        for (const TexelRun& run : amendment.runs)
            for (int k = 0; k < run.count; ++k)
                amended.at(wrapped(static_cast<float>(run.x + k), width),
                           wrapped(static_cast<float>(run.y), height)) = keep ? 255 : 128;
    }
    out.marked = Matte(out.value.size());
    for (int y = 0; y < out.marked.height(); ++y) {
        for (int x = 0; x < out.marked.width(); ++x) {
            if (out.where.at(x, y) == 0) continue;
            const float* uv = coords.uv.pixel(x, y);
            out.marked.at(x, y) = amended.at(wrapped(uv[0], width), wrapped(uv[1], height));
        }
    }
}

// Draws the appearance change since the reference frame, where motion was lost or something else is
// visible.
Status draw_confidence(const Shot& shot, const LatticeField& ref_from_cur, int reference, int frame,
                       OverlayPicture& out) {
    out.unit = "difference from the reference";
    out.low = 0;
    out.high = 1;
    WEFT_TRY(here, shot.source->plate(frame));
    WEFT_TRY(there, shot.source->plate(reference));
    const ImageF1 now = small_pattern(*here, *shot.plan.display_from_plate, 1);
    const ImageF1 before = small_pattern(*there, *shot.plan.display_from_plate, 1);
    cv::Mat difference(now.height(), now.width(), CV_32FC1, cv::Scalar(0));
    parallel_rows(now.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < now.width(); ++x) {
                if (out.where.at(x, y) == 0) continue;
                const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                const Vec2 q = p + ref_from_cur.at(p);
                const int u = std::clamp(static_cast<int>(q.x), 0, now.width() - 1);
                const int v = std::clamp(static_cast<int>(q.y), 0, now.height() - 1);
                difference.at<float>(y, x) = std::abs(now.at(x, y) - before.at(u, v));
            }
        }
    });
    cv::boxFilter(difference, difference, CV_32F, {9, 9});
    constexpr float kLost = 0.35f;
    for (int y = 0; y < now.height(); ++y)
        for (int x = 0; x < now.width(); ++x)
            out.value.at(x, y) = code(difference.at<float>(y, x) / kLost);
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

// The plane from the scene, or synthesized again.
Expected<std::shared_ptr<const TexturePlane>> grown_plane(const Shot& shot, const RegionPlan& plan,
                                                          const RegionScene& scene,
                                                          const CancelToken& cancel) {
    if (scene.grown && scene.grown->source.size() == scene.plane.size()) return scene.grown;
    PlaneOptions options = plane_options(plan, shot.plan.seed, scene.plane.size());
    options.tileable = true;
    options.amendments = plan.amendments;
    WEFT_TRY(plane, grow_texture(plan, options, cancel));
    return std::make_shared<const TexturePlane>(std::move(plane));
}

std::string id_of(const ShotTexture& texture) {
    return texture.library_id.empty() ? texture.id.substr(0, 12) : "db:" + texture.library_id;
}

// Finds the reference frames whose tracks a frame of a locked texture uses, with their weights
// (SurfacePass::blend; the time offset of a held drawing is ignored).
Status follow_tracks(const RegionPlan& plan, const AnalysisStore& store, const RegionScene& scene,
                     int region, Provenance& out) {
    std::vector<int> references = plan.reference_frames;
    std::sort(references.begin(), references.end());
    const auto next = std::upper_bound(references.begin(), references.end(), out.frame);
    out.track_frame = next == references.begin() ? references.front() : *(next - 1);
    if (plan.temporal != TemporalMode::kLocked) return {};
    const bool between =
        next != references.begin() && next != references.end() && *(next - 1) != out.frame;
    if (between) {
        const float after = smooth_step(static_cast<float>(out.frame),
                                        static_cast<float>(*(next - 1)), static_cast<float>(*next));
        out.two = TwoTracks{*(next - 1), *next, after, {}};
    }
    for (const TrackSeam& seam : scene.seams) {
        if (!seam.covers(out.frame) || !store.has({region, out.frame, AnalysisKind::kTrackAfter}))
            continue;
        if (!out.two) out.two = TwoTracks{out.track_frame, out.track_frame, 0, {}};
        TwoTracks::Seam one;
        one.labels = {out.frame - 1,
                      out.frame + 1,
                      seam.cell_px,
                      seam.origin,
                      {seam.after[static_cast<std::size_t>(out.frame - seam.first - 1)]}};
        WEFT_TRY(before, store.get({region, out.frame, AnalysisKind::kTrackBefore}));
        WEFT_TRY(after, store.get({region, out.frame, AnalysisKind::kTrackAfter}));
        WEFT_TRY(from_before, decode_lattice(before));
        WEFT_TRY(from_after, decode_lattice(after));
        one.before = std::move(from_before);
        one.after = std::move(from_after);
        out.two->seam = std::move(one);
        break;
    }
    return {};
}

// Everything but the plane.
Expected<Provenance> provenance_of(const Shot& shot, const AnalysisStore& store,
                                   const RegionScene& scene, int region, int frame) {
    const RegionPlan& plan = shot.plan.regions[static_cast<std::size_t>(region)];
    const ShotTexture& texture = shot.textures[static_cast<std::size_t>(region)];
    Provenance out;
    const ZonedAnalysis placed(*shot.source, shot.plan, store);
    WEFT_TRY(coords, placed.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(coords));
    out.ref_from_cur = std::move(ref_from_cur);
    WEFT_TRY(mapping, mapping_on(plan, scene, frame));
    out.mapping = mapping;
    out.texture = std::filesystem::path(texture.path).filename().string();
    out.texture_id = id_of(texture);
    out.reference_frame = plan.reference_frames.front();
    out.frame = frame;
    out.temporal = plan.temporal;
    out.fresh = plan.blend;
    out.reference_shading = scene.reference_shading;
    WEFT_CHECK_OK(follow_tracks(plan, store, scene, region, out));
    if (store.has({region, frame, AnalysisKind::kShading})) {
        WEFT_TRY(light, store.get({region, frame, AnalysisKind::kShading}));
        WEFT_TRY(shading, decode_shading(light));
        out.shading = std::move(shading);
    }
    return out;
}

}  // namespace

Expected<std::shared_ptr<const PlaneMap>> OverlayMaker::plane_map(const Shot& shot, int region,
                                                                  const RegionScene& scene,
                                                                  const CancelToken& cancel) {
    const RegionPlan& plan = shot.plan.regions[static_cast<std::size_t>(region)];
    if (plan.texture->is_plane || scene.plane.empty()) return nullptr;
    if (map_ && map_of_ == scene.plane.identity()) return map_;
    WEFT_TRY(grown, grown_plane(shot, plan, scene, cancel));
    const TexturePlane& plane = *grown;
    const std::vector<ImageU8x3> samples = synthesis_samples(plan);
    const SampleAtlas atlas({samples.begin(), samples.end()}, plan.orientations);
    const Image<std::int32_t, 2> position = atlas_positions(atlas, plane);
    auto map = std::make_shared<PlaneMap>();
    map->energy = Matte(plane.source.size());
    parallel_rows(map->energy.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < map->energy.width(); ++x) {
                // Draw seams of low cost too.
                const PlaneEnergy here = texel_energy(atlas, position, {x, y}, true);
                const double shown = here.length_px > 0 ? 48 + here.energy : 0;
                map->energy.at(x, y) = static_cast<std::uint8_t>(std::min(255.0, shown));
            }
        }
    });
    if (!plane.origin.empty()) {
        map->which = map->orientation = Image<std::uint8_t, 1>(plane.origin.size());
        for (int y = 0; y < plane.origin.height(); ++y)
            for (int x = 0; x < plane.origin.width(); ++x)
                map->which.at(x, y) = plane.origin.pixel(x, y)[0],
                                 map->orientation.at(x, y) = plane.origin.pixel(x, y)[1];
    }
    const TextureSource& from =
        shot.project.regions[shot.region_index[static_cast<std::size_t>(region)]]->texture;
    map->samples.push_back(std::filesystem::path(from.sample).filename().string());
    for (const std::string& further : from.also)
        map->samples.push_back(std::filesystem::path(further).filename().string());
    const ShotTexture& texture = shot.textures[static_cast<std::size_t>(region)];
    map->ids.push_back(id_of(texture));
    for (const ShotTexture& further : texture.also)
        map->ids.push_back(id_of(further));
    map->source = plane.source;
    map->patch = number_patches(*map);
    map_ = std::move(map);
    map_of_ = scene.plane.identity();
    return map_;
}

Expected<OverlayPicture> OverlayMaker::make(Overlay kind, const Shot& shot,
                                            const AnalysisStore& store, const RegionScene& scene,
                                            int region, int frame, const CancelToken& cancel) {
    const Size size = shot.source->size();
    const RegionPlan& plan = shot.plan.regions[static_cast<std::size_t>(region)];
    OverlayPicture out;
    out.kind = kind;
    out.frame = frame;
    out.id = next_picture_id();
    WEFT_TRY(shown, shown_matte(*shot.source, shot.plan, store, region, frame));
    out.where = std::move(shown);
    out.value = Matte(size);
    if (kind == Overlay::kLight || kind == Overlay::kLightConfidence) {
        WEFT_CHECK_OK(draw_light(store, region, frame, scene.reference_shading, out));
        return out;
    }
    const ZonedAnalysis placed(*shot.source, shot.plan, store);
    WEFT_TRY(bytes, placed.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(bytes));
    WEFT_TRY(mapping, mapping_on(plan, scene, frame));
    const TextureCoords coords = texture_coords(ref_from_cur, mapping, rect_of(size));
    std::shared_ptr<const PlaneMap> plane;
    if (kind == Overlay::kSeams || kind == Overlay::kSourceMap) {
        WEFT_TRY(map, plane_map(shot, region, scene, cancel));
        plane = std::move(map);
    }
    switch (kind) {
        case Overlay::kGrid:
            draw_grid(coords, plan.texture->pixels.size(), out);
            break;
        case Overlay::kStretch:
            draw_stretch(coords, plan.placement.aspect, out);
            break;
        case Overlay::kSeams:
            if (plane) draw_seams(coords, *plane, out);
            break;
        case Overlay::kMotion:
            draw_motion(ref_from_cur, out);
            break;
        case Overlay::kConfidence:
            WEFT_CHECK_OK(
                draw_confidence(shot, ref_from_cur, plan.reference_frames.front(), frame, out));
            break;
        case Overlay::kSourceMap: {
            if (plane) draw_source_map(coords, *plane, out);
            if (plane && !plan.amendments.empty()) draw_amended(coords, plan, *plane, out);
            WEFT_TRY(asked, provenance_of(shot, store, scene, region, frame));
            asked.plane = plane;
            out.provenance = std::make_shared<const Provenance>(std::move(asked));
            break;
        }
        case Overlay::kChecker:
            draw_checker(coords, plan.placement.scale, out);
            break;
        case Overlay::kCircles:
            draw_circles(coords, plan.placement.scale, out);
            break;
        case Overlay::kNormals:
            WEFT_CHECK_OK(draw_normals(shot, scene, store, region, out));
            break;
        case Overlay::kLight:
        case Overlay::kLightConfidence:
        case Overlay::kNone:
            break;
    }
    return out;
}

}  // namespace weft
