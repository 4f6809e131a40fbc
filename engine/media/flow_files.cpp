#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "engine/core/input_file.h"
#include "engine/media/decode_limit.h"
#include "engine/media/encode.h"
#include "engine/media/image_files.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

static_assert(std::endian::native == std::endian::little, ".flo is read as it lies in memory");

constexpr float kFloMagic = 202021.25f;  // "PIEH" (Baker et al., Middlebury flow, 2007)
constexpr float kFloUnknown = 1e9f;      // larger magnitudes stand for unknown motion
constexpr float kKittiZero = 32768.0f;   // Menze & Geiger, KITTI 2015: code = d · 64 + 2^15
constexpr float kKittiStep = 64.0f;

Expected<FlowField> read_flo(const std::string& path, Size expected) {
    WEFT_TRY(bytes, read_file(path, {}, static_cast<std::uint64_t>(decode_limit_bytes())));
    struct Header {
        float magic;
        std::int32_t width, height;
    } header{};
    if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != kFloMagic || header.width < 1 || header.height < 1) {
        return tl::unexpected(damaged(path, "not a .flo file"));
    }
    const Size size{header.width, header.height};
    WEFT_CHECK_OK(check_plate_size(path, "it", size, expected, "use the plate's motion"));
    const std::size_t need = sizeof header + static_cast<std::size_t>(size.width) *
                                                 static_cast<std::size_t>(size.height) * 8;
    if (bytes.size() < need) return tl::unexpected(damaged(path, "the file ends early"));
    FlowField flow(size);
    std::memcpy(flow.d.data(), bytes.data() + sizeof header, need - sizeof header);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            float* const d = flow.d.pixel(x, y);
            // Written so that NaN counts as unknown.
            if (std::abs(d[0]) <= kFloUnknown && std::abs(d[1]) <= kFloUnknown) continue;
            d[0] = d[1] = 0.0f;
            flow.valid.at(x, y) = 0;
        }
    }
    return flow;
}

Expected<FlowField> read_kitti(const std::string& path, Size expected) {
    WEFT_TRY(raster, read_raster(path, {}));
    const auto* codes = std::get_if<std::vector<std::uint16_t>>(&raster.samples);
    if (!codes || raster.channels != 3) {
        return tl::unexpected(
            unreadable(path, "motion as a picture must be a 16-bit RGB PNG in the KITTI encoding",
                       "Write it so, or as .flo."));
    }
    WEFT_CHECK_OK(
        check_plate_size(path, "it", raster.info.size, expected, "use the plate's motion"));
    FlowField flow(raster.info.size);
    const std::uint16_t* in = codes->data();
    float* d = flow.d.data();
    std::uint8_t* valid = flow.valid.data();
    for (std::size_t i = 0; i < flow.valid.size_bytes(); ++i, in += 3, d += 2) {
        valid[i] = in[2] != 0 ? 255 : 0;
        d[0] = valid[i] ? (static_cast<float>(in[0]) - kKittiZero) / kKittiStep : 0.0f;
        d[1] = valid[i] ? (static_cast<float>(in[1]) - kKittiZero) / kKittiStep : 0.0f;
    }
    return flow;
}

}  // namespace

Expected<FlowField> read_flow(const std::string& path, Size expected) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return fail(ErrorCode::kMissingFrames, "Motion file " + path + " not found.",
                    "Supply it, or leave the frame out.");
    }
    if (path.ends_with(".flo") || path.ends_with(".FLO")) return read_flo(path, expected);
    return read_kitti(path, expected);
}

Status write_flow_kitti(const std::string& path, const FlowField& flow) {
    std::vector<std::uint16_t> codes(flow.valid.size_bytes() * 3, 0);
    const float* d = flow.d.data();
    const std::uint8_t* valid = flow.valid.data();
    for (std::size_t i = 0; i < flow.valid.size_bytes(); ++i) {
        const float u = std::floor(d[2 * i] * kKittiStep + kKittiZero + 0.5f);
        const float v = std::floor(d[2 * i + 1] * kKittiStep + kKittiZero + 0.5f);
        // Motion of 512 px and more does not fit the format and is marked as unknown.
        if (valid[i] == 0 || !(u >= 0 && u <= 65535 && v >= 0 && v <= 65535)) continue;
        codes[3 * i] = static_cast<std::uint16_t>(u);
        codes[3 * i + 1] = static_cast<std::uint16_t>(v);
        codes[3 * i + 2] = 1;
    }
    return write_samples(path, {flow.size(), 3, SampleKind::kU16, codes.data()}, {});
}

}  // namespace weft
