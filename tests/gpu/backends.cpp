#include "tests/gpu/backends.h"

#include "gpu/cuda_backend.h"

namespace weft::test {
namespace {

// A search that sets the instruction set for as long as it lives.
class WithIsa final : public PlaneSearch {
  public:
    WithIsa(Isa isa, const PlaneSearchSetup& setup, SynthesisMethod method) {
        force_isa(isa);
        search_ = make_synthesis_search(setup, method);
    }
    ~WithIsa() override { force_isa(std::nullopt); }
    Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) override {
        return search_->update(rect, pixels, filled);
    }
    Expected<PlaneSearchResult> find(const PlaneSearchRequest& request) override {
        return search_->find(request);
    }

  private:
    std::unique_ptr<PlaneSearch> search_;
};

Searcher on_cpu(const std::string& name, Isa isa, SynthesisMethod method) {
    return {name,
            [=](const PlaneSearchSetup& setup, std::string& why) -> std::unique_ptr<PlaneSearch> {
                if (isa_available(isa)) return std::make_unique<WithIsa>(isa, setup, method);
                why = "This processor has no " + std::string(isa_name(isa)) + ".";
                return nullptr;
            },
            false};
}

Searcher emulated(const std::string& name, SearchStrategy strategy, ThreadOrder order) {
    return {name, [=](const PlaneSearchSetup& setup, std::string&) {
                return emulated_backend(strategy, order)->open_plane_search(setup);
            }};
}

std::shared_ptr<const Backend> from_registry(const std::string& name, std::string& why) {
    BackendRegistry registry;
    register_cuda(registry);
    const auto choice = registry.choose(name);
    if (choice) return choice->backend;
    why = choice.error().text();
    return nullptr;
}

Searcher on_gpu(const std::string& name, const std::string& backend) {
    return {name,
            [=](const PlaneSearchSetup& setup, std::string& why) -> std::unique_ptr<PlaneSearch> {
                const auto made = from_registry(backend, why);
                return made ? made->open_plane_search(setup) : nullptr;
            }};
}

}  // namespace

std::shared_ptr<const Backend> emulated_backend(SearchStrategy strategy, ThreadOrder order) {
    return std::make_shared<const GpuBackend>(std::make_shared<EmulatedDevice>(order),
                                              GpuBackendOptions{"emulated", strategy, 0});
}

std::vector<Searcher> searchers() {
    using Strategy = SearchStrategy;
    return {on_cpu("CpuScalar", Isa::kScalar, SynthesisMethod::kDirect),
            on_cpu("CpuAvx2", Isa::kAvx2, SynthesisMethod::kDirect),
            on_cpu("CpuAvx512", Isa::kAvx512, SynthesisMethod::kDirect),
            on_cpu("CpuFft", Isa::kScalar, SynthesisMethod::kFft),
            emulated("EmulatedTiled", Strategy::kTiled, ThreadOrder::kForward),
            emulated("EmulatedTiledBackward", Strategy::kTiled, ThreadOrder::kBackward),
            emulated("EmulatedTiledShuffled", Strategy::kTiled, ThreadOrder::kShuffled),
            emulated("EmulatedCandidate", Strategy::kCandidate, ThreadOrder::kForward),
            emulated("EmulatedCandidateShuffled", Strategy::kCandidate, ThreadOrder::kShuffled),
            emulated("EmulatedPixel", Strategy::kPixel, ThreadOrder::kForward),
            emulated("EmulatedPixelShuffled", Strategy::kPixel, ThreadOrder::kShuffled),
            on_gpu("CudaTiled", "cuda"),
            on_gpu("CudaCandidate", "cuda-candidate"),
            on_gpu("CudaPixel", "cuda-pixel")};
}

std::vector<Framer> framers() {
    return {{"Emulated", [](std::string&) { return emulated_backend(); }, true},
            {"EmulatedShuffled",
             [](std::string&) {
                 return emulated_backend(SearchStrategy::kTiled, ThreadOrder::kShuffled);
             },
             true},
            {"Cuda", [](std::string& why) { return from_registry("cuda", why); }, false}};
}

}  // namespace weft::test
