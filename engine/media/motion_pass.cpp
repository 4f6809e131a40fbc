// Motion and texture coordinates from renderers' passes: read_motion() and read_uv().

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_channels.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// A renderer's convention: a vector in `units`, y up; times `sign` it leads to the other frame.
struct Convention {
    std::array<const char*, 2> forward, backward;  // channels after "LAYER."
    std::array<const char*, 2> layers;             // where to look when none is named
    enum { kPixels, kHalfPicture, kPicture } units;
    float forward_sign, backward_sign;
    bool premultiplied;
};

Convention convention_of(MotionConvention convention) {
    using C = Convention;
    switch (convention) {
        case MotionConvention::kBlender:
            // Cycles' Vector pass: X, Y lead to the previous frame; Z, W come from the next one.
            return {{"Z", "W"}, {"X", "Y"}, {"Vector", ""}, C::kPixels, -1, 1, false};
        case MotionConvention::kNuke:
            return {{"u", "v"}, {"u", "v"}, {"forward", "backward"}, C::kPixels, 1, 1, false};
        case MotionConvention::kMoonray:
            // Screen space, −1 to 1 over the picture's width; filtered, so premultiplied by alpha.
            return {{"R", "G"}, {"R", "G"}, {"motionvec", "motion_vectors"}, C::kHalfPicture, 1,
                    -1,         true};
        case MotionConvention::kFlame:
            // Of the picture's size; the backward vector comes from the previous frame.
            return {{"R", "G"}, {"R", "G"}, {"", ""}, C::kPicture, 1, -1, false};
        case MotionConvention::kArnold:
        case MotionConvention::kFiles:
            break;
    }
    // Arnold's motionvector with its raw values: pixels over the frame.
    return {{"R", "G"}, {"R", "G"}, {"motionvector", ""}, C::kPixels, 1, -1, false};
}

// "shot.Vector" and the like: the part before ".X" in the file, if the layer is not named.
Expected<std::string> find_layer(const std::string& path, const Convention& convention,
                                 const std::array<const char*, 2>& channels, bool forward) {
    WEFT_TRY(names, exr_channels(path));
    const auto has = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const std::string tail = std::string(".") + channels[0];
    const std::string preferred = convention.layers[forward ? 0 : 1];
    for (const std::string& wanted :
         {preferred, std::string(convention.layers[0]), std::string(convention.layers[1])}) {
        if (wanted.empty()) continue;
        for (const std::string& name : names) {
            if (!name.ends_with(wanted + tail)) continue;
            const std::size_t before = name.size() - wanted.size() - tail.size();
            if (before > 0 && name[before - 1] != '.') continue;
            return name.substr(0, name.size() - tail.size()) + ".";
        }
    }
    if (has(channels[0]) && has(channels[1])) return std::string();
    return tl::unexpected(unreadable(path, "it has no motion pass in this convention",
                                     "Name its layer" + by({{setting::kMotionLayer}}) +
                                         "; its channels are: " + list_of(names) + "."));
}

}  // namespace

Expected<FlowField> read_motion(const std::string& path, const MotionSelect& select,
                                Size expected) {
    if (select.convention == MotionConvention::kFiles) return read_flow(path, expected);
    WEFT_CHECK_OK(check_picture_exists(path));
    const Convention convention = convention_of(select.convention);
    const bool forward = select.direction == MotionDirection::kForward;
    const auto& channels = forward ? convention.forward : convention.backward;
    std::string layer = select.layer.empty() ? "" : select.layer + ".";
    if (layer.empty()) {
        WEFT_TRY(found, find_layer(path, convention, channels, forward));
        layer = found;
    }
    Size size;
    WEFT_TRY(u, read_pass_channel(path, layer + channels[0], "motion", size));
    WEFT_TRY(v, read_pass_channel(path, layer + channels[1], "motion", size));
    WEFT_CHECK_OK(check_plate_size(path, "its motion", size, expected, kRenderAlike));
    std::vector<float> alpha;
    if (convention.premultiplied) {
        for (const std::string& name : {layer + "A", std::string("A")}) {
            if (auto found = read_pass_channel(path, name, "motion", size)) {
                alpha = std::move(*found);
                break;
            }
        }
    }
    const float sign = forward ? convention.forward_sign : convention.backward_sign;
    const float share = convention.units == Convention::kPixels        ? 0.0f
                        : convention.units == Convention::kHalfPicture ? 0.5f
                                                                       : 1.0f;
    // MoonRay's screen space has one unit for both axes: half of the width.
    const bool square = convention.units == Convention::kHalfPicture;
    const float unit_x = share > 0 ? share * static_cast<float>(size.width) : 1.0f;
    const float unit_y =
        share > 0 ? share * static_cast<float>(square ? size.width : size.height) : 1.0f;
    FlowField flow(size);
    constexpr float kUnknown = 1e6f;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const float a = alpha.empty() ? 1.0f : alpha[i];
        const float x = sign * unit_x * u[i] / a, y = -sign * unit_y * v[i] / a;
        const bool known = std::abs(x) < kUnknown && std::abs(y) < kUnknown;  // false for NaN
        flow.d.data()[2 * i] = known ? x : 0.0f;
        flow.d.data()[2 * i + 1] = known ? y : 0.0f;
        flow.valid.data()[i] = known ? 255 : 0;
    }
    return flow;
}

Expected<ImageF2> read_uv(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    std::string prefix = layer.empty() ? "" : layer + ".";
    std::array<const char*, 2> channels{"U", "V"};
    WEFT_TRY(names, exr_channels(path));
    const auto has = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (layer.empty()) {
        // "shot.UV.U" before a plain "U".
        for (const std::string& name : names) {
            if (name.ends_with("UV.U")) prefix = name.substr(0, name.size() - 1);
        }
    }
    if (!has(prefix + channels[0])) channels = {"R", "G"};
    Size size;
    WEFT_TRY(u, read_pass_channel(path, prefix + channels[0], "UV", size));
    WEFT_TRY(v, read_pass_channel(path, prefix + channels[1], "UV", size));
    WEFT_CHECK_OK(check_plate_size(path, "its UV map", size, expected, kRenderAlike));
    ImageF2 out(size);
    for (std::size_t i = 0; i < u.size(); ++i) {
        out.data()[2 * i] = u[i];
        out.data()[2 * i + 1] = v[i];
    }
    return out;
}

}  // namespace weft
