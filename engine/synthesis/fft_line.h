#pragma once
// Internal: complex transforms of sixteen lines at a time (Stockham's form: no bit reversal, the
// result is in order), for one instruction set. Functions are inlined into one that is compiled
// for that set and take vectors by reference, because passing them would depend on the set.

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/synthesis/plane_fft.h"

namespace weft {

struct FftTwiddle {
    float re, im;
};

/// Moves `radix` elements that lie `parts` · `stride` apart to neighbouring places `stride` apart.
struct FftPass {
    int radix, parts, stride;
    std::size_t twiddles;  ///< Index of the first: radix − 1 for each part.
};

struct FftLine {
    int length = 0;
    std::vector<FftPass> passes;
    std::vector<FftTwiddle> twiddles;
};

// NOLINTBEGIN(modernize-use-using): only a typedef takes the attributes.
struct FourFloats {
    typedef float V __attribute__((vector_size(16), may_alias));
};
struct EightFloats {
    typedef float V __attribute__((vector_size(32), may_alias));
};
struct SixteenFloats {
    typedef float V __attribute__((vector_size(64), may_alias));
};
// NOLINTEND(modernize-use-using)

#define WEFT_FFT_INLINE [[gnu::always_inline]] inline

/// The part of an element that one register holds.
template <class T>
struct FftValue {
    typename T::V re, im;
};
template <class T>
inline constexpr int kFftParts = static_cast<int>(sizeof(FftLanes) / sizeof(FftValue<T>));

template <class T>
WEFT_FFT_INLINE const typename T::V& real_part(const FftLanes& x, int part) {
    return reinterpret_cast<const typename T::V*>(x.re.data())[part];
}
template <class T>
WEFT_FFT_INLINE const typename T::V& imaginary_part(const FftLanes& x, int part) {
    return reinterpret_cast<const typename T::V*>(x.im.data())[part];
}
/// A backward transform is a forward one with real and imaginary parts swapped before and after.
template <class T, bool Backward>
WEFT_FFT_INLINE void load(const FftLanes& x, int part, FftValue<T>& v) {
    v.re = Backward ? imaginary_part<T>(x, part) : real_part<T>(x, part);
    v.im = Backward ? real_part<T>(x, part) : imaginary_part<T>(x, part);
}
template <class T, bool Backward>
WEFT_FFT_INLINE void store(const FftValue<T>& v, int part, FftLanes& x) {
    reinterpret_cast<typename T::V*>(x.re.data())[part] = Backward ? v.im : v.re;
    reinterpret_cast<typename T::V*>(x.im.data())[part] = Backward ? v.re : v.im;
}
template <class T>
WEFT_FFT_INLINE void turn(const FftTwiddle& w, FftValue<T>& v) {
    const typename T::V re = v.re * w.re - v.im * w.im;
    v.im = v.re * w.im + v.im * w.re;
    v.re = re;
}
template <class T>
WEFT_FFT_INLINE void sum_and_difference(FftValue<T>& a, FftValue<T>& b) {
    const typename T::V re = a.re - b.re, im = a.im - b.im;
    a.re += b.re, a.im += b.im;
    b.re = re, b.im = im;
}
/// a ← m − i·n, b ← m + i·n.
template <class T>
WEFT_FFT_INLINE void around(const FftValue<T>& m, const FftValue<T>& n, FftValue<T>& a,
                            FftValue<T>& b) {
    a.re = m.re + n.im, a.im = m.im - n.re;
    b.re = m.re - n.im, b.im = m.im + n.re;
}

/// The transform of N values in place.
template <class T, int N>
WEFT_FFT_INLINE void butterfly(FftValue<T>* v) {
    if constexpr (N == 2) {
        sum_and_difference(v[0], v[1]);
    } else if constexpr (N == 4) {
        sum_and_difference(v[0], v[2]);
        sum_and_difference(v[1], v[3]);
        const FftValue<T> m = v[2], n = v[3];
        sum_and_difference(v[0], v[1]);
        v[2] = v[1];
        around(m, n, v[1], v[3]);
    } else if constexpr (N == 3) {
        constexpr float kSin = 0.866025403784438646763723170752936183f;
        sum_and_difference(v[1], v[2]);
        const FftValue<T> m{v[0].re - v[1].re * 0.5f, v[0].im - v[1].im * 0.5f};
        const FftValue<T> n{v[2].re * kSin, v[2].im * kSin};
        v[0].re += v[1].re, v[0].im += v[1].im;
        around(m, n, v[1], v[2]);
    } else {
        static_assert(N == 5);
        constexpr float kCos1 = 0.309016994374947424102293417182819059f;
        constexpr float kCos2 = -0.809016994374947424102293417182819059f;
        constexpr float kSin1 = 0.951056516295153572116439333379382143f;
        constexpr float kSin2 = 0.587785252292473129168705954639072769f;
        sum_and_difference(v[1], v[4]);
        sum_and_difference(v[2], v[3]);
        const FftValue<T> m1{v[0].re + (v[1].re * kCos1 + v[2].re * kCos2),
                             v[0].im + (v[1].im * kCos1 + v[2].im * kCos2)};
        const FftValue<T> m2{v[0].re + (v[1].re * kCos2 + v[2].re * kCos1),
                             v[0].im + (v[1].im * kCos2 + v[2].im * kCos1)};
        const FftValue<T> n1{v[4].re * kSin1 + v[3].re * kSin2, v[4].im * kSin1 + v[3].im * kSin2};
        const FftValue<T> n2{v[4].re * kSin2 - v[3].re * kSin1, v[4].im * kSin2 - v[3].im * kSin1};
        v[0].re += v[1].re + v[2].re, v[0].im += v[1].im + v[2].im;
        around(m1, n1, v[1], v[4]);
        around(m2, n2, v[2], v[3]);
    }
}

template <class T, bool Backward, int N, bool Turned>
WEFT_FFT_INLINE void pass_part(const FftPass& pass, const FftTwiddle* w, const FftLanes* in,
                               FftLanes* out) {
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(pass.parts) * pass.stride;
    for (std::ptrdiff_t q = 0; q < pass.stride; ++q) {
        for (int part = 0; part < kFftParts<T>; ++part) {
            FftValue<T> v[N];
            for (int j = 0; j < N; ++j)
                load<T, Backward>(in[q + j * step], part, v[j]);
            butterfly<T, N>(v);
            if constexpr (Turned) {
                for (int k = 1; k < N; ++k)
                    turn(w[k - 1], v[k]);
            }
            for (int k = 0; k < N; ++k)
                store<T, Backward>(v[k], part, out[q + k * pass.stride]);
        }
    }
}

template <class T, bool Backward, int N>
WEFT_FFT_INLINE void run_pass(const FftPass& pass, const FftTwiddle* w, const FftLanes* in,
                              FftLanes* out) {
    pass_part<T, Backward, N, false>(pass, w, in, out);
    for (std::ptrdiff_t p = 1; p < pass.parts; ++p) {
        pass_part<T, Backward, N, true>(pass, w + p * (N - 1), in + p * pass.stride,
                                        out + p * N * pass.stride);
    }
}

/// Transforms line.length elements of `in` (at least two). `in` may be `b`; otherwise it is not
/// changed. Returns the buffer that holds the result, `a` or `b`.
template <class T, bool Backward>
WEFT_FFT_INLINE FftLanes* run_line(const FftLine& line, const FftLanes* in, FftLanes* a,
                                   FftLanes* b) {
    for (const FftPass& pass : line.passes) {
        const FftTwiddle* w = line.twiddles.data() + pass.twiddles;
        if (pass.radix == 4) {
            run_pass<T, Backward, 4>(pass, w, in, a);
        } else if (pass.radix == 2) {
            run_pass<T, Backward, 2>(pass, w, in, a);
        } else if (pass.radix == 3) {
            run_pass<T, Backward, 3>(pass, w, in, a);
        } else {
            run_pass<T, Backward, 5>(pass, w, in, a);
        }
        in = a;
        std::swap(a, b);
    }
    return b;
}

}  // namespace weft
