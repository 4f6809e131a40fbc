// Renderers' passes of places, normals and depth.
#include "engine/media/form_passes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_layers.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// The background of Cycles and Arnold; no coordinate is so large.
constexpr float kNowhere = 1e10f;

// Names in Cycles, Arnold, Nuke.
const PassKind kPlaces{"position",
                       {"Position", "P", "P_World", "Pworld", "worldposition"},
                       {{"X", "Y", "Z"}, {"R", "G", "B"}, {"x", "y", "z"}},
                       setting::kPositionLayer};
const PassKind kNormals{"normal",
                        {"Normal", "N", "normals", "nCamera", "normal_camera"},
                        {{"X", "Y", "Z"}, {"R", "G", "B"}, {"x", "y", "z"}},
                        setting::kNormalLayer};
const PassKind kDepth{
    "depth", {"Depth", "Z", "zdepth"}, {{"Z"}, {"V"}, {"z"}, {"R"}, {"Y"}}, setting::kDepthLayer};

// An unreadable file is none; reading it says why.
bool is_exr_file(const std::string& path) {
    const auto input = open_picture(path);
    return input && std::string_view((*input)->format_name()) == "openexr";
}

Expected<FoundPass> locate(const std::string& path, const PassKind& kind, const std::string& layer,
                           const std::vector<std::string>& beside) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(layers, list_pass_layers(path));
    auto found = find_pass(layers, kind, layer, beside);
    if (!found && layer.empty()) found = find_pass_alone(layers, kind);
    if (!found) return tl::unexpected(no_such_pass(path, kind, layer, layers));
    return std::move(*found);
}

Expected<ImageF3> read_vectors(const std::string& path, const PassKind& kind,
                               const std::string& layer, Size expected) {
    WEFT_TRY(found, locate(path, kind, layer, {}));
    Size size;
    WEFT_TRY(axes, read_pass(path, kind, found, expected, size));
    ImageF3 out(size);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < axes[c].size(); ++i)
            out.data()[3 * i + c] = axes[c][i];
    return out;
}

// Some renderers write the codes (n + 1) / 2 of a normal map into floats, too: then 2 n − 1 has the
// length 1 and n has not. Grey is no normal.
bool are_codes(const ImageF3& normals) {
    constexpr float kClose = 0.02f;
    std::size_t known = 0, codes = 0, lengths = 0;
    const std::size_t count = normals.size_bytes() / sizeof(float);
    for (std::size_t i = 0; i < count; i += 3) {
        const float* n = normals.data() + i;
        float own = 0, decoded = 0;
        for (int c = 0; c < 3; ++c)
            own += n[c] * n[c], decoded += (2 * n[c] - 1) * (2 * n[c] - 1);
        if (!(own > kClose) || !(decoded > kClose)) continue;
        ++known;
        codes += std::abs(std::sqrt(decoded) - 1) < kClose;
        lengths += std::abs(std::sqrt(own) - 1) < kClose;
    }
    return 10 * codes > 9 * known && 2 * lengths < known;
}

void decode_normals(ImageF3& normals) {
    float* const begin = normals.data();
    const std::size_t count = normals.size_bytes() / sizeof(float);
    for (std::size_t i = 0; i < count; i += 3) {
        float* n = begin + i;
        if (n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f) continue;
        for (int c = 0; c < 3; ++c)
            n[c] = 2 * n[c] - 1;
    }
}

// Where a depth pass has no layer of its own: a channel Z beside the picture, or the first channel
// of a file of its own.
std::optional<FoundPass> find_depth_beside(const std::vector<PassLayer>& layers) {
    for (const PassLayer& layer : layers) {
        const bool vectors = layer.has({"X", "Y", "Z"});
        if (!layer.prefixed && !vectors && layer.has({"Z"}))
            return FoundPass{layer, {layer.channel("Z")}, {}};
    }
    if (auto found = find_pass_alone(layers, kDepth)) return found;
    PassKind first = kDepth;
    if (layers.size() == 1) first.channels = {{layers.front().channels.front()}};
    return find_pass_alone(layers, first);
}

}  // namespace

Expected<FoundPass> locate_positions(const std::string& path, const std::string& layer,
                                     const std::vector<std::string>& beside) {
    return locate(path, kPlaces, layer, beside);
}

Expected<FoundPass> locate_normals(const std::string& path, const std::string& layer,
                                   const std::vector<std::string>& beside) {
    return locate(path, kNormals, layer, beside);
}

Expected<FoundPass> locate_depth(const std::string& path, const std::string& layer,
                                 const std::vector<std::string>& beside) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(layers, list_pass_layers(path));
    auto found = find_pass(layers, kDepth, layer, beside);
    if (!found && layer.empty()) found = find_depth_beside(layers);
    if (!found) return tl::unexpected(no_such_pass(path, kDepth, layer, layers));
    return std::move(*found);
}

Expected<ImageF3> read_positions(const std::string& path, const std::string& layer, Size expected) {
    WEFT_TRY(out, read_vectors(path, kPlaces, layer, expected));
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    const std::size_t count = out.size_bytes() / sizeof(float);
    for (std::size_t i = 0; i < count; i += 3) {
        float* place = out.data() + i;
        // Cycles' background, and what is beside its render region.
        if (place[0] == 0.0f && place[1] == 0.0f && place[2] == 0.0f)
            std::fill(place, place + 3, kUnknown);
        for (std::size_t c = 0; c < 3; ++c)
            if (!(std::abs(place[c]) < kNowhere)) place[c] = kUnknown;
    }
    return out;
}

Expected<ImageF2> read_st_layer(const std::string& path, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(layers, list_pass_layers(path));
    const PassKind kind{"st", {"st"}, {{"R", "G"}}, {}};
    const auto found = find_pass(layers, kind, {});
    if (!found || found->layer.name != "st") {
        return tl::unexpected(unreadable(path, "it has no layer st",
                                         "Render with that layer" + by({{setting::kLayers, "st"}}) +
                                             "; its layers and channels are: " + list_of(layers) +
                                             "."));
    }
    Size size;
    WEFT_TRY(st, read_pass(path, kind, *found, expected, size));
    ImageF2 out(size);
    for (std::size_t i = 0; i < st[0].size(); ++i)
        out.data()[2 * i] = st[0][i], out.data()[2 * i + 1] = st[1][i];
    return out;
}

Expected<ImageF3> read_normals(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    if (is_exr_file(path)) {
        WEFT_TRY(vectors, read_vectors(path, kNormals, layer, expected));
        if (are_codes(vectors)) decode_normals(vectors);
        return vectors;
    }
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

Expected<ImageF1> read_depth(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    if (!is_exr_file(path)) {
        return tl::unexpected(
            unreadable(path, "only an EXR of half or float holds distances, which a form needs",
                       "Render the depth pass as EXR, without normalising it."));
    }
    WEFT_TRY(found, locate_depth(path, layer));
    Size size;
    WEFT_TRY(channels, read_pass(path, kDepth, found, expected, size));
    ImageF1 out(size);
    // Nothing is there: 1e10 of Cycles (1e11 beside its render region) and 1e30 of others, which a
    // half can only hold as infinity or as its largest number.
    constexpr float kLargestHalf = 65504;
    std::transform(channels[0].begin(), channels[0].end(), out.data(), [](float v) {
        return v < kNowhere && v != kLargestHalf ? v : std::numeric_limits<float>::infinity();
    });
    return out;
}

}  // namespace weft
