#include "engine/media/dpx_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "engine/core/input_file.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// SMPTE ST 268-1: the generic header, with room for eight image elements.
constexpr std::size_t kHeader_bytes = 2048;
constexpr std::size_t kElements_at = 770, kWidth_at = 772, kHeight_at = 776;
constexpr std::size_t kElement_at = 780, kElement_bytes = 72, kMostElements = 8;
constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
constexpr std::uint64_t kWord_bytes = 4;

class Header {
  public:
    Header(const std::array<unsigned char, kHeader_bytes>& bytes, bool little)
        : bytes_(bytes), little_(little) {}
    [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t count) const {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < count; ++i)
            value = value << 8 | bytes_[little_ ? at + count - 1 - i : at + i];
        return value;
    }

  private:
    const std::array<unsigned char, kHeader_bytes>& bytes_;
    bool little_;
};

// Samples per pixel, by the descriptor; 0: not supported here.
std::uint64_t samples_of(std::uint32_t descriptor) {
    if (descriptor >= 1 && descriptor <= 8) return 1;
    if (descriptor == 50) return 3;                         // RGB
    if (descriptor == 51 || descriptor == 52) return 4;     // RGBA, ABGR
    if (descriptor == 100) return 2;                        // CbYCrY
    return descriptor == 101 || descriptor == 102 ? 3 : 0;  // CbYACrYA, CbYCr
}

std::uint64_t line_bytes(std::uint64_t samples, std::uint32_t bits, std::uint32_t packing) {
    const bool filled = packing == 1 || packing == 2;
    if (bits == 10 && filled) return (samples + 2) / 3 * 4;  // three to a word of 32 bits
    if (bits == 12 && filled) return samples * 2;
    return (samples * bits + 7) / 8;
}

struct ElementEnd {
    std::uint64_t least = 0;  // of the pixels, in bytes; 0: unknown
    // If each line is filled to words of 32 bits without the header saying so; 0: if it is not, or
    // cannot be.
    std::uint64_t filled = 0;
};

ElementEnd end_of_element(const Header& header, std::size_t k) {
    const std::size_t at = kElement_at + k * kElement_bytes;
    const std::uint64_t samples = samples_of(header.number(at + 20, 1));
    const std::uint32_t bits = header.number(at + 23, 1), packing = header.number(at + 24, 2);
    const bool compressed = header.number(at + 26, 2) == 1;
    std::uint64_t offset = header.number(at + 28, 4);
    if (samples == 0 || bits == 0 || bits > 64 || compressed) return {};
    if (offset == 0 || offset == kUndefined) {
        if (k > 0) return {};
        offset = header.number(4, 4);
    }
    const std::uint64_t padding = header.number(at + 32, 4);
    const std::uint64_t width = header.number(kWidth_at, 4), height = header.number(kHeight_at, 4);
    // A side; beyond it the decoder reports the error.
    constexpr std::uint64_t kMostPixels = 1 << 20;
    if (width > kMostPixels || height > kMostPixels) return {};
    const std::uint64_t line = line_bytes(width * samples, bits, packing);
    const bool padded = padding != kUndefined && padding < line;
    const std::uint64_t pad = padded ? padding : 0;
    ElementEnd out{offset + height * line + (height > 0 ? (height - 1) * pad : 0)};
    if (pad == 0 && line % kWord_bytes != 0)
        out.filled = offset + height * ((line + kWord_bytes - 1) / kWord_bytes * kWord_bytes);
    return out;
}

}  // namespace

Status check_dpx_layout(const std::string& path) {
    WEFT_TRY(file, InputFile::open(path));
    std::array<unsigned char, kHeader_bytes> bytes{};
    WEFT_TRY(count, file.read_at(0, bytes.data(), bytes.size()));
    const std::string_view magic(reinterpret_cast<const char*>(bytes.data()), 4);
    if (magic != "SDPX" && magic != "XPDS") return {};
    const Header header(bytes, magic == "XPDS");
    std::uint64_t needed = kHeader_bytes;
    const std::size_t elements = header.number(kElements_at, 2);
    bool filled = false;
    for (std::size_t k = 0; k < elements && k < kMostElements; ++k) {
        const ElementEnd end = end_of_element(header, k);
        needed = std::max(needed, end.least);
        filled = filled || (end.filled > 0 && end.filled == file.bytes());
    }
    if (count < bytes.size() || file.bytes() < needed) {
        return tl::unexpected(damaged(path, "it has " + std::to_string(file.bytes()) +
                                                " bytes, but its header and pixels take " +
                                                std::to_string(needed)));
    }
    if (!filled) return {};
    return tl::unexpected(
        unreadable(path, "its lines are filled to four bytes, which its header does not say",
                   "Convert it to a DPX of 10 bits, an EXR or a PNG (ffmpeg, which writes such "
                   "files, reads them)."));
}

}  // namespace weft
