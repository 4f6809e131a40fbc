#include "engine/pipeline/draft_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/block_means.h"
#include "engine/mask/plate_edge.h"
#include "engine/motion/follow_size.h"
#include "engine/pipeline/surface_track.h"

namespace weft {

int draft_factor(const ShotPlan& plan, Size plate) {
    constexpr std::int64_t kPixels = 240'000;
    constexpr int kMost = 8;
    const bool given = std::any_of(
        plan.regions.begin(), plan.regions.end(),
        [](const RegionPlan& region) { return region.true_motion || !region.track.empty(); });
    if (given) return 1;
    int factor = 1;
    while (factor < kMost && std::int64_t{plate.width} * plate.height > kPixels * factor * factor)
        factor *= 2;
    return factor;
}

Size DraftSource::size() const {
    return blocks_of(source_.size(), factor_);
}

Expected<std::shared_ptr<const ImageF3>> DraftSource::plate(int frame) const {
    WEFT_TRY(full, source_.plate(frame));
    return std::make_shared<const ImageF3>(block_means(*full, factor_));
}

Expected<PlateAlpha> DraftSource::alpha(int frame) const {
    WEFT_TRY(full, source_.alpha(frame));
    if (full.coverage)
        full.coverage = std::make_shared<const ImageF1>(block_means(*full.coverage, factor_));
    return full;
}

Expected<Matte> DraftSource::reduced(Expected<Matte> full) const {
    if (!full) return full;
    return block_means(*full, factor_);
}

Expected<Matte> DraftSource::matte(int region, int frame) const {
    return reduced(source_.matte(region, frame));
}

Expected<Matte> DraftSource::matte_key(int region, int frame) const {
    return reduced(source_.matte_key(region, frame));
}

Expected<Matte> DraftSource::holdout_key(int region, int painted, int frame) const {
    return reduced(source_.holdout_key(region, painted, frame));
}

Expected<ConfirmedPart> DraftSource::confirmed_part(int region, int layer, int frame) const {
    WEFT_TRY(full, source_.confirmed_part(region, layer, frame));
    return ConfirmedPart{block_means(full.matte, factor_), block_means(full.area, factor_)};
}

Expected<std::optional<Matte>> DraftSource::holdout(int region, int frame) const {
    WEFT_TRY(full, source_.holdout(region, frame));
    if (!full) return std::optional<Matte>();
    return std::optional<Matte>(block_means(*full, factor_));
}

// Only where nothing is reduced (draft_factor()).
Expected<FlowField> DraftSource::motion(int region, int frame) const {
    return source_.motion(region, frame);
}

Expected<Bytes> DraftStore::get(const AnalysisKey& key) const {
    WEFT_TRY(bytes, small_.get(key));
    if (factor_ == 1) return bytes;
    switch (key.kind) {
        case AnalysisKind::kMatte:
        case AnalysisKind::kMatteForward:
        case AnalysisKind::kMatteBackward: {
            WEFT_TRY(found, decode_matte(bytes));
            return encode(
                StoredMatte{enlarged(found.matte, Vec2(static_cast<float>(factor_)), plate_),
                            found.confidence});
        }
        case AnalysisKind::kCoords:
        case AnalysisKind::kCoordsOneWay: {
            WEFT_TRY(field, decode_lattice(bytes));
            const int spacing = SurfaceTrack::spacing_for(plate_, SurfaceTrack::Motion::kEstimated);
            return encode(resized(field, plate_, spacing));
        }
        default:
            return bytes;
    }
}

}  // namespace weft
