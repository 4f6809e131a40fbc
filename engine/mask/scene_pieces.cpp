#include "engine/mask/scene_pieces.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {
namespace {

cv::Mat opened(Matte& pieces) {
    cv::Mat view(pieces.height(), pieces.width(), CV_8U, pieces.data());
    cv::morphologyEx(view, view, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
    return view;
}

// Pixels along the outline of a piece.
struct PieceOutline {
    int all = 0, surface = 0, other = 0;

    void add(std::uint8_t beside) {
        ++all;
        surface += beside == static_cast<std::uint8_t>(Beside::kSurface) ? 1 : 0;
        other += beside == static_cast<std::uint8_t>(Beside::kOther) ? 1 : 0;
    }
    [[nodiscard]] bool is_joined() const {
        constexpr double kLeast = 0.15;
        return surface > other && surface > kLeast * all;
    }
};

}  // namespace

void keep_large(Matte& pieces, double least_px) {
    cv::Mat labels, stats, centres;
    cv::connectedComponentsWithStats(opened(pieces), labels, stats, centres, 8, CV_32S);
    for (int y = 0; y < pieces.height(); ++y) {
        for (int x = 0; x < pieces.width(); ++x) {
            const int area_px = stats.at<int>(labels.at<int>(y, x), cv::CC_STAT_AREA);
            if (area_px < least_px) pieces.at(x, y) = 0;
        }
    }
}

void keep_joined(Matte& pieces, const Matte& beside, double alone_px) {
    constexpr int kBeside_px = 2;
    cv::Mat labels, stats, centres;
    const int count =
        cv::connectedComponentsWithStats(opened(pieces), labels, stats, centres, 8, CV_32S);
    std::vector<PieceOutline> outlines(static_cast<std::size_t>(count));
    for (int y = kBeside_px; y + kBeside_px < pieces.height(); ++y) {
        for (int x = kBeside_px; x + kBeside_px < pieces.width(); ++x) {
            const int label = labels.at<int>(y, x);
            if (label == 0) continue;
            for (const Vec2i step : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
                if (labels.at<int>(y + step.y, x + step.x) == label) continue;
                const Vec2i p = Vec2i(x, y) + kBeside_px * step;
                outlines[static_cast<std::size_t>(label)].add(beside.at(p.x, p.y));
            }
        }
    }
    for (int y = 0; y < pieces.height(); ++y) {
        for (int x = 0; x < pieces.width(); ++x) {
            const int label = labels.at<int>(y, x);
            const bool alone = stats.at<int>(label, cv::CC_STAT_AREA) >= alone_px;
            if (label == 0 || (!alone && !outlines[static_cast<std::size_t>(label)].is_joined()))
                pieces.at(x, y) = 0;
        }
    }
}

}  // namespace weft
