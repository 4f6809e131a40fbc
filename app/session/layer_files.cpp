#include "app/session/layer_files.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

constexpr std::array<const char*, 7> kNames{"patch", "edge", "light", "st", "matte", "seam", "id"};

template <int C>
ExrLayer layer_of(const std::string& name, std::vector<std::string> channels,
                  const Image<float, C>& image, bool full_float = false) {
    for (std::string& channel : channels)
        channel = name + "." + channel;
    return {std::move(channels),
            full_float,
            {image.data(), image.data() + image.size_bytes() / sizeof(float)}};
}

ExrLayer patch_layer(const FrameLayers& layers) {
    ExrLayer out{{"patch.R", "patch.G", "patch.B", "patch.A"}, false, {}};
    const std::size_t pixels = layers.alpha.size_bytes() / sizeof(float);
    out.samples.reserve(4 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* p = layers.patch.data() + 3 * i;
        out.samples.insert(out.samples.end(), {p[0], p[1], p[2], layers.alpha.data()[i]});
    }
    return out;
}

}  // namespace

Expected<std::vector<std::string>> parse_layer_names(const std::string& text) {
    std::vector<std::string> out;
    if (text == "all") return std::vector<std::string>(kNames.begin(), kNames.end());
    for (std::size_t from = 0; from <= text.size() && !text.empty();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::string name = text.substr(from, comma - from);
        from = comma + 1;
        if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
            return fail(ErrorCode::kUsage,
                        "There is no layer '" + name +
                            "'. There are patch, edge, light, st, matte, seam and id, or all.");
        }
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
    return out;
}

std::vector<ExrLayer> exr_layers(const FrameLayers& layers, const std::vector<std::string>& names) {
    std::vector<ExrLayer> out;
    for (const std::string& name : names) {
        if (name == "patch") out.push_back(patch_layer(layers));
        if (name == "edge") out.push_back(layer_of(name, {"R", "G", "B"}, layers.edge));
        if (name == "light") out.push_back(layer_of(name, {"R", "G", "B"}, layers.light));
        if (name == "st") out.push_back(layer_of(name, {"R", "G"}, layers.st, true));
        if (name == "matte") out.push_back(layer_of(name, {"A"}, layers.alpha));
        if (name == "seam") out.push_back(layer_of(name, {"A"}, layers.seam));
        if (name == "id") out.push_back(layer_of(name, {"Y"}, layers.id, true));
    }
    return out;
}

}  // namespace weft
