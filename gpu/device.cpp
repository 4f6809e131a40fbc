#include "gpu/device.h"

namespace weft {

Status DeviceQueue::open(const std::shared_ptr<Device>& device) {
    if (queue_) return {};
    WEFT_TRY(queue, device->open_queue());
    device_ = device;
    queue_ = queue;
    return {};
}

}  // namespace weft
