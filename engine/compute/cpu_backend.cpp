#include "engine/compute/backend_registry.h"
#include "engine/compute/plane_sampler.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

class CpuBackend final : public Backend {
  public:
    [[nodiscard]] std::string name() const override { return "cpu"; }
    [[nodiscard]] std::string description() const override {
        return "CPU, " + std::to_string(thread_count()) + " threads";
    }
    void sample_plane(const SampleRequest& request, ImageView<float, 3> out) const override {
        sample_plane_cpu(request, out);
    }
};

}  // namespace

std::shared_ptr<const Backend> make_cpu_backend() {
    return std::make_shared<CpuBackend>();
}

}  // namespace weft
