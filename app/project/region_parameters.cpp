#include "app/project/form_parameters.h"
#include "app/project/look_parameters.h"
#include "app/project/matte_parameters.h"
#include "app/project/parameter_entry.h"

namespace weft {
namespace {

using namespace parameter_entry;
using R = Region;

std::vector<Parameter<Region>> make_region_table() {
    std::vector<Parameter<Region>> table{
        entry<R, &R::name>({.key = "name", .flag = "--name", .help = "Name of the region"}),
        entry<R, &R::enabled>(
            {.key = "enabled", .flag = "--enabled", .help = "Replace the texture of this region"}),
        entry<R, &R::color>(
            {.key = "color", .help = "Index of its colour in the editor", .min = 0, .max = 255}),
    };
    for (Parameter<Region>& p : region_matte_parameters())
        table.push_back(std::move(p));
    const Parameter<Region> rest[] = {
        entry<R, &R::texture, &TextureSource::sample>(
            {.group = "texture",
             .key = "sample",
             .flag = "--texture",
             .help = "Sample to synthesize the texture from",
             .is_path = true}),
        entry<R, &R::texture, &TextureSource::also>(
            {.group = "texture",
             .key = "also",
             .flag = "--texture-also",
             .help =
                 "Further sample of the same material, used together with the first; repeatable",
             .max = 63,
             .repeatable = true,
             .is_path = true}),
        entry<R, &R::texture, &TextureSource::mode>(
            {.group = "texture",
             .key = "mode",
             .flag = "--texture-mode",
             .help = "How the sample covers the surface: as its kind suggests, synthesized, or the "
                     "sample itself tiled, stretched or mirrored"}),
        entry<R, &R::texture, &TextureSource::plane>(
            {.group = "texture",
             .key = "plane",
             .flag = "--plane",
             .help = "Image used as the texture, without synthesis",
             .is_path = true}),
        entry<R, &R::texture, &TextureSource::wrap>(
            {.group = "texture",
             .key = "wrap",
             .flag = "--plane-wrap",
             .help = "Continuation beyond the border of the plane"}),
        entry<R, &R::texture, &TextureSource::space>(
            {.group = "texture",
             .key = "space",
             .help = "Colour space of this texture; default the project's"}),
        entry<R, &R::placement, &Placement::scale>(
            {.group = "placement",
             .key = "scale",
             .flag = "--scale",
             .unit = "plate px per sample px",
             .help = "Size of the texture at the placement's origin on the reference frame",
             .min = 0.001,
             .max = 1000}),
        entry<R, &R::placement, &Placement::rotate_deg>(
            {.group = "placement",
             .key = "rotate_deg",
             .flag = "--rotate",
             .unit = "deg",
             .help = "Rotation of the texture, counter-clockwise",
             .min = -3600,
             .max = 3600}),
        entry<R, &R::placement, &Placement::offset_px>(
            {.group = "placement",
             .key = "offset_px",
             .flag = "--offset",
             .unit = "px",
             .help = "Offset of the texture, X,Y in full-resolution plate pixels",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx}),
        entry<R, &R::placement, &Placement::corners_px>(
            {.group = "placement",
             .key = "corners_px",
             .flag = "--corners",
             .unit = "px",
             .help = "Corner pin: top left, top right, bottom right, bottom left, each x,y",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx,
             .optional = true}),
        entry<R, &R::placement, &Placement::fit>(
            {.group = "placement",
             .key = "fit",
             .flag = "--fit",
             .help = "Fit the image of a plane into the corners; otherwise it keeps its size"}),
        entry<R, &R::placement, &Placement::scale_keys>(
            {.group = "placement",
             .key = "scale_keys",
             .flag = "--scale-keys",
             .help = "Animated scale: FRAME:S, separated by spaces",
             .min = 0.001,
             .max = 1000}),
        entry<R, &R::placement, &Placement::rotate_keys>(
            {.group = "placement",
             .key = "rotate_keys",
             .flag = "--rotate-keys",
             .unit = "deg",
             .help = "Animated rotation: FRAME:DEG, separated by spaces",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx}),
        entry<R, &R::placement, &Placement::offset_keys>(
            {.group = "placement",
             .key = "offset_keys",
             .flag = "--offset-keys",
             .unit = "px",
             .help = "Animated offset: FRAME:X,Y, separated by spaces",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx,
             .components = 2}),
        entry<R, &R::placement, &Placement::warp>(
            {.group = "placement",
             .key = "warp",
             .flag = "--warp",
             .help = "Grid warp on the reference frame: a JSON file, text (2x2 corners x,y x,y x,y "
                     "x,y falloff PX points x,y …), or none",
             .optional = true}),
        entry<R, &R::placement, &Placement::uv>(
            {.group = "placement",
             .key = "uv",
             .flag = "--uv",
             .help = "UV pass or ST-map, EXR: exact texture coordinates for each pixel",
             .is_path = true}),
        entry<R, &R::placement, &Placement::uv_layer>(
            {.group = "placement",
             .key = "uv_layer",
             .flag = "--uv-layer",
             .help = "EXR layer of the UV pass; default the one that ends in UV"}),
        entry<R, &R::reference_frames>(
            {.key = "reference_frames",
             .flag = "--reference-frame",
             .help = "Frame on which the texture is placed; further "
                     "ones anchor it again; default the first that shows the surface well",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .repeatable = true}),
        entry<R, &R::motion, &MotionSource::files>(
            {.group = "motion",
             .key = "files",
             .flag = "--motion",
             .help =
                 "Pattern of motion vectors (.flo, KITTI 16-bit PNG) instead of estimated motion",
             .is_path = true}),
        entry<R, &R::motion, &MotionSource::direction>(
            {.group = "motion",
             .key = "direction",
             .flag = "--motion-direction",
             .help = "Motion vectors point to the next frame or to the previous one"}),
        entry<R, &R::motion, &MotionSource::convention>(
            {.group = "motion",
             .key = "convention",
             .flag = "--motion-convention",
             .help = "Convention of a renderer's motion pass; files: .flo and KITTI"}),
        entry<R, &R::motion, &MotionSource::layer>(
            {.group = "motion",
             .key = "layer",
             .flag = "--motion-layer",
             .help = "EXR layer of the motion pass; default by the convention"}),
        entry<R, &R::motion, &MotionSource::track>(
            {.group = "motion",
             .key = "track",
             .flag = "--track",
             .help = "Planar track of the surface: corner pins of Nuke or After Effects, "
                     "text, or JSON",
             .is_path = true}),
        entry<R, &R::synthesis, &SynthesisParams::seam>(
            {.group = "synthesis",
             .key = "seam",
             .flag = "--seam",
             .help = "Seam method: how patches of the sample are joined"}),
        entry<R, &R::synthesis, &SynthesisParams::overlap_px>(
            {.group = "synthesis",
             .key = "overlap_px",
             .flag = "--overlap",
             .unit = "px",
             .help = "Largest overlap of neighbouring patches, in sample pixels",
             .min = 12,
             .max = 2048}),
        entry<R, &R::synthesis, &SynthesisParams::feather_px>(
            {.group = "synthesis",
             .key = "feather_px",
             .flag = "--feather",
             .unit = "px",
             .help = "Blend across the seams, in sample pixels",
             .min = 0,
             .max = 256}),
        entry<R, &R::synthesis, &SynthesisParams::seam_cost>(
            {.group = "synthesis",
             .key = "seam_cost",
             .flag = "--seam-cost",
             .help = "Seam cost: mismatch over gradient, or the paper's eq. 2 and 3"}),
        entry<R, &R::synthesis, &SynthesisParams::refine>(
            {.group = "synthesis",
             .key = "refine",
             .flag = "--refine",
             .help = "Rounds of refinement: cuts all seams again, then puts patches over the worst",
             .min = 0,
             .max = 100}),
        entry<R, &R::synthesis, &SynthesisParams::rotations>(
            {.group = "synthesis",
             .key = "rotations",
             .flag = "--rotations",
             .help = "Also use the sample rotated by quarter turns"}),
        entry<R, &R::synthesis, &SynthesisParams::mirror>({.group = "synthesis",
                                                           .key = "mirror",
                                                           .flag = "--mirror",
                                                           .help = "Also use the sample mirrored"}),
        entry<R, &R::synthesis, &SynthesisParams::align>(
            {.group = "synthesis",
             .key = "align",
             .flag = "--align",
             .help = "Align rows of bricks, tiles and weaves"}),
        entry<R, &R::temporal, &TemporalParams::mode>(
            {.group = "temporal",
             .key = "mode",
             .flag = "--temporal",
             .help = "Temporal mode: locked to the surface, the paper's method, or every frame "
                     "independently"}),
        entry<R, &R::temporal, &TemporalParams::blend>(
            {.group = "temporal",
             .key = "blend",
             .flag = "--temporal-blend",
             .help = "Paper mode: weight of the new frame in the blend with the previous one (α)",
             .min = 0,
             .max = 1}),
        entry<R, &R::temporal, &TemporalParams::weight>(
            {.group = "temporal",
             .key = "weight",
             .flag = "--temporal-weight",
             .help = "Weight of similarity to the previous frame in seam selection (λ_t)",
             .min = 0,
             .max = 100}),
        entry<R, &R::temporal, &TemporalParams::surface>(
            {.group = "temporal",
             .key = "surface",
             .flag = "--surface",
             .help = "What moves: found from the clip, one rigid plane, a rigid thing, cloth that "
                     "bends, or a body with joints"}),
    };
    table.insert(table.end(), std::begin(rest), std::end(rest));
    for (auto& part : {form_parameters(), look_parameters()})
        table.insert(table.end(), part.begin(), part.end());
    return table;
}

}  // namespace

std::span<const Parameter<Region>> region_parameters() {
    static const std::vector<Parameter<Region>> table = make_region_table();
    return table;
}

}  // namespace weft
