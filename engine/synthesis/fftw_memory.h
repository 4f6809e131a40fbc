#pragma once
// FFTW's memory, sizes and plans. Its planner is the one part of it that is not thread-safe, and
// plans are made without timing (FFTW_ESTIMATE), or runs would differ.

#include <fftw3.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>

namespace weft {

std::mutex& fftw_planner_mutex();

/// The smallest even size ≥ n without prime factors above 5.
[[nodiscard]] int fast_fft_size(int n);

using FftwFloats = std::unique_ptr<float[], void (*)(void*)>;
[[nodiscard]] FftwFloats make_fftw_floats(std::size_t count);

struct FftwPlanDeleter {
    void operator()(fftwf_plan plan) const {
        const std::lock_guard lock(fftw_planner_mutex());
        fftwf_destroy_plan(plan);
    }
};
using FftwPlan = std::unique_ptr<std::remove_pointer_t<fftwf_plan>, FftwPlanDeleter>;

/// `make` calls one of FFTW's planners.
template <class Make>
[[nodiscard]] FftwPlan make_fftw_plan(Make make) {
    const std::lock_guard lock(fftw_planner_mutex());
    FftwPlan plan(make());
    if (!plan) throw std::bad_alloc();
    return plan;
}

}  // namespace weft
