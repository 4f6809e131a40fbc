#include "app/render/layer_files.h"

#include <string>

#include "engine/pipeline/st_rim.h"

namespace weft {
namespace {

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

// With the coverage in blue, by which Blender's Map UV multiplies.
ExrLayer st_layer(const FrameLayers& layers) {
    ExrLayer out{{"st.R", "st.G", "st.B"}, true, {}};
    const std::size_t pixels = layers.alpha.size_bytes() / sizeof(float);
    out.samples.reserve(3 * pixels);
    ImageF1 covers(layers.st.size());
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* st = layers.st.data() + 2 * i;
        covers.data()[i] = st[0] != 0 || st[1] != 0 ? layers.alpha.data()[i] : 0.0f;
    }
    ImageF2 all = layers.st;
    continue_map(all, covers);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* st = all.data() + 2 * i;
        out.samples.insert(out.samples.end(), {st[0], st[1], covers.data()[i]});
    }
    return out;
}

}  // namespace

std::vector<ExrLayer> exr_layers(const FrameLayers& layers, const std::vector<LayerKind>& kinds) {
    std::vector<ExrLayer> out;
    for (const LayerKind kind : kinds) {
        const std::string name(info_of(kind).name);
        switch (kind) {
            case LayerKind::kPatch:
                out.push_back(patch_layer(layers));
                break;
            case LayerKind::kEdge:
                out.push_back(layer_of(name, {"R", "G", "B"}, layers.edge));
                break;
            case LayerKind::kLight:
                out.push_back(layer_of(name, {"R", "G", "B"}, layers.light));
                break;
            case LayerKind::kLightConfidence:
                out.push_back(layer_of(name, {"A"}, layers.light_confidence));
                break;
            case LayerKind::kGloss:
                out.push_back(layer_of(name, {"R", "G", "B"}, layers.gloss));
                break;
            case LayerKind::kSt:
                out.push_back(st_layer(layers));
                break;
            case LayerKind::kMatte:
                out.push_back(layer_of(name, {"A"}, layers.alpha));
                break;
            case LayerKind::kSeam:
                out.push_back(layer_of(name, {"A"}, layers.seam));
                break;
            case LayerKind::kId:
                out.push_back(layer_of(name, {"Y"}, layers.id, true));
                break;
            case LayerKind::kTexture:
                out.push_back(layer_of(name, {"R", "G", "B"}, layers.texture));
                break;
            case LayerKind::kFinish:
                out.push_back(layer_of(name, {"R", "G", "B"}, layers.finish, true));
                break;
            case LayerKind::kNormal:
                out.push_back(layer_of(name, {"x", "y", "z"}, layers.form.normal));
                break;
            case LayerKind::kDepth:
                out.push_back(layer_of(name, {"Z"}, layers.form.depth, true));
                break;
            case LayerKind::kFormConfidence:
                out.push_back(layer_of(name, {"A"}, layers.form.confidence));
                break;
        }
    }
    return out;
}

}  // namespace weft
