#include "app/cli/texture/texture_sheet.h"

#include <algorithm>

#include "engine/color/color_space.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

constexpr int kSide = 96, kGap = 4;

void paste(const ImageU8x3& from, ImageU8x3& to, int x0, int y0) {
    const int w = std::min({kSide, from.width(), to.width() - x0});
    const int h = std::min({kSide, from.height(), to.height() - y0});
    for (int y = 0; y < h; ++y)
        std::copy_n(from.row(y), 3 * w, to.pixel(x0, y0 + y));
}

}  // namespace

ImageU8x3 contact_sheet(const std::vector<ImageU8x3>& pictures, int columns) {
    const int n = static_cast<int>(pictures.size());
    columns = std::max(1, std::min(columns, n));
    const int rows = (n + columns - 1) / columns, pitch = kSide + kGap;
    ImageU8x3 out(columns * pitch + kGap, rows * pitch + kGap, 40);
    for (int i = 0; i < n; ++i) {
        paste(pictures[static_cast<std::size_t>(i)], out, kGap + (i % columns) * pitch,
              kGap + (i / columns) * pitch);
    }
    return out;
}

Expected<ImageU8x3> recommendation_sheet(TextureLibrary& library, ViewU8x3 plate,
                                         const std::vector<Matte>& mattes,
                                         const Recommendation& advice) {
    constexpr int kColumns = 12, kPitch = kSide + kGap;
    std::vector<std::vector<Suggestion>> rows;
    for (const RegionSuggestions& region : advice.regions) {
        rows.push_back(region.suggestions);
        for (const SuggestionScheme& scheme : region.schemes)
            rows.push_back(scheme.suggestions);
    }
    const int width = std::max(plate.width(), kColumns * kPitch + kGap);
    ImageU8x3 out(width, plate.height() + static_cast<int>(rows.size()) * kPitch + kGap, 40);
    for (int y = 0; y < plate.height(); ++y) {
        std::copy_n(plate.row(y), 3 * plate.width(), out.row(y));
        for (const Matte& matte : mattes) {
            for (int x = 1; x < plate.width(); ++x) {
                const bool here = matte.at(x, y) >= 128, left = matte.at(x - 1, y) >= 128;
                const bool above = y > 0 && matte.at(x, y - 1) >= 128;
                if (here != left || (y > 0 && here != above)) {
                    std::uint8_t* p = out.pixel(x, y);
                    p[0] = 255;
                    p[1] = p[2] = 40;
                }
            }
        }
    }
    int y = plate.height() + kGap;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < std::min<std::size_t>(row.size(), kColumns); ++i) {
            WEFT_TRY(pixels, library.thumbnail(row[i].id));
            paste(pixels, out, kGap + static_cast<int>(i) * kPitch, y);
        }
        y += kPitch;
    }
    return out;
}

ImageU8x3 display_pixels(ViewF3 frame, bool display_encoded) {
    ImageU8x3 out(frame.size());
    for (int y = 0; y < frame.height(); ++y) {
        const float* from = frame.row(y);
        std::uint8_t* to = out.row(y);
        for (int i = 0; i < 3 * frame.width(); ++i) {
            const float v = display_encoded ? from[i] : linear_to_srgb(from[i]);
            to[i] = static_cast<std::uint8_t>((v > 0.0f ? std::min(v, 1.0f) : 0.0f) * 255 + 0.5f);
        }
    }
    return out;
}

Status write_picture(const std::string& path, ViewU8x3 picture, const WriteRule& rule) {
    ImageF3 pixels(picture.size());
    for (int y = 0; y < picture.height(); ++y) {
        std::transform(picture.row(y), picture.row(y) + 3 * picture.width(), pixels.row(y),
                       [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    }
    WriteOptions write;
    write.depth = default_depth(path, PixelDepth::kU8);
    write.rule = rule;
    WEFT_CHECK_OK(check_format(path, write));
    return write_image(path, pixels, {}, write);
}

}  // namespace weft
