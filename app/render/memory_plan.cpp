#include "app/render/memory_plan.h"

#include "engine/core/setting.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <string>

#include "engine/core/text.h"

namespace weft {
namespace {

// Fitted to peaks of 3840x2160 renders at final quality with a region over 41 % of the frame: 1.25
// GB with one frame at a time, 1.54 with two, 2.53 with four (measured with one heap per thread;
// see main.cpp). A constant part (program, libraries, texture planes, and 160 MB that a plane's
// finer levels take at most: by their size, they are not in those peaks), a part per pixel of the
// shot (analysis of the frames in hand), and a part per pixel of each frame rendered in parallel
// (working plate, canvas, texture, old surface, output, mattes).
constexpr std::int64_t kProgramBytes = 380ll << 20;
constexpr std::int64_t kShotBytesPerPixel = 70;
constexpr std::int64_t kFrameBytesPerPixel = 55;
// Additional memory of a frame's layers: images, samples by channel, and rows packed for the file;
// 60 of it for those of the form, and 60 for texture and finish, if they are asked for.
constexpr std::int64_t kLayersBytesPerPixel = 310;

std::int64_t frame_bytes_per_pixel(bool layers) {
    return kFrameBytesPerPixel + (layers ? kLayersBytesPerPixel : 0);
}

}  // namespace

Expected<std::size_t> frames_at_once(Size size, std::int64_t memory_bytes, bool layers) {
    if (memory_bytes <= 0) return std::numeric_limits<std::size_t>::max();
    const std::int64_t pixels = static_cast<std::int64_t>(size.width) * size.height;
    const std::int64_t shot = kProgramBytes + kShotBytesPerPixel * pixels;
    const std::int64_t frame = frame_bytes_per_pixel(layers) * pixels;
    const auto cache = memory_bytes / static_cast<std::int64_t>(kCacheShare);
    const std::int64_t fits = (memory_bytes - cache - shot) / frame;
    if (fits >= 1) return static_cast<std::size_t>(fits);
    const std::int64_t needed_mib = (((shot + frame) * 8 / 7) >> 20) + 1;
    return fail(ErrorCode::kNoSpace,
                "A frame of " + size_text(size) + " does not fit into the memory limit.",
                "Allow at least " + std::to_string(needed_mib) + "M" + by({{setting::kMemory}}) +
                    (layers ? ", or render without layers." : ", or render at a smaller size."));
}

std::int64_t render_memory_bytes(Size size, std::size_t side_by_side, bool layers) {
    const std::int64_t pixels = static_cast<std::int64_t>(size.width) * size.height;
    return kProgramBytes + kShotBytesPerPixel * pixels +
           frame_bytes_per_pixel(layers) * pixels * static_cast<std::int64_t>(side_by_side);
}

Expected<std::int64_t> parse_bytes(std::string_view text) {
    const auto wrong = [&] {
        return fail(ErrorCode::kUsage, "'" + std::string(text) + "' is not an amount of memory.",
                    "Write it like 3G or 800M.");
    };
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !(number >= 0)) return wrong();
    std::string unit(stop, text.data() + text.size());
    std::transform(unit.begin(), unit.end(), unit.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::size_t power = unit.empty() ? 0 : std::string_view("KMGT").find(unit[0]) + 1;
    const bool known =
        unit.empty() ||
        (power > 0 && (unit.size() == 1 || unit.substr(1) == "B" || unit.substr(1) == "IB"));
    for (std::size_t k = 0; known && k < power; ++k)
        number *= 1024;
    constexpr double kLargest = 1e15;
    if (!known || number > kLargest) return wrong();
    return static_cast<std::int64_t>(number);
}

}  // namespace weft
