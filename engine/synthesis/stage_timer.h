#pragma once
// Wall-clock times of stages.

#include <chrono>

namespace weft {

inline double stage_clock_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Adds up the time that a scope takes.
class StageTimer {
  public:
    explicit StageTimer(double& total_s) : total_s_(total_s) {}
    ~StageTimer() { total_s_ += stage_clock_s() - start_s_; }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    double& total_s_;
    double start_s_ = stage_clock_s();
};

}  // namespace weft
