#pragma once
#include <memory>
#include <string>

#include "engine/compute/backend.h"
#include "gpu/device.h"

namespace weft {

class GpuState;

/// How the placement search is distributed over threads. All strategies find the same.
enum class SearchStrategy {
    kTiled,      ///< Candidates in registers; what `cuda` uses.
    kCandidate,  ///< The paper's candidate-level strategy.
    kPixel       ///< The paper's pixel-level strategy.
};

struct GpuBackendOptions {
    std::string name = "cuda";
    SearchStrategy strategy = SearchStrategy::kTiled;
    std::size_t plane_bytes = 0;  ///< Memory for texture planes on the device; 0: a quarter of it.
};

/// A backend on a device. The CPU takes over what the device fails at; remarks() reports it.
class GpuBackend final : public Backend {
  public:
    explicit GpuBackend(std::shared_ptr<Device> device, GpuBackendOptions options = {});

    [[nodiscard]] std::string name() const override { return options_.name; }
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] std::vector<std::string> remarks() const override;
    void sample_plane(const SampleRequest& request, ImageView<float, 3> out) const override;
    [[nodiscard]] std::unique_ptr<PlaneSearch> open_plane_search(
        const PlaneSearchSetup& setup) const override;
    [[nodiscard]] std::unique_ptr<FrameCanvas> open_frame(ViewF3 frame) const override;

  private:
    GpuBackendOptions options_;
    std::shared_ptr<GpuState> state_;
};

}  // namespace weft
