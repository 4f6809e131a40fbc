#include "engine/media/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/media/metadata.h"
#include "engine/media/png_format.h"

namespace weft {
namespace {

// Level 2 takes half as long again for files 3 % smaller (film frames, Sub and Up).
constexpr int kLevel = 1;
constexpr int kFilterBandRows = 32;

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;
using OwnedBytes = std::unique_ptr<unsigned char[]>;

// Completes a chunk whose data lie at `data` already. Returns its end.
unsigned char* seal_chunk(unsigned char* data, std::string_view name, std::size_t bytes) {
    put_big_endian_u32(data - kPngChunkHead, static_cast<std::uint32_t>(bytes));
    std::memcpy(data - name.size(), name.data(), name.size());
    unsigned char* const end = data + bytes;
    put_big_endian_u32(end, libdeflate_crc32(0, data - name.size(), name.size() + bytes));
    return end + kPngChunkTail;
}

void add_chunk(std::vector<unsigned char>& out, std::string_view name, std::string_view data) {
    const std::size_t at = out.size() + kPngChunkHead;
    out.resize(at + data.size() + kPngChunkTail);
    std::memcpy(out.data() + at, data.data(), data.size());
    seal_chunk(out.data() + at, name, data.size());
}

std::string four_bytes(std::uint32_t value) {
    unsigned char four[4];
    put_big_endian_u32(four, value);
    return {reinterpret_cast<const char*>(four), sizeof four};
}

// Everything in front of the pixels. The offset and the time, both 0, are part of every PNG that
// Weft has written.
std::vector<unsigned char> header(const PngShape& shape, const WriteOptions& options) {
    using std::string_view_literals::operator""sv;
    static constexpr std::array<char, 4> kColourTypes{0, 4, 2, 6};  // by channels
    std::vector<unsigned char> out(kPngSignature.begin(), kPngSignature.end());
    std::string about = four_bytes(static_cast<std::uint32_t>(shape.size.width)) +
                        four_bytes(static_cast<std::uint32_t>(shape.size.height));
    about += static_cast<char>(8 * shape.bytes_per_sample);
    about += kColourTypes[static_cast<std::size_t>(shape.channels - 1)];
    about += "\0\0\0"sv;  // compression, filters and interlacing: the only or the usual kind
    add_chunk(out, "IHDR", about);
    add_chunk(out, "oFFs", "\0\0\0\0\0\0\0\0\0"sv);
    // Pixels to the unit of length, across and down, the unit being unknown.
    constexpr float kAcross = 100;
    const double aspect = options.pixel_aspect.value_or(1);
    const float down = kAcross * static_cast<float>(aspect);
    if (aspect != 1 && down > 0) {
        add_chunk(out, "pHYs",
                  four_bytes(static_cast<std::uint32_t>(kAcross)) +
                      four_bytes(static_cast<std::uint32_t>(down)) + '\0');
    }
    add_chunk(out, "tIME", "\x07\xb2\1\1\0\0\0"sv);  // 1970-01-01, not the present time
    if (!options.metadata.empty()) {
        add_chunk(out, "tEXt", std::string("Software\0"sv) + software_text(options.metadata));
        add_chunk(out, "tEXt", std::string("Copyright\0"sv) + copyright_text(options.metadata));
    }
    return out;
}

// One row as it lies in the file. `scratch` holds it unless the samples have that form already.
const unsigned char* row_of(const Samples& samples, const PngShape& shape, int y,
                            std::vector<unsigned char>& scratch) {
    const std::size_t bytes = shape.row_bytes();
    const auto* from =
        static_cast<const unsigned char*>(samples.data) + static_cast<std::size_t>(y) * bytes;
    if (shape.bytes_per_sample == 1) return from;
    scratch.resize(bytes);
    const auto* wide =
        static_cast<const std::uint16_t*>(samples.data) + static_cast<std::size_t>(y) * bytes / 2;
    for (std::size_t i = 0; i < bytes / 2; ++i) {
        scratch[2 * i] = static_cast<unsigned char>(wide[i] >> 8);
        scratch[2 * i + 1] = static_cast<unsigned char>(wide[i]);
    }
    return scratch.data();
}

OwnedBytes filter(const Samples& samples, const PngShape& shape) {
    OwnedBytes out = std::make_unique_for_overwrite<unsigned char[]>(shape.filtered_bytes());
    const std::size_t bytes = shape.row_bytes();
    parallel_rows(shape.size.height, kFilterBandRows, [&](int y0, int y1) {
        std::vector<unsigned char> scratch, scratch_above;
        const unsigned char* above =
            y0 == 0 ? nullptr : row_of(samples, shape, y0 - 1, scratch_above);
        for (int y = y0; y < y1; ++y) {
            const unsigned char* const row = row_of(samples, shape, y, scratch);
            filter_png_row(row, above, bytes, shape.pixel_bytes(),
                           out.get() + static_cast<std::size_t>(y) * (bytes + 1));
            scratch.swap(scratch_above);
            above = row;
        }
    });
    return out;
}

// Makes chunks of the `bytes` at `data`, which moves the later ones. Returns the end of the last.
unsigned char* seal_pixels(unsigned char* data, std::size_t bytes, std::size_t largest) {
    constexpr std::size_t kFrame = kPngChunkHead + kPngChunkTail;
    const std::size_t chunks = (bytes + largest - 1) / largest;
    unsigned char* end = data;
    for (std::size_t k = chunks; k-- > 0;) {
        const std::size_t count = std::min(largest, bytes - k * largest);
        unsigned char* const place = data + k * (largest + kFrame);
        std::memmove(place, data + k * largest, count);
        unsigned char* const sealed = seal_chunk(place, "IDAT", count);
        if (k + 1 == chunks) end = sealed;
    }
    return end;
}

}  // namespace

EncodedFile encode_png(const Samples& samples, const WriteOptions& options,
                       std::size_t largest_chunk) {
    const PngShape shape{samples.size, samples.channels, samples.kind == SampleKind::kU16 ? 2 : 1};
    const std::vector<unsigned char> head = header(shape, options);
    const OwnedBytes filtered = filter(samples, shape);
    const Compressor compressor(libdeflate_alloc_compressor(kLevel));
    if (!compressor) throw std::bad_alloc();
    constexpr std::size_t kFrame = kPngChunkHead + kPngChunkTail;
    const std::size_t most =
        libdeflate_zlib_compress_bound(compressor.get(), shape.filtered_bytes());
    const std::size_t most_chunks = most / largest_chunk + 1;

    EncodedFile file;
    file.data = std::make_unique_for_overwrite<unsigned char[]>(head.size() + most +
                                                                (most_chunks + 1) * kFrame);
    std::memcpy(file.data.get(), head.data(), head.size());
    unsigned char* const pixels = file.data.get() + head.size() + kPngChunkHead;
    const std::size_t bytes = libdeflate_zlib_compress(compressor.get(), filtered.get(),
                                                       shape.filtered_bytes(), pixels, most);
    unsigned char* const end = seal_pixels(pixels, bytes, largest_chunk);
    file.size =
        static_cast<std::size_t>(seal_chunk(end + kPngChunkHead, "IEND", 0) - file.data.get());
    return file;
}

}  // namespace weft
