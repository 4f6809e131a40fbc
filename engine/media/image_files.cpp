#include "engine/media/image_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/setting.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/matte_code.h"
#include "engine/media/plate_decode.h"
#include "engine/media/plates.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// The matte's samples among a raster's channels. Luma reads three.
struct MatteChannels {
    bool luma = false;
    int channel = 0;
};

bool has_transparency(const Raster& raster) {
    if (!raster.has_alpha) return false;
    return std::visit(
        [&](const auto& samples) {
            using T = typename std::decay_t<decltype(samples)>::value_type;
            const T opaque = std::is_floating_point_v<T> ? T{1} : std::numeric_limits<T>::max();
            const auto step = static_cast<std::size_t>(raster.channels);
            for (std::size_t i = step - 1; i < samples.size(); i += step) {
                if (samples[i] != opaque) return true;
            }
            return false;
        },
        raster.samples);
}

// "R", "G", "B", "A", "Y" and the default, among the colour channels; empty if there is none.
std::optional<MatteChannels> find_source(const Raster& raster, const std::string& channel) {
    const bool grey = raster.colors() < 3;
    const int alpha = raster.channels - 1;
    if (channel == "R") return MatteChannels{false, 0};
    if (channel == "G") return MatteChannels{false, grey ? 0 : 1};
    if (channel == "B") return MatteChannels{false, grey ? 0 : 2};
    if (channel == "A")
        return raster.has_alpha ? std::optional(MatteChannels{false, alpha}) : std::nullopt;
    if (channel.empty() && has_transparency(raster)) return MatteChannels{false, alpha};
    return MatteChannels{!grey, 0};
}

bool is_color_name(const std::string& channel) {
    return channel.empty() || channel == "R" || channel == "G" || channel == "B" ||
           channel == "A" || channel == "Y";
}

template <class T>
float as_share(T v) {
    if constexpr (std::is_floating_point_v<T>) {
        return v;
    } else {
        return static_cast<float>(static_cast<double>(v) / std::numeric_limits<T>::max());
    }
}

// The same of one 8-bit channel, which most mattes are, by a table.
void quantise_codes(const std::vector<std::uint8_t>& samples, std::size_t channel, std::size_t step,
                    std::uint8_t* out) {
    std::array<std::uint8_t, 256> coverage_of{};
    for (std::size_t code = 0; code < coverage_of.size(); ++code)
        coverage_of[code] = matte_code(as_share(static_cast<std::uint8_t>(code)));
    for (std::size_t at = channel; at < samples.size(); at += step)
        *out++ = coverage_of[samples[at]];
}

Matte coverage(const Raster& raster, MatteChannels source) {
    Matte matte(raster.info.size);
    const auto step = static_cast<std::size_t>(raster.channels);
    const auto channel = static_cast<std::size_t>(source.channel);
    std::uint8_t* const out = matte.data();
    if (const auto* codes = std::get_if<std::vector<std::uint8_t>>(&raster.samples);
        codes && !source.luma) {
        quantise_codes(*codes, channel, step, out);
        return matte;
    }
    std::visit(
        [&](const auto& samples) {
            for (std::size_t i = 0, at = 0; at < samples.size(); ++i, at += step) {
                const auto* p = samples.data() + at;
                out[i] = matte_code(source.luma
                                        ? luma_709(as_share(p[0]), as_share(p[1]), as_share(p[2]))
                                        : as_share(p[channel]));
            }
        },
        raster.samples);
    return matte;
}

// Renderers write ids as floats; Cycles does not filter them.
bool has_whole_numbers(const Raster& raster, int channel) {
    const auto* samples = std::get_if<std::vector<float>>(&raster.samples);
    if (!samples) return true;
    for (std::size_t at = static_cast<std::size_t>(channel); at < samples->size();
         at += static_cast<std::size_t>(raster.channels))
        if ((*samples)[at] != std::trunc((*samples)[at])) return false;  // NaN too
    return true;
}

void choose_id_channel(const std::string& path, RasterRequest& request) {
    const auto found = find_ids(path);
    if (!found) return;
    request.channel = found->channels.front();
    request.part = found->layer.part;
}

Matte equal_to(const Raster& raster, int channel, int value) {
    Matte matte(raster.info.size);
    const auto step = static_cast<std::size_t>(raster.channels);
    std::uint8_t* const out = matte.data();
    std::visit(
        [&](const auto& samples) {
            std::size_t at = static_cast<std::size_t>(channel);
            for (std::size_t i = 0; at < samples.size(); ++i, at += step) {
                out[i] = static_cast<double>(samples[at]) == value ? 255 : 0;
            }
        },
        raster.samples);
    return matte;
}

Error no_channel(const std::string& path, const Raster& raster, const std::string& channel) {
    const std::string have = raster.colors() < 3 ? "grey only" : "R, G and B only";
    return unreadable(path, "it has no channel '" + channel + "'", "It has " + have + ".");
}

}  // namespace

Status check_picture_exists(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) return {};
    return fail(ErrorCode::kMissingFrames, "File " + path + " not found.",
                "Supply it, or correct the name.");
}

Expected<PlateFrame> read_image(const std::string& path, const std::string& layer) {
    WEFT_TRY(raster, read_raster(path, {layer, {}, false}));
    return to_plate(raster);
}

std::string channel_of_mattes(const std::vector<std::string>& paths) {
    constexpr std::size_t kMostLooks = 24;
    const std::size_t looks = std::min(paths.size(), kMostLooks);
    for (std::size_t k = 0; k < looks; ++k) {
        const auto raster = read_raster(paths[k * paths.size() / looks], {});
        if (!raster || !raster->has_alpha) return {};
        if (has_transparency(*raster)) return "A";
    }
    return looks > 0 ? "Y" : std::string();
}

std::optional<FoundPass> find_ids(const std::string& path, const std::vector<std::string>& beside) {
    const PassKind kIds{"id",
                        {"IndexOB", "IndexMA", "object_id", "objectid", "id"},
                        {{"X"}, {"V"}, {"Y"}, {"R"}},
                        {}};
    const auto layers = list_pass_layers(path);
    if (!layers || layers->size() < 2) return std::nullopt;
    return find_pass(*layers, kIds, {}, beside);
}

Expected<Matte> read_matte(const std::string& path, const MatteSelect& select, Size expected) {
    WEFT_CHECK_OK(check_picture_exists(path));
    if (has_movie_extension(path)) {
        return fail(ErrorCode::kUsage, path + " is a movie, and one picture is needed here.",
                    "Write the frame as a picture, such as matte.png, and give that.");
    }
    if (!select.crypto.empty()) {
        WEFT_TRY(objects, read_cryptomatte(path, select.crypto, expected));
        if (select.invert) invert_matte(objects);
        return objects;
    }
    const bool by_color = is_color_name(select.channel);
    RasterRequest request;
    request.raw_codes = select.value.has_value();
    if (!by_color) request.channel = select.channel;
    if (select.value && select.channel.empty()) choose_id_channel(path, request);
    WEFT_TRY(raster, read_raster(path, request));
    WEFT_CHECK_OK(check_plate_size(path, "it", raster.info.size, expected, "scale or crop it"));

    MatteChannels source;
    if (by_color && !raster.palette_indices) {
        const auto found = find_source(raster, select.channel);
        if (!found) return tl::unexpected(no_channel(path, raster, select.channel));
        source = *found;
    }
    Matte matte;
    if (select.value) {
        // Without a channel the ids are in the first one: luma would mix them, and an ID matte's
        // alpha only marks where there is any object.
        const int ids = select.channel.empty() ? 0 : source.channel;
        if (!has_whole_numbers(raster, ids)) {
            return fail(
                ErrorCode::kUsage,
                path +
                    " has no integer ids (its samples are fractions), so no value can be picked.",
                "Name the channel with the ids" + by({{setting::kMatteChannel}}) +
                    ", or leave the matte value out.");
        }
        matte = equal_to(raster, ids, *select.value);
    } else {
        matte = coverage(raster, source);
    }
    if (select.invert) invert_matte(matte);
    return matte;
}

}  // namespace weft
