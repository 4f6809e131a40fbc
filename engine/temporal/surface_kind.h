#pragma once
#include <cstdint>

namespace weft {

/// What moves: how much a surface's motion may bend, and where.
enum class SurfaceKind : std::uint8_t {
    kFound,  ///< Taken for a rigid plane as long as the clip bears it out, else for a body.
    kPlane,  ///< One rigid plane, on every frame: a homography of the reference frame.
    kRigid,  ///< One rigid thing: as found, and not divided into parts.
    kCloth,  ///< Bends smoothly, without parts.
    kBody    ///< Bends, and may have joints: parts that move by themselves.
};

/// Whether a surface may turn out to be a plane.
[[nodiscard]] constexpr bool may_be_plane(SurfaceKind kind) {
    return kind != SurfaceKind::kCloth && kind != SurfaceKind::kBody;
}

}  // namespace weft
