#pragma once
// All kernels by number, so that what starts them needs no nvcc.

#include "gpu/kernels/frame.h"
#include "gpu/kernels/sampling.h"
#include "gpu/kernels/search_candidate.h"
#include "gpu/kernels/search_pixel.h"
#include "gpu/kernels/search_select.h"
#include "gpu/kernels/search_tiled.h"

namespace weft::kernels {

enum class KernelId : int {
    kSearchPixelLevel,
    kSearchCandidateLevel,
    kSearchTiled,
    kSearchSelect,
    kSamplePlane,
    kLayerInside,
    kLayerEdge,
    kRollOff,
};
constexpr int kKernelCount = static_cast<int>(KernelId::kRollOff) + 1;

template <class K>
struct KernelTag {
    using Kernel = K;
};

/// Calls visit(KernelTag<K>{}) for the kernel of that number and returns what it returns.
template <class Visit>
auto with_kernel(KernelId id, Visit visit) {
    switch (id) {
        case KernelId::kSearchPixelLevel:
            return visit(KernelTag<SearchPixelLevel>{});
        case KernelId::kSearchCandidateLevel:
            return visit(KernelTag<SearchCandidateLevel>{});
        case KernelId::kSearchTiled:
            return visit(KernelTag<SearchTiled>{});
        case KernelId::kSearchSelect:
            return visit(KernelTag<SearchSelect>{});
        case KernelId::kSamplePlane:
            return visit(KernelTag<SamplePlane>{});
        case KernelId::kLayerInside:
            return visit(KernelTag<LayerInside>{});
        case KernelId::kLayerEdge:
            return visit(KernelTag<LayerEdge>{});
        case KernelId::kRollOff:
            break;
    }
    return visit(KernelTag<RollOff>{});
}

}  // namespace weft::kernels
