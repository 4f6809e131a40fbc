#include "gpu/cuda_device.h"

#include <cuda_runtime_api.h>

#include "engine/core/setting.h"
#include "gpu/cuda_kernels.h"

namespace weft {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

Error error_of(cudaError_t code, const std::string& doing) {
    const std::string why = std::string(cudaGetErrorString(code)) + " (" + cudaGetErrorName(code) +
                            ") while " + doing + ".";
    if (code == cudaErrorMemoryAllocation) {
        (void)cudaGetLastError();  // This one is not the end of the device.
        return {ErrorCode::kNoSpace,
                "The GPU has too little free memory: " + why,
                "Close other programs that use it, or use the CPU" +
                    by({{setting::kBackend, "cpu"}}) + ".",
                {}};
    }
    return {ErrorCode::kNoBackend, "The GPU is no longer available: " + why, {}, {}};
}

Status status_of(cudaError_t code, const char* doing) {
    if (code == cudaSuccess) return {};
    return tl::unexpected<Error>(error_of(code, doing));
}

// A stream with the events that time it.
struct Stream {
    cudaStream_t stream = nullptr;
    cudaEvent_t start = nullptr, stop = nullptr;

    ~Stream() {
        if (start) cudaEventDestroy(start);
        if (stop) cudaEventDestroy(stop);
        if (stream) cudaStreamDestroy(stream);
    }
};

Stream& stream_of(Device::Queue queue) {
    return *static_cast<Stream*>(queue);
}

// The runtime's calls are thread-safe, and all threads use device 0.
class CudaDevice final : public Device {
  public:
    explicit CudaDevice(const cudaDeviceProp& properties)
        : description_(std::string(properties.name) + ", compute capability " +
                       std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                       ", " + std::to_string(properties.totalGlobalMem / kMiB) + " MiB"),
          total_bytes_(properties.totalGlobalMem) {}

    [[nodiscard]] std::string description() const override { return description_; }
    [[nodiscard]] std::size_t total_bytes() const override { return total_bytes_; }

    Expected<void*> allocate(std::size_t bytes) override {
        void* memory = nullptr;
        const cudaError_t code = cudaMalloc(&memory, bytes);
        if (code == cudaSuccess) return memory;
        return tl::unexpected<Error>(error_of(code, allocating(bytes)));
    }
    void release(void* memory) noexcept override { (void)cudaFree(memory); }

    Expected<PinnedMemory> allocate_pinned(std::size_t bytes) override {
        PinnedMemory memory;
        cudaError_t code = cudaHostAlloc(&memory.host, bytes, cudaHostAllocMapped);
        if (code == cudaSuccess) {
            code = cudaHostGetDevicePointer(&memory.device, memory.host, 0);
            if (code == cudaSuccess) return memory;
            (void)cudaFreeHost(memory.host);
        }
        return tl::unexpected<Error>(error_of(code, allocating(bytes)));
    }
    void release_pinned(PinnedMemory memory) noexcept override { (void)cudaFreeHost(memory.host); }

    Expected<Queue> open_queue() override {
        auto stream = std::make_unique<Stream>();
        WEFT_CHECK_OK(status_of(cudaStreamCreateWithFlags(&stream->stream, cudaStreamNonBlocking),
                                "opening a stream"));
        WEFT_CHECK_OK(status_of(cudaEventCreate(&stream->start), "making an event"));
        WEFT_CHECK_OK(status_of(cudaEventCreate(&stream->stop), "making an event"));
        return static_cast<Queue>(stream.release());
    }
    void close_queue(Queue queue) noexcept override { delete static_cast<Stream*>(queue); }

    Status copy(Queue queue, const CopyRows& r) override {
        const cudaStream_t stream = stream_of(queue).stream;
        const cudaError_t code =
            r.rows == 1 ? cudaMemcpyAsync(r.to, r.from, r.row_bytes, cudaMemcpyDefault, stream)
                        : cudaMemcpy2DAsync(r.to, r.to_pitch, r.from, r.from_pitch, r.row_bytes,
                                            r.rows, cudaMemcpyDefault, stream);
        return status_of(code, "copying");
    }
    Status clear(Queue queue, void* memory, std::size_t bytes) override {
        return status_of(cudaMemsetAsync(memory, 0, bytes, stream_of(queue).stream), "clearing");
    }
    Status launch(Queue queue, kernels::KernelId id, int blocks, const void* args) override {
        const int code = launch_cuda_kernel(id, blocks, args, stream_of(queue).stream);
        return status_of(static_cast<cudaError_t>(code), "starting a kernel");
    }
    Status start_timer(Queue queue) override {
        const Stream& s = stream_of(queue);
        return status_of(cudaEventRecord(s.start, s.stream), "timing");
    }
    Status stop_timer(Queue queue) override {
        const Stream& s = stream_of(queue);
        return status_of(cudaEventRecord(s.stop, s.stream), "timing");
    }
    Status wait(Queue queue) override {
        return status_of(cudaStreamSynchronize(stream_of(queue).stream), "waiting for it");
    }
    Expected<double> timed_ms(Queue queue) override {
        const Stream& s = stream_of(queue);
        float ms = 0;
        WEFT_CHECK_OK(status_of(cudaEventElapsedTime(&ms, s.start, s.stop), "timing"));
        return static_cast<double>(ms);
    }

  private:
    static std::string allocating(std::size_t bytes) {
        return "allocating " + std::to_string((bytes + kMiB - 1) / kMiB) + " MiB";
    }

    std::string description_;
    std::size_t total_bytes_;
};

tl::unexpected<Error> unusable(const std::string& why) {
    return fail(ErrorCode::kNoBackend, "CUDA cannot be used here: " + why + ".");
}

}  // namespace

Expected<std::shared_ptr<Device>> open_cuda_device() {
    int devices = 0;
    cudaError_t code = cudaGetDeviceCount(&devices);
    if (code != cudaSuccess) return unusable(cudaGetErrorString(code));
    if (devices == 0) return unusable("no CUDA device was found");
    cudaDeviceProp properties{};
    code = cudaGetDeviceProperties(&properties, 0);
    if (code != cudaSuccess) return unusable(cudaGetErrorString(code));
    // Loads the kernels, and so finds out whether there is code for this device.
    code = static_cast<cudaError_t>(load_cuda_kernels());
    if (code != cudaSuccess) {
        return unusable(std::string(properties.name) +
                        " does not run this build's kernels: " + cudaGetErrorString(code));
    }
    return std::make_shared<CudaDevice>(properties);
}

}  // namespace weft
