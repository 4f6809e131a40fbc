#include <limits>

#include "app/project/parameter_entry.h"

namespace weft {
namespace {

using namespace parameter_entry;

/// Path: to the MatteSource inside Owner; empty when Owner is one.
template <class Owner, auto... Path>
std::vector<Parameter<Owner>> matte_entries() {
    return {
        entry<Owner, Path..., &MatteSource::files>(
            {.group = "matte",
             .key = "files",
             .help = "Pattern of a matte for every frame, instead of keyframes",
             .is_path = true}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::value>(
            {.group = "matte",
             .key = "value",
             .flag = "--matte-value",
             .help = "Id matte: the matte is where the pixel equals this number",
             .min = 0,
             .max = std::numeric_limits<std::int32_t>::max(),
             .optional = true}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::channel>(
            {.group = "matte",
             .key = "channel",
             .flag = "--matte-channel",
             .help = "Channel that holds the matte: R, G, B, A, Y (luma) or a name; default A when "
                     "the file has a used alpha, else Y"}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::invert>(
            {.group = "matte",
             .key = "invert",
             .flag = "--matte-invert",
             .help = "The surface is where the matte is black"}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::crypto>(
            {.group = "matte", .key = "crypto", .help = "Objects of a Cryptomatte, with commas"}),
        entry<Owner, Path..., &MatteSource::steadiness>(
            {.group = "matte",
             .key = "steadiness",
             .flag = "--matte-steadiness",
             .help = "How much of the boundary's boil is taken out of propagated mattes",
             .min = 0,
             .max = 1}),
        entry<Owner, Path..., &MatteSource::frozen>(
            {.group = "matte",
             .key = "frozen",
             .flag = "--matte-frozen",
             .help = "Frames whose mattes are final: read from --matte-frozen-files, kept as they "
                     "are, and propagated from like painted ones",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .repeatable = true}),
        entry<Owner, Path..., &MatteSource::frozen_files>(
            {.group = "matte",
             .key = "frozen_files",
             .flag = "--matte-frozen-files",
             .help = "Pattern of the frozen frames' mattes, as 'weft matte' wrote them",
             .is_path = true}),
        entry<Owner, Path..., &MatteSource::carry>(
            {.group = "matte",
             .key = "carry",
             .flag = "--matte-carry",
             .help = "Which way painted mattes are carried; elsewhere there is none"}),
        entry<Owner, Path..., &MatteSource::carry_from>(
            {.group = "matte",
             .key = "carry_from",
             .flag = "--matte-from",
             .help = "First frame that painted mattes are carried to",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .optional = true}),
        entry<Owner, Path..., &MatteSource::carry_to>(
            {.group = "matte",
             .key = "carry_to",
             .flag = "--matte-to",
             .help = "Last frame that painted mattes are carried to",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .optional = true}),
    };
}

std::vector<Parameter<Region>> make_region_table() {
    using R = Region;
    std::vector<Parameter<Region>> table{
        entry<R, &R::name>({.key = "name", .flag = "--name", .help = "Name of the region"}),
        entry<R, &R::enabled>({.key = "enabled",
                               .flag = "--enabled",
                               .help = "Whether the region is replaced at all"}),
        entry<R, &R::color>(
            {.key = "color", .help = "Index of its colour in the editor", .min = 0, .max = 255}),
    };
    for (Parameter<Region>& p : matte_entries<Region, &Region::matte>())
        table.push_back(std::move(p));
    const Parameter<Region> rest[] = {
        entry<R, &R::texture, &TextureSource::sample>({.group = "texture",
                                                       .key = "sample",
                                                       .flag = "--texture",
                                                       .help = "Picture to grow the texture from",
                                                       .is_path = true}),
        entry<R, &R::texture, &TextureSource::also>(
            {.group = "texture",
             .key = "also",
             .flag = "--texture-also",
             .help = "Further picture of the same material, grown together with --texture; may be "
                     "given several times",
             .max = 63,
             .repeatable = true,
             .is_path = true}),
        entry<R, &R::texture, &TextureSource::plane>(
            {.group = "texture",
             .key = "plane",
             .flag = "--plane",
             .help = "Picture used as the texture itself, without synthesis",
             .is_path = true}),
        entry<R, &R::texture, &TextureSource::wrap>(
            {.group = "texture",
             .key = "wrap",
             .flag = "--plane-wrap",
             .help = "What lies beyond the border of the plane"}),
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
             .help = "Shift of the texture, X,Y in full-resolution plate pixels",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx}),
        entry<R, &R::placement, &Placement::corners_px>(
            {.group = "placement",
             .key = "corners_px",
             .flag = "--corners",
             .unit = "px",
             .help = "Where the texture's corners go: top left, top right, bottom right, bottom "
                     "left, each x,y",
             .min = -kMaxPlatePx,
             .max = kMaxPlatePx,
             .optional = true}),
        entry<R, &R::placement, &Placement::fit>(
            {.group = "placement",
             .key = "fit",
             .flag = "--fit",
             .help = "Fit a given picture (--plane) into the corners; --fit=false keeps its size, "
                     "as that of a texture from a sample"}),
        entry<R, &R::placement, &Placement::scale_keys>(
            {.group = "placement",
             .key = "scale_keys",
             .flag = "--scale-keys",
             .help = "Scale over time, FRAME:S between spaces, instead of one"}),
        entry<R, &R::placement, &Placement::rotate_keys>(
            {.group = "placement",
             .key = "rotate_keys",
             .flag = "--rotate-keys",
             .help = "Rotation over time, FRAME:DEG between spaces, instead of one"}),
        entry<R, &R::placement, &Placement::offset_keys>(
            {.group = "placement",
             .key = "offset_keys",
             .flag = "--offset-keys",
             .help = "Shift over time, FRAME:X,Y between spaces, instead of one"}),
        entry<R, &R::placement, &Placement::uv>(
            {.group = "placement",
             .key = "uv",
             .flag = "--uv",
             .help = "UV pass or ST-map, EXR: which place of the texture each pixel shows, exactly",
             .is_path = true}),
        entry<R, &R::placement, &Placement::uv_layer>(
            {.group = "placement",
             .key = "uv_layer",
             .flag = "--uv-layer",
             .help = "EXR layer of the UV pass; default the one that ends in UV"}),
        entry<R, &R::reference_frames>({.key = "reference_frames",
                                        .flag = "--reference-frame",
                                        .help = "Frame on which the texture is placed; further "
                                                "ones hold it in place; default the first frame",
                                        .min = -kMaxFrame,
                                        .max = kMaxFrame,
                                        .repeatable = true}),
        entry<R, &R::motion, &MotionSource::files>(
            {.group = "motion",
             .key = "files",
             .flag = "--motion",
             .help = "Pattern of true motion (.flo, KITTI 16-bit PNG) instead of the estimate",
             .is_path = true}),
        entry<R, &R::motion, &MotionSource::direction>(
            {.group = "motion",
             .key = "direction",
             .flag = "--motion-direction",
             .help = "Whether a motion file points to the next frame or to the previous one"}),
        entry<R, &R::motion, &MotionSource::convention>(
            {.group = "motion",
             .key = "convention",
             .flag = "--motion-convention",
             .help = "How a renderer's motion pass is meant; files: .flo and KITTI"}),
        entry<R, &R::motion, &MotionSource::layer>(
            {.group = "motion",
             .key = "layer",
             .flag = "--motion-layer",
             .help = "EXR layer of the motion pass; default by the convention"}),
        entry<R, &R::motion, &MotionSource::track>(
            {.group = "motion",
             .key = "track",
             .flag = "--track",
             .help = "Planar track that the surface follows: corner pins of Nuke or After Effects, "
                     "text, or JSON",
             .is_path = true}),
        entry<R, &R::synthesis, &SynthesisParams::seam>(
            {.group = "synthesis",
             .key = "seam",
             .flag = "--seam",
             .help = "How pieces of the sample are joined"}),
        entry<R, &R::synthesis, &SynthesisParams::overlap_px>(
            {.group = "synthesis",
             .key = "overlap_px",
             .flag = "--overlap",
             .unit = "px",
             .help = "Largest overlap of neighbouring pieces, in sample pixels",
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
             .help = "What a seam costs: mismatch over gradient, or the paper's eq. 2 and 3"}),
        entry<R, &R::synthesis, &SynthesisParams::refine>(
            {.group = "synthesis",
             .key = "refine",
             .flag = "--refine",
             .help = "Rounds of refinement: cuts anew, then new pieces over the worst seams",
             .min = 0,
             .max = 100}),
        entry<R, &R::synthesis, &SynthesisParams::rotations>(
            {.group = "synthesis",
             .key = "rotations",
             .flag = "--rotations",
             .help = "Use the sample turned by quarters, too"}),
        entry<R, &R::synthesis, &SynthesisParams::mirror>({.group = "synthesis",
                                                           .key = "mirror",
                                                           .flag = "--mirror",
                                                           .help = "Use the sample mirrored, too"}),
        entry<R, &R::synthesis, &SynthesisParams::align>(
            {.group = "synthesis",
             .key = "align",
             .flag = "--align",
             .help = "Keep bricks, tiles and weaves in step; --align=false lets them go"}),
        entry<R, &R::temporal, &TemporalParams::mode>(
            {.group = "temporal",
             .key = "mode",
             .flag = "--temporal",
             .help = "How the texture is carried through time: locked to the surface, as in the "
                     "paper, or every frame anew"}),
        entry<R, &R::temporal, &TemporalParams::blend>(
            {.group = "temporal",
             .key = "blend",
             .flag = "--temporal-blend",
             .help = "Paper mode: share of the new frame in the blend with the previous one (α)",
             .min = 0,
             .max = 1}),
        entry<R, &R::temporal, &TemporalParams::weight>(
            {.group = "temporal",
             .key = "weight",
             .flag = "--temporal-weight",
             .help = "Weight of likeness to the previous frame when seams are chosen (λ_t)",
             .min = 0,
             .max = 100}),
        entry<R, &R::light, &LightParams::source>(
            {.group = "light",
             .key = "source",
             .flag = "--light",
             .help = "Where the light on the new texture comes from",
             .path_key = "image"}),
        entry<R, &R::light, &LightParams::image>(
            {.group = "light",
             .key = "image",
             .help = "Illumination picture of the light source 'image'",
             .is_path = true}),
        entry<R, &R::light, &LightParams::form>({.group = "light",
                                                 .key = "form",
                                                 .flag = "--light-form",
                                                 .help = "How the light is put on the texture"}),
        entry<R, &R::light, &LightParams::strength>({.group = "light",
                                                     .key = "strength",
                                                     .flag = "--light-strength",
                                                     .help = "Strength of the light (λ)",
                                                     .min = 0,
                                                     .max = 1}),
        entry<R, &R::light, &LightParams::strength_keys>(
            {.group = "light",
             .key = "strength_keys",
             .flag = "--light-keys",
             .help = "Strength of the light over time, FRAME:λ between spaces, instead of one"}),
        entry<R, &R::light, &LightParams::lamps>(
            {.group = "light",
             .key = "lamps",
             .flag = "--lamps",
             .help = "Painted light: point X,Y RADIUS GAIN; directional ANGLE GAIN; gradient X,Y "
                     "X,Y GAIN GAIN; keys as FRAME: … | FRAME: …"}),
        entry<R, &R::light, &LightParams::cast>(
            {.group = "light",
             .key = "cast",
             .flag = "--light-cast",
             .help = "How far the colour of the light is taken over as well",
             .min = 0,
             .max = 1}),
        entry<R, &R::light, &LightParams::highlights>(
            {.group = "light",
             .key = "highlights",
             .flag = "--highlights",
             .help = "How much of the old surface's gloss is kept",
             .min = 0,
             .max = 2}),
        entry<R, &R::light, &LightParams::albedo>(
            {.group = "light",
             .key = "albedo",
             .flag = "--albedo",
             .help = "Pattern of a pass of the plate's unlit colour: gives the exact light",
             .is_path = true}),
        entry<R, &R::light, &LightParams::lighting>(
            {.group = "light",
             .key = "lighting",
             .flag = "--lighting",
             .help = "Pattern of a pass of the plate's light alone: gives the exact light",
             .is_path = true}),
        entry<R, &R::light, &LightParams::pass_layer>(
            {.group = "light",
             .key = "pass_layer",
             .flag = "--light-layer",
             .help = "EXR layer of the albedo or lighting pass"}),
        entry<R, &R::light, &LightParams::exact>(
            {.group = "light",
             .key = "exact",
             .flag = "--light-exact",
             .help = "Take the pass's light as it is, colour included, not relative to the "
                     "reference frame's"}),
        entry<R, &R::finish, &FinishParams::grain>(
            {.group = "finish",
             .key = "grain",
             .flag = "--grain",
             .help = "How much of the plate's grain is put on the texture (final quality)",
             .min = 0,
             .max = 2}),
        entry<R, &R::finish, &FinishParams::focus>(
            {.group = "finish",
             .key = "focus",
             .flag = "--focus",
             .help = "How far the texture is blurred as the plate is (final quality)",
             .min = 0,
             .max = 2}),
        entry<R, &R::finish, &FinishParams::depth>(
            {.group = "finish",
             .key = "depth",
             .flag = "--depth-pass",
             .help = "Pattern of a depth pass, along which the plate's blur is followed",
             .is_path = true}),
        entry<R, &R::finish, &FinishParams::shutter_deg>(
            {.group = "finish",
             .key = "shutter_deg",
             .flag = "--shutter",
             .unit = "deg",
             .help =
                 "How long the shutter is open: the texture is blurred along its motion; 180 is "
                 "half a frame, 0 none; default as the plate is (final quality)",
             .min = 0,
             .max = 720,
             .optional = true}),
        entry<R, &R::lines, &LineParams::files>(
            {.group = "lines",
             .key = "files",
             .flag = "--lines",
             .help = "Pattern of the ink lines' coverage: they stay on top of the texture",
             .is_path = true}),
        entry<R, &R::lines, &LineParams::invert>(
            {.group = "lines",
             .key = "invert",
             .flag = "--lines-invert",
             .help = "The line pass is dark where there is ink"}),
        entry<R, &R::lines, &LineParams::extract>(
            {.group = "lines",
             .key = "extract",
             .flag = "--extract-lines",
             .help = "Find the ink lines in the plate and keep them on top of the texture"}),
        entry<R, &R::lines, &LineParams::width_px>(
            {.group = "lines",
             .key = "width_px",
             .flag = "--line-width",
             .unit = "px",
             .help = "The widest stroke that --extract-lines takes for ink",
             .min = 1,
             .max = 64}),
    };
    table.insert(table.end(), std::begin(rest), std::end(rest));
    return table;
}

}  // namespace

std::span<const Parameter<Region>> region_parameters() {
    static const std::vector<Parameter<Region>> table = make_region_table();
    return table;
}
std::span<const Parameter<MatteSource>> matte_parameters() {
    static const std::vector<Parameter<MatteSource>> table = matte_entries<MatteSource>();
    return table;
}

}  // namespace weft
