#include "ui/input/pen.h"

#include <algorithm>

namespace weft {

void PenDevices::add(int device, int number, double least, double most) {
    if (most > least) pens_[device] = {number, least, most};
}

void PenDevices::report(int device, const std::map<int, double>& values) {
    const auto pen = pens_.find(device);
    if (pen == pens_.end()) return;
    const auto value = values.find(pen->second.number);
    if (value == values.end()) return;
    const double part =
        (value->second - pen->second.least) / (pen->second.most - pen->second.least);
    // Zero pressure: the pen hovers above the tablet.
    if (part > 0)
        now_ = static_cast<float>(std::min(part, 1.0));
    else
        now_.reset();
}

}  // namespace weft
