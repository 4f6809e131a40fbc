#include "engine/media/light_passes.h"

#include <optional>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_layers.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

const std::vector<std::vector<std::string>> kColours{{"R", "G", "B"}, {"r", "g", "b"}};
constexpr std::string_view kSetting = setting::kLightLayer;

// The plate is albedo times light in each of these renderers.
const PassKind kAlbedo{"albedo",
                       {"DiffCol", "albedo", "diffuse_albedo", "diffuse_color", "base_color",
                        "basecolor", "diffuseFilter"},
                       kColours,
                       kSetting};
const PassKind kDirect{"lighting", {"DiffDir"}, kColours, kSetting};
const PassKind kIndirect{"lighting", {"DiffInd"}, kColours, kSetting};
const PassKind kWhole{"lighting", {"rawTotalLighting"}, kColours, kSetting};

std::optional<std::string> find_lighting(const std::vector<PassLayer>& layers,
                                         const std::vector<std::string>& beside) {
    if (const auto direct = find_pass(layers, kDirect, {}, beside)) {
        const std::string& name = direct->layer.name;
        const auto indirect = find_pass(layers, kIndirect, {}, {name});
        return indirect ? name + "+" + indirect->layer.name : name;
    }
    const auto whole = find_pass(layers, kWhole, {}, beside);
    return whole ? std::optional(whole->layer.name) : std::nullopt;
}

// The layers that a name stands for. One may have a "+" in its own name.
Expected<std::vector<std::string>> layers_of(const std::string& path, const std::string& name) {
    if (name.find('+') == std::string::npos) return std::vector<std::string>{name};
    WEFT_TRY(layers, list_pass_layers(path));
    if (layer_named(layers, name)) return std::vector<std::string>{name};
    std::vector<std::string> out;
    for (const std::string_view one : split(name, '+'))
        out.emplace_back(one);
    return out;
}

void add(PlateFrame& sum, const PlateFrame& more) {
    const std::size_t count = sum.rgb.size_bytes() / sizeof(float);
    for (std::size_t i = 0; i < count; ++i)
        sum.rgb.data()[i] += more.rgb.data()[i];
}

}  // namespace

Expected<std::string> find_light_layer(const std::string& path, LightPass pass,
                                       const std::vector<std::string>& beside) {
    WEFT_TRY(input, open_picture(path));
    if (std::string_view(input->format_name()) != "openexr") return std::string();
    WEFT_TRY(layers, list_pass_layers(path));
    const bool albedo = pass == LightPass::kAlbedo;
    if (layers.size() <= 1) return std::string();
    if (albedo) {
        if (const auto found = find_pass(layers, kAlbedo, {}, beside)) return found->layer.name;
    } else if (auto found = find_lighting(layers, beside)) {
        return std::move(*found);
    }
    return tl::unexpected(no_such_pass(path, albedo ? kAlbedo : kWhole, {}, layers));
}

bool is_same_picture(const std::string& path, const std::string& layer, const std::string& other) {
    if (layer == other) return true;
    const auto one = locate_colour(path, layer), two = locate_colour(path, other);
    return one && two && one->part == two->part && one->rgb == two->rgb;
}

Expected<PlateFrame> read_light_pass(const std::string& path, LightPass pass,
                                     const std::string& layer) {
    WEFT_CHECK_OK(check_picture_exists(path));
    std::string name = layer;
    if (name.empty()) {
        WEFT_TRY(found, find_light_layer(path, pass));
        name = std::move(found);
    }
    WEFT_TRY(names, layers_of(path, name));
    WEFT_TRY(sum, read_image(path, names.front()));
    for (std::size_t k = 1; k < names.size(); ++k) {
        WEFT_TRY(more, read_image(path, names[k]));
        if (more.rgb.size() != sum.rgb.size()) {
            return tl::unexpected(unreadable(
                path, "its layers '" + names[k] + "' and '" + names.front() + "' differ in size",
                "Name layers of one size" + by({{kSetting}}) + "."));
        }
        add(sum, more);
    }
    return sum;
}

}  // namespace weft
