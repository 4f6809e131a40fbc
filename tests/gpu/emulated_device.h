#pragma once
#include <atomic>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <set>

#include "gpu/device.h"
#include "tests/gpu/emulate.h"

namespace weft::test {

/// A device that the host plays. What is queued is done at wait() and not before, as late as a real
/// device might, so that memory which is used again too early shows. It can be made to fail.
class EmulatedDevice final : public Device {
  public:
    explicit EmulatedDevice(ThreadOrder order = ThreadOrder::kForward) : order_(order) {}
    ~EmulatedDevice() override;

    /// The call number `call` from now on (0 is the next) fails. With NoBackend so do all after it:
    /// the device is lost.
    void fail_at(int call, ErrorCode code);
    /// Whether that call has come.
    [[nodiscard]] bool has_failed() const { return failed_; }
    /// No more than so much may be allocated, pinned memory included.
    void limit_memory(std::size_t bytes) { limit_bytes_ = bytes; }
    [[nodiscard]] std::size_t allocated_bytes() const { return allocated_bytes_; }
    [[nodiscard]] int copies() const { return copies_; }

    [[nodiscard]] std::string description() const override { return "emulated device"; }
    [[nodiscard]] std::size_t total_bytes() const override { return limit_bytes_; }
    Expected<void*> allocate(std::size_t bytes) override;
    void release(void* memory) noexcept override;
    Expected<PinnedMemory> allocate_pinned(std::size_t bytes) override;
    void release_pinned(PinnedMemory memory) noexcept override { release(memory.host); }
    Expected<Queue> open_queue() override;
    void close_queue(Queue queue) noexcept override;
    Status copy(Queue queue, const CopyRows& rows) override;
    Status clear(Queue queue, void* memory, std::size_t bytes) override;
    Status launch(Queue queue, kernels::KernelId id, int blocks, const void* args) override;
    Status start_timer(Queue) override { return step("start_timer"); }
    Status stop_timer(Queue) override { return step("stop_timer"); }
    Status wait(Queue queue) override;
    Expected<double> timed_ms(Queue) override { return 0.5; }

  private:
    struct Work {
        std::vector<std::function<void()>> queued;
    };
    Status step(const std::string& call);

    ThreadOrder order_;
    std::atomic<int> calls_left_{std::numeric_limits<int>::max()};
    std::atomic<bool> failed_{false}, lost_{false};
    ErrorCode code_ = ErrorCode::kNoBackend;
    std::mutex mutex_;
    std::set<std::pair<void*, std::size_t>> memory_;
    std::set<Work*> queues_;
    std::size_t limit_bytes_ = std::size_t{1} << 30;
    std::atomic<std::size_t> allocated_bytes_{0};
    std::atomic<int> copies_{0};
};

}  // namespace weft::test
