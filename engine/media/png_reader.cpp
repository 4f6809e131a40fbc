#include "engine/media/png_reader.h"

#include <png.h>

#include <bit>
#include <cstdio>
#include <memory>
#include <new>
#include <utility>

#include "engine/media/raster_errors.h"

namespace weft {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// libpng leaves by calling the error handler, which must not return. An exception passes through
// its frames (Debian builds it with unwind tables) and, unlike longjmp, runs our destructors.
struct PngFailure {
    std::string reason;
};

[[noreturn]] void on_error(png_structp /*png*/, png_const_charp message) {
    throw PngFailure{message};
}
void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

class PngHandle {
  public:
    explicit PngHandle(std::FILE* file)
        : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)) {
        if (!png_) throw std::bad_alloc();
        info_ = png_create_info_struct(png_);
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_init_io(png_, file);
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
    [[nodiscard]] Size size() const {
        return {static_cast<int>(png_get_image_width(png_, info_)),
                static_cast<int>(png_get_image_height(png_, info_))};
    }
    [[nodiscard]] SampleKind kind() const {
        return png_get_bit_depth(png_, info_) == 16 ? SampleKind::kU16 : SampleKind::kU8;
    }

  private:
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

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

Expected<Raster> read_open(std::FILE* file, const std::string& path, bool raw_codes) {
    const PngHandle handle(file);
    png_read_info(handle.png(), handle.info());
    WEFT_CHECK_OK(check_memory(path, handle.size(), 4));
    Raster raster;
    raster.info = {handle.size(), handle.kind(), 0.0, handle.pixel_aspect()};
    raster.palette_indices =
        raw_codes && png_get_color_type(handle.png(), handle.info()) == PNG_COLOR_TYPE_PALETTE;
    set_transforms(handle, raw_codes);
    raster.channels = png_get_channels(handle.png(), handle.info());
    raster.has_alpha =
        (png_get_color_type(handle.png(), handle.info()) & PNG_COLOR_MASK_ALPHA) != 0;
    if (raster.info.kind == SampleKind::kU16) {
        raster.samples = read_rows<std::uint16_t>(handle, raster.channels);
    } else {
        raster.samples = read_rows<std::uint8_t>(handle, raster.channels);
    }
    return raster;
}

template <class F>
auto with_file(const std::string& path, const F& body) -> decltype(body(nullptr)) {
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        return tl::unexpected(unreadable(path, "it cannot be opened", "Check its permissions."));
    }
    try {
        return body(file.get());
    } catch (const PngFailure& failure) {
        return tl::unexpected(damaged(path, "PNG, " + failure.reason));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, path + " does not fit into memory.");
    }
}

}  // namespace

bool is_png(const std::string& path) {
    const File file(std::fopen(path.c_str(), "rb"));
    png_byte signature[8] = {};
    return file && std::fread(signature, 1, sizeof signature, file.get()) == sizeof signature &&
           png_sig_cmp(signature, 0, sizeof signature) == 0;
}

Expected<RasterInfo> probe_png(const std::string& path) {
    return with_file(path, [](std::FILE* file) -> Expected<RasterInfo> {
        const PngHandle handle(file);
        png_read_info(handle.png(), handle.info());
        return RasterInfo{handle.size(), handle.kind(), 0.0, handle.pixel_aspect()};
    });
}

Expected<Raster> read_png(const std::string& path, bool raw_codes) {
    return with_file(path, [&](std::FILE* file) { return read_open(file, path, raw_codes); });
}

}  // namespace weft
