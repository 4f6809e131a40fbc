#include "engine/synthesis/fftw_memory.h"

namespace weft {

std::mutex& fftw_planner_mutex() {
    static std::mutex mutex;
    return mutex;
}

int fast_fft_size(int n) {
    for (n += n % 2;; n += 2) {
        int rest = n;
        for (const int f : {2, 3, 5}) {
            while (rest % f == 0)
                rest /= f;
        }
        if (rest == 1) return n;
    }
}

FftwFloats make_fftw_floats(std::size_t count) {
    auto* p = static_cast<float*>(fftwf_malloc(count * sizeof(float)));
    if (!p) throw std::bad_alloc();
    return {p, fftwf_free};
}

}  // namespace weft
