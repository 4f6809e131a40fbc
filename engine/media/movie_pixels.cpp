#include "engine/media/movie_pixels.h"

extern "C" {
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBandRows = 16;

float unit(float v) {
    return v > 0.0f ? std::min(v, 1.0f) : 0.0f;  // NaN becomes 0
}

std::uint8_t code(float v) {
    return static_cast<std::uint8_t>(v + 0.5f);
}

// Rec. ITU-R BT.709-6, 3.2-3.4: Y' = 0.2126 R' + 0.7152 G' + 0.0722 B', Cb = (B' - Y') / 1.8556,
// Cr = (R' - Y') / 1.5748; 8-bit codes 16 + 219 Y', 128 + 224 Cb, 128 + 224 Cr.
struct Ycc {
    float y, cb, cr;
};
Ycc bt709(const float* rgb) {
    const float r = unit(rgb[0]), g = unit(rgb[1]), b = unit(rgb[2]);
    const float y = luma_709(r, g, b);
    return {y, (b - y) / 1.8556f, (r - y) / 1.5748f};
}

// One row of luma codes, and its chroma before rounding, at the positions of the even columns.
void luma_row(const float* rgb, int width, std::uint8_t* luma, int coded_width,
              std::vector<Ycc>& pixels, std::vector<Ycc>& chroma) {
    for (int x = 0; x < coded_width; ++x) {
        pixels[static_cast<std::size_t>(x)] =
            bt709(rgb + static_cast<std::ptrdiff_t>(std::min(x, width - 1)) * 3);
        luma[x] = code(16.0f + 219.0f * pixels[static_cast<std::size_t>(x)].y);
    }
    for (std::size_t x = 0; x < chroma.size(); ++x) {
        // Chroma is sited on the even columns, so the low pass is centred there.
        const Ycc &l = pixels[x == 0 ? 0 : 2 * x - 1], &m = pixels[2 * x], &r = pixels[2 * x + 1];
        chroma[x].cb = 0.25f * (l.cb + r.cb) + 0.5f * m.cb;
        chroma[x].cr = 0.25f * (l.cr + r.cr) + 0.5f * m.cr;
    }
}

}  // namespace

void fill_yuv420_bt709(ViewF3 display_rgb, AVFrame& frame) {
    const int width = frame.width, chroma_width = width / 2;
    parallel_rows(frame.height / 2, kBandRows, [&](int y0, int y1) {
        std::vector<Ycc> pixels(static_cast<std::size_t>(width));
        std::array<std::vector<Ycc>, 2> chroma;
        chroma.fill(std::vector<Ycc>(static_cast<std::size_t>(chroma_width)));
        for (int y = y0; y < y1; ++y) {
            for (int half = 0; half < 2; ++half) {
                const int row = 2 * y + half;
                luma_row(display_rgb.row(std::min(row, display_rgb.height() - 1)),
                         display_rgb.width(),
                         frame.data[0] + static_cast<std::ptrdiff_t>(row) * frame.linesize[0],
                         width, pixels, chroma[static_cast<std::size_t>(half)]);
            }
            auto* cb = frame.data[1] + static_cast<std::ptrdiff_t>(y) * frame.linesize[1];
            auto* cr = frame.data[2] + static_cast<std::ptrdiff_t>(y) * frame.linesize[2];
            for (std::size_t x = 0; x < chroma[0].size(); ++x) {
                cb[x] = code(128.0f + 112.0f * (chroma[0][x].cb + chroma[1][x].cb));
                cr[x] = code(128.0f + 112.0f * (chroma[0][x].cr + chroma[1][x].cr));
            }
        }
    });
}

void fill_bgr0(ViewF3 display_rgb, AVFrame& frame) {
    parallel_rows(frame.height, kBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const float* in = display_rgb.row(y);
            auto* out = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
            for (int x = 0; x < frame.width; ++x, in += 3, out += 4) {
                for (int c = 0; c < 3; ++c)
                    out[c] = code(255.0f * unit(in[2 - c]));
                out[3] = 0;
            }
        }
    });
}

// ---- decoded frames to RGB -------------------------------------------------------------------

enum class MovieMatrix { kRgb, kBt601, kBt709, kSmpte240m, kFcc, kBt2020 };

namespace {

MovieMatrix matrix_of(const AVFrame& frame) {
    const AVPixFmtDescriptor* format =
        av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    if (format && (format->flags & AV_PIX_FMT_FLAG_RGB)) return MovieMatrix::kRgb;
    switch (frame.colorspace) {
        case AVCOL_SPC_BT709:
            return MovieMatrix::kBt709;
        case AVCOL_SPC_BT470BG:
        case AVCOL_SPC_SMPTE170M:
            return MovieMatrix::kBt601;
        case AVCOL_SPC_SMPTE240M:
            return MovieMatrix::kSmpte240m;
        case AVCOL_SPC_FCC:
            return MovieMatrix::kFcc;
        case AVCOL_SPC_BT2020_NCL:
        case AVCOL_SPC_BT2020_CL:
            return MovieMatrix::kBt2020;
        default:
            return frame.width > 1024 || frame.height > 576 ? MovieMatrix::kBt709
                                                            : MovieMatrix::kBt601;
    }
}

}  // namespace

struct MovieConverter::Setup {
    int width = 0, height = 0;
    AVPixelFormat from = AV_PIX_FMT_NONE, to = AV_PIX_FMT_NONE;
    MovieMatrix matrix = MovieMatrix::kRgb;
    bool full_range = false;
    AVChromaLocation chroma = AVCHROMA_LOC_UNSPECIFIED;
    bool operator==(const Setup&) const = default;
};

namespace {

bool is_deep(const AVPixFmtDescriptor& format) {
    return std::any_of(format.comp, format.comp + format.nb_components,
                       [](const AVComponentDescriptor& c) { return c.depth > 8; });
}

// A palette's alpha is ignored, as in picture files.
bool has_alpha(const AVPixFmtDescriptor& format) {
    return (format.flags & AV_PIX_FMT_FLAG_ALPHA) && !(format.flags & AV_PIX_FMT_FLAG_PAL);
}

bool is_full_range(const AVFrame& frame, const AVPixFmtDescriptor& format) {
    switch (frame.format) {
        case AV_PIX_FMT_YUVJ411P:
        case AV_PIX_FMT_YUVJ420P:
        case AV_PIX_FMT_YUVJ422P:
        case AV_PIX_FMT_YUVJ440P:
        case AV_PIX_FMT_YUVJ444P:
            return true;
        default:
            break;
    }
    // Untagged grey comes from pictures.
    const bool grey = format.nb_components <= 2;
    return grey ? frame.color_range != AVCOL_RANGE_MPEG : frame.color_range == AVCOL_RANGE_JPEG;
}

// Not Y'CbCr: swscale gives RGB codes of these, which takes no more than moving bytes.
bool is_rgb(AVPixelFormat from, const AVPixFmtDescriptor& format) {
    return (format.flags & AV_PIX_FMT_FLAG_RGB) != 0 || from == AV_PIX_FMT_PAL8 ||
           from == AV_PIX_FMT_XYZ12LE || from == AV_PIX_FMT_XYZ12BE;
}

AVPixelFormat working_format(AVPixelFormat from, const AVPixFmtDescriptor& format) {
    const bool alpha = has_alpha(format);
    if (!is_rgb(from, format)) return alpha ? AV_PIX_FMT_YUVA444P16 : AV_PIX_FMT_YUV444P16;
    if (is_deep(format)) return alpha ? AV_PIX_FMT_RGBA64 : AV_PIX_FMT_RGB48;
    return alpha ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24;
}

// The weights of red and blue in luma.
struct Luma {
    float r, b;
};
Luma luma_weights(MovieMatrix matrix) {
    switch (matrix) {
        case MovieMatrix::kBt709:
            return {0.2126f, 0.0722f};
        case MovieMatrix::kSmpte240m:
            return {0.212f, 0.087f};
        case MovieMatrix::kFcc:
            return {0.30f, 0.11f};
        case MovieMatrix::kBt2020:
            return {0.2627f, 0.0593f};
        default:
            return {0.299f, 0.114f};
    }
}

// From 16-bit words whose upper `bits` are the codes to values in [0, 1]: value = word·gain +
// offset. Rec. ITU-R BT.601-7 2.5 and BT.2020-2 4: n bits are 2^(n-8) times the codes of 8.
struct Levels {
    float luma_gain, luma_offset, chroma_gain;  // chroma: (word - 32768)·gain
    float alpha_gain;  // of the code itself: swscale fills the lower bits as it likes
    int alpha_shift;
    Levels(int bits, bool full_range) {
        const float codes = static_cast<float>(1 << bits) / 65536.0f;
        const float unit = static_cast<float>(1 << (bits - 8));
        const float full = static_cast<float>((1 << bits) - 1);
        alpha_gain = 1.0f / full;
        alpha_shift = 16 - bits;
        luma_gain = codes / (full_range ? full : 219.0f * unit);
        luma_offset = full_range ? 0.0f : -16.0f / 219.0f;
        chroma_gain = codes / (full_range ? full : 224.0f * unit);
    }
};

// The inverse of R' = Y' + (2 - 2 Kr) Cr, B' = Y' + (2 - 2 Kb) Cb, Y' = Kr R' + Kg G' + Kb B', in
// float and rounded once: swscale's own integers are up to 3 codes of 10 bits off in blue.
template <class T>
std::vector<T> rgb_from_ycc(const AVFrame& ycc, Luma weights, const Levels& levels, bool alpha) {
    constexpr auto kMax = static_cast<float>(std::numeric_limits<T>::max());
    const float red = 2.0f - 2.0f * weights.r, blue = 2.0f - 2.0f * weights.b;
    const float green = 1.0f - weights.r - weights.b;
    const float green_cr = weights.r * red / green, green_cb = weights.b * blue / green;
    const int channels = alpha ? 4 : 3;
    const std::ptrdiff_t row_samples = static_cast<std::ptrdiff_t>(ycc.width) * channels;
    std::vector<T> samples(static_cast<std::size_t>(row_samples * ycc.height));
    const auto code_of = [](float v) { return static_cast<T>(unit(v) * kMax + 0.5f); };
    parallel_rows(ycc.height, kBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const auto plane = [&](int i) {
                return reinterpret_cast<const std::uint16_t*>(
                    ycc.data[i] + static_cast<std::ptrdiff_t>(y) * ycc.linesize[i]);
            };
            const std::uint16_t *in_y = plane(0), *in_cb = plane(1), *in_cr = plane(2);
            const std::uint16_t* in_a = alpha ? plane(3) : nullptr;
            T* out = samples.data() + y * row_samples;
            for (int x = 0; x < ycc.width; ++x, out += channels) {
                const float luma = in_y[x] * levels.luma_gain + levels.luma_offset;
                const float cb = (static_cast<float>(in_cb[x]) - 32768.0f) * levels.chroma_gain;
                const float cr = (static_cast<float>(in_cr[x]) - 32768.0f) * levels.chroma_gain;
                out[0] = code_of(luma + red * cr);
                out[1] = code_of(luma - green_cb * cb - green_cr * cr);
                out[2] = code_of(luma + blue * cb);
                if (alpha)
                    out[3] = code_of(static_cast<float>(in_a[x] >> levels.alpha_shift) *
                                     levels.alpha_gain);
            }
        }
    });
    return samples;
}

// Position of chroma in 1/256 of a luma pixel from the first one's centre; only for the directions
// in which there is less chroma than luma.
void set_chroma_position(SwsContext* scaler, const AVPixFmtDescriptor& format,
                         AVChromaLocation chroma) {
    constexpr int kBetween = 128, kNext = 256;
    const bool centre = chroma == AVCHROMA_LOC_CENTER || chroma == AVCHROMA_LOC_TOP ||
                        chroma == AVCHROMA_LOC_BOTTOM;
    const bool top = chroma == AVCHROMA_LOC_TOPLEFT || chroma == AVCHROMA_LOC_TOP;
    const bool bottom = chroma == AVCHROMA_LOC_BOTTOMLEFT || chroma == AVCHROMA_LOC_BOTTOM;
    if (format.log2_chroma_w == 1) {
        av_opt_set_int(scaler, "src_h_chr_pos", centre ? kBetween : 0, 0);
    }
    if (format.log2_chroma_h == 1) {
        av_opt_set_int(scaler, "src_v_chr_pos", top ? 0 : bottom ? kNext : kBetween, 0);
    }
}

template <class T>
std::vector<T> packed(const AVFrame& rgb, int channels) {
    const std::ptrdiff_t row_samples = static_cast<std::ptrdiff_t>(rgb.width) * channels;
    std::vector<T> samples(static_cast<std::size_t>(row_samples * rgb.height));
    for (std::ptrdiff_t y = 0; y < rgb.height; ++y) {
        const auto* in = reinterpret_cast<const T*>(rgb.data[0] + y * rgb.linesize[0]);
        std::copy(in, in + row_samples, samples.data() + y * row_samples);
    }
    return samples;
}

// Turns a picture of w×h pixels clockwise: the one at (x, y) goes to `first + x·along + y·down`.
template <class T>
std::vector<T> turned(const std::vector<T>& samples, std::ptrdiff_t w, std::ptrdiff_t h,
                      int channels, int rotation_deg) {
    std::ptrdiff_t first = w * h - 1, along = -1, down = -w;
    if (rotation_deg == 90) first = h - 1, along = h, down = -1;
    if (rotation_deg == 270) first = (w - 1) * h, along = -h, down = 1;
    std::vector<T> out(samples.size());
    const T* in = samples.data();
    for (std::ptrdiff_t y = 0; y < h; ++y) {
        for (std::ptrdiff_t x = 0; x < w; ++x, in += channels)
            std::copy(in, in + channels, out.data() + (first + x * along + y * down) * channels);
    }
    return out;
}

}  // namespace

void MovieConverter::FreeScaler::operator()(SwsContext* scaler) const {
    sws_freeContext(scaler);
}

MovieConverter::MovieConverter() = default;
MovieConverter::~MovieConverter() = default;

bool MovieConverter::prepare(const AVFrame& frame) {
    const auto from = static_cast<AVPixelFormat>(frame.format);
    const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(from);
    if (!format || !sws_isSupportedInput(from)) return false;
    const AVPixelFormat to = working_format(from, *format);
    const Setup setup{frame.width,
                      frame.height,
                      from,
                      to,
                      matrix_of(frame),
                      is_full_range(frame, *format),
                      frame.chroma_location};
    if (scaler_ && setup_ && *setup_ == setup) return true;

    scaler_.reset(sws_alloc_context());
    working_.reset(av_frame_alloc());
    if (!scaler_ || !working_) return false;
    SwsContext* s = scaler_.get();
    av_opt_set_int(s, "srcw", frame.width, 0);
    av_opt_set_int(s, "srch", frame.height, 0);
    av_opt_set_int(s, "src_format", from, 0);
    av_opt_set_int(s, "dstw", frame.width, 0);
    av_opt_set_int(s, "dsth", frame.height, 0);
    av_opt_set_int(s, "dst_format", to, 0);
    // Without these flags the fast paths round down; the last one gives every machine the same
    // codes.
    av_opt_set_int(
        s, "sws_flags",
        SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT, 0);
    const bool rgb = is_rgb(from, *format);
    if (!rgb) set_chroma_position(s, *format, setup.chroma);
    if (sws_init_context(s, nullptr, nullptr) < 0) return false;
    // Y'CbCr keeps its codes, whatever the range, and only chroma is brought to luma's size: said
    // to be limited on both sides, they are shifted; full ones would be stretched on some paths.
    const int* matrix = sws_getCoefficients(SWS_CS_DEFAULT);
    sws_setColorspaceDetails(s, matrix, rgb, matrix, rgb, 0, 1 << 16, 1 << 16);
    working_->format = to;
    working_->width = frame.width;
    working_->height = frame.height;
    if (av_frame_get_buffer(working_.get(), 0) < 0) return false;
    setup_ = std::make_unique<Setup>(setup);
    return true;
}

std::shared_ptr<const Raster> MovieConverter::convert(const AVFrame& frame, int rotation_deg) {
    if (!prepare(frame)) {
        setup_.reset();
        return nullptr;
    }
    if (sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, working_->data,
                  working_->linesize) != frame.height) {
        return nullptr;
    }
    const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(setup_->from);
    auto raster = std::make_shared<Raster>();
    raster->has_alpha = has_alpha(format);
    raster->channels = raster->has_alpha ? 4 : 3;
    raster->info.kind = is_deep(format) ? SampleKind::kU16 : SampleKind::kU8;
    raster->info.size =
        rotation_deg % 180 == 0 ? Size{frame.width, frame.height} : Size{frame.height, frame.width};
    const auto fill = [&](auto zero) {
        using T = decltype(zero);
        std::vector<T> samples =
            is_rgb(setup_->from, format)
                ? packed<T>(*working_, raster->channels)
                : rgb_from_ycc<T>(
                      *working_, luma_weights(setup_->matrix),
                      Levels(std::clamp(format.comp[0].depth, 8, 16), setup_->full_range),
                      raster->has_alpha);
        if (rotation_deg != 0) {
            samples = turned(samples, frame.width, frame.height, raster->channels, rotation_deg);
        }
        raster->samples = std::move(samples);
    };
    if (is_deep(format)) {
        fill(std::uint16_t{0});
    } else {
        fill(std::uint8_t{0});
    }
    return raster;
}

}  // namespace weft
