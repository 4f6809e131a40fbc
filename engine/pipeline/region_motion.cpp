#include "engine/pipeline/region_motion.h"

#include "engine/motion/lattice_root.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

constexpr std::size_t kMostKept = 64;  // a frame is asked for by its neighbours, soon after it

}  // namespace

Expected<std::shared_ptr<const LatticeField>> RegionMotion::ref_from(int frame) const {
    {
        const std::lock_guard lock(mutex_);
        if (const auto at = kept_.find(frame); at != kept_.end()) return at->second;
    }
    WEFT_TRY(bytes, store_.get({region_, frame, AnalysisKind::kCoords}));
    WEFT_TRY(field, decode_lattice(bytes));
    auto found = std::make_shared<const LatticeField>(std::move(field));
    const std::lock_guard lock(mutex_);
    if (kept_.size() >= kMostKept) kept_.clear();
    kept_.emplace(frame, found);
    return found;
}

Expected<LatticeField> RegionMotion::between(int from, int to) const {
    WEFT_TRY(ref_from_here, ref_from(from));
    if (from == to) return LatticeField(ref_from_here->full_size(), ref_from_here->spacing());
    if (to == plan().reference_frames.front()) return *ref_from_here;
    WEFT_TRY(ref_from_there, ref_from(to));
    return through_reference(*ref_from_here, *ref_from_there);
}

Expected<Matte> RegionMotion::visible(int frame) const {
    return shown_matte(source_, plan_, store_, region_, frame);
}

Expected<float> RegionMotion::confidence(int frame) const {
    if (!plan().propagated()) return 1.0f;
    WEFT_TRY(bytes, store_.get({region_, frame, AnalysisKind::kMatte}));
    WEFT_TRY(matte, decode_matte(bytes));
    return matte.confidence;
}

}  // namespace weft
