#include "app/render/burn_in.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace weft {

void burn_in(ImageView<float, 3> display, const std::string& text) {
    constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
    const double wanted_px = std::max(8.0, display.height() / 30.0);
    int baseline = 0;
    const double scale = wanted_px / cv::getTextSize("0", kFont, 1.0, 1, &baseline).height;
    const int thickness = std::max(1, static_cast<int>(wanted_px / 12));
    const cv::Size size = cv::getTextSize(text, kFont, scale, thickness, &baseline);
    const int margin = static_cast<int>(wanted_px / 2);
    cv::Mat drawn(std::min(display.height(), size.height + baseline + margin),
                  std::min(display.width(), size.width + 2 * margin), CV_8UC1, cv::Scalar(0));
    cv::putText(drawn, text, {margin, size.height + margin / 2}, kFont, scale, cv::Scalar(255),
                thickness, cv::LINE_AA);
    constexpr float kBand = 0.35f;  // opacity of the picture behind the text
    for (int y = 0; y < drawn.rows; ++y) {
        for (int x = 0; x < drawn.cols; ++x) {
            float* p = display.pixel(x, display.height() - drawn.rows + y);
            const float ink = static_cast<float>(drawn.at<unsigned char>(y, x)) / 255.0f;
            for (int c = 0; c < 3; ++c)
                p[c] = ink + (1 - ink) * kBand * std::clamp(p[c], 0.0f, 1.0f);
        }
    }
}

}  // namespace weft
