#include "engine/composite/grain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/composite/moving_light.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr int kReach = GrainModel::kRadius;
constexpr int kBins = GrainModel::kBins;
constexpr float kFlatShare = 0.35f;   // of pixels, those of least gradient
constexpr std::size_t kFewest = 400;  // flat pixels
constexpr std::size_t kFewestInBin = 100;
constexpr double kLeastDeviation = 0.35 / 255;  // less is not seen
constexpr double kMostDeviation = 0.1;          // more is no grain
constexpr double kMostOfUsual = 2.5;            // grain of one luma beside that of all
constexpr double kLeastShare = 0.25;  // of the flat pixels' difference that must not be motion

float luma_of(const float* p) {
    return 0.299f * p[0] + 0.587f * p[1] + 0.114f * p[2];
}

// Catmull-Rom weights (Keys 1981, a = -1/2).
std::array<float, 4> cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (-t + 2 * t2 - t3), 0.5f * (2 - 5 * t2 + 3 * t3), 0.5f * (t + 4 * t2 - 3 * t3),
            0.5f * (t3 - t2)};
}

struct Lookup {
    std::array<float, 3> value{};
    float gain = 0;  // sum of squared weights
    bool known = false;
};

Lookup look_up(ViewF3 picture, ViewU8x1 visible, float x, float y) {
    Lookup out;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    if (i < 1 || j < 1 || i + 2 >= picture.width() || j + 2 >= picture.height()) return out;
    const auto wx = cubic(x - static_cast<float>(i)), wy = cubic(y - static_cast<float>(j));
    float squares_x = 0, squares_y = 0;
    for (int b = 0; b < 4; ++b) {
        squares_x += wx[static_cast<std::size_t>(b)] * wx[static_cast<std::size_t>(b)];
        squares_y += wy[static_cast<std::size_t>(b)] * wy[static_cast<std::size_t>(b)];
        for (int a = 0; a < 4; ++a) {
            const int u = i - 1 + a, v = j - 1 + b;
            if (visible.row(v)[u] != 255) return out;
            const float w = wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)];
            const float* p = picture.pixel(u, v);
            for (std::size_t c = 0; c < 3; ++c)
                out.value[c] += w * p[c];
        }
    }
    out.gain = squares_x * squares_y;
    out.known = std::isfinite(out.value[0] + out.value[1] + out.value[2]);
    return out;
}

// Mean of 5×5 lumas: what noise there is in it is a fifth.
float local_luma(ViewF3 picture, int x, int y) {
    float sum = 0;
    for (int v = -2; v <= 2; ++v) {
        for (int u = -2; u <= 2; ++u)
            sum += luma_of(picture.pixel(x + u, y + v));
    }
    return sum / 25.0f;
}

int bin_of(float luma) {
    return std::clamp(static_cast<int>(luma * kBins), 0, kBins - 1);
}

// The kernel whose autocorrelation is `acf` (centre 1): the root of its power spectrum, negative
// power taken as none, back in space.
std::array<float, GrainModel::kSide * GrainModel::kSide> kernel_of(
    const std::array<double, GrainModel::kSide * GrainModel::kSide>& acf) {
    constexpr int kSize = 16, kSide = GrainModel::kSide;
    std::array<std::array<double, kSize>, kSize> root{};
    // Long double: see docs/decisions/0002-determinism.md.
    const auto cosine = [](int a) {
        return static_cast<double>(std::cos(2 * std::numbers::pi_v<long double> * a / kSize));
    };
    for (int v = 0; v < kSize; ++v) {
        for (int u = 0; u < kSize; ++u) {
            double power = 0;
            for (int y = -kReach; y <= kReach; ++y) {
                for (int x = -kReach; x <= kReach; ++x) {
                    // A taper, or the cut at the reach would ring.
                    const double r2 =
                        static_cast<double>(x * x + y * y) / (kReach * kReach + kReach);
                    const double taper = std::max(0.0, 1 - r2 * r2);
                    power += taper * cosine(u * x + v * y) *
                             acf[static_cast<std::size_t>((y + kReach) * kSide + x + kReach)];
                }
            }
            root[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] =
                std::sqrt(std::max(0.0, power));
        }
    }
    std::array<float, kSide * kSide> kernel{};
    double energy = 0;
    for (int y = -kReach; y <= kReach; ++y) {
        for (int x = -kReach; x <= kReach; ++x) {
            double sum = 0;
            for (int v = 0; v < kSize; ++v) {
                for (int u = 0; u < kSize; ++u)
                    sum += root[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] *
                           cosine(u * x + v * y);
            }
            kernel[static_cast<std::size_t>((y + kReach) * kSide + x + kReach)] =
                static_cast<float>(sum);
            energy += sum * sum;
        }
    }
    for (float& k : kernel)
        k = static_cast<float>(k / std::sqrt(std::max(energy, 1e-30)));
    return kernel;
}

// A random number of deviation 1 for a pixel and channel of the plate: the sum of four uniform ones
// is normal enough, and needs no function whose last bit may differ between machines.
float normal(std::uint64_t key, int x, int y, int channel) {
    const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                       static_cast<std::uint32_t>(y);
    const std::uint64_t bits =
        mix64(mix64(key ^ mix64(place)) + static_cast<std::uint64_t>(channel));
    std::uint32_t sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += static_cast<std::uint32_t>((bits >> (16 * k)) & 0xffff);
    constexpr float kMean = 4 * 32767.5f, kDeviation = 37837.2f;  // 2 · 65536 / √12
    return (static_cast<float>(sum) - kMean) / kDeviation;
}

}  // namespace

bool GrainModel::present() const {
    for (const auto& channel : deviation) {
        for (const float d : channel) {
            if (d > 0) return true;
        }
    }
    return false;
}

void GrainMeter::add(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible,
                     ViewF2 prev_from_cur) {
    const Size size = current.size();
    ImageF3 difference(size);
    Matte known(size);
    ImageF1 gradient2(size), luma(size), gain(size);
    parallel_rows(size.height, 8, [&](int y0, int y1) {
        for (int y = std::max(4, y0); y < std::min(size.height - 4, y1); ++y) {
            for (int x = 4; x < size.width - 4; ++x) {
                // Wholly inside, so that nothing of another object is in the difference.
                if (visible.row(y)[x] != 255 || visible.row(y - 4)[x] != 255 ||
                    visible.row(y + 4)[x] != 255 || visible.row(y)[x - 4] != 255 ||
                    visible.row(y)[x + 4] != 255)
                    continue;
                const float* d = prev_from_cur.pixel(x, y);
                const Lookup before =
                    look_up(previous, previous_visible, static_cast<float>(x) + d[0],
                            static_cast<float>(y) + d[1]);
                const float* p = current.pixel(x, y);
                if (!before.known || !std::isfinite(p[0] + p[1] + p[2])) continue;
                const float gx =
                    0.5f * (local_luma(current, x + 1, y) - local_luma(current, x - 1, y));
                const float gy =
                    0.5f * (local_luma(current, x, y + 1) - local_luma(current, x, y - 1));
                if (!std::isfinite(gx + gy)) continue;
                for (std::size_t c = 0; c < 3; ++c)
                    difference.pixel(x, y)[c] = p[c] - before.value[c];
                gradient2.row(y)[x] = gx * gx + gy * gy;
                luma.row(y)[x] = luma_of(p);
                gain.row(y)[x] = 1.0f + before.gain;
                known.row(y)[x] = 255;
            }
        }
    });
    std::vector<float> gradients;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (known.row(y)[x]) gradients.push_back(gradient2.row(y)[x]);
        }
    }
    if (gradients.size() < kFewest) return;
    const auto at = gradients.begin() +
                    static_cast<std::ptrdiff_t>(kFlatShare * static_cast<float>(gradients.size()));
    std::nth_element(gradients.begin(), at, gradients.end());
    const float flat = *at;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (gradient2.row(y)[x] > flat) known.row(y)[x] = 0;
        }
    }
    const std::vector<float> variances = leave_out_moving_light(difference, known);
    block_variances_.insert(block_variances_.end(), variances.begin(), variances.end());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (!known.row(y)[x]) continue;
            const float* d = difference.pixel(x, y);
            pixels_.push_back(
                {{d[0], d[1], d[2]}, gradient2.row(y)[x], luma.row(y)[x], gain.row(y)[x]});
            for (int v = -kReach; v <= kReach; ++v) {
                for (int u = -kReach; u <= kReach; ++u) {
                    const int nx = x + u, ny = y + v;
                    if (!known.row(ny)[nx]) continue;
                    const auto lag = static_cast<std::size_t>((v + kReach) * kLags + u + kReach);
                    lag_counts_[lag] += 1;
                    for (std::size_t c = 0; c < 3; ++c)
                        lag_sums_[c][lag] +=
                            static_cast<double>(d[c]) * difference.pixel(nx, ny)[c];
                }
            }
        }
    }
}

GrainModel GrainMeter::model() const {
    GrainModel model;
    const std::size_t n = pixels_.size();
    if (n < kFewest || block_variances_.empty()) return model;
    // Squared difference = grain · gain + motion · gradient²: a line for each channel.
    std::array<double, 3> motion{}, grain{};
    std::array<double, 3> all{};
    double mean_g = 0, mean_gain = 0, gg = 0;
    for (const Pixel& p : pixels_)
        mean_g += p.gradient2, mean_gain += p.gain;
    mean_g /= static_cast<double>(n), mean_gain /= static_cast<double>(n);
    for (const Pixel& p : pixels_)
        gg += (p.gradient2 - mean_g) * (p.gradient2 - mean_g);
    for (std::size_t c = 0; c < 3; ++c) {
        double cross = 0;
        for (const Pixel& p : pixels_) {
            const double square = static_cast<double>(p.difference[c]) * p.difference[c];
            all[c] += square / static_cast<double>(n);
            cross += (p.gradient2 - mean_g) * square;
        }
        motion[c] = gg > 0 ? std::max(0.0, cross / gg) : 0.0;
        grain[c] = (all[c] - motion[c] * mean_g) / mean_gain -
                   static_cast<double>(quantum_) * quantum_ / 12;
    }
    const double most = std::max({grain[0], grain[1], grain[2]});
    // Grain is everywhere. A texture under light that moves, or what is followed badly, differs as
    // finely, but not in most places.
    std::vector<float> variances = block_variances_;
    const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
    std::nth_element(variances.begin(), middle, variances.end());
    const double usual = *middle / mean_gain - static_cast<double>(quantum_) * quantum_ / 12;
    const bool seen = usual > kLeastDeviation * kLeastDeviation &&
                      most > kLeastDeviation * kLeastDeviation &&
                      most < kMostDeviation * kMostDeviation &&
                      most * mean_gain > kLeastShare * std::max({all[0], all[1], all[2]});
    if (!seen) return model;

    const double most_in_bin = kMostOfUsual * kMostOfUsual * usual;
    std::array<std::array<double, 3>, 3> together{};
    std::array<std::array<double, kBins>, 3> sums{};
    std::array<std::size_t, kBins> counts{};
    for (const Pixel& p : pixels_) {
        const auto bin = static_cast<std::size_t>(bin_of(p.luma));
        ++counts[bin];
        for (std::size_t c = 0; c < 3; ++c) {
            const double square = static_cast<double>(p.difference[c]) * p.difference[c];
            sums[c][bin] += (square - motion[c] * p.gradient2) / p.gain -
                            static_cast<double>(quantum_) * quantum_ / 12;
            for (std::size_t e = 0; e <= c; ++e)
                together[c][e] += static_cast<double>(p.difference[c]) * p.difference[e];
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t b = 0; b < kBins; ++b) {
            const double mean = std::max(0.0, grain[c]);
            // Few pixels: mostly the mean over all lumas.
            const double weight =
                static_cast<double>(counts[b]) / static_cast<double>(counts[b] + kFewestInBin);
            const double own = counts[b] > 0 ? sums[c][b] / static_cast<double>(counts[b]) : mean;
            model.deviation[c][b] = static_cast<float>(
                std::sqrt(std::clamp(weight * own + (1 - weight) * mean, 0.0, most_in_bin)));
        }
        auto acf = lag_sums_[c];
        for (std::size_t k = 0; k < acf.size(); ++k)
            acf[k] = lag_counts_[k] > 0 ? acf[k] / lag_counts_[k] : 0.0;
        const double centre = std::max(acf[acf.size() / 2], 1e-30);
        for (double& a : acf)
            a /= centre;
        model.kernel[c] = kernel_of(acf);
    }
    const auto correlation = [&](std::size_t a, std::size_t b) {
        return std::clamp(
            together[a][b] / std::sqrt(std::max(1e-30, together[a][a] * together[b][b])), -0.99,
            0.99);
    };
    const double gr = correlation(1, 0), br = correlation(2, 0), bg = correlation(2, 1);
    const double g1 = std::sqrt(1 - gr * gr);
    const double b1 = (bg - br * gr) / g1;
    const double b2 = std::sqrt(std::max(0.0, 1 - br * br - b1 * b1));
    model.mix = {1,
                 static_cast<float>(gr),
                 static_cast<float>(g1),
                 static_cast<float>(br),
                 static_cast<float>(b1),
                 static_cast<float>(b2)};
    return model;
}

void add_grain(ImageView<float, 3> display, ViewU8x1 matte, Vec2i origin, const GrainModel& model,
               float strength, std::uint64_t key) {
    if (!model.present() || !(strength > 0) || display.empty()) return;
    constexpr int kSide = GrainModel::kSide;
    const int width = display.width() + 2 * kReach;
    parallel_rows(display.height(), 16, [&](int y0, int y1) {
        ImageF3 white(width, y1 - y0 + 2 * kReach);
        for (int y = 0; y < white.height(); ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    white.pixel(x, y)[c] =
                        normal(key, origin.x + x - kReach, origin.y + y0 + y - kReach, c);
                }
            }
        }
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < display.width(); ++x) {
                if (matte.row(y)[x] == 0) continue;
                std::array<float, 3> shaped{};
                for (int v = 0; v < kSide; ++v) {
                    const float* w = white.pixel(x, y - y0 + v);
                    for (int u = 0; u < kSide; ++u, w += 3) {
                        const auto k = static_cast<std::size_t>(v * kSide + u);
                        for (std::size_t c = 0; c < 3; ++c)
                            shaped[c] += model.kernel[c][k] * w[c];
                    }
                }
                const auto& m = model.mix;
                const std::array<float, 3> mixed{
                    m[0] * shaped[0], m[1] * shaped[0] + m[2] * shaped[1],
                    m[3] * shaped[0] + m[4] * shaped[1] + m[5] * shaped[2]};
                float* p = display.pixel(x, y);
                const float at =
                    std::clamp(luma_of(p) * kBins - 0.5f, 0.0f, static_cast<float>(kBins) - 1.0f);
                const auto b = static_cast<std::size_t>(at);
                const std::size_t next = std::min<std::size_t>(b + 1, kBins - 1);
                const float t = at - static_cast<float>(b);
                for (std::size_t c = 0; c < 3; ++c) {
                    const float deviation = model.deviation[c][b] +
                                            t * (model.deviation[c][next] - model.deviation[c][b]);
                    p[c] += strength * deviation * mixed[c];
                }
            }
        }
    });
}

}  // namespace weft
