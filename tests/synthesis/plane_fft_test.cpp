// The transforms against the definition in double precision, within the error that the placement
// search counts on.

#include "engine/synthesis/plane_fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/isa.h"
#include "engine/core/rng.h"

namespace weft::test {
namespace {

using Complex = std::complex<double>;

// The transform of one line by its definition.
std::vector<Complex> transform(const std::vector<Complex>& in) {
    const std::size_t n = in.size();
    std::vector<Complex> roots(n), out(n);
    for (std::size_t k = 0; k < n; ++k)
        roots[k] = std::polar(
            1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j)
            out[k] += in[j] * roots[k * j % n];
    }
    return out;
}

// Of a real plane, [ky][kx].
std::vector<std::vector<Complex>> transform(const std::vector<float>& plane, Size filled,
                                            Size size) {
    const auto w = static_cast<std::size_t>(size.width), h = static_cast<std::size_t>(size.height);
    std::vector<std::vector<Complex>> out(h, std::vector<Complex>(w));
    for (std::size_t y = 0; y < static_cast<std::size_t>(filled.height); ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(filled.width); ++x)
            out[y][x] = static_cast<double>(plane[y * static_cast<std::size_t>(filled.width) + x]);
        out[y] = transform(out[y]);
    }
    for (std::size_t x = 0; x < w; ++x) {
        std::vector<Complex> column(h);
        for (std::size_t y = 0; y < h; ++y)
            column[y] = out[y][x];
        column = transform(column);
        for (std::size_t y = 0; y < h; ++y)
            out[y][x] = column[y];
    }
    return out;
}

std::vector<float> noise(Size size, std::uint64_t seed) {
    Rng rng(seed);
    std::vector<float> out(static_cast<std::size_t>(size.width) *
                           static_cast<std::size_t>(size.height));
    for (float& v : out)
        v = static_cast<float>(rng.below(511)) - 255.0f;
    return out;
}

double norm(const std::vector<float>& v) {
    double sum = 0;
    for (const float x : v)
        sum += static_cast<double>(x) * static_cast<double>(x);
    return std::sqrt(sum);
}

// What error_bound() of the placement search is made of, without its factor of safety.
double radix_two_bound(Size size) {
    return 14 * (std::log2(static_cast<double>(size.width) * size.height) + 1) * 0x1.0p-24;
}

// All radices, their products, rows longer than columns and the reverse, the shortest there are.
const std::vector<Size> kSizes{{4, 4},    {4, 6},    {6, 10},   {8, 8},   {10, 4},   {16, 32},
                               {18, 54},  {30, 250}, {50, 20},  {64, 96}, {90, 150}, {120, 128},
                               {240, 18}, {16, 486}, {1280, 4}, {4, 1250}};

TEST(PlaneFft, SizesHaveSmallFactorsOnly) {
    for (int n = 1; n < 3000; ++n) {
        const int size = fast_fft_size(n);
        ASSERT_GE(size, std::max(n, 4));
        ASSERT_EQ(size % 2, 0);
        int rest = size;
        for (const int f : {2, 3, 5}) {
            while (rest % f == 0)
                rest /= f;
        }
        ASSERT_EQ(rest, 1) << size;
        ASSERT_LE(size, 1.2 * n + 4) << size;
    }
}

TEST(PlaneFft, IsTheTransformByItsDefinition) {
    for (const Size size : kSizes) {
        for (const Size filled : {size, Size{(size.width + 1) / 2, (2 * size.height + 2) / 3}}) {
            const std::vector<float> plane = noise(filled, 3);
            const auto truth = transform(plane, filled, size);
            const PlaneFft fft(size);
            std::vector<FftLanes> spectrum(fft.spectrum_size());
            fft.forward_rows(plane.data(), filled, spectrum.data());
            fft.forward_columns(spectrum.data());
            double error = 0, whole = 0;
            for (std::size_t ky = 0; ky < truth.size(); ++ky) {
                for (std::size_t kx = 0; kx <= truth[ky].size() / 2; ++kx) {
                    const FftLanes& at =
                        spectrum[kx / kFftLanes * static_cast<std::size_t>(fft.padded_height()) +
                                 ky];
                    const Complex found(static_cast<double>(at.re[kx % kFftLanes]),
                                        static_cast<double>(at.im[kx % kFftLanes]));
                    error += std::norm(found / 2.0 - truth[ky][kx]);
                    whole += std::norm(truth[ky][kx]);
                }
            }
            // A third of the bound each for two transforms forwards and one backwards.
            EXPECT_LE(std::sqrt(error / whole), radix_two_bound(size) / 3)
                << size.width << "x" << size.height;
            EXPECT_GT(whole, 0);
        }
    }
}

TEST(PlaneFft, CorrelatesByDefinition) {
    for (const Size size : kSizes) {
        const Size small{(size.width + 2) / 3, (size.height + 1) / 2};
        const std::vector<float> a = noise(small, 5), b = noise(size, 6);
        const PlaneFft fft(size);
        std::vector<FftLanes> rows(fft.spectrum_size()), spectrum(fft.spectrum_size());
        fft.forward_rows(a.data(), small, rows.data());
        fft.forward_rows(b.data(), size, spectrum.data());
        fft.forward_columns(spectrum.data());
        const PlaneFft::Product product{rows.data(), spectrum.data(), -2.0f};
        fft.correlate({&product, 1}, rows.data());
        std::vector<float> out(fft.row_stride() * static_cast<std::size_t>(fft.padded_height()));
        const int first = size.height / 3;
        fft.backward_rows(rows.data(), first, size.height, out.data());
        double worst = 0;
        Rng rng(7);
        for (int i = 0; i < 60; ++i) {
            const int tx = static_cast<int>(rng.below(static_cast<std::uint32_t>(size.width)));
            const int ty = first + static_cast<int>(
                                       rng.below(static_cast<std::uint32_t>(size.height - first)));
            double truth = 0;  // Σ a(p)·b(p − t), round the borders.
            for (int y = 0; y < small.height; ++y) {
                for (int x = 0; x < small.width; ++x) {
                    const int bx = (x - tx + size.width) % size.width;
                    const int by = (y - ty + size.height) % size.height;
                    truth += static_cast<double>(a[static_cast<std::size_t>(y * small.width + x)]) *
                             static_cast<double>(b[static_cast<std::size_t>(by * size.width + bx)]);
                }
            }
            const double found =
                static_cast<double>(out[static_cast<std::size_t>(ty) * fft.row_stride() +
                                        static_cast<std::size_t>(tx)]) /
                (4.0 * size.width * size.height);
            worst = std::max(worst, std::abs(found + 2 * truth));
        }
        EXPECT_LE(worst, 2 * radix_two_bound(size) * norm(a) * norm(b))
            << size.width << "x" << size.height;
    }
}

TEST(PlaneFft, GivesTheSameBitsWithEveryInstructionSet) {
    for (const Size size : kSizes) {
        const Size filled{size.width - 1, size.height - 2};
        const std::vector<float> plane = noise(filled, 9);
        const PlaneFft fft(size);
        std::vector<float> first;
        for (const Isa isa : {Isa::kScalar, Isa::kAvx2, Isa::kAvx512}) {
            if (!isa_available(isa)) continue;
            force_isa(isa);
            std::vector<FftLanes> rows(fft.spectrum_size());
            fft.forward_rows(plane.data(), filled, rows.data());
            std::vector<FftLanes> spectrum = rows;
            fft.forward_columns(spectrum.data());
            const std::array<PlaneFft::Product, 2> products{
                {{rows.data(), spectrum.data(), 1.0f}, {spectrum.data(), spectrum.data(), -2.0f}}};
            fft.correlate(products, rows.data());
            std::vector<float> out(fft.row_stride() *
                                   static_cast<std::size_t>(fft.padded_height()));
            fft.backward_rows(rows.data(), 0, size.height, out.data());
            std::vector<float> inside;
            for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y) {
                for (std::size_t x = 0; x < static_cast<std::size_t>(size.width); ++x)
                    inside.push_back(out[y * fft.row_stride() + x]);
            }
            if (first.empty()) first = inside;
            EXPECT_EQ(inside, first) << isa_name(isa);
        }
        force_isa(std::nullopt);
    }
}

}  // namespace
}  // namespace weft::test
