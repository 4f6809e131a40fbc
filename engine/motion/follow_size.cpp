#include "engine/motion/follow_size.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

template <int C>
Image<std::uint8_t, C> reduced_picture(ImageView<const std::uint8_t, C> picture, Size to) {
    assert(to.width <= picture.width() && to.height <= picture.height());
    Image<std::uint8_t, C> out(to);
    cv::Mat small(to.height, to.width, CV_8UC(C), out.data());
    cv::resize(as_mat(picture), small, small.size(), 0, 0, cv::INTER_AREA);
    return out;
}

// Where the centre of pixel `at` lies among `count` pixel centres.
float place_of(int at, float scale, int count) {
    const float g = (static_cast<float>(at) + 0.5f) * scale - 0.5f;
    return std::min(std::max(g, 0.0f), static_cast<float>(count - 1));
}

}  // namespace

Size follow_size(Size plate) {
    return bounded_size(plate, std::int64_t{960} * 540);
}

Size bounded_size(Size plate, std::int64_t most_px) {
    const std::int64_t area = std::int64_t{plate.width} * plate.height;
    if (area <= most_px) return plate;
    const double scale = std::sqrt(static_cast<double>(most_px) / static_cast<double>(area));
    const auto side = [&](int extent) {
        return std::max(1, static_cast<int>(std::lround(scale * extent)));
    };
    return {side(plate.width), side(plate.height)};
}

Matte reduced(ViewU8x1 picture, Size to) {
    return reduced_picture<1>(picture, to);
}

ImageU8x3 reduced(ViewU8x3 picture, Size to) {
    return reduced_picture<3>(picture, to);
}

FlowField resized(const FlowField& motion, Size to) {
    if (motion.size() == to) return motion;
    FlowField out(to);
    const Size from = motion.size();
    const float sx = static_cast<float>(from.width) / static_cast<float>(to.width);
    const float sy = static_cast<float>(from.height) / static_cast<float>(to.height);
    parallel_rows(to.height, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const float gy = place_of(y, sy, from.height);
            const int iy = static_cast<int>(gy), below = std::min(iy + 1, from.height - 1);
            const float fy = gy - static_cast<float>(iy);
            const float *a = motion.d.row(iy), *b = motion.d.row(below);
            const std::uint8_t* valid = motion.valid.row(fy < 0.5f ? iy : below);
            float* d = out.d.row(y);
            for (int x = 0; x < to.width; ++x) {
                const float gx = place_of(x, sx, from.width);
                const int ix = static_cast<int>(gx), right = std::min(ix + 1, from.width - 1);
                const float fx = gx - static_cast<float>(ix);
                for (int c = 0; c < 2; ++c) {
                    const float top = a[2 * ix + c] + fx * (a[2 * right + c] - a[2 * ix + c]);
                    const float low = b[2 * ix + c] + fx * (b[2 * right + c] - b[2 * ix + c]);
                    d[2 * x + c] = (top + fy * (low - top)) / (c == 0 ? sx : sy);
                }
                out.valid.at(x, y) = valid[fx < 0.5f ? ix : right];
            }
        }
    });
    return out;
}

LatticeField resized(const LatticeField& motion, Size to, int spacing) {
    const Size from = motion.full_size();
    if (from == to && spacing == motion.spacing()) return motion;
    const Vec2 gain(static_cast<float>(to.width) / static_cast<float>(from.width),
                    static_cast<float>(to.height) / static_cast<float>(from.height));
    LatticeField out(to, spacing);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, gain * motion.at(out.node_position(i, j) / gain));
    }
    return out;
}

}  // namespace weft
