// Renderers' passes of places, normals and depth.
#include "engine/media/form_passes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_channels.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

using Names = std::array<std::string, 3>;

// A pass of three numbers by pixel.
struct VectorPass {
    const char* name;
    // In Cycles, Arnold, Nuke; after the last dot or at the beginning of a layer's name.
    std::span<const char* const> layers;
    std::string_view layer_setting;
};
constexpr std::array kPlaceLayers{"Position", "position", "P",
                                  "P_World",  "Pworld",   "worldposition"};
constexpr std::array kNormalLayers{"Normal",  "normal",       "N", "normals", "Normals",
                                   "nCamera", "normal_camera"};
constexpr VectorPass kPlaces{"position", kPlaceLayers, setting::kPositionLayer};
constexpr VectorPass kNormals{"normal", kNormalLayers, setting::kNormalLayer};
const std::array<Names, 3> kAxes{{{"X", "Y", "Z"}, {"R", "G", "B"}, {"x", "y", "z"}}};

// An unreadable file is none; reading it says why.
bool is_exr(const std::string& path) {
    const auto input = open_picture(path);
    return input && std::string_view((*input)->format_name()) == "openexr";
}

bool is_layer(std::string_view layer, std::string_view wanted) {
    if (!layer.ends_with(wanted)) return false;
    return layer.size() == wanted.size() || layer[layer.size() - wanted.size() - 1] == '.';
}

// The three channels of a layer, if it has them.
std::optional<Names> channels_of(const std::vector<std::string>& all, const std::string& layer) {
    const auto has = [&](const std::string& name) {
        return std::find(all.begin(), all.end(), name) != all.end();
    };
    const std::string prefix = layer.empty() ? "" : layer + ".";
    for (const Names& axes : kAxes) {
        Names names{prefix + axes[0], prefix + axes[1], prefix + axes[2]};
        if (has(names[0]) && has(names[1]) && has(names[2])) return names;
    }
    return std::nullopt;
}

std::optional<Names> find_channels(const std::vector<std::string>& all, const VectorPass& pass,
                                   const std::string& layer) {
    if (!layer.empty()) return channels_of(all, layer);
    for (const char* wanted : pass.layers) {
        for (const std::string& name : all) {
            const std::size_t dot = name.rfind('.');
            if (dot == std::string::npos || !is_layer(name.substr(0, dot), wanted)) continue;
            if (auto found = channels_of(all, name.substr(0, dot))) return found;
        }
    }
    // A file of its own.
    return all.size() <= 4 ? channels_of(all, "") : std::nullopt;
}

Expected<ImageF3> read_vectors(const std::string& path, const VectorPass& pass,
                               const std::string& layer, Size expected) {
    WEFT_TRY(all, exr_channels(path));
    const std::string name = pass.name;
    const auto names = find_channels(all, pass, layer);
    if (!names) {
        return tl::unexpected(unreadable(path, "it has no " + name + " pass",
                                         "Name its layer" + by({{pass.layer_setting}}) +
                                             "; its channels are: " + list_of(all) + "."));
    }
    ImageF3 out;
    for (std::size_t c = 0; c < 3; ++c) {
        Size size;
        WEFT_TRY(values, read_pass_channel(path, (*names)[c], name, size));
        WEFT_CHECK_OK(
            check_plate_size(path, "its " + name + " pass", size, expected, kRenderAlike));
        if (out.empty()) out = ImageF3(size);
        for (std::size_t i = 0; i < values.size(); ++i)
            out.data()[3 * i + c] = values[i];
    }
    return out;
}

// The channel of a depth pass: by its name, or the first of a file of its own.
std::optional<std::string> depth_channel(const std::vector<std::string>& all) {
    for (const std::string& name : all) {
        const std::size_t dot = name.rfind('.');
        const std::string_view last(name.data() + (dot == std::string::npos ? 0 : dot + 1));
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        const bool of_depth = layer.empty() || is_layer(layer, "Depth") || is_layer(layer, "depth");
        if ((last == "Z" && of_depth) || (last == "V" && is_layer(layer, "Depth"))) return name;
    }
    if (all.empty() || all.size() > 4) return std::nullopt;
    const auto red = std::find(all.begin(), all.end(), "R");
    return red == all.end() ? all.front() : *red;
}

}  // namespace

Expected<ImageF3> read_positions(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(out, read_vectors(path, kPlaces, layer, expected));
    constexpr float kNowhere = 1e10f;  // Cycles' and Arnold's background
    std::transform(out.data(), out.data() + out.size_bytes() / sizeof(float), out.data(),
                   [](float v) {
                       return std::abs(v) < kNowhere ? v : std::numeric_limits<float>::quiet_NaN();
                   });
    return out;
}

Expected<ImageF2> read_st_layer(const std::string& path, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(all, exr_channels(path));
    ImageF2 out;
    for (std::size_t c = 0; c < 2; ++c) {
        const std::string name = c == 0 ? "st.R" : "st.G";
        if (std::find(all.begin(), all.end(), name) == all.end()) {
            return tl::unexpected(unreadable(path, "it has no layer st",
                                             "Render with that layer" +
                                                 by({{setting::kLayers, "st"}}) +
                                                 "; its channels are: " + list_of(all) + "."));
        }
        Size size;
        WEFT_TRY(values, read_pass_channel(path, name, "st", size));
        WEFT_CHECK_OK(check_plate_size(path, "its layer st", size, expected,
                                       "give the layers of a render of this plate"));
        if (out.empty()) out = ImageF2(size);
        for (std::size_t i = 0; i < values.size(); ++i)
            out.data()[2 * i + c] = values[i];
    }
    return out;
}

Expected<ImageF3> read_normals(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    if (is_exr(path)) return read_vectors(path, kNormals, layer, expected);
    WEFT_TRY(picture, read_image(path, layer));
    if (picture.depth != PixelDepth::kU8 && picture.depth != PixelDepth::kU16) {
        return tl::unexpected(unreadable(path, "a normal pass in floating point is expected as EXR",
                                         "Render the normal pass as EXR."));
    }
    WEFT_CHECK_OK(
        check_plate_size(path, "its normal pass", picture.rgb.size(), expected, kRenderAlike));
    ImageF3& out = picture.rgb;
    std::transform(out.data(), out.data() + out.size_bytes() / sizeof(float), out.data(),
                   [](float v) { return 2 * v - 1; });
    return std::move(out);
}

Expected<ImageF1> read_depth(const std::string& path, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    if (!is_exr(path)) {
        return tl::unexpected(
            unreadable(path, "only an EXR of half or float holds distances, which a form needs",
                       "Render the depth pass as EXR, without normalising it."));
    }
    WEFT_TRY(all, exr_channels(path));
    const auto name = depth_channel(all);
    if (!name) {
        return tl::unexpected(
            unreadable(path, "it has no depth pass",
                       "Give an EXR with a channel Z; its channels are: " + list_of(all) + "."));
    }
    Size size;
    WEFT_TRY(values, read_pass_channel(path, *name, "depth", size));
    WEFT_CHECK_OK(check_plate_size(path, "its depth pass", size, expected, kRenderAlike));
    ImageF1 out(size);
    std::copy(values.begin(), values.end(), out.data());
    return out;
}

}  // namespace weft
