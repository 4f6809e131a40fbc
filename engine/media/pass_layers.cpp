#include "engine/media/pass_layers.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"
#include "engine/media/stereo_views.h"

namespace weft {
namespace {

PassLayer& layer_for(std::vector<PassLayer>& layers, int part, const std::string& part_name,
                     const std::string& name, bool prefixed) {
    const auto known = std::find_if(layers.begin(), layers.end(), [&](const PassLayer& layer) {
        return layer.part == part && layer.name == name && layer.prefixed == prefixed;
    });
    if (known != layers.end()) return *known;
    layers.push_back({part, name, part_name, prefixed, {}, {}, {}, {}, true});
    return layers.back();
}

void add_part(const OIIO::ImageSpec& spec, int part, std::vector<PassLayer>& layers) {
    const std::string part_name(spec.get_string_attribute("oiio:subimagename"));
    const std::string codec(spec.get_string_attribute("compression"));
    const std::string view(spec.get_string_attribute("view"));
    for (const std::string& channel : spec.channelnames) {
        const std::size_t dot = channel.rfind('.');
        const bool prefixed = dot != std::string::npos;
        const std::string name = prefixed ? channel.substr(0, dot) : part_name;
        PassLayer& layer = layer_for(layers, part, part_name, name, prefixed);
        layer.channels.push_back(prefixed ? channel.substr(dot + 1) : channel);
        layer.codec = codec;
        layer.view = view;
    }
}

// Tells each layer's view. `views`: those that the file declares, the default one first.
void name_views(const std::vector<std::string>& views, std::vector<PassLayer>& layers) {
    const std::string first = views.empty() ? "left" : views.front();
    for (PassLayer& layer : layers) {
        ViewName name = split_view(layer.name, views);
        layer.pass = std::move(name.pass);
        if (!name.view.empty()) layer.view = std::move(name.view);
        layer.first_view = layer.view.empty() || same_ignoring_case(layer.view, first);
    }
}

using Told = FoundPass::Told;

std::vector<std::string> views_of(const std::vector<FoundPass>& candidates) {
    std::vector<std::string> views;
    for (const FoundPass& candidate : candidates)
        if (!candidate.layer.view.empty()) views.push_back(candidate.layer.view);
    return views;
}

// How closely a pass and a layer of the plate belong together: render and view, the render, the
// view, or not.
int kinship(const PassLayer& pass, const ViewName& neighbour) {
    const bool render = render_of(pass.pass) == render_of(neighbour.pass);
    const bool named_view =
        !neighbour.view.empty() && same_ignoring_case(pass.view, neighbour.view);
    const bool view = named_view || (neighbour.view.empty() && pass.first_view);
    return render && view ? 3 : render ? 2 : named_view ? 1 : 0;
}

// The candidate that belongs to a layer of `beside`, else the first of the first view. Says why.
FoundPass& chosen_among(std::vector<FoundPass>& candidates,
                        const std::vector<std::string>& beside) {
    const std::vector<std::string> views = views_of(candidates);
    int closest = 0;
    FoundPass* nearest = nullptr;
    for (const std::string& neighbour : beside) {
        const ViewName name = split_view(neighbour, views);
        for (FoundPass& candidate : candidates) {
            const int close = kinship(candidate.layer, name);
            if (close <= closest) continue;
            closest = close;
            nearest = &candidate;
            candidate.why = "which belongs to " + neighbour;
            candidate.told = Told::kByNeighbour;
        }
    }
    if (nearest) return *nearest;
    const auto first = std::find_if(candidates.begin(), candidates.end(),
                                    [](const FoundPass& found) { return found.layer.first_view; });
    FoundPass& chosen = first == candidates.end() ? candidates.front() : *first;
    const bool by_view = std::all_of(candidates.begin(), candidates.end(), [&](const auto& other) {
        return &other == &chosen || (other.layer.pass == chosen.layer.pass &&
                                     other.layer.first_view != chosen.layer.first_view);
    });
    chosen.why = by_view ? "of the file's first view" : "the first in the file";
    chosen.told = by_view ? Told::kByView : Told::kByOrder;
    return chosen;
}

}  // namespace

std::string PassLayer::channel(std::string_view last) const {
    auto at = std::find(channels.begin(), channels.end(), last);
    // Nuke writes out the names of the channels of layers.
    for (const auto& [letter, word] : {std::pair<std::string_view, std::string_view>{"R", "red"},
                                       {"G", "green"},
                                       {"B", "blue"},
                                       {"A", "alpha"}})
        if (at == channels.end() && last == letter)
            at = std::find(channels.begin(), channels.end(), word);
    if (at == channels.end()) return {};
    return prefixed ? name + "." + *at : *at;
}

bool PassLayer::has(const std::vector<std::string>& all) const {
    return std::all_of(all.begin(), all.end(),
                       [&](const std::string& one) { return !channel(one).empty(); });
}

Expected<std::vector<PassLayer>> list_pass_layers(const std::string& path) {
    return guarded(path, [&]() -> Expected<std::vector<PassLayer>> {
        WEFT_TRY(input, open_picture(path));
        std::vector<PassLayer> layers;
        for (int part = 0; input->seek_subimage(part, 0); ++part)
            if (!input->spec().deep) add_part(input->spec(), part, layers);
        static_cast<void>(input->geterror());
        name_views(list_views(*input), layers);
        return layers;
    });
}

std::string list_of(const std::vector<PassLayer>& layers) {
    constexpr std::size_t kShown = 24;
    std::string list;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        if (k == kShown) return list + "; …";
        if (k > 0) list += "; ";
        if (!layers[k].name.empty()) list += layers[k].name + ": ";
        for (std::size_t c = 0; c < layers[k].channels.size(); ++c)
            list += (c > 0 ? ", " : "") + layers[k].channels[c];
    }
    return list;
}

bool is_called(const PassLayer& layer, std::string_view wanted) {
    const std::string_view name = layer.pass;
    if (name.size() < wanted.size()) return false;
    const std::size_t before = name.size() - wanted.size();
    return same_ignoring_case(name.substr(before), wanted) &&
           (before == 0 || name[before - 1] == '.');
}

const PassLayer* layer_named(const std::vector<PassLayer>& layers, std::string_view name) {
    const auto find = [&](auto&& matches) -> const PassLayer* {
        const auto at = std::find_if(layers.begin(), layers.end(), matches);
        return at == layers.end() ? nullptr : &*at;
    };
    if (const auto* exact = find([&](const PassLayer& layer) { return layer.name == name; }))
        return exact;
    if (const auto* alike =
            find([&](const PassLayer& layer) { return same_ignoring_case(layer.name, name); }))
        return alike;
    if (const auto* part =
            find([&](const PassLayer& layer) { return same_ignoring_case(layer.part_name, name); }))
        return part;
    const auto behind = [&](const PassLayer& layer) { return is_called(layer, name); };
    return std::count_if(layers.begin(), layers.end(), behind) == 1 ? find(behind) : nullptr;
}

std::optional<FoundPass> pass_in(const PassLayer& layer, const PassKind& kind) {
    for (const auto& channels : kind.channels) {
        if (!layer.has(channels)) continue;
        FoundPass found{layer, {}, {}};
        for (const std::string& channel : channels)
            found.channels.push_back(layer.channel(channel));
        return found;
    }
    return std::nullopt;
}

std::optional<FoundPass> find_pass(const std::vector<PassLayer>& layers, const PassKind& kind,
                                   const std::string& named,
                                   const std::vector<std::string>& beside) {
    if (!named.empty()) {
        const PassLayer* layer = layer_named(layers, named);
        return layer ? pass_in(*layer, kind) : std::nullopt;
    }
    for (const std::string& wanted : kind.layers) {
        std::vector<FoundPass> candidates;
        for (const bool letter_by_letter : {true, false}) {
            for (const PassLayer& layer : layers) {
                if (!is_called(layer, wanted)) continue;
                if (letter_by_letter && !layer.pass.ends_with(wanted)) continue;
                if (auto found = pass_in(layer, kind)) candidates.push_back(std::move(*found));
            }
            if (!candidates.empty()) break;
        }
        if (candidates.empty()) continue;
        FoundPass& chosen = chosen_among(candidates, beside);
        for (const FoundPass& other : candidates)
            if (&other != &chosen) chosen.also_called.push_back(other.layer.name);
        return std::move(chosen);
    }
    return std::nullopt;
}

std::optional<FoundPass> find_pass_alone(const std::vector<PassLayer>& layers,
                                         const PassKind& kind) {
    constexpr std::size_t kMostChannels = 4;
    if (layers.size() != 1 || layers.front().channels.size() > kMostChannels) return std::nullopt;
    return pass_in(layers.front(), kind);
}

Expected<std::vector<std::vector<float>>> read_pass(const std::string& path, const PassKind& kind,
                                                    const FoundPass& pass, Size expected,
                                                    Size& size) {
    std::vector<std::vector<float>> out;
    for (const std::string& channel : pass.channels) {
        RasterRequest request;
        request.channel = channel;
        request.part = pass.layer.part;
        WEFT_TRY(raster, read_raster(path, request));
        size = raster.info.size;
        WEFT_CHECK_OK(
            check_plate_size(path, "its " + kind.what + " pass", size, expected, kRenderAlike));
        auto* samples = std::get_if<std::vector<float>>(&raster.samples);
        if (!samples) {
            return tl::unexpected(unreadable(path, "its " + kind.what + " is not in half or float",
                                             "Render the " + kind.what + " pass as EXR."));
        }
        out.push_back(std::move(*samples));
    }
    return out;
}

Error no_such_pass(const std::string& path, const PassKind& kind, const std::string& named,
                   const std::vector<PassLayer>& layers) {
    std::string wanted;
    for (const auto& channels : kind.channels) {
        if (!wanted.empty()) wanted += " or ";
        for (std::size_t c = 0; c < channels.size(); ++c)
            wanted += (c > 0 ? ", " : "") + channels[c];
    }
    const std::string name =
        kind.layer_setting.empty() ? std::string() : "Name its layer" + by({{kind.layer_setting}});
    const bool cut = std::any_of(layers.begin(), layers.end(), [](const PassLayer& layer) {
        return std::any_of(layer.channels.begin(), layer.channels.end(),
                           [&](const auto& last) { return is_cut_name(layer.channel(last)); });
    });
    if (cut) {
        return unreadable(path, "it has no whole " + kind.what + " pass; it has " + list_of(layers),
                          kShorterNames);
    }
    const std::string has = "its layers and channels are: " + list_of(layers) + ".";
    if (!named.empty()) {
        return unreadable(path,
                          "it has no layer '" + named + "' with the channels of a " + kind.what +
                              " pass (" + wanted + ")",
                          "Name another" + by({{kind.layer_setting}}) + "; " + has);
    }
    return unreadable(path, "it has no " + kind.what + " pass in a layer of a known name",
                      (name.empty() ? "Give a file that has one" : name) + "; " + has);
}

}  // namespace weft
