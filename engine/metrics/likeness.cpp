#include "engine/metrics/likeness.h"

#include <algorithm>
#include <cmath>

#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kSoftFrom = 5;
constexpr int kCropPx = 96;

enum class Part { kOutside, kSoftEdge, kInterior };

Part part_of(std::uint8_t matte) {
    if (matte >= kInsideCoverage) return Part::kInterior;
    return matte >= kSoftFrom ? Part::kSoftEdge : Part::kOutside;
}

// Expected − seen in levels; 0 if either is NaN.
ImageF3 error_of(ViewF3 expected, ViewF3 seen) {
    ImageF3 out(expected.size());
    for (int y = 0; y < out.height(); ++y) {
        const float* a = expected.row(y);
        const float* b = seen.row(y);
        float* e = out.row(y);
        for (int k = 0; k < 3 * out.width(); ++k) {
            const float d = 255 * (a[k] - b[k]);
            e[k] = std::isfinite(d) ? d : 0;
        }
    }
    return out;
}

double size_of(const float* e) {
    return (std::abs(static_cast<double>(e[0])) + std::abs(static_cast<double>(e[1])) +
            std::abs(static_cast<double>(e[2]))) /
           3;
}

std::uint8_t code(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f);
}

ImageU8x3 cut_out(ViewF3 picture, const Recti& box) {
    ImageU8x3 out(box.size());
    for (int y = 0; y < box.height(); ++y) {
        const float* from = picture.pixel(box.x0, box.y0 + y);
        std::transform(from, from + static_cast<std::ptrdiff_t>(3 * box.width()), out.row(y),
                       [](float v) { return code(std::isfinite(v) ? 255 * v : 0); });
    }
    return out;
}

double mean_or_none(const RowSum& sum) {
    return sum.count > 0 ? sum.mean() : -1;
}

}  // namespace

const FrameLikeness& SequenceLikeness::add(int frame, ViewF3 expected, ViewF3 seen,
                                           ViewU8x1 matte) {
    FrameLikeness out;
    out.frame = frame;
    out.features = residual_motion(luma_8bit(expected), luma_8bit(seen), eroded_inside(matte, 2));
    ImageF3 error = error_of(expected, seen);
    RowSum interior, soft, outside, change;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const float* e = error.pixel(x, y);
            const Part part = part_of(matte.at(x, y));
            (part == Part::kInterior   ? interior
             : part == Part::kSoftEdge ? soft
                                       : outside)
                .add(size_of(e));
            if (last_matte_.empty()) continue;
            if (part != Part::kSoftEdge && part_of(last_matte_.at(x, y)) != Part::kSoftEdge)
                continue;
            const float* l = last_error_.pixel(x, y);
            const std::array<float, 3> d{e[0] - l[0], e[1] - l[1], e[2] - l[2]};
            change.add(size_of(d.data()));
        }
    }
    out.interior = mean_or_none(interior);
    out.soft_edge = mean_or_none(soft);
    out.outside = mean_or_none(outside);
    out.soft_edge_change = mean_or_none(change);
    keep_worst(frame, expected, seen, matte);
    last_error_ = std::move(error);
    last_matte_ = Matte(matte.size());
    for (int y = 0; y < matte.height(); ++y)
        std::copy(matte.row(y), matte.row(y) + matte.width(), last_matte_.row(y));
    frames_.push_back(out);
    return frames_.back();
}

// The frame's worst window, by half steps; at least a tenth of it must show the surface.
void SequenceLikeness::keep_worst(int frame, ViewF3 expected, ViewF3 seen, ViewU8x1 matte) {
    const int side = std::min({kCropPx, matte.width(), matte.height()});
    const ImageF3 error = error_of(expected, seen);
    WorstCrop worst;
    worst.frame = frame;
    for (int y0 = 0; y0 + side <= matte.height(); y0 += side / 2) {
        for (int x0 = 0; x0 + side <= matte.width(); x0 += side / 2) {
            RowSum sum;
            for (int y = y0; y < y0 + side; ++y) {
                for (int x = x0; x < x0 + side; ++x) {
                    if (matte.at(x, y) >= kSoftFrom) sum.add(size_of(error.pixel(x, y)));
                }
            }
            if (10 * sum.count < side * side || sum.mean() <= worst.difference) continue;
            worst.difference = sum.mean();
            worst.box = {x0, y0, x0 + side, y0 + side};
        }
    }
    if (worst.box.empty()) return;
    const auto at = std::upper_bound(
        worst_.begin(), worst_.end(), worst,
        [](const WorstCrop& a, const WorstCrop& b) { return a.difference > b.difference; });
    if (at == worst_.end() && static_cast<int>(worst_.size()) >= most_crops_) return;
    worst.expected = cut_out(expected, worst.box);
    worst.seen = cut_out(seen, worst.box);
    worst_.insert(at, std::move(worst));
    if (static_cast<int>(worst_.size()) > most_crops_) worst_.pop_back();
}

SequenceLikeness::Summary SequenceLikeness::summary() const {
    Summary out;
    RowSum interior, soft, outside, change;
    double length = 0;
    std::int64_t patches = 0;
    const auto count = [](RowSum& sum, double v) {
        if (v >= 0) sum.add(v);
    };
    for (const FrameLikeness& f : frames_) {
        count(interior, f.interior);
        count(soft, f.soft_edge);
        count(outside, f.outside);
        count(change, f.soft_edge_change);
        if (f.features.patches == 0) continue;
        length += f.features.mean_px * static_cast<double>(f.features.patches);
        patches += f.features.patches;
        out.largest_offset_px = std::max(out.largest_offset_px, f.features.mean_px);
    }
    out.offset_px = patches > 0 ? length / static_cast<double>(patches) : 0;
    out.interior = interior.mean();
    out.soft_edge = soft.mean();
    out.outside = outside.mean();
    out.soft_edge_change = change.mean();
    return out;
}

ImageU8x3 strip_of(const std::vector<WorstCrop>& crops) {
    constexpr int kGap = 2;
    if (crops.empty()) return {};
    const int side = crops.front().box.width();
    const int columns = static_cast<int>(crops.size());
    ImageU8x3 out(Size{columns * (side + kGap) - kGap, 3 * (side + kGap) - kGap});
    std::fill_n(out.data(), out.size_bytes(), std::uint8_t{0});
    for (int k = 0; k < columns; ++k) {
        const WorstCrop& crop = crops[static_cast<std::size_t>(k)];
        for (int y = 0; y < side; ++y) {
            for (int i = 0; i < 3 * side; ++i) {
                const int a = crop.expected.row(y)[i], b = crop.seen.row(y)[i];
                const int x = k * (side + kGap) * 3 + i;
                out.row(y)[x] = crop.expected.row(y)[i];
                out.row(y + side + kGap)[x] = crop.seen.row(y)[i];
                out.row(y + 2 * (side + kGap))[x] = code(static_cast<float>(128 + 4 * (b - a)));
            }
        }
    }
    return out;
}

}  // namespace weft
