#include "texture_db/describe/sample_codec.h"

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/hash.h"

namespace weft {
namespace {

constexpr std::int64_t kLargest_px = 64ll << 20;

std::uint32_t big_endian(const std::byte* p) {
    return static_cast<std::uint32_t>(p[0]) << 24 | static_cast<std::uint32_t>(p[1]) << 16 |
           static_cast<std::uint32_t>(p[2]) << 8 | static_cast<std::uint32_t>(p[3]);
}

// A PNG states its size in its first chunk. Used only to reject, before memory is allocated.
bool png_too_large(std::span<const std::byte> bytes) {
    if (bytes.size() < 24 || std::memcmp(bytes.data(), "\x89PNG", 4) != 0) return false;
    const auto width = static_cast<std::int64_t>(big_endian(bytes.data() + 16));
    const auto height = static_cast<std::int64_t>(big_endian(bytes.data() + 20));
    return width > 65535 || height > 65535 || width * height > kLargest_px;
}

cv::Mat header_of(ViewU8x3 image) {
    return cv::Mat(image.height(), image.width(), CV_8UC3, const_cast<std::uint8_t*>(image.data()),
                   static_cast<std::size_t>(image.stride()));
}

std::vector<std::byte> encoded(ViewU8x3 image, const char* format,
                               const std::vector<int>& settings) {
    cv::Mat bgr;
    cv::cvtColor(header_of(image), bgr, cv::COLOR_RGB2BGR);
    std::vector<std::uint8_t> bytes;
    cv::imencode(format, bgr, bytes, settings);
    std::vector<std::byte> out(bytes.size());
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
}

}  // namespace

std::vector<std::byte> encode_png(ViewU8x3 image) {
    return encoded(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 5});
}

std::vector<std::byte> encode_jpeg(ViewU8x3 image) {
    return encoded(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, 92});
}

Expected<ImageU8x3> decode_picture(std::span<const std::byte> bytes) {
    if (bytes.empty() || png_too_large(bytes))
        return fail(ErrorCode::kUnreadable, "A stored picture is damaged.");
    cv::Mat bgr;
    try {
        const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8UC1,
                           const_cast<std::byte*>(bytes.data()));
        bgr = cv::imdecode(data, cv::IMREAD_COLOR);
    } catch (const cv::Exception&) {
        bgr.release();
    }
    if (bgr.empty()) return fail(ErrorCode::kUnreadable, "A stored picture is damaged.");
    ImageU8x3 image(bgr.cols, bgr.rows);
    cv::cvtColor(bgr, header_of(image), cv::COLOR_BGR2RGB);
    return image;
}

std::string texture_id(const ImageU8x3& pixels) {
    return Hasher().image(pixels).finish().hex();
}

ImageU8x3 resized(ViewU8x3 image, Size size) {
    ImageU8x3 out(size);
    cv::Mat target = header_of(out);
    const bool smaller = size.width < image.width() || size.height < image.height();
    cv::resize(header_of(image), target, target.size(), 0, 0,
               smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
    return out;
}

ImageU8x3 cropped(ViewU8x3 image, const Recti& r) {
    ImageU8x3 out(r.size());
    for (int y = 0; y < out.height(); ++y) {
        std::memcpy(out.row(y), image.pixel(r.x0, r.y0 + y),
                    static_cast<std::size_t>(r.width()) * 3);
    }
    return out;
}

}  // namespace weft
