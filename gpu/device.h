#pragma once
// The device interface of the backend: memory, copies, kernels, waiting. CudaDevice is the real
// one; tests run the same backend on a device emulated on the host, also with injected failures.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "gpu/kernels/catalogue.h"

namespace weft {

/// Host memory that the device can reach by itself.
struct PinnedMemory {
    void* host = nullptr;
    void* device = nullptr;
};

/// Rows of bytes, pitches in bytes. Either side may be on the host or on the device.
struct CopyRows {
    void* to = nullptr;
    std::size_t to_pitch = 0;
    const void* from = nullptr;
    std::size_t from_pitch = 0;
    std::size_t row_bytes = 0, rows = 0;
};

/// Thread-safe. Work in one queue runs in order, and the caller must use a queue from one thread at
/// a time. Errors: NoSpace if memory is short, NoBackend for anything after which the device is
/// unusable.
class Device {
  public:
    using Queue = void*;

    virtual ~Device() = default;
    [[nodiscard]] virtual std::string description() const = 0;
    [[nodiscard]] virtual std::size_t total_bytes() const = 0;

    [[nodiscard]] virtual Expected<void*> allocate(std::size_t bytes) = 0;
    virtual void release(void* memory) noexcept = 0;
    [[nodiscard]] virtual Expected<PinnedMemory> allocate_pinned(std::size_t bytes) = 0;
    virtual void release_pinned(PinnedMemory memory) noexcept = 0;
    [[nodiscard]] virtual Expected<Queue> open_queue() = 0;
    virtual void close_queue(Queue queue) noexcept = 0;

    // These are put into the queue; pinned memory must stay as it is until wait() returns.
    [[nodiscard]] virtual Status copy(Queue queue, const CopyRows& rows) = 0;
    [[nodiscard]] virtual Status clear(Queue queue, void* memory, std::size_t bytes) = 0;
    [[nodiscard]] virtual Status launch(Queue queue, kernels::KernelId id, int blocks,
                                        const void* args) = 0;
    [[nodiscard]] virtual Status start_timer(Queue queue) = 0;
    [[nodiscard]] virtual Status stop_timer(Queue queue) = 0;

    [[nodiscard]] virtual Status wait(Queue queue) = 0;
    /// Between the timer's start and its stop; after wait().
    [[nodiscard]] virtual Expected<double> timed_ms(Queue queue) = 0;
};

struct PlainDeviceMemory {
    using Memory = void*;
    static Expected<Memory> allocate(Device& device, std::size_t bytes) {
        return device.allocate(bytes);
    }
    static void release(Device& device, Memory memory) noexcept { device.release(memory); }
};
struct PinnedHostMemory {
    using Memory = PinnedMemory;
    static Expected<Memory> allocate(Device& device, std::size_t bytes) {
        return device.allocate_pinned(bytes);
    }
    static void release(Device& device, Memory memory) noexcept { device.release_pinned(memory); }
};

/// Memory of one kind that grows on demand. Growing discards the content and must not happen while
/// work with it is queued.
template <class Kind>
class GrowingBuffer {
  public:
    GrowingBuffer() = default;
    ~GrowingBuffer() { reset(); }
    GrowingBuffer(GrowingBuffer&& o) noexcept { *this = std::move(o); }
    GrowingBuffer& operator=(GrowingBuffer&& o) noexcept {
        std::swap(device_, o.device_);
        std::swap(memory_, o.memory_);
        std::swap(bytes_, o.bytes_);
        return *this;
    }

    [[nodiscard]] Status reserve(const std::shared_ptr<Device>& device, std::size_t bytes) {
        if (bytes <= bytes_) return {};
        reset();
        WEFT_TRY(memory, Kind::allocate(*device, bytes));
        device_ = device;
        memory_ = memory;
        bytes_ = bytes;
        return {};
    }
    void reset() noexcept {
        if (bytes_ > 0) Kind::release(*device_, memory_);
        memory_ = {};
        bytes_ = 0;
    }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  protected:
    [[nodiscard]] typename Kind::Memory memory() const { return memory_; }

  private:
    std::shared_ptr<Device> device_;
    typename Kind::Memory memory_{};
    std::size_t bytes_ = 0;
};

class DeviceBuffer : public GrowingBuffer<PlainDeviceMemory> {
  public:
    template <class T>
    [[nodiscard]] T* as() const {
        return static_cast<T*>(memory());
    }
};

class PinnedBuffer : public GrowingBuffer<PinnedHostMemory> {
  public:
    template <class T>
    [[nodiscard]] T* host(std::size_t offset_bytes = 0) const {
        return reinterpret_cast<T*>(static_cast<std::byte*>(memory().host) + offset_bytes);
    }
    template <class T>
    [[nodiscard]] T* device(std::size_t offset_bytes = 0) const {
        return reinterpret_cast<T*>(static_cast<std::byte*>(memory().device) + offset_bytes);
    }
};

/// A queue that is closed with its owner.
class DeviceQueue {
  public:
    DeviceQueue() = default;
    ~DeviceQueue() {
        if (queue_) device_->close_queue(queue_);
    }
    DeviceQueue(const DeviceQueue&) = delete;
    DeviceQueue& operator=(const DeviceQueue&) = delete;

    [[nodiscard]] Status open(const std::shared_ptr<Device>& device);
    [[nodiscard]] Device::Queue get() const { return queue_; }

  private:
    std::shared_ptr<Device> device_;
    Device::Queue queue_ = nullptr;
};

/// Queues kernel K over as many blocks as its arguments need.
template <class K>
[[nodiscard]] Status launch(Device& device, Device::Queue queue, kernels::KernelId id,
                            const typename K::Args& args) {
    const int blocks = K::blocks(args);
    return blocks > 0 ? device.launch(queue, id, blocks, &args) : Status{};
}

}  // namespace weft
