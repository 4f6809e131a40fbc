#pragma once
// How long something takes, by a clock that never goes back.

#include <chrono>

namespace weft {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
    return seconds_between(start, Clock::now());
}

/// Adds the time that a scope takes to a sum.
class ScopeTimer {
  public:
    explicit ScopeTimer(double& total_s) : total_s_(total_s) {}
    ~ScopeTimer() { total_s_ += seconds_since(start_); }
    ScopeTimer(const ScopeTimer&) = delete;
    ScopeTimer& operator=(const ScopeTimer&) = delete;

  private:
    double& total_s_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace weft
