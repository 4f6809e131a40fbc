#include "app/project/look_parameters.h"

#include <utility>

#include "app/project/parameter_entry.h"

namespace weft {
namespace {

using parameter_entry::entry;
using R = Region;
using Table = std::vector<Parameter<Region>>;

Table light_entries() {
    return {
        entry<R, &R::light, &LightParams::source>({.group = "light",
                                                   .key = "source",
                                                   .flag = "--light",
                                                   .help = "Source of the light on the new texture",
                                                   .path_key = "image"}),
        entry<R, &R::light, &LightParams::image>(
            {.group = "light",
             .key = "image",
             .help = "Illumination image of the light source 'image'",
             .is_path = true}),
        entry<R, &R::light, &LightParams::form>(
            {.group = "light",
             .key = "form",
             .flag = "--blend-mode",
             .old_flag = "--light-form",
             .help = "How the light is applied to the texture"}),
        entry<R, &R::light, &LightParams::strength>({.group = "light",
                                                     .key = "strength",
                                                     .flag = "--light-strength",
                                                     .help = "Strength of the light (λ); above 1 "
                                                             "its contrast is raised",
                                                     .min = 0,
                                                     .max = 2}),
        entry<R, &R::light, &LightParams::strength_keys>(
            {.group = "light",
             .key = "strength_keys",
             .flag = "--light-keys",
             .help = "Animated strength of the light: FRAME:λ, separated by spaces",
             .min = 0,
             .max = 2}),
        entry<R, &R::light, &LightParams::lamps>(
            {.group = "light",
             .key = "lamps",
             .flag = "--lamps",
             .help = "Painted light: point X,Y RADIUS GAIN; directional ANGLE GAIN; gradient X,Y "
                     "X,Y GAIN GAIN; keys as FRAME: … | FRAME: …"}),
        entry<R, &R::light, &LightParams::detail>(
            {.group = "light",
             .key = "detail",
             .flag = "--light-detail",
             .help =
                 "Light detail: 0 broad light only, 0.5 as estimated, 1 all that the plate shows",
             .min = 0,
             .max = 1}),
        entry<R, &R::light, &LightParams::keep_detail>(
            {.group = "light",
             .key = "keep_detail",
             .flag = "--keep-detail",
             .help = "How much of the old surface's fine detail (creases, seams, dirt) is kept",
             .min = 0,
             .max = 2}),
        entry<R, &R::light, &LightParams::cast>(
            {.group = "light",
             .key = "cast",
             .flag = "--light-tint",
             .old_flag = "--light-cast",
             .help = "How much of the light's colour the texture takes; default measured",
             .min = 0,
             .max = 1,
             .optional = true}),
        entry<R, &R::light, &LightParams::highlights>(
            {.group = "light",
             .key = "highlights",
             .flag = "--highlights",
             .help = "How much of the old surface's gloss is kept",
             .min = 0,
             .max = 2}),
        entry<R, &R::light, &LightParams::roughness>(
            {.group = "light",
             .key = "roughness",
             .flag = "--highlight-roughness",
             .help = "Blurs the gloss that is kept: 0 as sharp as the plate, 1 very rough",
             .min = 0,
             .max = 1}),
        entry<R, &R::light, &LightParams::albedo>(
            {.group = "light",
             .key = "albedo",
             .flag = "--albedo",
             .help = "Pattern of the plate's albedo pass: gives the exact light",
             .is_path = true}),
        entry<R, &R::light, &LightParams::lighting>(
            {.group = "light",
             .key = "lighting",
             .flag = "--lighting",
             .help = "Pattern of the plate's lighting pass: gives the exact light",
             .is_path = true}),
        entry<R, &R::light, &LightParams::pass_layer>(
            {.group = "light",
             .key = "pass_layer",
             .flag = "--light-layer",
             .help = "EXR layer of these passes; several joined by + are added up"}),
        entry<R, &R::light, &LightParams::exact>(
            {.group = "light",
             .key = "exact",
             .flag = "--light-exact",
             .help = "Use the pass's light unchanged, colour included, not relative to the "
                     "reference frame's"}),
    };
}

Table grade_entries() {
    return {
        entry<R, &R::grade, &GradeParams::match>(
            {.group = "grade",
             .key = "match",
             .flag = "--match-plate",
             .help = "How far the texture's exposure follows the plate's",
             .min = 0,
             .max = 1}),
        entry<R, &R::grade, &GradeParams::exposure>({.group = "grade",
                                                     .key = "exposure",
                                                     .flag = "--exposure",
                                                     .unit = "stops",
                                                     .help = "Exposure of the texture",
                                                     .min = -10,
                                                     .max = 10}),
        entry<R, &R::grade, &GradeParams::temperature>(
            {.group = "grade",
             .key = "temperature",
             .flag = "--temperature",
             .unit = "mired",
             .help = "Colour temperature of the texture; above 0 is warmer",
             .min = -200,
             .max = 200}),
        entry<R, &R::grade, &GradeParams::multiply>(
            {.group = "grade",
             .key = "multiply",
             .flag = "--multiply",
             .help = "Factor on the texture, in linear light; one number or R,G,B",
             .min = 0,
             .max = 100}),
        entry<R, &R::grade, &GradeParams::contrast>(
            {.group = "grade",
             .key = "contrast",
             .flag = "--contrast",
             .help = "Contrast of the texture about middle grey",
             .min = 0,
             .max = 4}),
        entry<R, &R::grade, &GradeParams::gamma>(
            {.group = "grade",
             .key = "gamma",
             .flag = "--gamma",
             .help = "Gamma of the texture; above 1 is brighter",
             .min = 0.1,
             .max = 10}),
        entry<R, &R::grade, &GradeParams::saturation>({.group = "grade",
                                                       .key = "saturation",
                                                       .flag = "--saturation",
                                                       .help = "Saturation of the texture",
                                                       .min = 0,
                                                       .max = 4}),
        entry<R, &R::grade, &GradeParams::hue_deg>({.group = "grade",
                                                    .key = "hue_deg",
                                                    .flag = "--hue",
                                                    .unit = "deg",
                                                    .help = "Turns the texture's hue",
                                                    .min = -180,
                                                    .max = 180}),
        entry<R, &R::grade, &GradeParams::offset>(
            {.group = "grade",
             .key = "offset",
             .flag = "--color-offset",
             .help = "Added to the texture, in linear light; one number or R,G,B",
             .min = -10,
             .max = 10}),
    };
}

Table layer_entries() {
    return {
        entry<R, &R::layer, &LayerParams::opacity>({.group = "layer",
                                                    .key = "opacity",
                                                    .flag = "--opacity",
                                                    .help = "Opacity of the new surface",
                                                    .min = 0,
                                                    .max = 1}),
        entry<R, &R::layer, &LayerParams::blend>(
            {.group = "layer",
             .key = "blend",
             .flag = "--layer-blend",
             .help = "Blend mode of the new surface over the old one"}),
    };
}

Table finish_entries() {
    return {
        entry<R, &R::finish, &FinishParams::grain>(
            {.group = "finish",
             .key = "grain",
             .flag = "--grain",
             .help = "How much of the plate's grain is added to the texture",
             .min = 0,
             .max = 2}),
        entry<R, &R::finish, &FinishParams::focus>(
            {.group = "finish",
             .key = "focus",
             .flag = "--defocus",
             .old_flag = "--focus",
             .help = "How much of the plate's defocus is applied to the texture",
             .min = 0,
             .max = 2}),
        entry<R, &R::finish, &FinishParams::depth>(
            {.group = "finish",
             .key = "depth",
             .flag = "--depth-pass",
             .help = "Pattern of a depth pass that guides defocus",
             .is_path = true}),
        entry<R, &R::finish, &FinishParams::depth_layer>(
            {.group = "finish",
             .key = "depth_layer",
             .flag = "--depth-layer",
             .help = "EXR layer of the depth pass; default Depth or Z"}),
        entry<R, &R::finish, &FinishParams::shutter_deg>(
            {.group = "finish",
             .key = "shutter_deg",
             .flag = "--shutter",
             .unit = "deg",
             .help = "Shutter angle of the motion blur; default measured (final quality)",
             .min = 0,
             .max = 720,
             .optional = true}),
    };
}

Table line_entries() {
    return {
        entry<R, &R::lines, &LineParams::files>(
            {.group = "lines",
             .key = "files",
             .flag = "--lines",
             .help = "Pattern of the ink lines' coverage; lines stay on top of the texture",
             .is_path = true}),
        entry<R, &R::lines, &LineParams::invert>({.group = "lines",
                                                  .key = "invert",
                                                  .flag = "--lines-invert",
                                                  .help = "Ink is dark in the line pass"}),
        entry<R, &R::lines, &LineParams::extract>(
            {.group = "lines",
             .key = "extract",
             .flag = "--extract-lines",
             .help = "Find the ink lines in the plate and keep them on top of the texture"}),
        entry<R, &R::lines, &LineParams::width_px>({.group = "lines",
                                                    .key = "width_px",
                                                    .flag = "--line-width",
                                                    .unit = "px",
                                                    .help = "The widest stroke that counts as ink",
                                                    .min = 1,
                                                    .max = 64}),
    };
}

}  // namespace

std::vector<Parameter<Region>> look_parameters() {
    Table table;
    for (Table part :
         {light_entries(), grade_entries(), layer_entries(), finish_entries(), line_entries()})
        for (Parameter<Region>& entry : part)
            table.push_back(std::move(entry));
    return table;
}

}  // namespace weft
