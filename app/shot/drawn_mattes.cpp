#include "app/shot/drawn_mattes.h"

#include <algorithm>

#include "app/exchange/track_file.h"
#include "engine/mask/keyed_shape.h"
#include "engine/mask/shape_matte.h"

namespace weft {

Expected<std::shared_ptr<const CornerTrack>> DrawnMattes::track_of(const KeyedShape& shape) const {
    using Track = std::shared_ptr<const CornerTrack>;
    if (shape.follow == ShapeFollow::kNone) return std::make_shared<const CornerTrack>();
    if (shape.track.empty())
        return fail(ErrorCode::kUsage, "A shape follows a track, but none is set.",
                    "Choose a track, or let the shape follow nothing.");
    const std::lock_guard lock(mutex_);
    Track& known = tracks_[shape.track];
    if (!known) {
        WEFT_TRY(track, read_corner_track(shape.track, {size_, first_frame_, true}));
        known = std::make_shared<const CornerTrack>(std::move(track));
    }
    return known;
}

Expected<RotoShape> DrawnMattes::shape(const KeyedShape& shape, int frame) const {
    WEFT_TRY(track, track_of(shape));
    return shape_on(shape, *track, frame, aspect_);
}

std::optional<RotoShape> DrawnMattes::known_shape(const KeyedShape& shape, int frame) const {
    if (shape.follow == ShapeFollow::kNone) return shape_on(shape, {}, frame, aspect_);
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return std::nullopt;
    const auto known = tracks_.find(shape.track);
    if (known == tracks_.end() || !known->second) return std::nullopt;
    return shape_on(shape, *known->second, frame, aspect_);
}

Expected<Matte> DrawnMattes::matte(const KeyedShape& shape, bool invert, int frame) const {
    WEFT_TRY(here, this->shape(shape, frame));
    Matte out = matte_of_shape(here, size_, aspect_);
    if (invert)
        std::transform(out.data(), out.data() + out.size_bytes(), out.data(),
                       [](std::uint8_t v) { return static_cast<std::uint8_t>(255 - v); });
    return out;
}

void add_shape(Hasher& hasher, const KeyedShape& shape) {
    hasher.value(static_cast<int>(shape.follow)).text(shape.track);
    for (const auto& [frame, drawn] : shape.keys) {
        hasher.value(frame).value(static_cast<std::uint64_t>(drawn.points.size()));
        for (const RotoPoint& p : drawn.points)
            for (const float number :
                 {p.at.x, p.at.y, p.in.x, p.in.y, p.out.x, p.out.y, p.feather_px})
                hasher.value(number);
    }
}

Status check_shapes(const Region& region, const FrameReader& plate) {
    const DrawnMattes drawn(plate.size(), plate.frames().front());
    const auto check = [&](const MatteSource& matte) -> Status {
        if (matte.shape.empty()) return {};
        WEFT_TRY(shape, drawn.shape(matte.shape, matte.shape.keys.begin()->first));
        return {};
    };
    WEFT_CHECK_OK(check(*region.matte));
    for (const MatteSource& holdout : *region.holdouts)
        WEFT_CHECK_OK(check(holdout));
    for (const Zone& zone : *region.zones)
        WEFT_CHECK_OK(check(zone.matte));
    return {};
}

}  // namespace weft
