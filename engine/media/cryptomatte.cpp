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
#include "engine/media/picture_file.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

struct Layer {
    std::string name;
    int part = 0;
    std::vector<std::array<int, 2>> ranks;  // channels of id and coverage
    std::map<std::string, std::uint32_t> ids;
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
        if (!layer.ranks.empty()) layers.push_back(std::move(layer));
    }
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

    // The display window's samples of a layer's ranks: id, coverage, id, coverage …
    [[nodiscard]] Expected<std::vector<float>> samples(const Layer& layer, Size& size) {
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
        return out;
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

// * matches any text.
bool matches(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, star = std::string_view::npos, mark = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
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
    while (p < pattern.size() && pattern[p] == '*')
        ++p;
    return p == pattern.size();
}

struct Wanted {
    const Layer* layer = nullptr;
    std::set<std::uint32_t> ids;
};

// The ids of a name: in the layer that it names, else in the first layer that has it.
std::optional<Wanted> find_name(const std::vector<Layer>& layers, std::string_view name) {
    const std::size_t slash = name.find('/');
    for (const bool qualified : {true, false}) {
        if (qualified && slash == std::string_view::npos) continue;
        const std::string_view where = qualified ? name.substr(0, slash) : std::string_view();
        const std::string_view what = qualified ? name.substr(slash + 1) : name;
        for (const Layer& layer : layers) {
            if (!std::string_view(layer.name).ends_with(where)) continue;
            Wanted wanted{&layer, {}};
            for (const auto& [known, id] : layer.ids)
                if (matches(known, what)) wanted.ids.insert(id);
            if (layer.ids.empty()) wanted.ids.insert(cryptomatte_id(what));
            if (!wanted.ids.empty()) return wanted;
        }
    }
    return std::nullopt;
}

Error no_such_name(const std::string& path, std::string_view name,
                   const std::vector<Layer>& layers) {
    constexpr std::size_t kShown = 12;
    std::string list;
    std::size_t shown = 0;
    for (const Layer& layer : layers) {
        for (const auto& [known, id] : layer.ids) {
            if (shown++ < kShown) list += (list.empty() ? "" : ", ") + known;
        }
    }
    return unreadable(path, "its Cryptomatte has no '" + std::string(name) + "'",
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

Expected<Matte> read_cryptomatte(const std::string& path, std::string_view names, Size expected) {
    return guarded(path, [&]() -> Expected<Matte> {
        WEFT_TRY(file, CryptoFile::open(path));
        std::map<const Layer*, std::set<std::uint32_t>> wanted;
        for (std::size_t from = 0; from <= names.size();) {
            const std::size_t comma = std::min(names.find(',', from), names.size());
            const std::string_view name = names.substr(from, comma - from);
            from = comma + 1;
            const auto found = find_name(file.layers(), name);
            if (!found) return tl::unexpected(no_such_name(path, name, file.layers()));
            wanted[found->layer].insert(found->ids.begin(), found->ids.end());
        }
        std::vector<double> sum;
        Size size;
        for (const auto& [layer, ids] : wanted) {
            WEFT_TRY(samples, file.samples(*layer, size));
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
