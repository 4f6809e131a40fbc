#include "gpu/gpu_frame.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace weft {
namespace {

using kernels::KernelId;
using kernels::LayerArgs;
using kernels::SampleArgs;
using kernels::SoftPixel;

constexpr char kInstead[] = "The CPU composited the frame instead.";
constexpr std::size_t kRgbBytes = 3 * sizeof(float);

template <class T, int C>
void pack(ImageView<const T, C> from, T* to) {
    const auto row = static_cast<std::size_t>(from.width()) * C;
    for (int y = 0; y < from.height(); ++y, to += row)
        std::memcpy(to, from.row(y), row * sizeof(T));
}

int wrap_of(WrapMode wrap) {
    switch (wrap) {
        case WrapMode::kRepeat:
            return kernels::kWrapRepeat;
        case WrapMode::kMirror:
            return kernels::kWrapMirror;
        case WrapMode::kClamp:
            break;
    }
    return kernels::kWrapClamp;
}

// The data of a layer, stored contiguously in pinned memory.
class Parcel {
  public:
    explicit Parcel(PinnedBuffer& staging) : staging_(staging) {}
    static std::size_t rounded(std::size_t bytes) { return (bytes + 255) / 256 * 256; }

    template <class T>
    T* add(std::size_t count) {
        at_ = end_;
        end_ += rounded(count * sizeof(T));
        return staging_.host<T>(at_);
    }
    // Sends what was added last.
    Status send(GpuState& state, Device::Queue queue, DeviceBuffer& to, std::size_t bytes) const {
        if (bytes == 0) return {};
        return state.device()->copy(
            queue, {to.as<void>(), bytes, staging_.host<void>(at_), bytes, bytes, 1});
    }

  private:
    PinnedBuffer& staging_;
    std::size_t at_ = 0, end_ = 0;
};

// Fills in what does not depend on the frame, and sends coordinates and matte.
Expected<SampleArgs> send_texture(GpuState& state, FramePlace& place, const DevicePlane& plane,
                                  const SampleRequest& request, Parcel& parcel) {
    const std::size_t pixels = area(request.coords.size());
    WEFT_CHECK_OK(state.reserve(place.coords, pixels * 2 * sizeof(float)));
    WEFT_CHECK_OK(state.reserve(place.matte, pixels));
    pack(request.coords, parcel.add<float>(2 * pixels));
    WEFT_CHECK_OK(parcel.send(state, place.queue.get(), place.coords, pixels * 2 * sizeof(float)));
    pack(request.matte, parcel.add<std::uint8_t>(pixels));
    WEFT_CHECK_OK(parcel.send(state, place.queue.get(), place.matte, pixels));

    SampleArgs args{};
    std::copy(plane.levels.begin(), plane.levels.end(), args.levels);
    args.level_count = static_cast<int>(plane.levels.size());
    args.plane_level = request.plane->plane_level();
    args.wrap = wrap_of(request.plane->wrap());
    args.fewest = request.quality == SampleQuality::kFinal ? 3 : 2;
    args.most = request.quality == SampleQuality::kFinal ? 8 : 4;
    args.coords = place.coords.as<float>();
    args.matte = place.matte.as<std::uint8_t>();
    args.width = request.coords.width(), args.height = request.coords.height();
    return args;
}

Status check_texture(const SampleRequest& r) {
    if (r.plane && !r.plane->empty() && r.plane->levels().size() <= kernels::kMostLevels &&
        r.coords.size() == r.matte.size()) {
        return {};
    }
    return fail(ErrorCode::kUsage,
                "A texture to be sampled on the GPU needs a plane, and coordinates and a matte of "
                "one size.");
}

std::vector<SoftPixel> soft_pixels(const LayerRequest& layer) {
    const ViewU8x1& matte = layer.texture.matte;
    std::vector<SoftPixel> soft;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const std::uint8_t m = matte.row(y)[x];
            if (m == 0 || m == 255) continue;
            const float* b = layer.old_surface.pixel(x, y);
            soft.push_back({y * matte.width() + x, {b[0], b[1], b[2]}});
        }
    }
    return soft;
}

Status sample_at(GpuState& state, FramePlace& place, std::shared_ptr<const DevicePlane>& plane,
                 const SampleRequest& request, ImageView<float, 3> out) {
    WEFT_CHECK_OK(check_texture(request));
    const std::size_t pixels = area(request.coords.size());
    WEFT_TRY(found, state.plane(*request.plane, place.queue.get()));
    plane = found;
    WEFT_CHECK_OK(state.reserve(
        place.layer_staging,
        std::max(Parcel::rounded(pixels * 2 * sizeof(float)) + Parcel::rounded(pixels),
                 pixels * kRgbBytes)));
    WEFT_CHECK_OK(state.reserve(place.texture, pixels * kRgbBytes));
    Parcel parcel(place.layer_staging);
    WEFT_TRY(args, send_texture(state, place, *plane, request, parcel));
    args.out = place.texture.as<float>();
    Device& device = *state.device();
    // Outside of the matte nothing is sampled, and all of it is copied.
    WEFT_CHECK_OK(device.clear(place.queue.get(), args.out, pixels * kRgbBytes));
    WEFT_CHECK_OK(
        launch<kernels::SamplePlane>(device, place.queue.get(), KernelId::kSamplePlane, args));
    WEFT_CHECK_OK(
        device.copy(place.queue.get(), {place.layer_staging.host<void>(), pixels * kRgbBytes,
                                        args.out, pixels * kRgbBytes, pixels * kRgbBytes, 1}));
    WEFT_CHECK_OK(device.wait(place.queue.get()));
    const auto* from = place.layer_staging.host<float>();
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x, from += 3) {
            if (request.matte.row(y)[x] != 0) std::copy_n(from, 3, out.pixel(x, y));
        }
    }
    return {};
}

}  // namespace

Status sample_plane_on(GpuState& state, const SampleRequest& request, ImageView<float, 3> out) {
    if (out.empty()) return {};
    WEFT_TRY(place, state.take_place());
    std::shared_ptr<const DevicePlane> plane;  // Held until nothing is queued any more.
    const Status status = sample_at(state, *place, plane, request, out);
    // After a failure the queue may still be running: wait before the place is released.
    if (!status && !state.device()->wait(place->queue.get())) return status;
    state.give_back(std::move(place));
    return status;
}

Expected<std::unique_ptr<GpuFrame>> GpuFrame::open(std::shared_ptr<GpuState> state, ViewF3 frame) {
    if (frame.empty()) return fail(ErrorCode::kUsage, "A frame to composite is empty.");
    WEFT_TRY(place, state->take_place());
    std::unique_ptr<GpuFrame> canvas(new GpuFrame(state, frame.size(), std::move(place)));
    WEFT_CHECK_OK(canvas->upload(frame));
    return canvas;
}

GpuFrame::~GpuFrame() {
    // The queue must be empty before the buffers serve another frame.
    if (state_->device()->wait(place_->queue.get()) && !broken_) {
        state_->give_back(std::move(place_));
    }
}

Status GpuFrame::noted(Status status) {
    if (!status) {
        broken_ = true;
        if (status.error().code != ErrorCode::kUsage) state_->note(status.error(), kInstead);
    }
    return status;
}

Status GpuFrame::upload(ViewF3 frame) {
    const std::size_t bytes = area(size_) * kRgbBytes;
    FramePlace& p = *place_;
    WEFT_CHECK_OK(state_->reserve(p.frame_staging, bytes));
    WEFT_CHECK_OK(state_->reserve(p.frame, bytes));
    WEFT_CHECK_OK(state_->reserve(p.touched, area(size_)));
    WEFT_CHECK_OK(state_->reserve(p.exceeded, sizeof(std::uint64_t)));
    pack(frame, p.frame_staging.host<float>());
    Device& device = *state_->device();
    WEFT_CHECK_OK(device.copy(
        p.queue.get(), {p.frame.as<void>(), bytes, p.frame_staging.host<void>(), bytes, bytes, 1}));
    return device.clear(p.queue.get(), p.touched.as<void>(), area(size_));
}

Status GpuFrame::check(const LayerRequest& layer) const {
    WEFT_CHECK_OK(check_texture(layer.texture));
    const Size box = layer.texture.coords.size();
    const Recti at{layer.origin.x, layer.origin.y, layer.origin.x + box.width,
                   layer.origin.y + box.height};
    const bool lit = !layer.gain || (!layer.gain->shading.empty() && layer.gain->downscale > 0);
    if (at == at.intersected(rect_of(size_)) && layer.old_surface.size() == box && lit) return {};
    return fail(ErrorCode::kUsage, "A layer does not fit its frame.");
}

Status GpuFrame::add(const LayerRequest& layer) {
    if (broken_) return fail(ErrorCode::kNoBackend, "The GPU has failed at this frame before.");
    if (layer.texture.coords.empty()) return {};
    return noted(add_layer(layer));
}

Status GpuFrame::add_layer(const LayerRequest& layer) {
    WEFT_CHECK_OK(check(layer));
    FramePlace& p = *place_;
    Device& device = *state_->device();
    // The layer before may still be read from the staging.
    if (!touched_.empty()) WEFT_CHECK_OK(device.wait(p.queue.get()));
    WEFT_TRY(plane, state_->plane(*layer.texture.plane, p.queue.get()));
    planes_.push_back(plane);

    const std::size_t pixels = area(layer.texture.coords.size());
    const std::vector<SoftPixel> soft = soft_pixels(layer);
    const std::size_t soft_bytes = soft.size() * sizeof(SoftPixel);
    const bool lit = layer.gain && layer.gain->strength > 0 &&
                     std::isfinite(layer.gain->reference) && layer.gain->reference > 0;
    const std::size_t shading = lit ? area(layer.gain->shading.size()) : 0;
    WEFT_CHECK_OK(state_->reserve(p.layer_staging, Parcel::rounded(pixels * 2 * sizeof(float)) +
                                                       Parcel::rounded(pixels) +
                                                       Parcel::rounded(soft_bytes) +
                                                       Parcel::rounded(shading * sizeof(float))));
    WEFT_CHECK_OK(state_->reserve(p.soft, soft_bytes));
    WEFT_CHECK_OK(state_->reserve(p.shading, shading * sizeof(float)));

    Parcel parcel(p.layer_staging);
    LayerArgs args{};
    WEFT_TRY(texture, send_texture(*state_, p, *plane, layer.texture, parcel));
    args.texture = texture;
    std::copy(soft.begin(), soft.end(), parcel.add<SoftPixel>(soft.size()));
    WEFT_CHECK_OK(parcel.send(*state_, p.queue.get(), p.soft, soft_bytes));
    if (lit) {
        pack(layer.gain->shading, parcel.add<float>(shading));
        WEFT_CHECK_OK(parcel.send(*state_, p.queue.get(), p.shading, shading * sizeof(float)));
        args.shading = p.shading.as<float>();
        args.shading_w = layer.gain->shading.width();
        args.shading_h = layer.gain->shading.height();
        args.shading_scale = 1.0f / static_cast<float>(layer.gain->downscale);
        args.inverse_reference = 1.0f / layer.gain->reference;
        args.least_gain = layer.gain->least_gain, args.most_gain = layer.gain->most_gain;
        args.strength = std::min(1.0f, layer.gain->strength);
    }
    std::copy(layer.multiply.begin(), layer.multiply.end(), args.multiply);
    args.frame = p.frame.as<float>();
    args.touched = p.touched.as<std::uint8_t>();
    args.frame_w = size_.width;
    args.origin_x = layer.origin.x, args.origin_y = layer.origin.y;
    args.soft = p.soft.as<SoftPixel>();
    args.soft_count = static_cast<int>(soft.size());
    WEFT_CHECK_OK(
        launch<kernels::LayerInside>(device, p.queue.get(), KernelId::kLayerInside, args));
    WEFT_CHECK_OK(launch<kernels::LayerEdge>(device, p.queue.get(), KernelId::kLayerEdge, args));
    touched_ = touched_.united({layer.origin.x, layer.origin.y, layer.origin.x + texture.width,
                                layer.origin.y + texture.height});
    return {};
}

Status GpuFrame::download(const Recti& rect, bool with_touched) {
    FramePlace& p = *place_;
    Device& device = *state_->device();
    const auto width = static_cast<std::size_t>(rect.width()),
               rows = static_cast<std::size_t>(rect.height()),
               pitch = static_cast<std::size_t>(size_.width);
    const std::size_t first =
        static_cast<std::size_t>(rect.y0) * pitch + static_cast<std::size_t>(rect.x0);
    // Growing must wait until nothing is read from it.
    WEFT_CHECK_OK(device.wait(p.queue.get()));
    WEFT_CHECK_OK(state_->reserve(p.layer_staging, width * rows * (kRgbBytes + 1)));
    WEFT_CHECK_OK(device.copy(p.queue.get(), {p.layer_staging.host<void>(), width * kRgbBytes,
                                              p.frame.as<float>() + 3 * first, pitch * kRgbBytes,
                                              width * kRgbBytes, rows}));
    if (with_touched) {
        WEFT_CHECK_OK(
            device.copy(p.queue.get(), {p.layer_staging.host<void>(width * rows * kRgbBytes), width,
                                        p.touched.as<std::uint8_t>() + first, pitch, width, rows}));
    }
    WEFT_CHECK_OK(device.wait(p.queue.get()));
    planes_.clear();
    return {};
}

Status GpuFrame::read(const Recti& rect, ImageView<float, 3> out) {
    if (broken_) return fail(ErrorCode::kNoBackend, "The GPU has failed at this frame before.");
    if (rect.empty()) return {};
    if (rect != rect.intersected(rect_of(size_)) || out.size() != rect.size()) {
        return fail(ErrorCode::kUsage, "The rectangle to read is outside the frame.");
    }
    WEFT_CHECK_OK(noted(download(rect, false)));
    const auto* from = place_->layer_staging.host<float>();
    for (int y = 0; y < rect.height(); ++y, from += 3 * rect.width())
        std::copy_n(from, 3 * rect.width(), out.row(y));
    return {};
}

Status GpuFrame::roll_off(float knee) {
    FramePlace& p = *place_;
    Device& device = *state_->device();
    WEFT_CHECK_OK(device.clear(p.queue.get(), p.exceeded.as<void>(), sizeof(std::uint64_t)));
    kernels::RollOffArgs args{};
    args.frame = p.frame.as<float>();
    args.touched = p.touched.as<std::uint8_t>();
    args.width = size_.width;
    args.x0 = touched_.x0, args.y0 = touched_.y0, args.x1 = touched_.x1, args.y1 = touched_.y1;
    args.knee = std::clamp(knee, 0.0f, 0.999f);
    args.exceeded = p.exceeded.as<std::uint64_t>();
    return launch<kernels::RollOff>(device, p.queue.get(), KernelId::kRollOff, args);
}

Status GpuFrame::complete(std::optional<float> knee) {
    if (knee) {
        WEFT_CHECK_OK(roll_off(*knee));
        WEFT_CHECK_OK(state_->device()->copy(
            place_->queue.get(), {&exceeded_, sizeof exceeded_, place_->exceeded.as<void>(),
                                  sizeof exceeded_, sizeof exceeded_, 1}));
    }
    return download(touched_, true);
}

Expected<std::int64_t> GpuFrame::finish(std::optional<float> knee, ImageView<float, 3> out) {
    if (broken_) return fail(ErrorCode::kNoBackend, "The GPU has failed at this frame before.");
    if (out.size() != size_) return fail(ErrorCode::kUsage, "The finished frame has another size.");
    if (touched_.empty()) return 0;
    WEFT_CHECK_OK(noted(complete(knee)));
    const auto width = static_cast<std::size_t>(touched_.width());
    const auto* from = place_->layer_staging.host<float>();
    const auto* touched = place_->layer_staging.host<std::uint8_t>(
        width * static_cast<std::size_t>(touched_.height()) * kRgbBytes);
    for (int y = touched_.y0; y < touched_.y1; ++y) {
        for (int x = touched_.x0; x < touched_.x1; ++x, from += 3, ++touched) {
            if (*touched != 0) std::copy_n(from, 3, out.pixel(x, y));
        }
    }
    return static_cast<std::int64_t>(exceeded_);
}

}  // namespace weft
