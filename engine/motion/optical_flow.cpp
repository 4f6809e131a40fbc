#include "engine/motion/optical_flow.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/motion/follow_size.h"
#include "engine/motion/patch_search.h"

namespace weft {
namespace {

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

// The finest level that is searched, and the most steps of a patch there.
struct SearchDepth {
    std::size_t finest;
    int iterations;
};

SearchDepth depth_for(Size size, FlowQuality quality, std::size_t levels) {
    // Larger pictures end at a level of about the same size.
    const int widest = quality == FlowQuality::kDraft ? 512 : 1280;
    SearchDepth depth{0, quality == FlowQuality::kDraft ? 12 : 16};
    while ((size.width >> depth.finest) > widest && depth.finest + 1 < levels)
        ++depth.finest;
    return depth;
}

ImageF2 search(const std::vector<SearchPicture>& source, const std::vector<SearchPicture>& target,
               const SearchDepth& depth) {
    ImageF2 motion;
    for (std::size_t level = source.size(); level-- > depth.finest;)
        motion = search_level(source[level], target[level], motion, depth.iterations);
    return motion;
}

FlowField at_full_size(ImageF2 motion, Size size) {
    FlowField found(motion.size());
    found.d = std::move(motion);
    return found.size() == size ? std::move(found) : resized(found, size);
}

}  // namespace

FlowField estimate_flow(ViewU8x1 source, ViewU8x1 target, FlowQuality quality) {
    assert(source.size() == target.size());
    const auto from = search_pyramid(source), to = search_pyramid(target);
    const SearchDepth depth = depth_for(source.size(), quality, from.size());
    return at_full_size(search(from, to, depth), source.size());
}

FlowPair estimate_flows(ViewU8x1 a, ViewU8x1 b, FlowQuality quality) {
    return estimate_flows(a, b, quality, a.size());
}

FlowPair estimate_flows(ViewU8x1 a, ViewU8x1 b, FlowQuality quality, Size frame) {
    assert(a.size() == b.size());
    const auto of_a = search_pyramid(a), of_b = search_pyramid(b);
    const SearchDepth depth = depth_for(frame, quality, of_a.size());
    return {at_full_size(search(of_a, of_b, depth), a.size()),
            at_full_size(search(of_b, of_a, depth), a.size())};
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
