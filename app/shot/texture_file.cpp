#include "app/shot/texture_file.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "app/project/project.h"

namespace weft {

Expected<ReadTexture> read_texture(const std::string& path, const std::string& library) {
    ReadTexture out;
    if (!names_library_texture(path)) {
        WEFT_TRY(picture, read_image(path));
        out.picture = std::move(picture);
        if (auto credit = read_texture_credit(path)) out.credit = std::move(*credit);
        return out;
    }
    WEFT_TRY(resolved, resolve_texture(library, path));
    out.credit = std::move(resolved.credit);
    out.picture.rgb = ImageF3(resolved.pixels.size());
    std::transform(resolved.pixels.data(), resolved.pixels.data() + resolved.pixels.size_bytes(),
                   out.picture.rgb.data(),
                   [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    return out;
}

std::string transparency_warning(const std::string& path, const ImageF1& alpha) {
    // What antialiasing or rounding leaves does not show.
    constexpr float kOpaque = 0.99f;
    const auto clear =
        std::count_if(alpha.data(), alpha.data() + alpha.size_bytes() / sizeof(float),
                      [](float a) { return a < kOpaque; });
    if (clear == 0) return {};
    return "The texture " + path + " is transparent in " + std::to_string(clear) +
           " pixels. A texture's alpha is not used, so they show the colour that is stored there, "
           "often black. Crop it to what is opaque, or put it over a colour first.";
}

}  // namespace weft
