// Σ w·|C(p) − S(p−t)|² = Σ w·|C|² + Σ w(p)·|S(p−t)|² − 2 Σ w(p)·C(p)·S(p−t) over the pixels p that
// the sample reaches. The first sum is exact, from an integral image; the others are correlations.
// All values are taken less the sample's mean, which changes no difference and keeps errors small.

#include "engine/synthesis/fft_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/synthesis/fftw_memory.h"

namespace weft {
namespace {

using Floats = FftwFloats;

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

struct FftCorrelation::Plans {
    FftwPlan forward, backward;
    std::size_t padded_row = 0, count = 0;  ///< Floats of an in-place row, of the whole.

    explicit Plans(Size fft)
        : padded_row(2 * static_cast<std::size_t>(fft.width / 2 + 1)),
          count(padded_row * static_cast<std::size_t>(fft.height)) {
        const Floats work = make_fftw_floats(count);
        auto* spectrum = reinterpret_cast<fftwf_complex*>(work.get());
        forward = make_fftw_plan([&] {
            return fftwf_plan_dft_r2c_2d(fft.height, fft.width, work.get(), spectrum,
                                         FFTW_ESTIMATE);
        });
        backward = make_fftw_plan([&] {
            return fftwf_plan_dft_c2r_2d(fft.height, fft.width, spectrum, work.get(),
                                         FFTW_ESTIMATE);
        });
    }
    void run_forward(float* data) const {
        fftwf_execute_dft_r2c(forward.get(), data, reinterpret_cast<fftwf_complex*>(data));
    }
    void run_backward(float* data) const {
        fftwf_execute_dft_c2r(backward.get(), reinterpret_cast<fftwf_complex*>(data), data);
    }
};

// A block's weighted channels and weights as floats, their Euclidean lengths, and the exact sums.
struct FftCorrelation::Weighted {
    std::vector<Spectrum> data;
    std::array<double, 4> norms{};
    Integral weights, lengths;
};

FftCorrelation::FftCorrelation(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi)
    : sample_size_(sample.size()), block_(block), lo_(lo), hi_(hi) {
    // Circular wrap must not bring a sample pixel over a block pixel that it does not reach.
    const auto size = [](int s, int b, int l, int h) {
        return fast_fft_size(std::max({b, s + std::max(h, 0), b - l}));
    };
    fft_ = {size(sample.width(), block.width, lo.x, hi.x),
            size(sample.height(), block.height, lo.y, hi.y)};
    plans_ = std::make_unique<Plans>(fft_);

    std::array<std::int64_t, 3> total{};
    for (int y = 0; y < sample.height(); ++y) {
        for (int i = 0; i < 3 * sample.width(); ++i) {
            total[static_cast<std::size_t>(i % 3)] += sample.row(y)[i];
        }
    }
    const auto area = static_cast<std::int64_t>(sample.width()) * sample.height();
    for (std::size_t c = 0; c < 3; ++c)
        mean_[c] = static_cast<int>(total[c] / area);

    for (std::size_t c = 0; c < 4; ++c) {
        Floats data = make_fftw_floats(plans_->count);
        std::fill_n(data.get(), plans_->count, 0.0f);
        for (int y = 0; y < sample.height(); ++y) {
            float* out = data.get() + static_cast<std::size_t>(y) * plans_->padded_row;
            for (int x = 0; x < sample.width(); ++x) {
                const std::uint8_t* p = sample.pixel(x, y);
                int v = 0;
                if (c < 3) {
                    v = p[c] - mean_[c];
                } else {
                    for (std::size_t k = 0; k < 3; ++k)
                        v += (p[k] - mean_[k]) * (p[k] - mean_[k]);
                }
                out[x] = static_cast<float>(v);
                norms_[c] += static_cast<double>(v) * v;
            }
        }
        norms_[c] = std::sqrt(norms_[c]);
        plans_->run_forward(data.get());
        spectra_.push_back(std::move(data));
    }
}

FftCorrelation::~FftCorrelation() = default;

FftCorrelation::Weighted FftCorrelation::weigh(const MatchTarget& target) const {
    Weighted out{{}, {}, Integral(block_), Integral(block_)};
    for (int c = 0; c < 4; ++c) {
        out.data.push_back(make_fftw_floats(plans_->count));
        std::fill_n(out.data.back().get(), plans_->count, 0.0f);
    }
    std::vector<std::uint64_t> weight_row(static_cast<std::size_t>(block_.width));
    std::vector<std::uint64_t> length_row(weight_row.size());
    const bool guided = !target.guide.empty();
    for (int y = 0; y < block_.height; ++y) {
        const std::size_t base = static_cast<std::size_t>(y) * plans_->padded_row;
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
            if (v[3] == 0) continue;
            for (std::size_t c = 0; c < 4; ++c) {
                out.data[c][base + i] = static_cast<float>(v[c]);
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

// F(w)·conj(F(|S|²)) − 2 Σ F(w·C)·conj(F(S)) and back, in data[0].
void FftCorrelation::correlate(std::vector<Spectrum>& data) const {
    for (const Floats& d : data)
        plans_->run_forward(d.get());
    for (std::size_t i = 0; i < plans_->count; i += 2) {
        float re = 0, im = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const float ar = data[c][i], ai = data[c][i + 1];
            const float br = spectra_[c][i], bi = spectra_[c][i + 1];
            const float k = c < 3 ? -2.0f : 1.0f;
            re += k * (ar * br + ai * bi);
            im += k * (ai * br - ar * bi);
        }
        data[0][i] = re;
        data[0][i + 1] = im;
    }
    plans_->run_backward(data[0].get());
}

FftCorrelation::Estimate FftCorrelation::estimate(const MatchTarget& target) const {
    Weighted block = weigh(target);
    correlate(block.data);

    Estimate out;
    // A convolution by FFT of size N is off by at most ‖a‖‖b‖·((1+u)^3n·(1+u√5)^(3n+1)·(1+μ)^3n −
    // 1), n = log2 N, u = 2^-24 (Brent, Percival & Zimmermann 2007, theorem 5.1), below 14·(n+1)·u
    // for μ ≤ u. That is for radix 2; the factor 4 covers FFTW's mixed radices, the rounding of
    // inputs and of the sum over four products.
    const double points = static_cast<double>(fft_.width) * fft_.height;
    double size = block.norms[3] * norms_[3];
    for (std::size_t c = 0; c < 3; ++c)
        size += 2 * block.norms[c] * norms_[c];
    out.error = 4 * 14 * (std::log2(points) + 1) * 0x1.0p-24 * size + 1.0;

    const float scale = 1.0f / static_cast<float>(points);
    const Recti all = rect_of(block_);
    for (int ty = lo_.y; ty <= hi_.y; ++ty) {
        const int row = ty < 0 ? ty + fft_.height : ty;
        const float* values =
            block.data[0].get() + static_cast<std::size_t>(row) * plans_->padded_row;
        for (int tx = lo_.x; tx <= hi_.x; ++tx) {
            const Recti reach =
                all.intersected({tx, ty, tx + sample_size_.width, ty + sample_size_.height});
            const double fixed = reach.empty() ? 0 : static_cast<double>(block.lengths.sum(reach));
            out.weight.push_back(reach.empty() ? 0 : block.weights.sum(reach));
            out.ssd.push_back(fixed +
                              static_cast<double>(values[tx < 0 ? tx + fft_.width : tx] * scale));
        }
    }
    return out;
}

}  // namespace weft
