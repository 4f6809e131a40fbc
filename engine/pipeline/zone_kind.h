#pragma once

namespace weft {

/// What a painted zone changes on its region, and what its value means there.
enum class ZoneKind {
    /// How much of the light the texture takes: a factor on the light's strength, 0 to 2. 0 leaves
    /// the texture unlit, 1 changes nothing.
    kLight,
    /// What there counts as light: light detail, 0 (paint) to 1 (light, all that the plate shows).
    kDetail,
    // The motion of the surface (engine/temporal/zone_motion.h); the value is how far, 0 to 1.
    kIgnore,        ///< The picture there says nothing of it; the surface around does.
    kStiffer,       ///< It moves as one flat, stiff piece.
    kCalmer,        ///< Its trembling is averaged away over time.
    kSurroundings,  ///< It moves with what the picture shows around the zone.
};

/// Whether a zone changes the surface's motion, and not its light.
[[nodiscard]] constexpr bool changes_motion(ZoneKind kind) {
    return kind != ZoneKind::kLight && kind != ZoneKind::kDetail;
}

/// The number under which the matte of a region's zone number `zone` goes where those of its mattes
/// are numbered: −1 and below, apart from the extent's 0 and the holdouts' 1 and above.
[[nodiscard]] constexpr int zone_layer(int zone) {
    return -1 - zone;
}
[[nodiscard]] constexpr bool is_zone_layer(int layer) {
    return layer < 0;
}
/// The zone's number, of a layer for which is_zone_layer() holds.
[[nodiscard]] constexpr int zone_of_layer(int layer) {
    return -1 - layer;
}

}  // namespace weft
