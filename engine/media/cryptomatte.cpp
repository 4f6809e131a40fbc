#include "engine/media/cryptomatte.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/cryptomatte_selection.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

struct Layer {
    std::string name;
    int part = 0;
    std::vector<std::array<int, 2>> ranks;  // channels of id and coverage
    std::map<std::string, std::uint32_t> ids;
    std::string stored_as;  // "half, dwaa": what may have changed its ids
};

int channel_named(const OIIO::ImageSpec& spec, const std::string& name) {
    for (int c = 0; c < spec.nchannels; ++c) {
        if (same_ignoring_case(spec.channelnames[static_cast<std::size_t>(c)], name)) return c;
    }
    return -1;
}

std::vector<std::array<int, 2>> ranks_of(const OIIO::ImageSpec& spec, const std::string& layer) {
    std::vector<std::array<int, 2>> ranks;
    for (int k = 0; k < 64; ++k) {
        const std::string stem = layer + (k < 10 ? "0" : "") + std::to_string(k) + ".";
        const auto channel = [&](const char* shortly, const char* at_length) {
            const int c = channel_named(spec, stem + shortly);
            return c >= 0 ? c : channel_named(spec, stem + at_length);
        };
        const std::array<int, 4> rgba{channel("R", "red"), channel("G", "green"),
                                      channel("B", "blue"), channel("A", "alpha")};
        if (rgba[0] < 0 || rgba[1] < 0) return ranks;
        ranks.push_back({rgba[0], rgba[1]});
        if (rgba[2] >= 0 && rgba[3] >= 0) ranks.push_back({rgba[2], rgba[3]});
    }
    return ranks;
}

// A feature film's set has some hundred thousand names.
constexpr std::uint64_t kManifestLimit_bytes = std::uint64_t{64} << 20;

// From the header, or from a file beside the picture.
std::string manifest_text(const OIIO::ImageSpec& spec, const std::string& key,
                          const std::string& path) {
    const std::string inside(spec.get_string_attribute(key + "manifest"));
    const std::string file(spec.get_string_attribute(key + "manif_file"));
    if (!inside.empty() || file.empty() || file.find('/') != std::string::npos) return inside;
    const auto beside = std::filesystem::path(path).parent_path() / file;
    return read_file(beside.string(), "The manifest", kManifestLimit_bytes).value_or(std::string());
}

// The format and codec of the layer's first id.
std::string stored_as(const OIIO::ImageSpec& spec, int channel) {
    const std::string format(spec.channelformat(channel).c_str());
    return format + ", " + std::string(spec.get_string_attribute("compression", "none"));
}

void add_layers(const OIIO::ImageSpec& spec, int part, const std::string& path,
                std::vector<Layer>& layers) {
    constexpr std::string_view kPrefix = "cryptomatte/";
    for (const OIIO::ParamValue& entry : spec.extra_attribs) {
        const std::string attribute(entry.name().string());
        if (!attribute.starts_with(kPrefix) || !attribute.ends_with("/name")) continue;
        Layer layer;
        layer.name = entry.get_string();
        layer.part = part;
        layer.ranks = ranks_of(spec, layer.name);
        const std::string key = attribute.substr(0, attribute.size() - 4);
        // Without a manifest, names can still be matched by their hashes.
        if (auto ids = parse_cryptomatte_manifest(manifest_text(spec, key, path)))
            layer.ids = std::move(*ids);
        if (layer.ranks.empty()) continue;
        layer.stored_as = stored_as(spec, layer.ranks.front()[0]);
        layers.push_back(std::move(layer));
    }
}

// Whether ids may have lost bits where they were stored like this.
bool may_round(std::string_view stored_as) {
    constexpr std::array<std::string_view, 5> kLossy{"pxr24", "b44", "b44a", "dwaa", "dwab"};
    const std::string_view codec = stored_as.substr(stored_as.find(", ") + 2);
    return stored_as.starts_with("half") ||
           std::find(kLossy.begin(), kLossy.end(), codec.substr(0, codec.find(':'))) !=
               kLossy.end();
}

// Ids as PXR24 keeps them: 24 of 32 bits, rounded.
constexpr std::uint32_t kLostBits = 0xff;
std::uint32_t rounded_id(std::uint32_t id) {
    return (id + (kLostBits + 1) / 2) & ~kLostBits;
}

// Where no id that covers anything has its last 8 bits, and none of them is `known`, each becomes
// the known one that it was rounded from. Returns how many different ids stay unknown if none has
// such an original, else 0.
std::size_t restore_rounded_ids(std::vector<float>& samples, const std::set<std::uint32_t>& known) {
    std::map<std::uint32_t, std::uint32_t> originals;
    for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
        if (samples[k] == 0.0f || !(samples[k + 1] > 0.0f)) continue;
        const auto id = std::bit_cast<std::uint32_t>(samples[k]);
        if ((id & kLostBits) != 0 || known.contains(id)) return 0;
        originals.emplace(id, id);
    }
    bool any = false;
    for (const std::uint32_t id : known) {
        const auto rounded = originals.find(rounded_id(id));
        if (rounded == originals.end()) continue;
        rounded->second = id;
        any = true;
    }
    if (!any) return originals.size();
    for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
        const auto original = originals.find(std::bit_cast<std::uint32_t>(samples[k]));
        if (original != originals.end()) samples[k] = std::bit_cast<float>(original->second);
    }
    return 0;
}

class CryptoFile {
  public:
    static Expected<CryptoFile> open(const std::string& path) {
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) {
            return fail(ErrorCode::kMissingFrames,
                        "File " + path + " not found. Supply it, or correct the name.");
        }
        CryptoFile file;
        file.path_ = path;
        WEFT_TRY(input, open_picture(path));
        file.input_ = std::move(input);
        for (int k = 0; file.input_->seek_subimage(k, 0); ++k)
            add_layers(file.input_->spec(), k, path, file.layers_);
        static_cast<void>(file.input_->geterror());
        if (file.layers_.empty()) {
            return tl::unexpected(
                unreadable(path, "it has no Cryptomatte",
                           "Render one, or name its file" + by({{setting::kCryptoFiles}}) + "."));
        }
        return file;
    }

    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }

    // The display window's samples of a layer's ranks: id, coverage, id, coverage … An id that a
    // codec has rounded is that of the manifest or of `also` again.
    [[nodiscard]] Expected<std::vector<float>> samples(const Layer& layer, Size& size,
                                                       const std::set<std::uint32_t>& also = {}) {
        input_->seek_subimage(layer.part, 0);
        const OIIO::ImageSpec spec = input_->spec();
        size = {spec.full_width, spec.full_height};
        if (spec.deep || size.empty()) return tl::unexpected(damaged(path_, "it has no pixels"));
        const auto wide = static_cast<std::size_t>(spec.nchannels);
        WEFT_CHECK_OK(check_memory(path_, {spec.width, spec.height}, spec.nchannels));
        WEFT_CHECK_OK(check_memory(path_, size, static_cast<int>(2 * layer.ranks.size())));
        std::vector<float> data(static_cast<std::size_t>(spec.width) *
                                static_cast<std::size_t>(spec.height) * wide);
        if (!input_->read_image(layer.part, 0, 0, spec.nchannels, OIIO::TypeFloat, data.data()))
            return tl::unexpected(damaged(path_, input_->geterror()));
        const std::size_t count = 2 * layer.ranks.size();
        std::vector<float> out(static_cast<std::size_t>(size.width) *
                               static_cast<std::size_t>(size.height) * count);
        const Recti window =
            Recti{spec.x, spec.y, spec.x + spec.width, spec.y + spec.height}.intersected(
                {spec.full_x, spec.full_y, spec.full_x + size.width, spec.full_y + size.height});
        for (int y = window.y0; y < window.y1; ++y) {
            for (int x = window.x0; x < window.x1; ++x) {
                const float* from = data.data() + (static_cast<std::size_t>(y - spec.y) *
                                                       static_cast<std::size_t>(spec.width) +
                                                   static_cast<std::size_t>(x - spec.x)) *
                                                      wide;
                float* to = out.data() + (static_cast<std::size_t>(y - spec.full_y) *
                                              static_cast<std::size_t>(size.width) +
                                          static_cast<std::size_t>(x - spec.full_x)) *
                                             count;
                for (const auto& [id, coverage] : layer.ranks) {
                    *to++ = from[id];
                    *to++ = from[coverage];
                }
            }
        }
        std::set<std::uint32_t> known = also;
        for (const auto& [name, id] : layer.ids)
            known.insert(id);
        const std::size_t unknown = restore_rounded_ids(out, known);
        // One object that the manifest does not list may have such an id by chance.
        const std::size_t enough = may_round(layer.stored_as) ? 1 : 2;
        if (unknown < enough || layer.ids.empty()) return out;
        return tl::unexpected(
            unreadable(path_,
                       "no id of its Cryptomatte '" + layer.name +
                           "' is one of its objects': they have been "
                           "rounded where it was written (" +
                           layer.stored_as + ")",
                       "Write Cryptomattes as 32-bit float with a lossless codec such as ZIP."));
    }

  private:
    std::string path_;
    std::unique_ptr<OIIO::ImageInput> input_;
    std::vector<Layer> layers_;
};

std::string name_of(const Layer& layer, std::uint32_t id) {
    for (const auto& [name, hash] : layer.ids)
        if (hash == id) return name;
    char text[16];
    std::snprintf(text, sizeof text, "%08x", id);
    return text;
}

Expected<std::vector<CryptoObject>> objects_of(CryptoFile& file, const Layer& layer) {
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
    const Layer* layer = nullptr;
    std::set<std::uint32_t> ids;
};

bool ends_with(const Layer& layer, std::string_view where) {
    return std::string_view(layer.name).ends_with(where);
}

// The part of a name that says its layer, and the rest. Names may hold a slash, too.
std::pair<std::string_view, std::string_view> split_layer(const std::vector<Layer>& layers,
                                                          std::string_view name) {
    const std::size_t slash = name.find('/');
    if (slash == std::string_view::npos) return {{}, name};
    const std::string_view where = name.substr(0, slash);
    const bool known = std::any_of(layers.begin(), layers.end(),
                                   [&](const Layer& layer) { return ends_with(layer, where); });
    return known ? std::pair(where, name.substr(slash + 1)) : std::pair(std::string_view(), name);
}

// The ids of a name that the manifests list: in the layer that it names, else in the first layer
// that has it.
std::optional<Wanted> find_listed(const std::vector<Layer>& layers, std::string_view name) {
    const auto [where, what] = split_layer(layers, name);
    const auto find_in = [&](std::string_view in, std::string_view text) -> std::optional<Wanted> {
        for (const Layer& layer : layers) {
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
Wanted find_name(const std::vector<Layer>& layers, std::string_view name) {
    if (auto listed = find_listed(layers, name)) return std::move(*listed);
    const auto [where, what] = split_layer(layers, name);
    const auto layer =
        std::find_if(layers.begin(), layers.end(),
                     [&, in = where](const Layer& one) { return ends_with(one, in); });
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
                   const std::vector<Layer>& layers) {
    constexpr std::size_t kShown = 12;
    std::string list;
    std::size_t shown = 0;
    for (const Layer& layer : layers) {
        for (const auto& [known, id] : layer.ids) {
            if (shown++ < kShown) list += (list.empty() ? "" : ", ") + known;
        }
    }
    const std::string others =
        frames > 1 ? ", nor has that of any other of " + std::to_string(frames) + " frames" : "";
    return unreadable(path, "its Cryptomatte has no '" + shown_name(name) + "'" + others,
                      "It has: " + list + (shown > kShown ? ", …" : "") + ".");
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
        for (const Layer& layer : file.layers()) {
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

Expected<Matte> read_cryptomatte(const std::string& path, std::string_view names, Size expected) {
    return guarded(path, [&]() -> Expected<Matte> {
        WEFT_TRY(file, CryptoFile::open(path));
        std::map<const Layer*, std::set<std::uint32_t>> wanted;
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
        const Layer& layer = file.layers().front();
        Size size;
        WEFT_TRY(samples, file.samples(layer, size));
        if (x < 0 || y < 0 || x >= size.width || y >= size.height) {
            return fail(ErrorCode::kUsage,
                        "The pixel " + std::to_string(x) + "," + std::to_string(y) +
                            " is outside " + path + ". Give one inside its " +
                            std::to_string(size.width) + " x " + std::to_string(size.height) + ".");
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
