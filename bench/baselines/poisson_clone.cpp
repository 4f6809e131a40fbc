#include "bench/baselines/poisson_clone.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

namespace weft {
namespace {

// seamlessClone needs its border inside the picture. A frame of repeated pixels provides one where
// the picture's edge cuts the region.
constexpr int kBorder = 4;

cv::Mat with_border(ViewU8x3 image) {
    const cv::Mat view(image.height(), image.width(), CV_8UC3,
                       const_cast<std::uint8_t*>(image.data()),
                       static_cast<std::size_t>(image.stride()));
    cv::Mat out;
    cv::copyMakeBorder(view, out, kBorder, kBorder, kBorder, kBorder, cv::BORDER_REPLICATE);
    return out;
}

}  // namespace

ImageU8x3 poisson_clone(ViewU8x3 plate, ViewU8x3 texture, ViewU8x1 matte) {
    cv::Mat mask(plate.height() + 2 * kBorder, plate.width() + 2 * kBorder, CV_8UC1, cv::Scalar(0));
    for (int y = 0; y < matte.height(); ++y) {
        std::uint8_t* row = mask.ptr(y + kBorder) + kBorder;
        for (int x = 0; x < matte.width(); ++x)
            row[x] = matte.at(x, y) >= 128 ? 255 : 0;
    }
    const cv::Rect box = cv::boundingRect(mask);
    ImageU8x3 out(plate.size());
    cv::Mat blended = with_border(plate);
    if (!box.empty()) {
        const cv::Point centre(box.x + box.width / 2, box.y + box.height / 2);
        cv::Mat result;
        cv::seamlessClone(with_border(texture), blended, mask, centre, result, cv::NORMAL_CLONE);
        blended = result;
    }
    for (int y = 0; y < out.height(); ++y)
        std::copy_n(blended.ptr(y + kBorder) + 3 * kBorder, 3 * out.width(), out.row(y));
    return out;
}

}  // namespace weft
