#include "engine/media/frame_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/media/encode.h"

namespace weft {
namespace {

enum class Format { kPng, kJpeg, kTiff, kExr, kDpx, kUnknown };

constexpr int kCodeBandRows = 32;
constexpr float kLargestHalf = 65504.0f;

Format format_of(const std::string& path) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension == ".png") return Format::kPng;
    if (extension == ".jpg" || extension == ".jpeg") return Format::kJpeg;
    if (extension == ".tif" || extension == ".tiff") return Format::kTiff;
    if (extension == ".exr") return Format::kExr;
    if (extension == ".dpx") return Format::kDpx;
    return Format::kUnknown;
}

struct FormatFacts {
    const char* name;
    const char* depths;  // in words, for messages
    bool u8, u16, half, full;
};

FormatFacts facts_of(Format format) {
    switch (format) {
        case Format::kPng:
            return {"PNG", "8 or 16 bits", true, true, false, false};
        case Format::kJpeg:
            return {"JPEG", "8 bits", true, false, false, false};
        case Format::kTiff:
            return {"TIFF", "8 or 16 bits or float", true, true, false, true};
        case Format::kExr:
            return {"EXR", "half or float", false, false, true, true};
        case Format::kDpx:
            return {"DPX", "8 or 16 bits", true, true, false, false};
        case Format::kUnknown:
            break;
    }
    return {"", "", false, false, false, false};
}

bool holds(const FormatFacts& facts, PixelDepth depth) {
    switch (depth) {
        case PixelDepth::kU8:
            return facts.u8;
        case PixelDepth::kU16:
            return facts.u16;
        case PixelDepth::kHalf:
            return facts.half;
        case PixelDepth::kFloat:
            return facts.full;
    }
    return false;
}

const char* words(PixelDepth depth) {
    switch (depth) {
        case PixelDepth::kU8:
            return "8 bits";
        case PixelDepth::kU16:
            return "16 bits";
        case PixelDepth::kHalf:
            return "half";
        case PixelDepth::kFloat:
            return "float";
    }
    return "";
}

Error unknown_extension(const std::string& path) {
    return {ErrorCode::kUsage,
            path + ": unknown kind of file.",
            "Use .png, .jpg, .tif, .exr or .dpx.",
            {}};
}

Status check_numbers(const std::string& path, const WriteOptions& options) {
    static constexpr std::array kCompressions{"none",  "rle", "zip",  "zips", "piz",
                                              "pxr24", "b44", "b44a", "dwaa", "dwab"};
    const Format format = format_of(path);
    if (format == Format::kJpeg && (options.jpeg_quality < 1 || options.jpeg_quality > 100)) {
        return fail(ErrorCode::kUsage, path + ": JPEG quality must lie between 1 and 100.");
    }
    if (format == Format::kDpx && options.dpx_bits != 10 && options.dpx_bits != 12 &&
        options.dpx_bits != 16) {
        return fail(ErrorCode::kUsage, path + ": a DPX has 10, 12 or 16 bits.");
    }
    if (format == Format::kExr && options.exr_compression != "auto" &&
        std::find(kCompressions.begin(), kCompressions.end(), options.exr_compression) ==
            kCompressions.end()) {
        return fail(ErrorCode::kUsage,
                    path + ": unknown EXR compression '" + options.exr_compression + "'.",
                    "Use auto, none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa or dwab.");
    }
    return {};
}

// Half up, once. NaN becomes 0. Without branches, so that the compiler vectorises it.
template <class T>
T code_of(float v) {
    constexpr float kMax = static_cast<float>(std::numeric_limits<T>::max());
    const float scaled = v * kMax + 0.5f;
    const float above_0 = scaled > 0.0f ? scaled : 0.0f;
    return static_cast<T>(static_cast<std::int32_t>(above_0 < kMax ? above_0 : kMax));
}

float stored_as_half(float v) {
    return std::isfinite(v) ? std::clamp(v, -kLargestHalf, kLargestHalf) : v;
}

// Interleaves the colour and alpha of one row; `convert` makes one sample of a float.
template <class T, class Convert>
void pack_row(const float* rgb, const float* alpha, std::size_t width, Convert convert, T* to) {
    if (!alpha) {
        for (std::size_t i = 0; i < 3 * width; ++i)
            to[i] = convert(rgb[i]);
        return;
    }
    for (std::size_t x = 0; x < width; ++x, rgb += 3, to += 4) {
        for (std::size_t c = 0; c < 3; ++c)
            to[c] = convert(rgb[c]);
        to[3] = convert(alpha[x]);
    }
}

// Not a vector, which would first fill the samples with zeros.
template <class T, class Convert>
std::unique_ptr<T[]> pack(ViewF3 rgb, ViewF1 alpha, Convert convert) {
    const auto channels = static_cast<std::size_t>(alpha.empty() ? 3 : 4);
    const auto width = static_cast<std::size_t>(rgb.width());
    auto out = std::make_unique_for_overwrite<T[]>(width * static_cast<std::size_t>(rgb.height()) *
                                                   channels);
    parallel_rows(rgb.height(), kCodeBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            pack_row(rgb.row(y), alpha.empty() ? nullptr : alpha.row(y), width, convert,
                     out.get() + static_cast<std::size_t>(y) * width * channels);
        }
    });
    return out;
}

AlphaKind written_alpha(const std::string& path, const WriteOptions& options) {
    switch (format_of(path)) {
        case Format::kTiff:
            return format_of(options.source) == Format::kTiff ? options.alpha
                                                              : AlphaKind::kStraight;
        case Format::kExr:
        case Format::kDpx:
        case Format::kJpeg:  // over black, since it has no alpha
            return AlphaKind::kAssociated;
        case Format::kPng:
        case Format::kUnknown:
            break;
    }
    return AlphaKind::kStraight;
}

template <class T, class Convert>
Status pack_and_write(const std::string& path, ViewF3 rgb, ViewF1 alpha, SampleKind kind,
                      const WriteOptions& options, Convert convert) {
    const std::unique_ptr<T[]> samples = pack<T>(rgb, alpha, convert);
    return write_samples(
        path,
        {rgb.size(), alpha.empty() ? 3 : 4, kind, samples.get(), written_alpha(path, options)},
        options);
}

Status write_as_given(const std::string& path, ViewF3 rgb, ViewF1 alpha,
                      const WriteOptions& options) {
    switch (options.depth) {
        case PixelDepth::kU8:
            return pack_and_write<std::uint8_t>(path, rgb, alpha, SampleKind::kU8, options,
                                                [](float v) { return code_of<std::uint8_t>(v); });
        case PixelDepth::kU16:
            return pack_and_write<std::uint16_t>(path, rgb, alpha, SampleKind::kU16, options,
                                                 [](float v) { return code_of<std::uint16_t>(v); });
        case PixelDepth::kHalf:
            return pack_and_write<float>(path, rgb, alpha, SampleKind::kHalf, options,
                                         [](float v) { return stored_as_half(v); });
        case PixelDepth::kFloat:
            break;
    }
    return pack_and_write<float>(path, rgb, alpha, SampleKind::kFloat, options,
                                 [](float v) { return v; });
}

}  // namespace

PixelDepth default_depth(const std::string& path, PixelDepth plate) {
    const FormatFacts facts = facts_of(format_of(path));
    if (holds(facts, plate)) return plate;
    switch (format_of(path)) {
        case Format::kPng:
        case Format::kDpx:
            return PixelDepth::kU16;
        case Format::kTiff:
            return PixelDepth::kFloat;
        case Format::kExr:
            return plate == PixelDepth::kU8 ? PixelDepth::kHalf : PixelDepth::kFloat;
        case Format::kJpeg:
        case Format::kUnknown:
            break;
    }
    return PixelDepth::kU8;
}

Status check_format(const std::string& path, const WriteOptions& options) {
    const Format format = format_of(path);
    if (format == Format::kUnknown) return tl::unexpected(unknown_extension(path));
    const FormatFacts facts = facts_of(format);
    if (!holds(facts, options.depth)) {
        return fail(ErrorCode::kUsage,
                    path + ": " + facts.name + " cannot hold " + words(options.depth) + ".",
                    std::string("Choose ") + facts.depths + ", or another file format.");
    }
    return check_numbers(path, options);
}

Status write_image(const std::string& path, ViewF3 rgb, ViewF1 alpha, const WriteOptions& options) {
    WEFT_CHECK_OK(check_format(path, options));
    if (rgb.empty() || (!alpha.empty() && alpha.size() != rgb.size())) {
        return fail(ErrorCode::kUsage,
                    path + ": the picture is empty or its alpha has another size.");
    }
    const AlphaKind wanted = written_alpha(path, options);
    const ViewF1 kept = format_of(path) == Format::kJpeg ? ViewF1() : alpha;
    if (alpha.empty() || wanted == options.alpha) return write_as_given(path, rgb, kept, options);
    ImageF3 converted(rgb.size());
    for (int y = 0; y < rgb.height(); ++y)
        std::copy_n(rgb.row(y), 3 * static_cast<std::ptrdiff_t>(rgb.width()), converted.row(y));
    if (wanted == AlphaKind::kAssociated)
        associate(converted, alpha);
    else
        unassociate(converted, alpha);
    return write_as_given(path, converted, kept, options);
}

Status write_matte(const std::string& path, ViewU8x1 matte, const WriteRule& rule) {
    const Format format = format_of(path);
    if (format == Format::kUnknown) return tl::unexpected(unknown_extension(path));
    if (format != Format::kPng && format != Format::kTiff) {
        return fail(ErrorCode::kUsage, path + ": mattes are PNG or TIFF.", "Use .png or .tif.");
    }
    if (matte.empty()) return fail(ErrorCode::kUsage, path + ": the matte is empty (0 pixels).");
    std::vector<std::uint8_t> codes;
    codes.reserve(static_cast<std::size_t>(matte.width()) *
                  static_cast<std::size_t>(matte.height()));
    for (int y = 0; y < matte.height(); ++y) {
        codes.insert(codes.end(), matte.row(y), matte.row(y) + matte.width());
    }
    WriteOptions options;
    options.rule = rule;
    return write_samples(path, {matte.size(), 1, SampleKind::kU8, codes.data()}, options);
}

}  // namespace weft
