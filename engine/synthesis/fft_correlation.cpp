// Σ w·|C(p) − S(p−t)|² = Σ w·|C|² + Σ w(p)·|S(p−t)|² − 2 Σ w(p)·C(p)·S(p−t) over the pixels p that
// the sample reaches. The first sum is exact, from an integral image; the others are correlations.
// The sample's mean is subtracted from all values, which changes no difference and keeps errors
// small.

#include "engine/synthesis/fft_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/synthesis/scratch.h"

namespace weft {
namespace {

// Sums over rectangles of exact integers.
class Integral {
  public:
    explicit Integral(Size s)
        : width_(s.width + 1),
          sums_(static_cast<std::size_t>(s.width + 1) * static_cast<std::size_t>(s.height + 1), 0) {
    }
    void set_row(int y, const std::vector<std::uint64_t>& values) {
        std::uint64_t run = 0;
        std::uint64_t* out = &sums_[static_cast<std::size_t>(y + 1) * width_];
        const std::uint64_t* above = out - width_;
        for (std::size_t x = 0; x < values.size(); ++x) {
            run += values[x];
            out[x + 1] = above[x + 1] + run;
        }
    }
    [[nodiscard]] std::uint64_t sum(const Recti& r) const {
        return at(r.x1, r.y1) - at(r.x0, r.y1) - at(r.x1, r.y0) + at(r.x0, r.y0);
    }

  private:
    [[nodiscard]] std::uint64_t at(int x, int y) const {
        return sums_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
    }
    std::size_t width_;
    std::vector<std::uint64_t> sums_;
};

}  // namespace

// The Euclidean lengths of a block's weighted channels and weights, and the exact sums.
struct FftCorrelation::Weighted {
    std::array<double, 4> norms{};
    Integral weights, lengths;
};

FftCorrelation::FftCorrelation(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi)
    : sample_size_(sample.size()), block_(block), lo_(lo), hi_(hi) {
    // Circular wrap must not move a sample pixel over a block pixel that it does not reach.
    const auto size = [](int s, int b, int l, int h) {
        return fast_fft_size(std::max({b, s + std::max(h, 0), b - l}));
    };
    fft_ = std::make_unique<PlaneFft>(Size{size(sample.width(), block.width, lo.x, hi.x),
                                           size(sample.height(), block.height, lo.y, hi.y)});

    std::array<std::int64_t, 3> total{};
    for (int y = 0; y < sample.height(); ++y) {
        for (int i = 0; i < 3 * sample.width(); ++i) {
            total[static_cast<std::size_t>(i % 3)] += sample.row(y)[i];
        }
    }
    const auto area = static_cast<std::int64_t>(sample.width()) * sample.height();
    for (std::size_t c = 0; c < 3; ++c)
        mean_[c] = static_cast<int>(total[c] / area);

    std::vector<float> plane(static_cast<std::size_t>(area));
    for (std::size_t c = 0; c < 4; ++c) {
        float* out = plane.data();
        for (int y = 0; y < sample.height(); ++y) {
            for (int x = 0; x < sample.width(); ++x) {
                const std::uint8_t* p = sample.pixel(x, y);
                int v = 0;
                if (c < 3) {
                    v = p[c] - mean_[c];
                } else {
                    for (std::size_t k = 0; k < 3; ++k)
                        v += (p[k] - mean_[k]) * (p[k] - mean_[k]);
                }
                *out++ = static_cast<float>(v);
                norms_[c] += static_cast<double>(v) * v;
            }
        }
        norms_[c] = std::sqrt(norms_[c]);
        spectra_[c].resize(fft_->spectrum_size());
        fft_->forward_rows(plane.data(), sample_size_, spectra_[c].data());
        fft_->forward_columns(spectra_[c].data());
    }
}

FftCorrelation::~FftCorrelation() = default;

// Writes the channels and the weights to four planes of the block's size.
FftCorrelation::Weighted FftCorrelation::weigh(const MatchTarget& target, float* planes) const {
    Weighted out{{}, Integral(block_), Integral(block_)};
    const auto area =
        static_cast<std::size_t>(block_.width) * static_cast<std::size_t>(block_.height);
    std::vector<std::uint64_t> weight_row(static_cast<std::size_t>(block_.width));
    std::vector<std::uint64_t> length_row(weight_row.size());
    const bool guided = !target.guide.empty();
    for (int y = 0; y < block_.height; ++y) {
        float* row = planes + static_cast<std::size_t>(y) * weight_row.size();
        for (int x = 0; x < block_.width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            std::array<std::int64_t, 4> v{};  // Weighted channels, and the weight.
            std::uint64_t length = 0;
            const auto add = [&](const std::uint8_t* p, std::uint32_t w) {
                v[3] += w;
                for (std::size_t c = 0; c < 3; ++c) {
                    const int d = p[c] - mean_[c];
                    v[c] += static_cast<std::int64_t>(w) * d;
                    length += static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(d * d);
                }
            };
            if (target.filled.at(x, y)) add(target.pixels.pixel(x, y), target.fill_weight);
            if (guided && target.guide_known.at(x, y)) {
                add(target.guide.pixel(x, y), target.guide_weight);
            }
            weight_row[i] = static_cast<std::uint64_t>(v[3]);
            length_row[i] = length;
            for (std::size_t c = 0; c < 4; ++c) {
                row[c * area + i] = static_cast<float>(v[c]);
                out.norms[c] += static_cast<double>(v[c]) * static_cast<double>(v[c]);
            }
        }
        out.weights.set_row(y, weight_row);
        out.lengths.set_row(y, length_row);
    }
    for (double& n : out.norms)
        n = std::sqrt(n);
    return out;
}

// w ⋆ |S|² − 2 Σ w·C ⋆ S at the requested translations, in the layout of PlaneFft::backward_rows().
void FftCorrelation::correlate(const float* planes, float* out) const {
    const std::size_t size = fft_->spectrum_size();
    const auto area =
        static_cast<std::size_t>(block_.width) * static_cast<std::size_t>(block_.height);
    Scratch<std::vector<FftLanes>> rows(4 * size);
    std::array<PlaneFft::Product, 4> products{};
    for (std::size_t c = 0; c < 4; ++c) {
        FftLanes* to = (*rows).data() + c * size;
        fft_->forward_rows(planes + c * area, block_, to);
        products[c] = {to, spectra_[c].data(), c < 3 ? -2.0f : 1.0f};
    }
    FftLanes* sum = (*rows).data();
    fft_->correlate(products, sum);
    const int height = fft_->size().height;
    if (lo_.y < 0) fft_->backward_rows(sum, lo_.y + height, std::min(hi_.y, -1) + 1 + height, out);
    if (hi_.y >= 0) fft_->backward_rows(sum, std::max(lo_.y, 0), hi_.y + 1, out);
}

// A convolution by FFT of size N is off by at most ‖a‖‖b‖·((1+u)^3n·(1+u√5)^(3n+1)·(1+μ)^3n − 1),
// n = log2 N, u = 2^-24 (Brent, Percival & Zimmermann 2007, theorem 5.1), below 14·(n+1)·u for
// μ ≤ u. That is for radix 2; docs/decisions/0008-fft.md says why the factor 4 covers radices 3 to
// 5, the split of real rows, the rounding of inputs and the sum over four products.
double FftCorrelation::error_bound(const Weighted& block) const {
    const double points = static_cast<double>(fft_->size().width) * fft_->size().height;
    double size = block.norms[3] * norms_[3];
    for (std::size_t c = 0; c < 3; ++c)
        size += 2 * block.norms[c] * norms_[c];
    return 4 * 14 * (std::log2(points) + 1) * 0x1.0p-24 * size + 1.0;
}

FftCorrelation::Estimate FftCorrelation::estimate(const MatchTarget& target) const {
    const Size fft = fft_->size();
    const std::size_t stride = fft_->row_stride();
    Scratch<std::vector<float>> values(stride * static_cast<std::size_t>(fft_->padded_height()));
    Scratch<std::vector<float>> planes(4 * static_cast<std::size_t>(block_.width) *
                                       static_cast<std::size_t>(block_.height));
    const Weighted block = weigh(target, (*planes).data());
    correlate((*planes).data(), (*values).data());

    Estimate out;
    out.error = error_bound(block);
    const float scale = 1.0f / (4 * static_cast<float>(fft.width) * static_cast<float>(fft.height));
    const Recti all = rect_of(block_);
    for (int ty = lo_.y; ty <= hi_.y; ++ty) {
        const int row = ty < 0 ? ty + fft.height : ty;
        const float* at = (*values).data() + static_cast<std::size_t>(row) * stride;
        for (int tx = lo_.x; tx <= hi_.x; ++tx) {
            const Recti reach =
                all.intersected({tx, ty, tx + sample_size_.width, ty + sample_size_.height});
            const double fixed = reach.empty() ? 0 : static_cast<double>(block.lengths.sum(reach));
            out.weight.push_back(reach.empty() ? 0 : block.weights.sum(reach));
            out.ssd.push_back(fixed +
                              static_cast<double>(at[tx < 0 ? tx + fft.width : tx] * scale));
        }
    }
    return out;
}

}  // namespace weft
