// The place of what each pixel shows, from renderers' passes: read_positions().

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_channels.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

using Names = std::array<std::string, 3>;

// Cycles, Arnold, Nuke; after the last dot or at the beginning of a layer's name.
constexpr std::array kLayers{"Position", "position", "P", "P_World", "Pworld", "worldposition"};
const std::array<Names, 3> kAxes{{{"X", "Y", "Z"}, {"R", "G", "B"}, {"x", "y", "z"}}};

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

std::optional<Names> find_channels(const std::vector<std::string>& all, const std::string& layer) {
    if (!layer.empty()) return channels_of(all, layer);
    for (const char* wanted : kLayers) {
        for (const std::string& name : all) {
            const std::size_t dot = name.rfind('.');
            if (dot == std::string::npos || !is_layer(name.substr(0, dot), wanted)) continue;
            if (auto found = channels_of(all, name.substr(0, dot))) return found;
        }
    }
    // A file of its own.
    return all.size() <= 4 ? channels_of(all, "") : std::nullopt;
}

}  // namespace

Expected<ImageF3> read_positions(const std::string& path, const std::string& layer, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    WEFT_TRY(all, exr_channels(path));
    const auto names = find_channels(all, layer);
    if (!names) {
        return tl::unexpected(unreadable(path, "it has no position pass",
                                         "Name its layer" + by({{setting::kPositionLayer}}) +
                                             "; its channels are: " + list_of(all) + "."));
    }
    ImageF3 out;
    for (std::size_t c = 0; c < 3; ++c) {
        Size size;
        WEFT_TRY(values, read_pass_channel(path, (*names)[c], "position", size));
        WEFT_CHECK_OK(check_plate_size(path, "its position pass", size, expected, kRenderAlike));
        if (out.empty()) out = ImageF3(size);
        constexpr float kNowhere = 1e10f;  // Cycles' and Arnold's background
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool known = std::abs(values[i]) < kNowhere;
            out.data()[3 * i + c] = known ? values[i] : std::numeric_limits<float>::quiet_NaN();
        }
    }
    return out;
}

}  // namespace weft
