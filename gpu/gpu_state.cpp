#include "gpu/gpu_state.h"

#include <algorithm>

namespace weft {

void GpuState::note(const Error& error, const std::string& instead) {
    if (error.code == ErrorCode::kNoBackend) lost_ = true;
    std::string remark = error.text() + " " + instead;
    const std::lock_guard lock(remarks_mutex_);
    if (std::find(remarks_.begin(), remarks_.end(), remark) == remarks_.end()) {
        remarks_.push_back(std::move(remark));
    }
}

std::vector<std::string> GpuState::remarks() const {
    const std::lock_guard lock(remarks_mutex_);
    return remarks_;
}

void GpuState::free_idle() {
    {
        const std::lock_guard lock(places_mutex_);
        places_.clear();
    }
    const std::lock_guard lock(planes_mutex_);
    shrink_planes(0);
}

// Planes in use stay, because their users hold them too.
void GpuState::shrink_planes(std::size_t limit_bytes) {
    std::size_t bytes = 0;
    for (const auto& plane : planes_)
        bytes += plane->memory.bytes();
    for (auto it = planes_.end(); it != planes_.begin() && bytes > limit_bytes;) {
        --it;
        if (it->use_count() > 1) continue;
        bytes -= (*it)->memory.bytes();
        it = planes_.erase(it);
    }
}

Status GpuState::send_levels(const PlanePyramid& pyramid, DevicePlane& plane, Device::Queue queue) {
    auto* to = plane.memory.as<kernels::Texel>();
    for (const auto& level : pyramid.levels()) {
        WEFT_CHECK_OK(device_->copy(queue, {to, level.size_bytes(), level.data(),
                                            level.size_bytes(), level.size_bytes(), 1}));
        plane.levels.push_back(
            {to, level.width(), level.height(),
             static_cast<float>(level.width()) / static_cast<float>(pyramid.size().width),
             static_cast<float>(level.height()) / static_cast<float>(pyramid.size().height)});
        to += static_cast<std::ptrdiff_t>(level.width()) * level.height();
    }
    return {};
}

Expected<std::shared_ptr<const DevicePlane>> GpuState::upload(const PlanePyramid& pyramid,
                                                              Device::Queue queue) {
    std::size_t bytes = 0;
    for (const auto& level : pyramid.levels())
        bytes += level.size_bytes();
    auto plane = std::make_shared<DevicePlane>();
    plane->identity = pyramid.identity();
    Status reserved = plane->memory.reserve(device_, bytes);
    if (!reserved && reserved.error().code == ErrorCode::kNoSpace) {
        shrink_planes(0);
        reserved = plane->memory.reserve(device_, bytes);
    }
    WEFT_CHECK_OK(reserved);
    const Status sent = send_levels(pyramid, *plane, queue);
    // In any case nothing may still write to the plane's memory when it is released.
    const Status done = device_->wait(queue);
    WEFT_CHECK_OK(sent);
    WEFT_CHECK_OK(done);
    return plane;
}

Expected<std::shared_ptr<const DevicePlane>> GpuState::plane(const PlanePyramid& pyramid,
                                                             Device::Queue queue) {
    const std::lock_guard lock(planes_mutex_);
    const auto found = std::find_if(planes_.begin(), planes_.end(), [&](const auto& p) {
        return p->identity == pyramid.identity();
    });
    if (found != planes_.end()) {
        planes_.splice(planes_.begin(), planes_, found);
        return planes_.front();
    }
    WEFT_TRY(plane, upload(pyramid, queue));
    planes_.push_front(plane);
    shrink_planes(plane_bytes_);
    return plane;
}

Expected<std::unique_ptr<FramePlace>> GpuState::take_place() {
    {
        const std::lock_guard lock(places_mutex_);
        if (!places_.empty()) {
            auto place = std::move(places_.back());
            places_.pop_back();
            return place;
        }
    }
    auto place = std::make_unique<FramePlace>();
    WEFT_CHECK_OK(place->queue.open(device_));
    return place;
}

void GpuState::give_back(std::unique_ptr<FramePlace> place) {
    const std::lock_guard lock(places_mutex_);
    places_.push_back(std::move(place));
}

}  // namespace weft
