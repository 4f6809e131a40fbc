#include "app/base/render_speed.h"

#include <algorithm>
#include <cmath>

namespace weft {

double calibrated_speed(double speed, double estimated_s, double took_s) {
    if (!(estimated_s > 0) || !(took_s > 0)) return speed;
    return std::clamp(speed * std::sqrt(estimated_s / took_s), 0.05, 20.0);
}

}  // namespace weft
