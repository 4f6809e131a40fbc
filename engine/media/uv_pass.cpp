// Texture coordinates from renderers' passes and ST-maps: read_uv().

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_layers.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

const PassKind kUv{"UV",
                   {"UV", "ST", "texcoord"},
                   {{"U", "V"}, {"u", "v"}, {"X", "Y"}, {"x", "y"}, {"R", "G"}},
                   setting::kUvLayer};

// U and V in a layer of any name, or the one layer of a map, of which Weft's own has another for
// the way back (docs/FORMATS.md, "ST-maps").
std::optional<FoundPass> find_elsewhere(const std::vector<PassLayer>& layers) {
    const PassKind uv{kUv.what, {}, {{"U", "V"}}, {}};
    for (const PassLayer& layer : layers)
        if (auto found = pass_in(layer, uv)) return found;
    std::vector<PassLayer> maps;
    for (const PassLayer& layer : layers)
        if (layer.name != "stabilize") maps.push_back(layer);
    return find_pass_alone(maps, kUv);
}

// How much of a pixel the pass covers, by which renderers multiply its coordinates: in "A", or as
// the third channel of what Blender's File Output node writes. Empty if it does not say.
std::string coverage_channel(const FoundPass& pass) {
    const bool file_output = pass.channels.front() == pass.layer.channel("X");
    const bool uv = pass.channels.front() == pass.layer.channel("U");
    return file_output ? pass.layer.channel("Z") : uv ? pass.layer.channel("A") : std::string();
}

constexpr float kWholePixel = 0.999f;

// A third coordinate is no coverage.
bool covers_any(const std::vector<float>& coverage) {
    return std::any_of(coverage.begin(), coverage.end(),
                       [](float v) { return v >= kWholePixel; }) &&
           std::all_of(coverage.begin(), coverage.end(),
                       [](float v) { return v >= 0 && v <= 2 - kWholePixel; });
}

// Coordinates that count in pixels go up by 1 from one to the next. Of those from 0 to 1 a texture
// that repeats so often would be a flat colour.
bool count_pixels(const ImageF2& uv) {
    constexpr float kStep = 0.5f;
    std::int64_t pairs = 0, wide = 0;
    for (int y = 0; y < uv.height(); ++y) {
        for (int x = 1; x < uv.width(); ++x) {
            const float du = uv.at(x, y, 0) - uv.at(x - 1, y, 0);
            const float dv = uv.at(x, y, 1) - uv.at(x - 1, y, 1);
            if (!std::isfinite(du) || !std::isfinite(dv) || (du == 0 && dv == 0)) continue;
            ++pairs;
            wide += std::hypot(du, dv) > kStep;
        }
    }
    return 2 * wide > pairs;
}

}  // namespace

Expected<FoundPass> locate_uv(const std::string& path, const std::string& layer,
                              const std::vector<std::string>& beside) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(layers, list_pass_layers(path));
    auto found = find_pass(layers, kUv, layer, beside);
    if (!found && layer.empty()) found = find_elsewhere(layers);
    if (!found) return tl::unexpected(no_such_pass(path, kUv, layer, layers));
    return std::move(*found);
}

Expected<ImageF2> read_uv(const std::string& path, const std::string& layer, Size expected) {
    WEFT_TRY(found, locate_uv(path, layer));
    const std::string coverage = coverage_channel(found);
    if (!coverage.empty()) found.channels.push_back(coverage);
    Size size;
    WEFT_TRY(uv, read_pass(path, kUv, found, expected, size));
    const bool covers = !coverage.empty() && covers_any(uv[2]);
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    ImageF2 out(size);
    for (std::size_t i = 0; i < uv[0].size(); ++i) {
        const bool known = !covers || uv[2][i] >= kWholePixel;
        out.data()[2 * i] = known ? uv[0][i] : kUnknown;
        out.data()[2 * i + 1] = known ? uv[1][i] : kUnknown;
    }
    if (count_pixels(out)) {
        return tl::unexpected(unreadable(
            path, "its UV changes by more than half a texture from pixel to pixel, as pixels do",
            "Divide it by the picture's size: coordinates go from 0 to 1."));
    }
    return out;
}

}  // namespace weft
