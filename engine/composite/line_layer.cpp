#include "engine/composite/line_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/finite_rgb.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

// ---- extraction ------------------------------------------------------------------------------

constexpr int kNeighbourhood = 24;  // px; the darkest stroke within sets what full coverage is

cv::Mat luma_of(ViewU8x3 display) {
    cv::Mat out(display.height(), display.width(), CV_8UC1);
    for (int y = 0; y < display.height(); ++y) {
        std::uint8_t* row = out.ptr(y);
        for (int x = 0; x < display.width(); ++x) {
            const std::uint8_t* p = display.pixel(x, y);
            row[x] = static_cast<std::uint8_t>(luma_709_code(p[0], p[1], p[2]));
        }
    }
    return out;
}

cv::Mat disc(int radius) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

// ---- the ink's colour --------------------------------------------------------------------------

constexpr int kCore = 224;  // coverage from which a pixel shows ink alone
constexpr int kCoreCell = 8;

struct ColourSum {
    std::array<double, 3> rgb{};
    double weight = 0;
    void add(const float* p) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] += static_cast<double>(p[c]);
        weight += 1;
    }
    void add(const ColourSum& o) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] += o.rgb[c];
        weight += o.weight;
    }
};

// Sums of the core pixels' colours, in cells of kCoreCell × kCoreCell px.
class Cores {
  public:
    Cores(ViewF3 plate, ViewU8x1 lines)
        : width_((plate.width() + kCoreCell - 1) / kCoreCell),
          height_((plate.height() + kCoreCell - 1) / kCoreCell),
          cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                if (lines.at(x, y) < kCore || !finite_rgb(plate.pixel(x, y))) continue;
                cells_[index(x / kCoreCell, y / kCoreCell)].add(plate.pixel(x, y));
                all_.add(plate.pixel(x, y));
            }
        }
    }

    // Sums of the cores in the cell and its eight neighbours, else of all; weight 0: no cores.
    [[nodiscard]] ColourSum near(int x, int y) const {
        ColourSum sum;
        const int u = x / kCoreCell, v = y / kCoreCell;
        for (int j = std::max(0, v - 1); j <= std::min(height_ - 1, v + 1); ++j)
            for (int i = std::max(0, u - 1); i <= std::min(width_ - 1, u + 1); ++i)
                sum.add(cells_[index(i, j)]);
        return sum.weight > 0 ? sum : all_;
    }

  private:
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(i);
    }
    int width_, height_;
    std::vector<ColourSum> cells_;
    ColourSum all_;
};

}  // namespace

Matte extract_ink(ViewU8x3 display, ViewU8x1 matte, const InkOptions& options) {
    const cv::Mat luma = luma_of(display);
    const int radius = std::max(1, static_cast<int>(std::ceil(options.width_px / 2)) + 1);
    cv::Mat closed, hat, strongest;
    cv::morphologyEx(luma, closed, cv::MORPH_CLOSE, disc(radius));
    cv::subtract(closed, luma, hat);
    cv::dilate(hat, strongest,
               cv::getStructuringElement(cv::MORPH_RECT,
                                         {2 * kNeighbourhood + 1, 2 * kNeighbourhood + 1}));
    cv::Mat reach(matte.height(), matte.width(), CV_8UC1, const_cast<std::uint8_t*>(matte.data()),
                  static_cast<std::size_t>(matte.stride()));
    cv::Mat inside;
    cv::dilate(reach, inside, disc(std::max(1, static_cast<int>(std::lround(options.width_px)))));
    const float least = 255.0f * options.contrast;
    Matte out(matte.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const auto full = static_cast<float>(strongest.at<std::uint8_t>(y, x));
            if (inside.at<std::uint8_t>(y, x) == 0 || full < least) continue;
            // Shading and compression make faint valleys everywhere, so the first eighth does not
            // count.
            const float share = static_cast<float>(hat.at<std::uint8_t>(y, x)) / full;
            const float coverage = std::clamp((share - 0.125f) / 0.775f, 0.0f, 1.0f);
            out.at(x, y) = static_cast<std::uint8_t>(255.0f * coverage + 0.5f);
        }
    }
    return out;
}

void lay_lines(ImageView<float, 3> surface, ViewF3 plate, ViewU8x1 lines) {
    const Cores cores(plate, lines);
    parallel_rows(surface.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < surface.width(); ++x) {
                const float l = static_cast<float>(lines.at(x, y)) / 255.0f;
                const float* p = plate.pixel(x, y);
                if (l <= 0 || !finite_rgb(p)) continue;
                const ColourSum core = cores.near(x, y);
                // In a core the pixel shows its own ink.
                const bool own = lines.at(x, y) >= kCore || core.weight <= 0;
                for (int c = 0; c < 3; ++c) {
                    const float ink =
                        own ? p[c]
                            : static_cast<float>(core.rgb[static_cast<std::size_t>(c)] /
                                                 core.weight);
                    float& s = surface.at(x, y, c);
                    s += l * (ink - s);
                }
            }
        }
    });
}

}  // namespace weft
