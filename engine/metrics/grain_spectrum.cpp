#include "engine/metrics/grain_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/core/parallel.h"
#include "engine/metrics/region.h"
#include "engine/metrics/tde.h"

namespace weft {
namespace {

constexpr int kSide = 16;
constexpr double kFlattestBlocks = 0.25;  // of all blocks
constexpr std::size_t kFewestBlocks = 8;

ImageF1 channel(ViewF3 picture, int c) {
    ImageF1 out(picture.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.row(y)[x] = picture.pixel(x, y)[c];
    }
    return out;
}

struct Table {
    std::array<std::array<double, kSide>, kSide> cosine{}, sine{};
    std::array<double, kSide> window{};
    double window_energy = 0;
    std::array<std::array<int, kSide>, kSide> band{};
    Table() {
        for (int u = 0; u < kSide; ++u) {
            for (int x = 0; x < kSide; ++x) {
                const double a = 2 * std::numbers::pi * u * x / kSide;
                cosine[idx(u)][idx(x)] = std::cos(a), sine[idx(u)][idx(x)] = std::sin(a);
            }
            window[idx(u)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (u + 0.5) / kSide);
        }
        double sum = 0;
        for (const double w : window)
            sum += w * w;
        window_energy = sum * sum;
        for (int v = 0; v < kSide; ++v) {
            for (int u = 0; u < kSide; ++u) {
                const double f = std::hypot(std::min(u, kSide - u), std::min(v, kSide - v)) / kSide;
                band[idx(v)][idx(u)] = std::min(GrainSpectrum::kBands - 1,
                                                static_cast<int>(f / 0.5 * GrainSpectrum::kBands));
            }
        }
    }
    static std::size_t idx(int k) { return static_cast<std::size_t>(k); }
};

// Power of a block by band. The mean is removed, so that the sum over bands is the mean square.
std::array<double, GrainSpectrum::kBands> powers(const ImageF3& difference, int x0, int y0, int c) {
    static const Table t;
    using Block = std::array<std::array<double, kSide>, kSide>;
    double mean = 0, weight = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double w = t.window[Table::idx(x)] * t.window[Table::idx(y)];
            mean += w * static_cast<double>(difference.pixel(x0 + x, y0 + y)[c]), weight += w;
        }
    }
    mean /= weight;
    Block re{}, im{};
    for (int y = 0; y < kSide; ++y) {
        for (int u = 0; u < kSide; ++u) {
            double a = 0, b = 0;
            for (int x = 0; x < kSide; ++x) {
                const double v = t.window[Table::idx(x)] *
                                 (static_cast<double>(difference.pixel(x0 + x, y0 + y)[c]) - mean);
                a += v * t.cosine[Table::idx(u)][Table::idx(x)];
                b -= v * t.sine[Table::idx(u)][Table::idx(x)];
            }
            re[Table::idx(y)][Table::idx(u)] = a * t.window[Table::idx(y)];
            im[Table::idx(y)][Table::idx(u)] = b * t.window[Table::idx(y)];
        }
    }
    std::array<double, GrainSpectrum::kBands> out{};
    for (int v = 0; v < kSide; ++v) {
        for (int u = 0; u < kSide; ++u) {
            double a = 0, b = 0;
            for (int y = 0; y < kSide; ++y) {
                const double cos = t.cosine[Table::idx(v)][Table::idx(y)],
                             sin = t.sine[Table::idx(v)][Table::idx(y)];
                a +=
                    re[Table::idx(y)][Table::idx(u)] * cos + im[Table::idx(y)][Table::idx(u)] * sin;
                b +=
                    im[Table::idx(y)][Table::idx(u)] * cos - re[Table::idx(y)][Table::idx(u)] * sin;
            }
            out[static_cast<std::size_t>(t.band[Table::idx(v)][Table::idx(u)])] += a * a + b * b;
        }
    }
    for (double& p : out)
        p /= kSide * kSide * t.window_energy;
    return out;
}

bool whole(ViewU8x1 visible, int x0, int y0) {
    for (int y = y0; y < y0 + kSide; ++y) {
        for (int x = x0; x < x0 + kSide; ++x) {
            if (visible.row(y)[x] == 0) return false;
        }
    }
    return true;
}

// Mean squared gradient of the picture under a small blur, which removes grain.
double steepness(const ImageF1& luma, int x0, int y0) {
    const auto mean = [&](int x, int y) {
        float sum = 0;
        for (int v = -1; v <= 1; ++v) {
            for (int u = -1; u <= 1; ++u)
                sum += luma.row(std::clamp(
                    y + v, 0, luma.height() - 1))[std::clamp(x + u, 0, luma.width() - 1)];
        }
        return static_cast<double>(sum) / 9;
    };
    double sum = 0;
    for (int y = y0; y < y0 + kSide; y += 2) {
        for (int x = x0; x < x0 + kSide; x += 2) {
            const double gx = mean(x + 1, y) - mean(x - 1, y), gy = mean(x, y + 1) - mean(x, y - 1);
            sum += gx * gx + gy * gy;
        }
    }
    return sum;
}

}  // namespace

void GrainSpectrumMeter::add(ViewF3 from, ViewF3 to, const FlowField& motion, ViewU8x1 visible,
                             bool forward) {
    ImageF3 difference(from.size());
    const float sign = forward ? -1.0f : 1.0f;  // later less earlier
    for (int c = 0; c < 3; ++c) {
        const ImageF1 there = moved(channel(to, c), motion);
        for (int y = 0; y < from.height(); ++y) {
            for (int x = 0; x < from.width(); ++x) {
                const float d = sign * 255.0f * (from.pixel(x, y)[c] - there.row(y)[x]);
                difference.pixel(x, y)[c] = std::isfinite(d) ? d : 0.0f;
            }
        }
    }
    const ImageF1 luma = luma_8bit(from);
    std::vector<Vec2i> places;
    for (int y = 0; y + kSide <= from.height(); y += kSide) {
        for (int x = 0; x + kSide <= from.width(); x += kSide) {
            if (whole(visible, x, y)) places.emplace_back(x, y);
        }
    }
    std::vector<Block> found(places.size());
    parallel_for(places.size(), [&](std::size_t k) {
        found[k].flatness = steepness(luma, places[k].x, places[k].y);
        for (int c = 0; c < 3; ++c)
            found[k].power[static_cast<std::size_t>(c)] =
                powers(difference, places[k].x, places[k].y, c);
    });
    blocks_.insert(blocks_.end(), found.begin(), found.end());

    // How this difference correlates with the one before, at one place of the surface.
    if (has_last_) {
        const ImageF3& other = forward ? difference : last_;
        const ImageF3& here = forward ? last_ : difference;
        const ViewU8x1 other_known = forward ? visible : last_known_.view();
        const ViewU8x1 here_known = forward ? last_known_.view() : visible;
        const FlowField& way = forward ? last_motion_ : motion;
        for (int y = 0; y < here.height(); ++y) {
            for (int x = 0; x < here.width(); ++x) {
                if (here_known.row(y)[x] == 0) continue;
                const int u =
                    static_cast<int>(std::floor(static_cast<float>(x) + 0.5f + way.d.at(x, y, 0)));
                const int v =
                    static_cast<int>(std::floor(static_cast<float>(y) + 0.5f + way.d.at(x, y, 1)));
                if (u < 0 || v < 0 || u >= other.width() || v >= other.height() ||
                    other_known.row(v)[u] == 0)
                    continue;
                for (int c = 0; c < 3; ++c) {
                    const double a = here.pixel(x, y)[c], b = other.pixel(u, v)[c];
                    cross_ += a * b, energy_a_ += a * a, energy_b_ += b * b;
                }
            }
        }
    }
    last_ = std::move(difference);
    last_known_ = Matte(visible.size());
    for (int y = 0; y < visible.height(); ++y)
        std::copy_n(visible.row(y), visible.width(), last_known_.row(y));
    last_motion_ = motion;
    has_last_ = true;
}

GrainSpectrum GrainSpectrumMeter::spectrum() const {
    GrainSpectrum out;
    if (blocks_.size() < kFewestBlocks) return out;
    std::vector<std::size_t> order(blocks_.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return blocks_[a].flatness != blocks_[b].flatness
                   ? blocks_[a].flatness < blocks_[b].flatness
                   : a < b;
    });
    order.resize(std::max(kFewestBlocks, static_cast<std::size_t>(
                                             kFlattestBlocks * static_cast<double>(order.size()))));
    out.blocks = static_cast<std::int64_t>(order.size());
    for (std::size_t c = 0; c < 3; ++c) {
        double all = 0;
        for (std::size_t b = 0; b < GrainSpectrum::kBands; ++b) {
            double sum = 0;
            for (const std::size_t k : order)
                sum += blocks_[k].power[c][b];
            // A difference contains the grain of two frames.
            const double power = 0.5 * sum / static_cast<double>(order.size());
            out.band[c][b] = std::sqrt(power);
            all += power;
        }
        out.deviation[c] = std::sqrt(all);
    }
    if (energy_a_ > 0 && energy_b_ > 0) out.correlation = cross_ / std::sqrt(energy_a_ * energy_b_);
    return out;
}

}  // namespace weft
