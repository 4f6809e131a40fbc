#pragma once
// Motion as it is estimated from a test's pictures.

#include "engine/motion/optical_flow.h"

namespace weft {

/// prev_from_cur, valid where the motion back agrees.
inline FlowField flow_between(const Matte& cur, const Matte& prev) {
    FlowField there = estimate_flow(cur, prev, FlowQuality::kFinal);
    FlowField back = estimate_flow(prev, cur, FlowQuality::kFinal);
    check_consistency(there, back);
    return there;
}

}  // namespace weft
