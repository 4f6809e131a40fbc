#include "app/project/parameter_entry.h"
#include "engine/core/pixel_aspect.h"

namespace weft {
namespace {

using namespace parameter_entry;

std::vector<Parameter<Project>> make_project_table() {
    using P = Project;
    return {
        entry<P, &P::name>({.key = "name", .flag = "--project-name", .help = "Name of the shot"}),
        entry<P, &P::plate, &Plate::path>(
            {.group = "plate",
             .key = "path",
             .flag = "--plate",
             .help = "Numbered sequence ('frames/####.png'), a folder with one, or a movie",
             .is_path = true}),
        entry<P, &P::plate, &Plate::layer>({.group = "plate",
                                            .key = "layer",
                                            .flag = "--plate-layer",
                                            .help = "EXR layer to read"}),
        entry<P, &P::plate, &Plate::movie_start>({.group = "plate",
                                                  .key = "movie_start",
                                                  .flag = "--movie-start",
                                                  .help = "Number of a movie's first frame",
                                                  .min = -kMaxFrame,
                                                  .max = kMaxFrame}),
        entry<P, &P::plate, &Plate::space>(
            {.group = "plate",
             .key = "space",
             .flag = "--plate-space",
             .help = "Colour space of the plate; default by the file type"}),
        entry<P, &P::plate, &Plate::fps>({.group = "plate",
                                          .key = "fps",
                                          .flag = "--fps",
                                          .unit = "frames/s",
                                          .help = "Frame rate; 0: the plate's",
                                          .min = 0,
                                          .max = 1000}),
        entry<P, &P::plate, &Plate::pixel_aspect>(
            {.group = "plate",
             .key = "pixel_aspect",
             .flag = "--pixel-aspect",
             .help = "Pixel width divided by height: 2 for anamorphic; default the plate's",
             .min = PixelAspect::kLeast,
             .max = PixelAspect::kMost,
             .optional = true}),
        entry<P, &P::plate, &Plate::missing>(
            {.group = "plate",
             .key = "missing",
             .flag = "--missing",
             .help = "Missing plate frames: stop, hold the previous one, black, or skip"}),
        entry<P, &P::color, &ColorSettings::working_space>(
            {.group = "color",
             .key = "working_space",
             .flag = "--working-space",
             .help = "Colour space to compute in; default linear"}),
        entry<P, &P::color, &ColorSettings::texture_space>(
            {.group = "color",
             .key = "texture_space",
             .flag = "--texture-space",
             .help = "Colour space of the textures; default by the file type"}),
        entry<P, &P::color, &ColorSettings::out_space>(
            {.group = "color",
             .key = "out_space",
             .flag = "--out-space",
             .help = "Colour space of the output; default by the file type"}),
        entry<P, &P::settings, &RenderSettings::quality>({.group = "settings",
                                                          .key = "quality",
                                                          .flag = "--quality",
                                                          .help = "Draft or final quality"}),
        entry<P, &P::settings, &RenderSettings::seed>({.group = "settings",
                                                       .key = "seed",
                                                       .flag = "--seed",
                                                       .help = "Seed of all random choices",
                                                       .min = 0,
                                                       .max = kMaxExactInteger}),
        entry<P, &P::settings, &RenderSettings::frames>(
            {.group = "settings",
             .key = "frames",
             .flag = "--frames",
             .help = "Frames to render: 1-40, 1-100x2, -5--1, 1,4,9-12; default all"}),
        entry<P, &P::settings, &RenderSettings::excluded_licences>(
            {.group = "settings",
             .key = "excluded_licences",
             .flag = "--exclude-licences",
             .help = "Licences and families that no texture may have (GPL, CC-BY-SA, copyleft, "
                     "unknown), separated by commas",
             .repeatable = true}),
        entry<P, &P::output, &Output::path>(
            {.group = "output",
             .key = "path",
             .flag = "--output",
             .help = "Pattern of the images to write ('out/####.png')",
             .is_path = true}),
        entry<P, &P::output, &Output::depth>(
            {.group = "output",
             .key = "depth",
             .flag = "--depth",
             .help =
                 "Bits per channel; auto: the plate's, or the nearest that the format supports"}),
        entry<P, &P::output, &Output::jpeg_quality>({.group = "output",
                                                     .key = "jpeg_quality",
                                                     .flag = "--jpeg-quality",
                                                     .help = "Quality of JPEG images",
                                                     .min = 1,
                                                     .max = 100}),
        entry<P, &P::output, &Output::exr_compression>(
            {.group = "output",
             .key = "exr_compression",
             .flag = "--exr-compression",
             .help = "Compression of EXR images: auto, none, rle, zip, zips, piz, dwaa, …"}),
        entry<P, &P::output, &Output::movie>(
            {.group = "output",
             .key = "movie",
             .flag = "--movie",
             .help = "Review movie to write: .mp4, or .mkv for lossless",
             .is_path = true}),
        entry<P, &P::output, &Output::burn_in>(
            {.group = "output",
             .key = "burn_in",
             .flag = "--burn-in",
             .help = "Burn frame number, version and colour space into the movie"}),
        entry<P, &P::output, &Output::layers>(
            {.group = "output",
             .key = "layers",
             .flag = "--layers",
             .help = "EXR layers for compositing, separated by commas"}),
        entry<P, &P::output, &Output::layers_path>(
            {.group = "output",
             .key = "layers_path",
             .flag = "--layers-output",
             .help = "Pattern of separate EXR files for the layers",
             .is_path = true}),
    };
}

}  // namespace

std::span<const Parameter<Project>> project_parameters() {
    static const std::vector<Parameter<Project>> table = make_project_table();
    return table;
}

std::string_view choice_name(TemporalMode value) {
    return name_of(value);
}
std::string_view choice_name(LightSource value) {
    return name_of(value);
}

}  // namespace weft
