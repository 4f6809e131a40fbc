#pragma once
// Shared state of a GPU backend's operations: the device, the texture planes on it, the buffers of
// frames, and failures.

#include <atomic>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/compute/plane_pyramid.h"
#include "engine/core/geometry.h"
#include "gpu/device.h"

namespace weft {

[[nodiscard]] inline std::size_t area(Size s) {
    return static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
}

/// A texture plane on the device.
struct DevicePlane {
    std::uint64_t identity = 0;
    DeviceBuffer memory;
    std::vector<kernels::Level> levels;
};

/// Buffers and a queue for one frame at a time; kept and used again, because allocating is slow.
struct FramePlace {
    DeviceQueue queue;
    PinnedBuffer frame_staging, layer_staging;
    DeviceBuffer frame, touched, exceeded;
    DeviceBuffer coords, matte, shading, soft, texture;
};

/// Thread-safe.
class GpuState {
  public:
    /// Planes are kept on the device up to `plane_bytes`, besides those in use.
    GpuState(std::shared_ptr<Device> device, std::size_t plane_bytes)
        : device_(std::move(device)), plane_bytes_(plane_bytes) {}

    [[nodiscard]] const std::shared_ptr<Device>& device() const { return device_; }
    /// True after an error that the device does not recover from.
    [[nodiscard]] bool lost() const { return lost_; }
    /// Records a failure; `instead` says what happens now, for the report.
    void note(const Error& error, const std::string& instead);
    [[nodiscard]] std::vector<std::string> remarks() const;

    /// Reserves memory; if there is too little, first frees what is only cached.
    template <class Buffer>
    [[nodiscard]] Status reserve(Buffer& buffer, std::size_t bytes) {
        Status status = buffer.reserve(device_, bytes);
        if (status || status.error().code != ErrorCode::kNoSpace) return status;
        free_idle();
        return buffer.reserve(device_, bytes);
    }

    /// The plane on the device, copied there if it is not there yet.
    [[nodiscard]] Expected<std::shared_ptr<const DevicePlane>> plane(const PlanePyramid& pyramid,
                                                                     Device::Queue queue);
    [[nodiscard]] Expected<std::unique_ptr<FramePlace>> take_place();
    void give_back(std::unique_ptr<FramePlace> place);

  private:
    void free_idle();
    void shrink_planes(std::size_t limit_bytes);
    Status send_levels(const PlanePyramid& pyramid, DevicePlane& plane, Device::Queue queue);
    [[nodiscard]] Expected<std::shared_ptr<const DevicePlane>> upload(const PlanePyramid& pyramid,
                                                                      Device::Queue queue);

    std::shared_ptr<Device> device_;
    std::size_t plane_bytes_;
    std::atomic<bool> lost_{false};

    mutable std::mutex remarks_mutex_;
    std::vector<std::string> remarks_;

    std::mutex planes_mutex_;
    std::list<std::shared_ptr<const DevicePlane>> planes_;  ///< The one used last in front.

    std::mutex places_mutex_;
    std::vector<std::unique_ptr<FramePlace>> places_;
};

}  // namespace weft
