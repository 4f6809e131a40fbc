#include "gpu/device.h"

namespace weft {

Status DeviceBuffer::reserve(const std::shared_ptr<Device>& device, std::size_t bytes) {
    if (bytes <= bytes_) return {};
    reset();
    WEFT_TRY(memory, device->allocate(bytes));
    device_ = device;
    memory_ = memory;
    bytes_ = bytes;
    return {};
}

void DeviceBuffer::reset() noexcept {
    if (memory_) device_->release(memory_);
    memory_ = nullptr;
    bytes_ = 0;
}

Status PinnedBuffer::reserve(const std::shared_ptr<Device>& device, std::size_t bytes) {
    if (bytes <= bytes_) return {};
    reset();
    WEFT_TRY(memory, device->allocate_pinned(bytes));
    device_ = device;
    memory_ = memory;
    bytes_ = bytes;
    return {};
}

void PinnedBuffer::reset() noexcept {
    if (memory_.host) device_->release_pinned(memory_);
    memory_ = {};
    bytes_ = 0;
}

Status DeviceQueue::open(const std::shared_ptr<Device>& device) {
    if (queue_) return {};
    WEFT_TRY(queue, device->open_queue());
    device_ = device;
    queue_ = queue;
    return {};
}

}  // namespace weft
