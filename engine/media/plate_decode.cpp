#include "engine/media/plate_decode.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

// Dividing gives the float nearest to code/255, so that ·255 and rounding gives the code back.
const std::array<float, 256>& unit_from_u8() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = static_cast<float>(i) / 255.0f;
        return t;
    }();
    return table;
}

struct ToUnit {
    const std::array<float, 256>& table = unit_from_u8();
    float operator()(std::uint8_t v) const { return table[v]; }
    float operator()(std::uint16_t v) const { return static_cast<float>(v) / 65535.0f; }
    float operator()(std::uint32_t v) const {
        return static_cast<float>(static_cast<double>(v) / 4294967295.0);
    }
    float operator()(float v) const { return v; }
};

template <class T>
void split(const std::vector<T>& samples, const Raster& raster, PlateFrame& frame) {
    const ToUnit to_unit;
    const auto channels = static_cast<std::size_t>(raster.channels);
    const bool grey = raster.colors() < 3;
    const std::size_t pixels = samples.size() / channels;
    const T* in = samples.data();
    float* rgb = frame.rgb.data();
    float* alpha = raster.has_alpha ? frame.alpha.data() : nullptr;
    for (std::size_t i = 0; i < pixels; ++i, in += channels, rgb += 3) {
        rgb[0] = to_unit(in[0]);
        rgb[1] = grey ? rgb[0] : to_unit(in[1]);
        rgb[2] = grey ? rgb[0] : to_unit(in[2]);
        if (alpha) alpha[i] = to_unit(in[channels - 1]);
    }
}

std::int64_t count_nonfinite(const PlateFrame& frame) {
    std::int64_t count = 0;
    const std::size_t pixels = frame.rgb.size_bytes() / (3 * sizeof(float));
    const float* rgb = frame.rgb.data();
    const float* alpha = frame.alpha.empty() ? nullptr : frame.alpha.data();
    for (std::size_t i = 0; i < pixels; ++i, rgb += 3) {
        const bool finite = std::isfinite(rgb[0]) && std::isfinite(rgb[1]) &&
                            std::isfinite(rgb[2]) && (!alpha || std::isfinite(alpha[i]));
        count += finite ? 0 : 1;
    }
    return count;
}

}  // namespace

PixelDepth depth_of(SampleKind kind) {
    switch (kind) {
        case SampleKind::kU8:
            return PixelDepth::kU8;
        case SampleKind::kU16:
            return PixelDepth::kU16;
        case SampleKind::kHalf:
            return PixelDepth::kHalf;
        default:
            return PixelDepth::kFloat;
    }
}

bool is_display_encoded(SampleKind kind) {
    return kind == SampleKind::kU8 || kind == SampleKind::kU16 || kind == SampleKind::kU32;
}

PlateFrame to_plate(const Raster& raster) {
    PlateFrame frame;
    frame.depth = depth_of(raster.info.kind);
    frame.color = raster.info.color;
    frame.rgb = ImageF3(raster.info.size);
    if (raster.has_alpha) frame.alpha = ImageF1(raster.info.size);
    frame.alpha_kind = raster.alpha_kind;
    std::visit([&](const auto& samples) { split(samples, raster, frame); }, raster.samples);
    if (!is_display_encoded(raster.info.kind)) frame.nonfinite = count_nonfinite(frame);
    return frame;
}

}  // namespace weft
