#include "engine/media/png_reader.h"

#include <png.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/input_file.h"
#include "engine/media/icc_profile.h"
#include "engine/media/orientation.h"
#include "engine/media/png_plain.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// libpng reports errors through a handler that must not return. An exception passes through its
// frames (Debian builds it with unwind tables) and, unlike longjmp, runs our destructors.
struct PngFailure {
    std::string reason;
};

[[noreturn]] void on_error(png_structp /*png*/, png_const_charp message) {
    throw PngFailure{message};
}
void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

// libpng's position in the file.
struct PngSource {
    const InputFile& file;
    std::uint64_t at = 0;
};

void on_read(png_structp png, png_bytep to, png_size_t count) {
    auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
    const auto got = source.file.read_at(source.at, to, count);
    if (!got || *got < count) throw PngFailure{"Read Error"};
    source.at += count;
}

// Chunks of PNG's third edition that libpng 1.6 does not know: coding-independent code points
// (11.3.2.6) and animation control (11.3.6.1).
constexpr png_byte kNewChunks[] = "cICP\0acTL";
constexpr const char *kCodingChunk = "cICP", *kAnimationChunk = "acTL";

// The chunk's bytes; empty without one of this name and size.
std::span<const png_byte> new_chunk(png_const_structp png, png_infop info, const char* name,
                                    std::size_t bytes) {
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(png, info, &chunks);
    for (int k = 0; k < count; ++k)
        if (std::memcmp(chunks[k].name, name, 4) == 0 && chunks[k].size == bytes)
            return {chunks[k].data, bytes};
    return {};
}

// The transfer's code point in H.273; empty without the chunk.
std::optional<int> transfer_of(png_const_structp png, png_infop info) {
    const auto coding = new_chunk(png, info, kCodingChunk, 4);
    if (coding.empty()) return std::nullopt;
    return coding[1];
}

// Other readers see an animation's first picture alone.
bool is_animated(png_const_structp png, png_infop info) {
    const auto control = new_chunk(png, info, kAnimationChunk, 8);
    return !control.empty() && png_get_uint_32(control.data()) > 1;
}

class PngHandle {
  public:
    explicit PngHandle(const InputFile& file)
        : source_{file},
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)) {
        if (!png_) throw std::bad_alloc();
        info_ = png_create_info_struct(png_);
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png_, &source_, on_read);
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_ALWAYS, kNewChunks, 2);
    }
    ~PngHandle() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngHandle(const PngHandle&) = delete;
    PngHandle& operator=(const PngHandle&) = delete;

    [[nodiscard]] png_structp png() const { return png_; }
    [[nodiscard]] png_infop info() const { return info_; }
    /// Width of a pixel over its height; 1 where the file does not say.
    [[nodiscard]] double pixel_aspect() const {
        png_uint_32 x = 0, y = 0;
        int unit = 0;
        if (!png_get_pHYs(png_, info_, &x, &y, &unit) || x == 0) return 1;
        return sane_pixel_aspect(static_cast<double>(y) / static_cast<double>(x));
    }
    [[nodiscard]] int orientation() const {
        png_bytep exif = nullptr;
        png_uint_32 bytes = 0;
        if (!png_get_eXIf_1(png_, info_, &bytes, &exif)) return 1;
        return orientation_of_exif(exif, bytes);
    }
    [[nodiscard]] FileColor color() const;
    [[nodiscard]] RasterInfo info_as_seen() const {
        const int turned = orientation();
        const double aspect = pixel_aspect();
        return {upright(size(), turned),
                kind(),
                0.0,
                lies_on_its_side(turned) ? 1 / aspect : aspect,
                color(),
                turned};
    }
    [[nodiscard]] Size size() const {
        return {static_cast<int>(png_get_image_width(png_, info_)),
                static_cast<int>(png_get_image_height(png_, info_))};
    }
    /// How the pixels lie in the file if that is all there is to know about them.
    [[nodiscard]] std::optional<PngShape> plain_shape() const {
        const int depth = png_get_bit_depth(png_, info_);
        if ((depth != 8 && depth != 16) ||
            png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE ||
            png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE ||
            png_get_valid(png_, info_, PNG_INFO_tRNS) != 0)
            return std::nullopt;
        return PngShape{size(), png_get_channels(png_, info_), depth / 8};
    }
    /// Where the first IDAT chunk begins, once png_read_info() has found it.
    [[nodiscard]] std::uint64_t first_pixels() const { return source_.at - kPngChunkHead; }
    [[nodiscard]] const InputFile& file() const { return source_.file; }
    [[nodiscard]] SampleKind kind() const {
        return png_get_bit_depth(png_, info_) == 16 ? SampleKind::kU16 : SampleKind::kU8;
    }

  private:
    PngSource source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

// The sRGB chunk has precedence, then a profile, then gAMA and cHRM (PNG 1.2, 11.3.3); before all
// of them cICP.
FileColor PngHandle::color() const {
    constexpr int kPq = 16, kHlg = 18;
    const auto transfer = transfer_of(png_, info_);
    if (transfer == kPq || transfer == kHlg) return {"srgb", "is an HDR picture (PQ or HLG)"};
    if (png_get_valid(png_, info_, PNG_INFO_sRGB) != 0) return {};
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    png_uint_32 bytes = 0;
    int compression = 0;
    if (png_get_iCCP(png_, info_, &name, &compression, &profile, &bytes) != 0)
        return color_of_profile(profile, bytes, "srgb");
    double gamma = 0;
    if (png_get_gAMA(png_, info_, &gamma) != 0) {
        if (auto note = note_of_gamma(gamma); !note.empty()) return {"srgb", note};
    }
    std::array<double, 8> xy{};
    if (png_get_cHRM(png_, info_, &xy[6], &xy[7], &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5]) ==
        0)
        return {};
    return {"srgb", note_of_primaries(xy)};
}

void set_transforms(const PngHandle& handle, bool raw_codes) {
    png_structp png = handle.png();
    if (raw_codes) {
        png_set_packing(png);
    } else {
        png_set_expand(png);  // palette to RGB, small depths to 8 bits, transparent colour to alpha
    }
    if (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, handle.info());
}

// The samples if the file is plain and sound.
template <class T>
std::optional<std::vector<T>> read_plain(const PngHandle& handle) {
    const auto shape = handle.plain_shape();
    if (!shape) return std::nullopt;
    std::vector<T> samples((shape->filtered_bytes() + sizeof(T) - 1) / sizeof(T));
    const std::span bytes(reinterpret_cast<unsigned char*>(samples.data()),
                          samples.size() * sizeof(T));
    if (!read_plain_png(handle.file(), handle.first_pixels(), *shape, bytes)) return std::nullopt;
    samples.resize(shape->row_bytes() * static_cast<std::size_t>(shape->size.height) / sizeof(T));
    if constexpr (sizeof(T) == 2 && std::endian::native == std::endian::little) {
        for (T& sample : samples)
            sample = static_cast<T>(sample << 8 | sample >> 8);
    }
    return samples;
}

template <class T>
std::vector<T> read_rows(const PngHandle& handle, int channels) {
    const Size size = handle.size();
    const std::size_t row =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels);
    std::vector<T> samples(row * static_cast<std::size_t>(size.height));
    std::vector<png_bytep> rows(static_cast<std::size_t>(size.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = reinterpret_cast<png_bytep>(samples.data() + y * row);
    }
    png_read_image(handle.png(), rows.data());
    png_read_end(handle.png(), nullptr);  // finds a file cut off behind its pixels
    return samples;
}

// libpng reads what is unusual, and says what is wrong with what is damaged.
template <class T>
void read_into(Raster& raster, const PngHandle& handle, bool raw_codes) {
    auto plain = read_plain<T>(handle);
    if (!plain) set_transforms(handle, raw_codes);
    raster.channels = png_get_channels(handle.png(), handle.info());
    raster.has_alpha =
        (png_get_color_type(handle.png(), handle.info()) & PNG_COLOR_MASK_ALPHA) != 0;
    raster.samples = upright(plain ? std::move(*plain) : read_rows<T>(handle, raster.channels),
                             handle.size(), raster.channels, raster.info.orientation);
}

Status read_header(const PngHandle& handle, const std::string& path) {
    png_read_info(handle.png(), handle.info());
    if (is_animated(handle.png(), handle.info())) return tl::unexpected(animated(path));
    return {};
}

Expected<Raster> read_open(const InputFile& file, const std::string& path, bool raw_codes) {
    const PngHandle handle(file);
    WEFT_CHECK_OK(read_header(handle, path));
    WEFT_CHECK_OK(check_memory(path, handle.size(), 4));
    Raster raster;
    raster.info = handle.info_as_seen();
    raster.palette_indices =
        raw_codes && png_get_color_type(handle.png(), handle.info()) == PNG_COLOR_TYPE_PALETTE;
    if (raster.info.kind == SampleKind::kU16) {
        read_into<std::uint16_t>(raster, handle, raw_codes);
    } else {
        read_into<std::uint8_t>(raster, handle, raw_codes);
    }
    return raster;
}

template <class F>
auto guarded_png(const std::string& path, const F& body) -> decltype(body()) {
    try {
        return body();
    } catch (const PngFailure& failure) {
        return tl::unexpected(damaged(path, "PNG, " + failure.reason));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, path + " does not fit into memory.");
    }
}

bool has_signature(const InputFile& file) {
    png_byte signature[8] = {};
    const auto got = file.read_at(0, signature, sizeof signature);
    return got && *got == sizeof signature && png_sig_cmp(signature, 0, sizeof signature) == 0;
}

}  // namespace

bool is_png(const std::string& path) {
    const auto file = InputFile::open(path);
    return file && has_signature(*file);
}

Expected<RasterInfo> probe_png(const InputFile& file, const std::string& path) {
    return guarded_png(path, [&]() -> Expected<RasterInfo> {
        const PngHandle handle(file);
        WEFT_CHECK_OK(read_header(handle, path));
        return handle.info_as_seen();
    });
}

Expected<RasterInfo> probe_png(const std::string& path) {
    WEFT_TRY(file, InputFile::open(path));
    return probe_png(file, path);
}

Expected<Raster> read_png(const InputFile& file, const std::string& path, bool raw_codes) {
    return guarded_png(path, [&] { return read_open(file, path, raw_codes); });
}

Expected<Raster> read_png(const std::string& path, bool raw_codes) {
    WEFT_TRY(file, InputFile::open(path));
    return read_png(file, path, raw_codes);
}

}  // namespace weft
