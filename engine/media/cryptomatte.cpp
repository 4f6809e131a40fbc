#include "engine/media/cryptomatte.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <optional>
#include <set>

#include "engine/media/cryptomatte_file.h"
#include "engine/media/cryptomatte_selection.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster_errors.h"
#include "engine/media/stereo_views.h"

namespace weft {
namespace {

std::string name_of(const CryptoLayer& layer, std::uint32_t id) {
    for (const auto& [name, hash] : layer.ids)
        if (hash == id) return name;
    char text[16];
    std::snprintf(text, sizeof text, "%08x", id);
    return text;
}

Expected<std::vector<CryptoObject>> objects_of(CryptoFile& file, const CryptoLayer& layer) {
    Size size;
    WEFT_TRY(samples, file.samples(layer, size));
    std::map<std::uint32_t, double> coverage;
    for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
        if (samples[k] != 0.0f && samples[k + 1] > 0.0f)
            coverage[std::bit_cast<std::uint32_t>(samples[k])] += samples[k + 1];
    }
    std::vector<CryptoObject> out;
    for (const auto& [id, sum] : coverage)
        out.push_back({layer.name, name_of(layer, id), id, sum});
    std::stable_sort(out.begin(), out.end(), [](const CryptoObject& a, const CryptoObject& b) {
        return a.coverage_px > b.coverage_px;
    });
    return out;
}

// kAnyText matches any text.
bool matches(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, star = std::string_view::npos, mark = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == kAnyText) {
            star = p++;
            mark = t;
        } else if (p < pattern.size() && pattern[p] == text[t]) {
            ++p, ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++mark;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == kAnyText)
        ++p;
    return p == pattern.size();
}

struct Wanted {
    const CryptoLayer* layer = nullptr;
    std::set<std::uint32_t> ids;
};

bool ends_with(const CryptoLayer& layer, std::string_view where) {
    return std::string_view(layer.name).ends_with(where);
}

// The part of a name that says its layer, and the rest. Names may hold a slash, too.
std::pair<std::string_view, std::string_view> split_layer(const std::vector<CryptoLayer>& layers,
                                                          std::string_view name) {
    const std::size_t slash = name.find('/');
    // Names that begin with a slash are paths: "/obj/geo1" of Houdini, "/World/Chair" of USD.
    if (slash == std::string_view::npos || slash == 0) return {{}, name};
    const std::string_view where = name.substr(0, slash);
    const bool known = std::any_of(layers.begin(), layers.end(), [&](const CryptoLayer& layer) {
        return ends_with(layer, where);
    });
    return known ? std::pair(where, name.substr(slash + 1)) : std::pair(std::string_view(), name);
}

// The ids of a name that the manifests list: in the layer that it names, else in the first layer
// that has it.
std::optional<Wanted> find_listed(const std::vector<CryptoLayer>& layers, std::string_view name) {
    const auto [where, what] = split_layer(layers, name);
    const auto find_in = [&](std::string_view in, std::string_view text) -> std::optional<Wanted> {
        for (const CryptoLayer& layer : layers) {
            if (!ends_with(layer, in)) continue;
            Wanted wanted{&layer, {}};
            for (const auto& [known, id] : layer.ids)
                if (matches(known, text)) wanted.ids.insert(id);
            if (!wanted.ids.empty()) return wanted;
        }
        return std::nullopt;
    };
    auto found = find_in(where, what);
    return found || where.empty() ? found : find_in({}, name);
}

// Renderers list the objects that a frame shows, or none at all: what is not listed is looked for
// by its hash, and is nowhere if no pixel has that.
Wanted find_name(const std::vector<CryptoLayer>& layers, std::string_view name) {
    if (auto listed = find_listed(layers, name)) return std::move(*listed);
    const auto [where, what] = split_layer(layers, name);
    const auto layer =
        std::find_if(layers.begin(), layers.end(),
                     [&, in = where](const CryptoLayer& one) { return ends_with(one, in); });
    Wanted wanted{&*layer, {}};
    if (what.find(kAnyText) == std::string_view::npos) wanted.ids.insert(cryptomatte_id(what));
    return wanted;
}

// As an artist writes it.
std::string shown_name(std::string name) {
    std::replace(name.begin(), name.end(), kAnyText, '*');
    return name;
}

Error no_such_name(const std::string& path, std::size_t frames, const std::string& name,
                   const std::vector<CryptoLayer>& layers) {
    constexpr std::size_t kShown = 12;
    std::string list;
    std::size_t shown = 0;
    for (const CryptoLayer& layer : layers) {
        for (const auto& [known, id] : layer.ids) {
            if (shown++ < kShown) list += (list.empty() ? "" : ", ") + known;
        }
    }
    const std::string others =
        frames > 1 ? ", nor has that of any other of " + std::to_string(frames) + " frames" : "";
    const std::string none = "its Cryptomatte has no '" + shown_name(name) + "'" + others;
    if (list.empty()) {
        const auto manifests = cryptomatte_manifest_files(path);
        const std::string where = manifests.empty() ? std::string("in its header")
                                                    : "in " + manifests.front() + " beside it";
        return unreadable(path, none,
                          "It lists no names (there is no manifest " + where +
                              "): give the object's whole name, as the scene has it.");
    }
    return unreadable(path, none, "It has: " + list + (shown > kShown ? ", …" : "") + ".");
}

}  // namespace

std::vector<std::string> cryptomatte_manifest_files(const std::string& path) {
    std::vector<std::string> out;
    const auto opened = open_picture(path);
    if (!opened) return out;
    const auto& input = *opened;
    for (int k = 0; input->seek_subimage(k, 0); ++k) {
        for (const OIIO::ParamValue& entry : input->spec().extra_attribs) {
            const std::string attribute(entry.name().string()), name = entry.get_string();
            if (attribute.starts_with("cryptomatte/") && attribute.ends_with("/manif_file") &&
                name.find('/') == std::string::npos)
                out.push_back((std::filesystem::path(path).parent_path() / name).string());
        }
    }
    static_cast<void>(OIIO::geterror());
    return out;
}

Expected<std::vector<CryptoObject>> list_cryptomatte(const std::string& path) {
    return guarded(path, [&]() -> Expected<std::vector<CryptoObject>> {
        WEFT_TRY(file, CryptoFile::open(path));
        std::vector<CryptoObject> all;
        for (const CryptoLayer& layer : file.layers()) {
            WEFT_TRY(objects, objects_of(file, layer));
            all.insert(all.end(), objects.begin(), objects.end());
        }
        return all;
    });
}

Status check_cryptomatte_names(const std::vector<std::string>& paths, std::string_view names) {
    std::vector<std::string> missing = split_crypto_names(names);
    std::optional<Error> first;
    const auto find_in = [&](const std::string& path, bool in_pixels) {
        return guarded(path, [&]() -> Status {
            WEFT_TRY(file, CryptoFile::open(path));
            std::vector<std::string> still;
            for (std::string& name : missing) {
                bool found = find_listed(file.layers(), name).has_value();
                if (!found && in_pixels) {
                    const Wanted wanted = find_name(file.layers(), name);
                    Size size;
                    WEFT_TRY(samples, file.samples(*wanted.layer, size, wanted.ids));
                    for (std::size_t k = 0; !found && k + 1 < samples.size(); k += 2)
                        found = samples[k + 1] > 0 &&
                                wanted.ids.contains(std::bit_cast<std::uint32_t>(samples[k]));
                }
                if (!found) still.push_back(std::move(name));
            }
            missing = std::move(still);
            if (!missing.empty() && !first)
                first = no_such_name(path, paths.size(), missing.front(), file.layers());
            return {};
        });
    };
    // Manifests are quickly read; most names are in the first.
    for (const bool in_pixels : {false, true}) {
        first.reset();
        for (std::size_t k = 0; k < paths.size() && !missing.empty(); ++k)
            WEFT_CHECK_OK(find_in(paths[k], in_pixels));
    }
    if (missing.empty() || !first) return {};
    return tl::unexpected(std::move(*first));
}

std::string cryptomatte_layer(const std::string& path, std::string_view names) {
    const auto layer = guarded(path, [&]() -> Expected<std::string> {
        WEFT_TRY(file, CryptoFile::open(path));
        const auto found = find_listed(file.layers(), split_crypto_names(names).front());
        return found ? found->layer->name : std::string();
    });
    return layer.value_or(std::string());
}

std::string cryptomatte_names_beside(const std::string& path, std::string_view names,
                                     std::string_view beside) {
    const auto rewritten = guarded(path, [&]() -> Expected<std::string> {
        WEFT_TRY(file, CryptoFile::open(path));
        std::vector<CryptoLayer> same;
        for (const CryptoLayer& layer : file.layers())
            if (render_of(layer.name) == render_of(beside)) same.push_back(layer);
        std::string out;
        bool changed = false;
        for (const std::string& name : split_crypto_names(names)) {
            const auto there = find_listed(same, name);
            const bool first =
                there && find_listed(file.layers(), name)->layer->name == there->layer->name;
            const bool named = !split_layer(file.layers(), name).first.empty();
            const bool prefixed = there && !first && !named;
            changed |= prefixed;
            if (!out.empty()) out += ", ";
            out += escaped_crypto_name(prefixed ? there->layer->name + "/" + name : name);
        }
        return changed ? out : std::string(names);
    });
    return rewritten.value_or(std::string(names));
}

Expected<Matte> read_cryptomatte(const std::string& path, std::string_view names, Size expected) {
    return guarded(path, [&]() -> Expected<Matte> {
        WEFT_TRY(file, CryptoFile::open(path));
        std::map<const CryptoLayer*, std::set<std::uint32_t>> wanted;
        for (const std::string& name : split_crypto_names(names)) {
            const Wanted found = find_name(file.layers(), name);
            wanted[found.layer].insert(found.ids.begin(), found.ids.end());
        }
        std::vector<double> sum;
        Size size;
        for (const auto& [layer, ids] : wanted) {
            WEFT_TRY(samples, file.samples(*layer, size, ids));
            WEFT_CHECK_OK(
                check_plate_size(path, "it", size, expected, "render it at the plate's size"));
            const std::size_t count = 2 * layer->ranks.size();
            sum.resize(samples.size() / count);
            for (std::size_t i = 0; i < sum.size(); ++i) {
                for (std::size_t k = 0; k < count; k += 2) {
                    const float* rank = samples.data() + i * count + k;
                    if (rank[1] > 0 && ids.contains(std::bit_cast<std::uint32_t>(rank[0])))
                        sum[i] += rank[1];
                }
            }
        }
        Matte out(size);
        std::transform(sum.begin(), sum.end(), out.data(), [](double v) {
            return static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 255.0 + 0.5);
        });
        return out;
    });
}

Expected<CryptoObject> pick_cryptomatte(const std::string& path, int x, int y) {
    return guarded(path, [&]() -> Expected<CryptoObject> {
        WEFT_TRY(file, CryptoFile::open(path));
        const CryptoLayer& layer = file.layers().front();
        Size size;
        WEFT_TRY(samples, file.samples(layer, size));
        if (x < 0 || y < 0 || x >= size.width || y >= size.height) {
            return fail(ErrorCode::kUsage,
                        "The pixel " + std::to_string(x) + "," + std::to_string(y) +
                            " is outside " + path + ".",
                        "Give one inside its " + std::to_string(size.width) + " x " +
                            std::to_string(size.height) + ".");
        }
        CryptoObject best{layer.name, "", 0, 0};
        const std::size_t count = 2 * layer.ranks.size();
        const float* at =
            samples.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                              static_cast<std::size_t>(x)) *
                                 count;
        for (std::size_t k = 0; k < count; k += 2) {
            if (at[k] == 0.0f || !(at[k + 1] > best.coverage_px)) continue;
            best.id = std::bit_cast<std::uint32_t>(at[k]);
            best.coverage_px = at[k + 1];
        }
        if (best.coverage_px > 0) best.name = name_of(layer, best.id);
        return best;
    });
}

}  // namespace weft
