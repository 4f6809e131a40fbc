#include "texture_db/library/source_picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/core/text.h"
#include "engine/media/image_files.h"
#include "engine/media/raster.h"
#include "texture_db/describe/picture_file.h"
#include "texture_db/starter/starter.h"

namespace weft {

Expected<ImageU8x3> read_picture_file(const std::string& path, long long max_pixels) {
    WEFT_TRY(about, probe_raster(path, {}));
    const long long pixels =
        static_cast<long long>(about.size.width) * static_cast<long long>(about.size.height);
    if (about.size.empty() || pixels > max_pixels) {
        return fail(ErrorCode::kUnreadable,
                    path + " is " + size_text(about.size) +
                        " pixels, more than a texture library takes (" +
                        std::to_string(max_pixels / 1'000'000) + " megapixels).",
                    "Scale it down and import it again.");
    }
    // A header may claim more than the file can hold: no format packs a pixel into less than about
    // a thousandth of a byte.
    std::error_code ignored;
    const auto bytes = static_cast<long long>(std::filesystem::file_size(path, ignored));
    if (!ignored && pixels > 4'000'000 && bytes < pixels / 1000) {
        return fail(ErrorCode::kUnreadable,
                    path + " claims to have " + std::to_string(pixels / 1'000'000) +
                        " megapixels but holds " + std::to_string(bytes) + " bytes: it is damaged.",
                    "Copy or export it again.");
    }
    WEFT_TRY(raster, read_raster(path, {}));
    ImageU8x3 out(raster.info.size);
    const auto step = static_cast<std::size_t>(raster.channels);
    const bool grey = raster.colors() < 3;
    const std::size_t count = out.size_bytes() / 3;
    const auto fill = [&](const auto& samples, auto code) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                out.data()[3 * i + c] = code(samples[i * step + (grey ? 0 : c)]);
        }
    };
    const auto encoded = [](float linear) {
        if (!(linear > 0)) return std::uint8_t{0};
        const float v =
            linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
        return static_cast<std::uint8_t>(std::min(v, 1.0f) * 255 + 0.5f);
    };
    if (const auto* u8 = std::get_if<std::vector<std::uint8_t>>(&raster.samples)) {
        fill(*u8, [](std::uint8_t v) { return v; });
    } else if (const auto* u16 = std::get_if<std::vector<std::uint16_t>>(&raster.samples)) {
        fill(*u16, [](std::uint16_t v) { return static_cast<std::uint8_t>((v + 128u) / 257u); });
    } else if (const auto* u32 = std::get_if<std::vector<std::uint32_t>>(&raster.samples)) {
        fill(*u32, [](std::uint32_t v) { return static_cast<std::uint8_t>(v >> 24); });
    } else {
        fill(std::get<std::vector<float>>(raster.samples), encoded);
    }
    return out;
}

Expected<ImageU8x3> read_source_picture(const TextureInfo& info) {
    if (info.origin == TextureOrigin::kProcedural) return starter_original(info.source);
    WEFT_TRY(picture, read_picture_file(info.source));
    if (picture.size() != info.original_size) {
        return fail(ErrorCode::kUnreadable,
                    info.source + " has changed since the texture was cut from it.");
    }
    return picture;
}

}  // namespace weft
