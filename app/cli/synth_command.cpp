#include <nlohmann/json.hpp>

#include <filesystem>

#include "app/cli/commands.h"
#include "engine/color/color_space.h"
#include "engine/core/parallel.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

Status write_plane(const std::string& path, const TexturePlane& plane) {
    ImageF3 pixels(plane.pixels.size());
    std::transform(plane.pixels.data(), plane.pixels.data() + plane.pixels.size_bytes(),
                   pixels.data(), [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    WriteOptions write;
    write.depth = default_depth(path, PixelDepth::kU8);
    if (write.depth == PixelDepth::kHalf || write.depth == PixelDepth::kFloat) {
        WEFT_TRY(to_linear, make_color_transform({"srgb"}, {"linear"}));
        to_linear->apply(pixels);
    }
    return write_image(path, pixels, {}, write);
}

// The source map: R and G are the sample's x and y of each texel, B the sample's number (0).
Status write_source_map(const std::string& path, const TexturePlane& plane) {
    ImageF3 map(plane.source.size());
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            for (int c = 0; c < 2; ++c)
                map.pixel(x, y)[c] = static_cast<float>(plane.source.pixel(x, y)[c]);
        }
    }
    WriteOptions write;
    write.depth = PixelDepth::kFloat;
    WEFT_CHECK_OK(check_format(path, write));
    return write_image(path, map, {}, write);
}

Expected<TexturePlane> run(const SynthOptions& options) {
    for (const std::string& path : {options.output, options.source_map}) {
        if (!path.empty() && !options.overwrite && std::filesystem::exists(path)) {
            return fail(ErrorCode::kUsage,
                        path + " exists already. Use --overwrite, or another name.");
        }
    }
    WriteOptions write;
    write.depth = default_depth(options.output, PixelDepth::kU8);
    WEFT_CHECK_OK(check_format(options.output, write));
    WEFT_TRY(picture, read_image(options.sample));
    const bool is_float = picture.depth == PixelDepth::kHalf || picture.depth == PixelDepth::kFloat;
    WEFT_TRY(space, parse_color_space(!options.texture_space.empty() ? options.texture_space
                                      : is_float                     ? "linear"
                                                                     : "srgb"));
    WEFT_TRY(display_from_texture, make_color_transform(space, {"srgb"}));
    const ImageU8x3 sample = make_views(picture.rgb, *display_from_texture).display;
    if (const auto warning = sample_warning(sample))
        print_warning(options.sample + ": " + *warning);
    auto plane = grow_plane(sample, options.plane, cancel_on_signals());
    if (!plane) return fail_in(std::move(plane).error(), options.sample);
    WEFT_CHECK_OK(write_plane(options.output, *plane));
    if (!options.source_map.empty()) WEFT_CHECK_OK(write_source_map(options.source_map, *plane));
    return plane;
}

}  // namespace

int synth_command(const SynthOptions& options) {
    set_thread_count(options.threads);
    const auto plane = run(options);
    if (!plane) return report_error(plane.error());
    const PlaneStats& s = plane->stats;
    const nlohmann::ordered_json json{
        {"size", {plane->pixels.width(), plane->pixels.height()}},
        {"seconds",
         {{"search", s.search_s}, {"seam", s.seam_s}, {"other", s.other_s}, {"total", s.total_s}}},
        {"seam_energy", s.seam_energy},
        {"seam_length_px", s.seam_length_px},
        {"seam_energy_per_area", s.seam_energy_per_area},
        {"peak_graph_bytes", s.peak_graph_bytes},
        {"placements", s.placements},
        {"backend", "cpu"},
        {"threads", thread_count()},
        {"seed", options.plane.seed}};
    if (options.json) {
        print(stdout, json.dump(2) + "\n");
        return 0;
    }
    char line[256];
    std::snprintf(line, sizeof line,
                  "%s %dx%d: %d placements, seam energy per area %.3f, %.3fs (search %.3f, seam "
                  "%.3f, other %.3f)\n",
                  options.output.c_str(), plane->pixels.width(), plane->pixels.height(),
                  s.placements, s.seam_energy_per_area, s.total_s, s.search_s, s.seam_s, s.other_s);
    print(stdout, line);
    return 0;
}

}  // namespace weft
