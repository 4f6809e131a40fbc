#include "app/flatten/flat_file.h"

#include <algorithm>
#include <filesystem>

#include "engine/core/text.h"
#include "engine/media/open_raster.h"

namespace weft {
namespace {

std::string ending_of(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

ImageF1 alpha_of(const Matte& coverage) {
    ImageF1 out(coverage.size());
    std::transform(coverage.data(), coverage.data() + coverage.size_bytes(), out.data(),
                   [](std::uint8_t c) { return static_cast<float>(c) / 255.0f; });
    return out;
}

Expected<ImageF3> encoded(const ImageF3& working, const ShotSpaces& spaces,
                          const std::string& space) {
    WEFT_TRY(transform, make_color_transform(spaces.working, {space}));
    ImageF3 out = working;
    transform->apply(out);
    return out;
}

}  // namespace

bool is_open_raster(const std::string& path) {
    return ending_of(path) == ".ora";
}

Status check_flat_file(const std::string& path) {
    const std::string ending = ending_of(path);
    for (const char* known : {".png", ".tif", ".tiff", ".exr", ".ora"})
        if (ending == known) return {};
    return fail(ErrorCode::kUsage,
                "A flat picture is written as .ora (OpenRaster, with layers), .png, .tif or .exr, "
                "and " +
                    path + " is none of them.",
                "Choose one of these names.");
}

Expected<std::vector<std::string>> write_flat_file(const std::string& path,
                                                   const FlatPictures& pictures,
                                                   const ShotSpaces& spaces, WriteOptions write) {
    const bool linear = ending_of(path) == ".exr";
    WEFT_TRY(surface, encoded(pictures.surface.colour, spaces, linear ? "linear" : "srgb"));
    const ImageF1 alpha = alpha_of(pictures.surface.coverage);
    // Krita asks for the profile of a PNG with 16 bits, and proposes a linear one.
    write.depth = linear                      ? PixelDepth::kFloat
                  : ending_of(path) == ".png" ? PixelDepth::kU8
                                              : PixelDepth::kU16;
    write.exr_compression = "zip";
    if (!is_open_raster(path)) {
        WEFT_CHECK_OK(write_image(path, surface, alpha, write));
        return std::vector<std::string>();
    }
    std::vector<OpenRasterLayer> layers{{"Surface", surface, alpha}};
    ImageF3 texture;
    if (pictures.texture) {
        WEFT_TRY(coded, encoded(*pictures.texture, spaces, "srgb"));
        texture = std::move(coded);
        layers.push_back({"Texture", texture, alpha, false});
    }
    const ImageF3 black(surface.size());
    const ImageF1 clear(surface.size());
    layers.push_back({"Paint", black, clear});
    WEFT_CHECK_OK(write_open_raster(path, layers, write));
    std::vector<std::string> names;
    for (const OpenRasterLayer& layer : layers)
        names.push_back(layer.name);
    return names;
}

}  // namespace weft
