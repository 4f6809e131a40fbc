#include <zip.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "engine/core/text.h"
#include "engine/media/atomic_file.h"
#include "engine/media/open_raster.h"
#include "engine/media/open_raster_reader.h"
#include "engine/media/png_writer.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

constexpr int kThumbnail_px = 256;  // at most, by the specification

struct DiscardZip {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FreeZipSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};

// A picture of straight colours with alpha.
struct Picture {
    ImageF3 rgb;
    ImageF1 alpha;
};

std::uint8_t sample_of(float v) {
    return v > 0 ? static_cast<std::uint8_t>(std::lround(std::min(v, 1.0f) * 255.0f))
                 : std::uint8_t{0};
}

EncodedFile png_of(ViewF3 rgb, ViewF1 alpha, const WriteOptions& options) {
    std::vector<std::uint8_t> samples;
    samples.reserve(4 * static_cast<std::size_t>(rgb.width()) *
                    static_cast<std::size_t>(rgb.height()));
    for (int y = 0; y < rgb.height(); ++y) {
        for (int x = 0; x < rgb.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                samples.push_back(sample_of(rgb.pixel(x, y)[c]));
            samples.push_back(alpha.empty() ? std::uint8_t{255} : sample_of(alpha.pixel(x, y)[0]));
        }
    }
    WriteOptions png = options;
    png.depth = PixelDepth::kU8;
    return encode_png({rgb.size(), 4, SampleKind::kU8, samples.data()}, png);
}

// The visible layers over each other, in their encoded colours as programs do it.
Picture merged(const std::vector<OpenRasterLayer>& layers) {
    const Size size = layers.front().rgb.size();
    Picture out{ImageF3(size), ImageF1(size)};
    for (const OpenRasterLayer& layer : layers) {
        if (!layer.visible) continue;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float over = layer.alpha.empty() ? 1.0f : layer.alpha.pixel(x, y)[0];
                float& alpha = out.alpha.at(x, y);
                const float under = alpha * (1 - over), sum = over + under;
                for (int c = 0; c < 3 && sum > 0; ++c) {
                    float& to = out.rgb.pixel(x, y)[c];
                    to = (over * layer.rgb.pixel(x, y)[c] + under * to) / sum;
                }
                alpha = sum;
            }
        }
    }
    return out;
}

Picture thumbnail_of(const Picture& picture) {
    const Size size = picture.rgb.size();
    const int step =
        std::max(1, (std::max(size.width, size.height) + kThumbnail_px - 1) / kThumbnail_px);
    Picture out{ImageF3(std::max(1, size.width / step), std::max(1, size.height / step)),
                ImageF1(std::max(1, size.width / step), std::max(1, size.height / step))};
    for (int y = 0; y < out.rgb.height(); ++y) {
        for (int x = 0; x < out.rgb.width(); ++x) {
            const int u = std::min(size.width - 1, x * step + step / 2);
            const int v = std::min(size.height - 1, y * step + step / 2);
            std::copy_n(picture.rgb.pixel(u, v), 3, out.rgb.pixel(x, y));
            out.alpha.at(x, y) = picture.alpha.at(u, v);
        }
    }
    return out;
}

std::string file_of_layer(std::size_t k) {
    return "data/layer" + std::to_string(k) + ".png";
}

// The top layer comes first.
std::string stack_xml(const std::vector<OpenRasterLayer>& layers) {
    const Size size = layers.front().rgb.size();
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<image version=\"0.0.5\" w=\"" +
                      std::to_string(size.width) + "\" h=\"" + std::to_string(size.height) +
                      "\">\n  <stack>\n";
    for (std::size_t k = layers.size(); k-- > 0;) {
        out += "    <layer name=\"" + xml_text(layers[k].name) + "\" src=\"" + file_of_layer(k) +
               "\" x=\"0\" y=\"0\" opacity=\"1.0\" composite-op=\"svg:src-over\" visibility=\"" +
               (layers[k].visible ? "visible" : "hidden") + "\"/>\n";
    }
    return out + "  </stack>\n</image>\n";
}

// An archive in memory.
class ZipWriter {
  public:
    ZipWriter() {
        zip_error_init(&error_);
        source_.reset(zip_source_buffer_create(nullptr, 0, 0, &error_));
        if (!source_) return;
        zip_source_keep(source_.get());
        archive_.reset(zip_open_from_source(source_.get(), ZIP_TRUNCATE, &error_));
    }
    ~ZipWriter() { zip_error_fini(&error_); }
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;

    /// `bytes` must live until finish(). Stored as they are: PNG is compressed already, and the
    /// first entry, which names the kind of file, has to be.
    void add(const std::string& name, std::span<const std::byte> bytes) {
        if (!archive_) return;
        zip_source_t* from = zip_source_buffer(archive_.get(), bytes.data(), bytes.size(), 0);
        const zip_int64_t at = zip_file_add(archive_.get(), name.c_str(), from, ZIP_FL_ENC_UTF_8);
        if (at < 0) {
            zip_source_free(from);
            failed_ = true;
            return;
        }
        const auto index = static_cast<zip_uint64_t>(at);
        constexpr zip_uint16_t kDay = 33;  // 1 January 1980: the same bytes at any time
        failed_ = failed_ ||
                  zip_set_file_compression(archive_.get(), index, ZIP_CM_STORE, 0) != 0 ||
                  zip_file_set_dostime(archive_.get(), index, 0, kDay, 0) != 0;
    }

    /// Errors: RenderFailed.
    [[nodiscard]] Expected<std::string> finish(const std::string& path) {
        const auto broken = [&] {
            return fail(ErrorCode::kRenderFailed, path + " cannot be packed: libzip failed.");
        };
        if (!archive_ || failed_ || zip_close(archive_.get()) != 0) return broken();
        static_cast<void>(archive_.release());  // zip_close() freed it
        zip_stat_t stat;
        zip_stat_init(&stat);
        if (zip_source_stat(source_.get(), &stat) != 0 || zip_source_open(source_.get()) != 0)
            return broken();
        std::string out(stat.size, '\0');
        const zip_int64_t got = zip_source_read(source_.get(), out.data(), out.size());
        zip_source_close(source_.get());
        if (got != static_cast<zip_int64_t>(out.size())) return broken();
        return out;
    }

  private:
    zip_error_t error_{};
    std::unique_ptr<zip_source_t, FreeZipSource> source_;
    std::unique_ptr<zip_t, DiscardZip> archive_;
    bool failed_ = false;
};

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

Expected<std::string> packed(const std::string& path, const std::vector<OpenRasterLayer>& layers,
                             const WriteOptions& options) {
    std::vector<EncodedFile> pictures;
    pictures.reserve(layers.size());
    for (const OpenRasterLayer& layer : layers)
        pictures.push_back(png_of(layer.rgb, layer.alpha, options));
    const Picture all = merged(layers), small = thumbnail_of(all);
    const EncodedFile whole = png_of(all.rgb, all.alpha, options);
    const EncodedFile thumbnail = png_of(small.rgb, small.alpha, options);
    const std::string stack = stack_xml(layers);
    ZipWriter zip;
    zip.add("mimetype", bytes_of("image/openraster"));
    zip.add("stack.xml", bytes_of(stack));
    for (std::size_t k = 0; k < pictures.size(); ++k)
        zip.add(file_of_layer(k), pictures[k].bytes());
    zip.add("mergedimage.png", whole.bytes());
    zip.add("Thumbnails/thumbnail.png", thumbnail.bytes());
    return zip.finish(path);
}

}  // namespace

Status write_open_raster(const std::string& path, const std::vector<OpenRasterLayer>& layers,
                         const WriteOptions& options) {
    for (const OpenRasterLayer& layer : layers) {
        if (layer.rgb.empty() || layer.rgb.size() != layers.front().rgb.size())
            return fail(ErrorCode::kUsage, path + ": the layers are empty or differ in size.");
    }
    if (layers.empty()) return fail(ErrorCode::kUsage, path + ": there is no layer.");
    return guarded(path, [&]() -> Status {
        WEFT_TRY(bytes, packed(path, layers, options));
        WEFT_TRY(temporary, TemporaryFile::create(path, options.rule));
        WEFT_CHECK_OK(temporary.write(bytes_of(bytes)));
        auto seen = probe_layered(temporary.name());
        if (!seen || seen->size != layers.front().rgb.size())
            return fail(ErrorCode::kRenderFailed,
                        path + " was not written, because the new file cannot be opened.");
        return temporary.commit();
    });
}

}  // namespace weft
