#include "engine/media/channel_choice.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// The layer in a channel's name, without the dot.
std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

std::string last_word(const std::string& layer) {
    return lower_case(layer.substr(layer.rfind('.') + 1));
}

// Renderers' names of the finished picture: Nuke, Arnold, V-Ray, Blender, RenderMan, Karma.
bool names_the_picture(const std::string& layer) {
    static const std::set<std::string> kNames{"rgba",      "rgb",   "beauty",    "combined",
                                              "main",      "color", "composite", "effectsresult",
                                              "rgb_color", "c"};
    return kNames.contains(last_word(layer));
}

// Renderers' names of data passes: a part or a channel of this name is not a plate.
bool names_data(const std::string& layer) {
    static const std::set<std::string> kNames{
        "z",        "zback",    "depth",   "zdepth",   "deep",     "distance",     "n",
        "normal",   "normals",  "p",       "position", "pref",     "pworld",       "id",
        "ids",      "objectid", "indexob", "indexma",  "motion",   "motionvector", "vector",
        "velocity", "uv",       "st",      "forward",  "backward", "mist",         "crypto"};
    const std::string word = last_word(layer);
    return kNames.contains(word) || word.starts_with("crypto") || word.starts_with("uncrypto");
}

int find_channel(const PartNames& part, const std::string& prefix,
                 std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        const std::string wanted = lower_case(prefix + std::string(name));
        for (std::size_t c = 0; c < part.channels.size(); ++c)
            if (lower_case(part.channels[c]) == wanted) return static_cast<int>(c);
    }
    return -1;
}

ChannelChoice choice_of(int part, std::vector<int> colors, int alpha) {
    ChannelChoice choice{part, std::move(colors), alpha >= 0};
    if (alpha >= 0) choice.channels.push_back(alpha);
    return choice;
}

std::optional<ChannelChoice> rgb_of(const PartNames& part, int number, const std::string& prefix) {
    const int r = find_channel(part, prefix, {"R", "red"});
    const int g = find_channel(part, prefix, {"G", "green"});
    const int b = find_channel(part, prefix, {"B", "blue"});
    if (r < 0 || g < 0 || b < 0) return std::nullopt;
    return choice_of(number, {r, g, b}, find_channel(part, prefix, {"A", "alpha"}));
}

// OpenEXR's luminance and chroma: Y alone is the picture without its colours.
bool has_chroma(const PartNames& part, const std::string& prefix) {
    return find_channel(part, prefix, {"RY"}) >= 0 && find_channel(part, prefix, {"BY"}) >= 0;
}

std::optional<ChannelChoice> grey_of(const PartNames& part, int number, const std::string& prefix,
                                     bool depth_too) {
    if (has_chroma(part, prefix)) return std::nullopt;
    int y = find_channel(part, prefix, {"Y", "I", "L", "V"});
    if (y < 0 && depth_too) y = find_channel(part, prefix, {"Z"});
    if (y < 0) return std::nullopt;
    return choice_of(number, {y}, find_channel(part, prefix, {"A", "alpha"}));
}

// By number, for files whose channel names say nothing.
std::optional<ChannelChoice> by_count(const PartNames& part, int number) {
    std::vector<int> colors;
    for (int c = 0; c < static_cast<int>(part.channels.size()) && c < 4; ++c)
        if (c != part.alpha) colors.push_back(c);
    if (colors.empty()) return std::nullopt;
    if (colors.size() == 1 || part.channels.size() == 2)
        return choice_of(number, {colors[0]}, part.alpha);
    if (colors.size() < 3) return std::nullopt;
    return choice_of(number, {colors[0], colors[1], colors[2]}, part.alpha);
}

std::optional<ChannelChoice> named_in(const PartNames& part, int number,
                                      const RasterRequest& request) {
    if (!request.channel.empty()) {
        int c = find_channel(part, "", {request.channel});
        // In a file with a part for each pass the part's name is the layer.
        const std::string own = part.name + ".";
        if (c < 0 && !part.name.empty() && request.channel.starts_with(own))
            c = find_channel(part, "", {request.channel.substr(own.size())});
        return c < 0 ? std::nullopt : std::optional(choice_of(number, {c}, -1));
    }
    const std::string prefix = request.layer + ".";
    if (auto choice = rgb_of(part, number, prefix)) return choice;
    if (auto choice = grey_of(part, number, prefix, true)) return choice;
    // A part of a multi-part file may have the layer's name itself, and Nuke calls the channels
    // without a layer rgba.
    const std::string layer = lower_case(request.layer);
    if (lower_case(part.name) != layer && layer != "rgba") return std::nullopt;
    if (auto choice = rgb_of(part, number, "")) return choice;
    return grey_of(part, number, "", true);
}

bool is_data(const PartNames& part) {
    return part.deep || names_data(part.name);
}

// The layers whose name says that they are the whole picture, one choice each.
std::vector<ChannelChoice> picture_layers(const std::vector<PartNames>& parts) {
    std::vector<ChannelChoice> found;
    std::set<std::string> seen;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (parts[k].deep) continue;
        for (const std::string& channel : parts[k].channels) {
            const std::string layer = layer_of(channel);
            if (!names_the_picture(layer) || !seen.insert(lower_case(layer)).second) continue;
            if (auto choice = rgb_of(parts[k], static_cast<int>(k), layer + "."))
                found.push_back(*choice);
        }
    }
    return found;
}

// What is all that a file holds leaves no choice: a matte's A, or Krita's only paint layer.
std::optional<ChannelChoice> only_layer(const std::vector<PartNames>& parts) {
    if (parts.size() != 1 || parts[0].channels.empty() || is_data(parts[0])) return std::nullopt;
    const std::vector<std::string>& channels = parts[0].channels;
    const std::string layer = layer_of(channels[0]);
    const bool one = std::all_of(channels.begin(), channels.end(),
                                 [&](const auto& channel) { return layer_of(channel) == layer; });
    if (!one || names_data(layer)) return std::nullopt;
    if (channels.size() == 1) {
        if (names_data(channels[0])) return std::nullopt;
        return choice_of(0, {0}, -1);
    }
    if (auto choice = rgb_of(parts[0], 0, layer + ".")) return choice;
    return grey_of(parts[0], 0, layer + ".", false);
}

// The picture of an EXR if no layer is requested; empty if that is ambiguous.
std::optional<ChannelChoice> evident(const std::vector<PartNames>& parts) {
    const auto first = [&](auto&& choose) -> std::optional<ChannelChoice> {
        for (std::size_t k = 0; k < parts.size(); ++k) {
            if (is_data(parts[k])) continue;
            if (auto choice = choose(parts[k], static_cast<int>(k))) return choice;
        }
        return std::nullopt;
    };
    if (auto choice = first([](const PartNames& p, int k) { return rgb_of(p, k, ""); }))
        return choice;
    const std::vector<ChannelChoice> layers = picture_layers(parts);
    if (layers.size() == 1) return layers.front();
    if (layers.size() > 1) return std::nullopt;
    if (auto choice = first([](const PartNames& p, int k) { return grey_of(p, k, "", false); }))
        return choice;
    return only_layer(parts);
}

std::string listed(const std::vector<PartNames>& parts, bool channels) {
    std::set<std::string> names;
    for (const PartNames& part : parts) {
        if (!part.name.empty() && !channels) names.insert(part.name);
        for (const std::string& channel : part.channels) {
            if (channels)
                names.insert(channel);
            else if (const std::string layer = layer_of(channel); !layer.empty())
                names.insert(layer);
        }
    }
    constexpr std::size_t kShown = 12;
    std::string list;
    std::size_t shown = 0;
    for (const std::string& name : names) {
        if (shown++ == kShown) return list + ", …";
        list += (list.empty() ? "" : ", ") + name;
    }
    return list;
}

// Textures and passes have no setting for the layer.
std::string name_one_of(const std::string& layers) {
    return "Name a layer if it is the plate" + by({{setting::kPlateLayer}}) +
           ", a channel if it is a matte" + by({{setting::kMatteChannel}}) +
           ", or write the one that is meant by itself; its layers are: " + layers + ".";
}

Error nothing_chosen(const std::string& path, const std::vector<PartNames>& parts,
                     const RasterRequest& request) {
    const std::string channels = listed(parts, true), layers = listed(parts, false);
    if (!request.channel.empty()) {
        return unreadable(path, "it has no channel '" + request.channel + "'",
                          "Its channels are: " + channels + ".");
    }
    const bool cut = std::any_of(parts.begin(), parts.end(), [](const PartNames& part) {
        return std::any_of(part.channels.begin(), part.channels.end(), is_cut_name);
    });
    if (cut) {
        return unreadable(path,
                          "channels of its picture are missing; its channels are: " + channels,
                          kShorterNames);
    }
    const bool deep =
        std::any_of(parts.begin(), parts.end(), [](const PartNames& part) { return part.deep; });
    if (deep) {
        return unreadable(path, "it holds deep samples, not a flat picture",
                          "Flatten it first (DeepToImage in Nuke).");
    }
    const std::string prefix = request.layer.empty() ? std::string() : request.layer + ".";
    const bool chroma = std::any_of(parts.begin(), parts.end(), [&](const PartNames& part) {
        return has_chroma(part, prefix);
    });
    if (chroma) {
        return unreadable(path, "it holds luminance and chroma (Y, RY, BY) instead of colours",
                          "Write it with the channels R, G and B.");
    }
    if (!request.layer.empty()) {
        return unreadable(path, "it has no layer '" + request.layer + "'",
                          layers.empty() ? "It has no layers: leave the layer out."
                                         : "Its layers are: " + layers + ".");
    }
    if (picture_layers(parts).size() > 1) {
        return unreadable(path, "several of its layers may be the picture", name_one_of(layers));
    }
    if (layers.empty()) {
        return unreadable(path, "it has no colours, only the channels " + channels,
                          "Give a file with R, G and B.");
    }
    return unreadable(path, "it has no channels R, G, B", name_one_of(layers));
}

}  // namespace

Expected<ChannelChoice> choose_channels(const std::string& path,
                                        const std::vector<PartNames>& parts,
                                        const RasterRequest& request, bool exr) {
    std::optional<ChannelChoice> choice;
    if (!request.layer.empty() || !request.channel.empty()) {
        for (std::size_t k = 0; k < parts.size() && !choice; ++k)
            if (!parts[k].deep && (request.part < 0 || request.part == static_cast<int>(k)))
                choice = named_in(parts[k], static_cast<int>(k), request);
    } else if (exr) {
        choice = evident(parts);
    } else {
        const PartNames& only = parts.front();
        choice = rgb_of(only, 0, "");
        if (!choice) choice = grey_of(only, 0, "", true);
        if (!choice) choice = by_count(only, 0);
    }
    if (choice) return *choice;
    return tl::unexpected(nothing_chosen(path, parts, request));
}

}  // namespace weft
