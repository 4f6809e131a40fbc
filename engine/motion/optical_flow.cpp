#include "engine/motion/optical_flow.h"

#include <cassert>
#include <cmath>
#include <opencv2/video/tracking.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

cv::Mat as_mat(ViewU8x1 image) {
    return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data()),
            static_cast<std::size_t>(image.stride())};
}

// DIS builds a pyramid down to patches of 8 px, so smaller pictures are padded by repeating the
// border. It also needs rows without gaps, which a crop does not have.
constexpr int kSmallest = 64;

cv::Mat prepared(const cv::Mat& image) {
    const int right = std::max(0, kSmallest - image.cols);
    const int bottom = std::max(0, kSmallest - image.rows);
    if (right == 0 && bottom == 0) return image.isContinuous() ? image : image.clone();
    cv::Mat out;
    cv::copyMakeBorder(image, out, 0, bottom, 0, right, cv::BORDER_REPLICATE);
    return out;
}

// Bilinear lookup of a displacement; false when p lies outside the pixel centres.
bool lookup(const ImageF2& d, float px, float py, Vec2& out) {
    const float gx = px - 0.5f, gy = py - 0.5f;
    if (!(gx >= 0 && gy >= 0 && gx <= static_cast<float>(d.width() - 1) &&
          gy <= static_cast<float>(d.height() - 1))) {
        return false;
    }
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const float fx = gx - static_cast<float>(x), fy = gy - static_cast<float>(y);
    const float* a = d.pixel(x, y);
    const float* b = d.pixel(x, std::min(y + 1, d.height() - 1));
    const int right = x + 1 < d.width() ? 2 : 0;
    for (int c = 0; c < 2; ++c) {
        const float top = a[c] + fx * (a[c + right] - a[c]);
        const float low = b[c] + fx * (b[c + right] - b[c]);
        out[c] = top + fy * (low - top);
    }
    return true;
}

float squared(float v) {
    return v * v;
}

// Marks in `there.valid` the pixels whose way there and back misses.
void check_one_way(const FlowField& there, const ImageF2& back, float tolerance_px, Matte& valid) {
    parallel_rows(there.d.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < there.d.width(); ++x) {
                const float* d = there.d.pixel(x, y);
                Vec2 home(0);
                const bool inside = lookup(back, static_cast<float>(x) + 0.5f + d[0],
                                           static_cast<float>(y) + 0.5f + d[1], home);
                const float miss = std::sqrt(squared(d[0] + home.x) + squared(d[1] + home.y));
                const float way = std::sqrt(squared(d[0]) + squared(d[1])) +
                                  std::sqrt(squared(home.x) + squared(home.y));
                if (!inside || miss > tolerance_px + 0.05f * way) valid.at(x, y) = 0;
            }
        }
    });
}

}  // namespace

FlowField estimate_flow(ViewU8x1 source, ViewU8x1 target, FlowQuality quality) {
    assert(source.size() == target.size());
    const auto dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
    const bool draft = quality == FlowQuality::kDraft;
    // The finest pyramid level determines precision and cost (measured on blender_fox_gt: the
    // rolling ball's error is 1.2 px at a quarter, 0.37 at a half and 0.14 at the full size).
    // Larger plates end at a level of about the same size.
    const int widest = draft ? 512 : 1280;
    int finest = 0;
    const cv::Mat from = prepared(as_mat(source)), to = prepared(as_mat(target));
    // A strip has no more levels than patches of 8 px fit into its short side.
    const int most = std::min(from.rows, from.cols) / 8;
    while ((source.width() >> finest) > widest && (2 << finest) <= most)
        ++finest;
    dis->setFinestScale(finest);
    dis->setPatchStride(4);
    dis->setGradientDescentIterations(draft ? 12 : 16);
    dis->setVariationalRefinementIterations(draft ? 0 : 5);
    cv::Mat flow;
    dis->calc(from, to, flow);
    FlowField out(source.size());
    for (int y = 0; y < out.d.height(); ++y) {
        const float* row = flow.ptr<float>(y);
        std::copy(row, row + out.d.stride(), out.d.row(y));
    }
    return out;
}

void check_consistency(FlowField& target_from_source, FlowField& source_from_target,
                       float tolerance_px) {
    check_consistency(target_from_source, source_from_target.d, tolerance_px);
    check_consistency(source_from_target, target_from_source.d, tolerance_px);
}

void check_consistency(FlowField& target_from_source, const ImageF2& source_from_target,
                       float tolerance_px) {
    check_one_way(target_from_source, source_from_target, tolerance_px, target_from_source.valid);
}

FlowField invert_flow(const FlowField& target_from_source) {
    // Every valid source pixel is splatted bilinearly; a target pixel takes the weighted mean of
    // what lands, unless the contributions disagree by more than a pixel: then two surfaces met
    // there and the motion is ambiguous.
    const Size size = target_from_source.size();
    FlowField out(size);
    ImageF1 weight(size);
    Image<float, 2> square(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (!target_from_source.valid.at(x, y)) continue;
            const float* d = target_from_source.d.pixel(x, y);
            const float gx = static_cast<float>(x) + d[0], gy = static_cast<float>(y) + d[1];
            // NaN lands nowhere either.
            if (!(gx > -1 && gy > -1 && gx < static_cast<float>(size.width) &&
                  gy < static_cast<float>(size.height))) {
                continue;
            }
            const int tx = static_cast<int>(std::floor(gx)), ty = static_cast<int>(std::floor(gy));
            const float fx = gx - static_cast<float>(tx), fy = gy - static_cast<float>(ty);
            for (int k = 0; k < 4; ++k) {
                const int qx = tx + (k & 1), qy = ty + (k >> 1);
                if (!rect_of(size).contains(qx, qy)) continue;
                const float w = ((k & 1) ? fx : 1 - fx) * ((k >> 1) ? fy : 1 - fy);
                weight.at(qx, qy) += w;
                for (int c = 0; c < 2; ++c) {
                    out.d.at(qx, qy, c) -= w * d[c];
                    square.at(qx, qy, c) += w * d[c] * d[c];
                }
            }
        }
    }
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float w = weight.at(x, y);
            if (w < 0.25f) {
                out.valid.at(x, y) = 0;
                out.d.at(x, y, 0) = out.d.at(x, y, 1) = 0;
                continue;
            }
            float variance = 0;
            for (int c = 0; c < 2; ++c) {
                const float mean = out.d.at(x, y, c) /= w;
                variance += square.at(x, y, c) / w - mean * mean;
            }
            if (variance > 1.0f) out.valid.at(x, y) = 0;
        }
    }
    return out;
}

}  // namespace weft
