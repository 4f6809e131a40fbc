#include "engine/media/cryptomatte_file.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <string_view>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

int channel_named(const OIIO::ImageSpec& spec, const std::string& name) {
    for (int c = 0; c < spec.nchannels; ++c) {
        if (same_ignoring_case(spec.channelnames[static_cast<std::size_t>(c)], name)) return c;
    }
    return -1;
}

std::vector<std::array<int, 2>> ranks_of(const OIIO::ImageSpec& spec, const std::string& layer) {
    std::vector<std::array<int, 2>> ranks;
    const auto add = [&](const std::string& stem) {
        const auto channel = [&](const char* shortly, const char* at_length) {
            const int c = channel_named(spec, stem + shortly);
            return c >= 0 ? c : channel_named(spec, stem + at_length);
        };
        const std::array<int, 4> rgba{channel("R", "red"), channel("G", "green"),
                                      channel("B", "blue"), channel("A", "alpha")};
        if (rgba[0] < 0 || rgba[1] < 0) return false;
        ranks.push_back({rgba[0], rgba[1]});
        if (rgba[2] >= 0 && rgba[3] >= 0) ranks.push_back({rgba[2], rgba[3]});
        return true;
    };
    for (int k = 0; k < 64; ++k)
        if (!add(layer + (k < 10 ? "0" : "") + std::to_string(k) + ".")) break;
    // Blender's File Output node calls it by its slot, whose name need not end in a number.
    if (ranks.empty()) add(layer + ".");
    return ranks;
}

// Blender cuts the names of channels: a view layer of 48 characters leaves one channel of four.
bool has_cut_names(OIIO::ImageInput& input) {
    for (int k = 0; input.seek_subimage(k, 0); ++k)
        for (const std::string& name : input.spec().channelnames)
            if (is_cut_name(name)) return true;
    return false;
}

// A feature film's set has some hundred thousand names.
constexpr std::uint64_t kManifestLimit_bytes = std::uint64_t{64} << 20;

// From the header, or from a file beside the picture.
std::string manifest_text(const OIIO::ImageSpec& spec, const std::string& key,
                          const std::string& path) {
    std::string inside(spec.get_string_attribute(key + "manifest"));
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
                std::vector<CryptoLayer>& layers) {
    constexpr std::string_view kPrefix = "cryptomatte/";
    for (const OIIO::ParamValue& entry : spec.extra_attribs) {
        const std::string attribute(entry.name().string());
        if (!attribute.starts_with(kPrefix) || !attribute.ends_with("/name")) continue;
        CryptoLayer layer;
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

// How many samples have an id beside a known one: what is left of ids where a picture was scaled,
// turned or blurred, since the weights of a filter hardly ever add up to 1 exactly. Of ids that
// were not touched one in some millions lies so close to another.
std::size_t filtered_ids(const std::vector<float>& samples, const std::set<std::uint32_t>& known) {
    constexpr std::uint32_t kBeside = 64;
    std::size_t count = 0;
    for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
        if (samples[k] == 0.0f || !(samples[k + 1] > 0.0f)) continue;
        const auto id = std::bit_cast<std::uint32_t>(samples[k]);
        const auto next = known.lower_bound(id < kBeside ? 0 : id - kBeside);
        count += next != known.end() && *next <= id + kBeside && !known.contains(id);
    }
    return count;
}

}  // namespace

Expected<CryptoFile> CryptoFile::open(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return fail(ErrorCode::kMissingFrames, "File " + path + " not found.",
                    "Supply it, or correct the name.");
    }
    CryptoFile file;
    file.path_ = path;
    WEFT_TRY(input, open_picture(path));
    file.input_ = std::move(input);
    for (int k = 0; file.input_->seek_subimage(k, 0); ++k)
        add_layers(file.input_->spec(), k, path, file.layers_);
    static_cast<void>(file.input_->geterror());
    if (file.layers_.empty() && has_cut_names(*file.input_)) {
        static_cast<void>(file.input_->geterror());
        return tl::unexpected(
            unreadable(path, "channels of its Cryptomatte are missing", kShorterNames));
    }
    if (file.layers_.empty()) {
        return tl::unexpected(
            unreadable(path, "it has no Cryptomatte",
                       "Render one, or name its file" + by({{setting::kCryptoFiles}}) + "."));
    }
    return file;
}

Expected<std::vector<float>> CryptoFile::samples(const CryptoLayer& layer, Size& size,
                                                 const std::set<std::uint32_t>& also) {
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
    constexpr std::size_t kByChance = 8;
    if (filtered_ids(out, known) > kByChance) {
        return tl::unexpected(unreadable(
            path_,
            "ids of its Cryptomatte '" + layer.name +
                "' are a little beside its objects': it has been scaled, turned or blurred",
            "Give the Cryptomatte as it was rendered, with the plate at the same size."));
    }
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

}  // namespace weft
