#include "tests/gpu/emulated_device.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace weft::test {

EmulatedDevice::~EmulatedDevice() {
    EXPECT_TRUE(memory_.empty()) << memory_.size() << " pieces of device memory were not released";
    EXPECT_TRUE(queues_.empty()) << queues_.size() << " queues were not closed";
}

void EmulatedDevice::fail_at(int call, ErrorCode code) {
    code_ = code;
    failed_ = false;
    calls_left_ = call;
}

Status EmulatedDevice::step(const std::string& call) {
    const bool now = calls_left_-- == 0;
    if (now) {
        failed_ = true;
        if (code_ == ErrorCode::kNoBackend) lost_ = true;
    }
    if (now || lost_) return fail(code_, "The emulated device failed at " + call + ".");
    return {};
}

Expected<void*> EmulatedDevice::allocate(std::size_t bytes) {
    WEFT_CHECK_OK(step("allocate"));
    const std::lock_guard lock(mutex_);
    if (allocated_bytes_ + bytes > limit_bytes_) {
        return fail(ErrorCode::kNoSpace, "The emulated device is full.");
    }
    // A multiple of the alignment; the end of what was asked for is checked by no one but ASan.
    void* memory = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
    std::memset(memory, kGarbage, bytes);
    memory_.insert({memory, bytes});
    allocated_bytes_ += bytes;
    return memory;
}

void EmulatedDevice::release(void* memory) noexcept {
    const std::lock_guard lock(mutex_);
    const auto found = memory_.lower_bound({memory, 0});
    if (found == memory_.end() || found->first != memory) std::abort();
    allocated_bytes_ -= found->second;
    std::free(memory);
    memory_.erase(found);
}

Expected<PinnedMemory> EmulatedDevice::allocate_pinned(std::size_t bytes) {
    WEFT_TRY(memory, allocate(bytes));
    return PinnedMemory{memory, memory};
}

Expected<Device::Queue> EmulatedDevice::open_queue() {
    WEFT_CHECK_OK(step("open_queue"));
    const std::lock_guard lock(mutex_);
    auto* work = new Work;
    queues_.insert(work);
    return static_cast<Queue>(work);
}

void EmulatedDevice::close_queue(Queue queue) noexcept {
    const std::lock_guard lock(mutex_);
    queues_.erase(static_cast<Work*>(queue));
    delete static_cast<Work*>(queue);
}

Status EmulatedDevice::copy(Queue queue, const CopyRows& rows) {
    WEFT_CHECK_OK(step("copy"));
    ++copies_;
    static_cast<Work*>(queue)->queued.emplace_back([rows] {
        for (std::size_t y = 0; y < rows.rows; ++y) {
            std::memcpy(static_cast<std::byte*>(rows.to) + y * rows.to_pitch,
                        static_cast<const std::byte*>(rows.from) + y * rows.from_pitch,
                        rows.row_bytes);
        }
    });
    return {};
}

Status EmulatedDevice::clear(Queue queue, void* memory, std::size_t bytes) {
    WEFT_CHECK_OK(step("clear"));
    static_cast<Work*>(queue)->queued.emplace_back(
        [memory, bytes] { std::memset(memory, 0, bytes); });
    return {};
}

Status EmulatedDevice::launch(Queue queue, kernels::KernelId id, int blocks, const void* args) {
    WEFT_CHECK_OK(step("launch"));
    auto& queued = static_cast<Work*>(queue)->queued;
    kernels::with_kernel(id, [&](auto tag) {
        using K = typename decltype(tag)::Kernel;
        queued.emplace_back(
            [=, order = order_, copied = *static_cast<const typename K::Args*>(args)] {
                emulate<K>(blocks, copied, order);
            });
    });
    return {};
}

Status EmulatedDevice::wait(Queue queue) {
    auto& queued = static_cast<Work*>(queue)->queued;
    const Status status = step("wait");
    // A lost device does not finish what it was given.
    if (status) {
        for (const auto& work : queued)
            work();
    }
    queued.clear();
    return status;
}

}  // namespace weft::test
