#include "app/base/frame_clock.h"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace weft {
namespace {

double now_ms(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

}  // namespace

void FrameClock::begin() {
    parts_.clear();
    open_ = -1;
}

void FrameClock::close() {
    if (open_ < 0) return;
    Part& part = parts_[static_cast<std::size_t>(open_)];
    part.wall_ms += now_ms(CLOCK_MONOTONIC) - wall_from_ms_;
    part.processor_ms += now_ms(CLOCK_THREAD_CPUTIME_ID) - processor_from_ms_;
    open_ = -1;
}

void FrameClock::enter(const char* name) {
    if (!on_) return;
    close();
    const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& part) {
        return std::strcmp(part.name, name) == 0;
    });
    open_ = static_cast<int>(found - parts_.begin());
    if (found == parts_.end()) parts_.push_back({name, 0, 0});
    wall_from_ms_ = now_ms(CLOCK_MONOTONIC);
    processor_from_ms_ = now_ms(CLOCK_THREAD_CPUTIME_ID);
}

void FrameClock::end() {
    close();
}

double FrameClock::wall_ms() const {
    double sum = 0;
    for (const Part& part : parts_)
        sum += part.wall_ms;
    return sum;
}

std::string FrameClock::text() const {
    std::vector<Part> sorted = parts_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Part& a, const Part& b) { return a.wall_ms > b.wall_ms; });
    char line[160];
    std::snprintf(line, sizeof line, "A frame took %.0f ms", wall_ms());
    std::string out = line;
    const char* before = ": ";
    for (const Part& part : sorted) {
        if (part.wall_ms < 1) break;
        std::snprintf(line, sizeof line, "%s%s %.0f ms (%.0f ms of work)", before, part.name,
                      part.wall_ms, part.processor_ms);
        out += line;
        before = ", ";
    }
    return out;
}

}  // namespace weft
