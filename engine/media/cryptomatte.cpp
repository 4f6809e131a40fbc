#include "engine/media/cryptomatte.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include "engine/media/exr_header.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// ---- the manifest ------------------------------------------------------------------------------

class ManifestReader {
  public:
    explicit ManifestReader(std::string_view text) : text_(text) {}

    Expected<std::map<std::string, std::uint32_t>> read() {
        std::map<std::string, std::uint32_t> out;
        if (!take('{')) return wrong("it does not begin with {");
        if (take('}')) return out;
        do {
            WEFT_TRY(name, string());
            if (!take(':')) return wrong("a name has no value");
            WEFT_TRY(hex, string());
            std::uint32_t id = 0;
            if (hex.empty() || hex.size() > 8) return wrong("a value has not 8 digits");
            for (const char c : hex) {
                const int digit = digit_of(c);
                if (digit < 0) return wrong("a value is not hexadecimal");
                id = id * 16 + static_cast<std::uint32_t>(digit);
            }
            out[std::move(name)] = id;
        } while (take(','));
        if (!take('}')) return wrong("it ends early");
        return out;
    }

  private:
    static tl::unexpected<Error> wrong(const char* why) {
        return fail(ErrorCode::kUnreadable,
                    std::string("The Cryptomatte manifest cannot be read: ") + why + ".");
    }
    static int digit_of(char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    }
    bool take(char wanted) {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
            ++at_;
        if (at_ >= text_.size() || text_[at_] != wanted) return false;
        ++at_;
        return true;
    }
    Expected<std::string> string() {
        if (!take('"')) return wrong("a text is missing");
        std::string out;
        while (at_ < text_.size() && text_[at_] != '"') {
            if (text_[at_] != '\\') {
                out += text_[at_++];
                continue;
            }
            if (++at_ >= text_.size()) break;
            const char c = text_[at_++];
            if (c == 'u') {
                WEFT_CHECK_OK(unicode(out));
            } else {
                static constexpr std::string_view kFrom = "nrtbf", kTo = "\n\r\t\b\f";
                const std::size_t k = kFrom.find(c);
                out += k == std::string_view::npos ? c : kTo[k];
            }
        }
        if (at_ >= text_.size()) return wrong("a text has no end");
        ++at_;
        return out;
    }
    // Four digits; of a surrogate pair each half is kept as three bytes, which is what a name's
    // hash was not made of, but such names are not found in practice.
    Status unicode(std::string& out) {
        unsigned code = 0;
        for (int k = 0; k < 4; ++k, ++at_) {
            const int digit = at_ < text_.size() ? digit_of(text_[at_]) : -1;
            if (digit < 0) return wrong("an escape is cut off");
            code = code * 16 + static_cast<unsigned>(digit);
        }
        if (code < 0x80) {
            out += static_cast<char>(code);
        } else if (code < 0x800) {
            out += static_cast<char>(0xC0 | (code >> 6));
            out += static_cast<char>(0x80 | (code & 0x3F));
        } else {
            out += static_cast<char>(0xE0 | (code >> 12));
            out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
            out += static_cast<char>(0x80 | (code & 0x3F));
        }
        return {};
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// ---- the layers --------------------------------------------------------------------------------

struct Layer {
    std::string name;
    int part = 0;
    std::vector<std::array<int, 2>> ranks;  // channels of id and coverage
    std::map<std::string, std::uint32_t> ids;
};

bool same_text(std::string_view a, std::string_view b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
               return std::tolower(static_cast<unsigned char>(x)) ==
                      std::tolower(static_cast<unsigned char>(y));
           });
}

int channel_named(const OIIO::ImageSpec& spec, const std::string& name) {
    for (int c = 0; c < spec.nchannels; ++c) {
        if (same_text(spec.channelnames[static_cast<std::size_t>(c)], name)) return c;
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

// In the header, or in a file beside the picture.
std::string manifest_text(const OIIO::ImageSpec& spec, const std::string& key,
                          const std::string& path) {
    const std::string inside(spec.get_string_attribute(key + "manifest"));
    const std::string file(spec.get_string_attribute(key + "manif_file"));
    if (!inside.empty() || file.empty() || file.find('/') != std::string::npos) return inside;
    std::ifstream stream(std::filesystem::path(path).parent_path() / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
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
        // Without a manifest names still have their hashes.
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
                        "There is no file " + path + ". Supply it, or correct the name.");
        }
        CryptoFile file;
        file.path_ = path;
        WEFT_CHECK_OK(check_exr_header(path));
        file.input_ = OIIO::ImageInput::open(path);
        if (!file.input_) return tl::unexpected(damaged(path, OIIO::geterror()));
        for (int k = 0; file.input_->seek_subimage(k, 0); ++k)
            add_layers(file.input_->spec(), k, path, file.layers_);
        static_cast<void>(file.input_->geterror());
        if (file.layers_.empty()) {
            return tl::unexpected(unreadable(path, "it holds no Cryptomatte",
                                             "Render one, or name its file (--crypto-files)."));
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

// * stands for anything.
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

// Which ids a name stands for: in the layer that it names, else in the first that has it.
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

std::uint32_t cryptomatte_id(std::string_view name) {
    constexpr std::uint32_t c1 = 0xcc9e2d51, c2 = 0x1b873593;
    std::uint32_t h = 0;
    const auto mix = [&](std::uint32_t k) { return std::rotl(k * c1, 15) * c2; };
    const std::size_t blocks = name.size() / 4;
    for (std::size_t i = 0; i < blocks; ++i) {
        std::uint32_t k = 0;
        std::memcpy(&k, name.data() + 4 * i, 4);
        h = std::rotl(h ^ mix(k), 13) * 5 + 0xe6546b64;
    }
    std::uint32_t tail = 0;
    for (std::size_t i = name.size(); i > 4 * blocks; --i)
        tail = (tail << 8) | static_cast<unsigned char>(name[i - 1]);
    h ^= mix(tail);
    h ^= static_cast<std::uint32_t>(name.size());
    h = (h ^ (h >> 16)) * 0x85ebca6b;
    h = (h ^ (h >> 13)) * 0xc2b2ae35;
    h ^= h >> 16;
    const std::uint32_t exponent = (h >> 23) & 255;
    return exponent == 0 || exponent == 255 ? h ^ (1u << 23) : h;
}

Expected<std::map<std::string, std::uint32_t>> parse_cryptomatte_manifest(std::string_view text) {
    return ManifestReader(text).read();
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
            if (!expected.empty() && size != expected) {
                return tl::unexpected(unreadable(
                    path,
                    "it is " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                        " but the plate is " + std::to_string(expected.width) + "x" +
                        std::to_string(expected.height),
                    "Both must have one size."));
            }
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
            return fail(ErrorCode::kUsage, "The pixel " + std::to_string(x) + "," +
                                               std::to_string(y) + " lies outside of " + path +
                                               ".");
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
