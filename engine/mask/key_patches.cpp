#include "engine/mask/key_patches.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <opencv2/core.hpp>

namespace weft {
namespace {

constexpr int kKeyPatchCodes = 27;
constexpr std::uint8_t kIsOutside = 0, kIsMixed = 1, kIsInside = 2;

// The surroundings of cells as rows of codes.
cv::Mat key_patches_of(const ImageU8x3& lab, const std::vector<std::int32_t>& cells) {
    cv::Mat out(static_cast<int>(cells.size()), kKeyPatchCodes, CV_8U);
    for (int k = 0; k < out.rows; ++k) {
        const int cell = cells[static_cast<std::size_t>(k)];
        const int x = cell % lab.width(), y = cell / lab.width();
        auto* to = out.ptr<std::uint8_t>(k);
        for (int j = y - 1; j <= y + 1; ++j)
            for (int i = x - 1; i <= x + 1; ++i)
                to = std::copy_n(lab.pixel(std::clamp(i, 0, lab.width() - 1),
                                           std::clamp(j, 0, lab.height() - 1)),
                                 3, to);
    }
    return out;
}

// Some of the cells of `area` that are of a side, evenly.
std::vector<std::int32_t> some_cells(const Image<std::uint8_t, 1>& sides, const Recti& area,
                                     std::uint8_t side) {
    constexpr std::size_t kMost = 1500;
    std::vector<std::int32_t> all, out;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            if (sides.at(x, y) == side) all.push_back(y * sides.width() + x);
    const std::size_t step = std::max<std::size_t>(1, all.size() / kMost);
    for (std::size_t k = 0; k < all.size(); k += step)
        out.push_back(all[k]);
    return out;
}

// The least miss of each of `asked`; infinite if nothing is known.
std::vector<float> least_misses(const cv::Mat& asked, const cv::Mat& known) {
    std::vector<float> out(static_cast<std::size_t>(asked.rows),
                           std::numeric_limits<float>::infinity());
    if (asked.empty() || known.empty()) return out;
    cv::Mat sums, which;
    cv::batchDistance(asked, known, sums, CV_32S, which, cv::NORM_L1, 1);
    for (int k = 0; k < asked.rows; ++k)
        out[static_cast<std::size_t>(k)] =
            static_cast<float>(sums.at<int>(k, 0)) / static_cast<float>(kKeyPatchCodes);
    return out;
}

}  // namespace

KeyPatches::KeyPatches(const ImageU8x3& lab, const ImageF1& inside)
    : lab_(lab), sides_(lab.size()) {
    constexpr float kMixed = 0.1f;
    for (int y = 0; y < lab.height(); ++y) {
        for (int x = 0; x < lab.width(); ++x) {
            const float share = inside.at(x, y);
            sides_.at(x, y) = share > 1 - kMixed ? kIsInside
                              : share < kMixed   ? kIsOutside
                                                 : kIsMixed;
        }
    }
}

std::vector<SideMisses> KeyPatches::misses(const ImageU8x3& lab,
                                           const std::vector<std::int32_t>& cells,
                                           const Recti& near) const {
    const cv::Mat asked = key_patches_of(lab, cells);
    const auto least = [&](const Recti& area, std::uint8_t side) {
        return least_misses(asked, key_patches_of(lab_, some_cells(sides_, area, side)));
    };
    const std::vector<float> inside = least(rect_of(lab_.size()), kIsInside);
    const std::vector<float> outside = least(near, kIsOutside);
    std::vector<SideMisses> out;
    for (std::size_t k = 0; k < cells.size(); ++k)
        out.push_back({inside[k], outside[k]});
    return out;
}

}  // namespace weft
