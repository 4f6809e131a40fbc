#include "engine/synthesis/plane_fft.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "engine/core/isa.h"
#include "engine/synthesis/fft_line.h"
#include "engine/synthesis/scratch.h"

namespace weft {

struct FftTables {
    FftLine row, column;                 // A row of w real values is one of w/2 complex ones.
    std::vector<FftTwiddle> real_roots;  // exp(−2πi·k/w) for k from 0 to w/4.
    int padded_height = 0;
    int batches = 0;  // Of 16 columns.
};

namespace {

constexpr auto kLanes = static_cast<std::size_t>(kFftLanes);
using Buffer = std::vector<FftLanes>;
using Tile = std::array<float, kLanes * kLanes>;

// In long double, which is the same on every processor (docs/decisions/0002-determinism.md).
FftTwiddle root_of_unity(std::int64_t numerator, std::int64_t denominator) {
    const long double angle = -2 * std::numbers::pi_v<long double> *
                              static_cast<long double>(numerator % denominator) /
                              static_cast<long double>(denominator);
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

FftLine make_line(int length) {
    FftLine line;
    line.length = length;
    int stride = 1;
    for (const int radix : {4, 2, 3, 5}) {
        while (length / stride % radix == 0) {
            const int rest = length / stride;
            line.passes.push_back({radix, rest / radix, stride, line.twiddles.size()});
            for (int p = 0; p < rest / radix; ++p) {
                for (int k = 1; k < radix; ++k)
                    line.twiddles.push_back(root_of_unity(std::int64_t{k} * p, rest));
            }
            stride *= radix;
        }
    }
    return line;
}

std::size_t up_to_lanes(std::size_t n) {
    return (n + kLanes - 1) / kLanes * kLanes;
}

// Row y, column x → row x, column y.
WEFT_FFT_INLINE void transpose(const float* in, std::size_t in_stride, float* out,
                               std::size_t out_stride) {
    using V = FourFloats::V;
    for (std::size_t y = 0; y < kLanes; y += 4) {
        for (std::size_t x = 0; x < kLanes; x += 4) {
            V r[4];
            for (std::size_t i = 0; i < 4; ++i)
                std::memcpy(&r[i], in + (y + i) * in_stride + x, sizeof(V));
            const V a = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
            const V b = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
            const V c = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
            const V d = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
            r[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
            r[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
            r[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
            r[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
            for (std::size_t i = 0; i < 4; ++i)
                std::memcpy(out + (x + i) * out_stride + y, &r[i], sizeof(V));
        }
    }
}

struct ForwardRows {
    const FftTables& tables;
    const float* plane;
    Size filled;
    FftLanes* out;

    // Sixteen rows from y on: lane i of element x/2 holds pixel (x, y + i), even x as real parts.
    WEFT_FFT_INLINE void gather(int y, FftLanes* elements) const {
        const auto width = static_cast<std::size_t>(filled.width);
        const auto rows = static_cast<std::size_t>(std::min(kFftLanes, filled.height - y));
        const float* first = plane + static_cast<std::size_t>(y) * width;
        auto* values = reinterpret_cast<float*>(elements);
        for (std::size_t x = 0; x < width; x += kLanes) {
            if (rows == kLanes && x + kLanes <= width) {
                transpose(first + x, width, values + x * kLanes, kLanes);
                continue;
            }
            Tile tile{};
            for (std::size_t i = 0; i < rows; ++i)
                std::copy_n(first + i * width + x, std::min(kLanes, width - x), &tile[i * kLanes]);
            transpose(tile.data(), kLanes, values + x * kLanes, kLanes);
        }
        const std::size_t gathered = up_to_lanes(width) / 2;
        const auto wanted = static_cast<std::size_t>(tables.row.length);
        if (gathered < wanted) std::fill(elements + gathered, elements + wanted, FftLanes{});
    }

    // The transforms of even and odd pixels, Z, become the row's: 2·X for k from 0 to w/2.
    template <class T>
    WEFT_FFT_INLINE void separate(FftLanes* z) const {
        const int n = tables.row.length;
        for (int part = 0; part < kFftParts<T>; ++part) {
            FftValue<T> a;
            load<T, false>(z[0], part, a);
            FftValue<T> first, last;
            first.re = 2.0f * (a.re + a.im), last.re = 2.0f * (a.re - a.im);
            first.im = last.im = a.re - a.re;
            store<T, false>(first, part, z[0]);
            store<T, false>(last, part, z[n]);
        }
        for (int k = 1; k <= n - k; ++k) {
            for (int part = 0; part < kFftParts<T>; ++part) {
                FftValue<T> a, b;
                load<T, false>(z[k], part, a);
                load<T, false>(z[n - k], part, b);
                FftValue<T> odd;  // −i·(a − conj b)·w^k
                odd.re = a.im + b.im, odd.im = b.re - a.re;
                turn(tables.real_roots[static_cast<std::size_t>(k)], odd);
                FftValue<T> even;
                even.re = a.re + b.re, even.im = a.im - b.im;
                a.re = even.re + odd.re, a.im = even.im + odd.im;
                b.re = even.re - odd.re, b.im = odd.im - even.im;
                store<T, false>(b, part, z[n - k]);
                store<T, false>(a, part, z[k]);
            }
        }
    }

    template <class T>
    WEFT_FFT_INLINE void run() const {
        const auto n = static_cast<std::size_t>(tables.row.length);
        const std::size_t room = static_cast<std::size_t>(tables.batches) * kLanes + kLanes;
        Scratch<Buffer> a(room), b(room);
        for (int y = 0; y < filled.height; y += kFftLanes) {
            gather(y, (*b).data());
            FftLanes* z = run_line<T, false>(tables.row, (*b).data(), (*a).data(), (*b).data());
            separate<T>(z);
            std::fill(z + n + 1, z + static_cast<std::size_t>(tables.batches) * kLanes, FftLanes{});
            for (int batch = 0; batch < tables.batches; ++batch) {
                FftLanes* to = out + batch * tables.padded_height + y;
                const FftLanes* from = z + static_cast<std::size_t>(batch) * kLanes;
                transpose(from->re.data(), 2 * kLanes, to->re.data(), 2 * kLanes);
                transpose(from->im.data(), 2 * kLanes, to->im.data(), 2 * kLanes);
            }
        }
        const auto written = up_to_lanes(static_cast<std::size_t>(filled.height));
        for (int batch = 0; batch < tables.batches; ++batch) {
            FftLanes* column = out + batch * tables.padded_height;
            std::fill(column + written, column + tables.padded_height, FftLanes{});
        }
    }
};

struct ForwardColumns {
    const FftTables& tables;
    FftLanes* spectrum;

    template <class T>
    WEFT_FFT_INLINE void run() const {
        const auto height = static_cast<std::size_t>(tables.column.length);
        Scratch<Buffer> a(height), b(height);
        for (int batch = 0; batch < tables.batches; ++batch) {
            FftLanes* column = spectrum + batch * tables.padded_height;
            const FftLanes* done =
                run_line<T, false>(tables.column, column, (*a).data(), (*b).data());
            std::copy_n(done, height, column);
        }
    }
};

struct Correlate {
    const FftTables& tables;
    std::span<const PlaneFft::Product> products;
    FftLanes* out;

    // sum += weight · x · conj(y)
    template <class T>
    WEFT_FFT_INLINE void add(float weight, const FftLanes* x, const FftLanes* y,
                             FftLanes* sum) const {
        for (int i = 0; i < tables.column.length; ++i) {
            for (int part = 0; part < kFftParts<T>; ++part) {
                FftValue<T> a, b, s;
                load<T, false>(x[i], part, a);
                load<T, false>(y[i], part, b);
                load<T, false>(sum[i], part, s);
                s.re += weight * (a.re * b.re + a.im * b.im);
                s.im += weight * (a.im * b.re - a.re * b.im);
                store<T, false>(s, part, sum[i]);
            }
        }
    }

    template <class T>
    WEFT_FFT_INLINE void run() const {
        const auto height = static_cast<std::size_t>(tables.column.length);
        Scratch<Buffer> a(height), b(height), sum(height);
        for (int batch = 0; batch < tables.batches; ++batch) {
            const std::ptrdiff_t at = std::ptrdiff_t{batch} * tables.padded_height;
            std::fill((*sum).begin(), (*sum).begin() + tables.column.length, FftLanes{});
            for (const PlaneFft::Product& p : products) {
                const FftLanes* x =
                    run_line<T, false>(tables.column, p.rows + at, (*a).data(), (*b).data());
                add<T>(p.weight, x, p.spectrum + at, (*sum).data());
            }
            const FftLanes* done =
                run_line<T, true>(tables.column, (*sum).data(), (*a).data(), (*b).data());
            std::copy_n(done, height, out + at);
        }
    }
};

struct BackwardRows {
    const FftTables& tables;
    const FftLanes* spectrum;
    int first, end;
    float* out;
    std::size_t stride;

    // The reverse of ForwardRows::separate().
    template <class T>
    WEFT_FFT_INLINE void join(FftLanes* z) const {
        const int n = tables.row.length;
        for (int part = 0; part < kFftParts<T>; ++part) {
            FftValue<T> a, b;
            load<T, false>(z[0], part, a);
            load<T, false>(z[n], part, b);
            a.im = a.re - b.re, a.re = a.re + b.re;
            store<T, false>(a, part, z[0]);
        }
        for (int k = 1; k <= n - k; ++k) {
            const FftTwiddle w = tables.real_roots[static_cast<std::size_t>(k)];
            for (int part = 0; part < kFftParts<T>; ++part) {
                FftValue<T> a, b;
                load<T, false>(z[k], part, a);
                load<T, false>(z[n - k], part, b);
                FftValue<T> odd;
                odd.re = a.re - b.re, odd.im = a.im + b.im;
                turn(FftTwiddle{w.re, -w.im}, odd);
                FftValue<T> even;
                even.re = a.re + b.re, even.im = a.im - b.im;
                a.re = even.re - odd.im, a.im = even.im + odd.re;
                b.re = even.re + odd.im, b.im = odd.re - even.im;
                store<T, false>(b, part, z[n - k]);
                store<T, false>(a, part, z[k]);
            }
        }
    }

    template <class T>
    WEFT_FFT_INLINE void run() const {
        const auto n = static_cast<std::size_t>(tables.row.length);
        const std::size_t room = static_cast<std::size_t>(tables.batches) * kLanes + kLanes;
        Scratch<Buffer> a(room), b(room);
        for (int y = first / kFftLanes * kFftLanes; y < end; y += kFftLanes) {
            for (int batch = 0; batch < tables.batches; ++batch) {
                const FftLanes* from = spectrum + batch * tables.padded_height + y;
                FftLanes* to = (*b).data() + static_cast<std::size_t>(batch) * kLanes;
                transpose(from->re.data(), 2 * kLanes, to->re.data(), 2 * kLanes);
                transpose(from->im.data(), 2 * kLanes, to->im.data(), 2 * kLanes);
            }
            join<T>((*b).data());
            const FftLanes* z =
                run_line<T, true>(tables.row, (*b).data(), (*a).data(), (*b).data());
            const auto* values = reinterpret_cast<const float*>(z);
            float* row = out + static_cast<std::size_t>(y) * stride;
            for (std::size_t x = 0; x < 2 * n; x += kLanes)
                transpose(values + x * kLanes, kLanes, row + x, stride);
        }
    }
};

template <class Work>
void run_portable(const Work& work) {
    work.template run<FourFloats>();
}

#if defined(__x86_64__)
template <class Work>
[[gnu::target("avx2")]] void run_avx2(const Work& work) {
    work.template run<EightFloats>();
}
template <class Work>
[[gnu::target("avx512f,avx512bw,avx512vl")]] void run_avx512(const Work& work) {
    work.template run<SixteenFloats>();
}
#endif

template <class Work>
void run(const Work& work) {
#if defined(__x86_64__)
    const Isa isa = current_isa();
    if (isa == Isa::kAvx512) return run_avx512(work);
    if (isa == Isa::kAvx2) return run_avx2(work);
#endif
    run_portable(work);
}

std::unique_ptr<const FftTables> make_tables(Size size) {
    auto tables = std::make_unique<FftTables>();
    tables->row = make_line(size.width / 2);
    tables->column = make_line(size.height);
    for (int k = 0; k <= size.width / 4; ++k)
        tables->real_roots.push_back(root_of_unity(k, size.width));
    tables->padded_height = static_cast<int>(up_to_lanes(static_cast<std::size_t>(size.height)));
    tables->batches =
        static_cast<int>(up_to_lanes(static_cast<std::size_t>(size.width / 2 + 1)) / kLanes);
    return tables;
}

}  // namespace

int fast_fft_size(int n) {
    for (n = std::max(n + n % 2, 4);; n += 2) {
        int rest = n;
        for (const int f : {2, 3, 5}) {
            while (rest % f == 0)
                rest /= f;
        }
        if (rest == 1) return n;
    }
}

PlaneFft::PlaneFft(Size size) : size_(size), tables_(make_tables(size)) {}
PlaneFft::~PlaneFft() = default;

std::size_t PlaneFft::spectrum_size() const {
    return static_cast<std::size_t>(tables_->batches) *
           static_cast<std::size_t>(tables_->padded_height);
}
std::size_t PlaneFft::row_stride() const {
    return up_to_lanes(static_cast<std::size_t>(size_.width));
}
int PlaneFft::padded_height() const {
    return tables_->padded_height;
}

void PlaneFft::forward_rows(const float* plane, Size filled, FftLanes* out) const {
    run(ForwardRows{*tables_, plane, filled, out});
}
void PlaneFft::forward_columns(FftLanes* spectrum) const {
    run(ForwardColumns{*tables_, spectrum});
}
void PlaneFft::correlate(std::span<const Product> products, FftLanes* out) const {
    run(Correlate{*tables_, products, out});
}
void PlaneFft::backward_rows(const FftLanes* spectrum, int first, int end, float* out) const {
    run(BackwardRows{*tables_, spectrum, first, end, out, row_stride()});
}

}  // namespace weft
