#pragma once
// The texture photographs of the evaluation data.

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "tests/support/places.h"

namespace weft::test {

/// Paths of all photographs, sorted; empty when the data is not there.
inline std::vector<std::string> photographs() {
    namespace fs = std::filesystem;
    std::vector<std::string> paths;
    const fs::path root = fs::path(shared_data_folder()) / "textures";
    if (!fs::exists(root)) return paths;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (entry.path().extension() == ".jpg") paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// The photograph as RGB, or with `crop_px` > 0 its centre of that size.
inline ImageU8x3 load_photograph(const std::string& path, int crop_px) {
    const cv::Mat bgr = cv::imread(path, cv::IMREAD_COLOR);
    const int w = crop_px > 0 ? std::min(crop_px, bgr.cols) : bgr.cols;
    const int h = crop_px > 0 ? std::min(crop_px, bgr.rows) : bgr.rows;
    const int x0 = (bgr.cols - w) / 2, y0 = (bgr.rows - h) / 2;
    ImageU8x3 out(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const auto& p = bgr.at<cv::Vec3b>(y0 + y, x0 + x);
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = p[2 - c];
        }
    }
    return out;
}

}  // namespace weft::test
