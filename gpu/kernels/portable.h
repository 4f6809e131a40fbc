#pragma once
// What a kernel body needs so that it compiles for the device and for the host alike. Bodies are
// plain C++17: they see no engine header, so any nvcc takes them.
//
// A body is a function template over a `Block`, which stands for one thread block:
//   block.index()            which block of the launch this is
//   block.each(f)            f(thread) for every thread of the block, then a barrier
//   auto s = block.local<T>(); s[thread]   a variable of each thread that outlives a barrier
// Code outside of each() must be the same for all threads of the block. On the device each() calls
// f once, for the thread that it is in; on the host it loops (tests/gpu/emulate.h).

#include <cstdint>

#ifdef __CUDACC__
#define WEFT_HD __host__ __device__ inline
#define WEFT_UNROLL _Pragma("unroll")
#else
#define WEFT_HD inline
#define WEFT_UNROLL
#endif

namespace weft::kernels {

using u8 = std::uint8_t;
using u32 = std::uint32_t;
using u64 = std::uint64_t;

template <class T>
WEFT_HD T smaller(T a, T b) {
    return b < a ? b : a;
}
template <class T>
WEFT_HD T larger(T a, T b) {
    return a < b ? b : a;
}
template <class T>
WEFT_HD T held(T v, T lo, T hi) {
    return smaller(larger(v, lo), hi);
}

WEFT_HD int ceil_div(int a, int b) {
    return (a + b - 1) / b;
}

/// Integers only, so the order of the additions does not matter.
WEFT_HD void atomic_add(u64* to, u64 value) {
#ifdef __CUDA_ARCH__
    atomicAdd(reinterpret_cast<unsigned long long*>(to), static_cast<unsigned long long>(value));
#else
    __atomic_fetch_add(to, value, __ATOMIC_RELAXED);
#endif
}

/// Sum of the products of the four bytes of a and b, added to sum.
WEFT_HD u32 dot_bytes(u32 a, u32 b, u32 sum) {
#ifdef __CUDA_ARCH__
    return __dp4a(a, b, sum);
#else
    for (int k = 0; k < 32; k += 8)
        sum += ((a >> k) & 255u) * ((b >> k) & 255u);
    return sum;
#endif
}

/// |a − b| of the four bytes each.
WEFT_HD u32 byte_distances(u32 a, u32 b) {
#ifdef __CUDA_ARCH__
    return __vabsdiffu4(a, b);
#else
    u32 out = 0;
    for (int k = 0; k < 32; k += 8) {
        const u32 x = (a >> k) & 255u, y = (b >> k) & 255u;
        out |= (x > y ? x - y : y - x) << k;
    }
    return out;
#endif
}

/// Lowest bit that is set; v is not 0.
WEFT_HD int lowest_bit(u32 v) {
#ifdef __CUDA_ARCH__
    return __ffs(static_cast<int>(v)) - 1;
#else
    return __builtin_ctz(v);
#endif
}

}  // namespace weft::kernels
