#include "engine/temporal/part_islands.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace weft {

Matte part_islands(const Matte& part) {
    constexpr int kSmall = 4;  // times less than the largest
    const cv::Mat codes(part.height(), part.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(part.data()));
    cv::Mat pieces, stats, centres;
    const int count = cv::connectedComponentsWithStats(codes >= 128, pieces, stats, centres, 8);
    int largest = 0;
    for (int k = 1; k < count; ++k)
        largest = std::max(largest, stats.at<int>(k, cv::CC_STAT_AREA));
    Matte out;
    for (int k = 1; k < count; ++k) {
        if (kSmall * stats.at<int>(k, cv::CC_STAT_AREA) >= largest) continue;
        if (out.empty()) out = Matte(part.size());
        cv::Mat(part.height(), part.width(), CV_8UC1, out.data()).setTo(255, pieces == k);
    }
    return out;
}

}  // namespace weft
