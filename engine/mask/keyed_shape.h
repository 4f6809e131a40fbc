#pragma once
// Roto shapes that follow a track.

#include <glm/mat3x3.hpp>

#include "engine/core/pixel_aspect.h"
#include "engine/mask/roto_shape.h"
#include "engine/motion/corner_track.h"

namespace weft {

/// What a shape that follows `track` does from one frame to another: a homography of plate pixels,
/// the identity without following or track. Before its first frame and after its last one the track
/// stands still. A similarity is one of the picture unsqueezed.
[[nodiscard]] glm::dmat3 track_motion(const CornerTrack& track, ShapeFollow follow, int from,
                                      int to, PixelAspect aspect = {});

/// The shape moved by a homography: points and the ends of handles go with it, feather with the
/// size. A shape that would cross the plane's horizon stays as it is.
[[nodiscard]] RotoShape moved(const RotoShape& shape, const glm::dmat3& motion);

/// The shape on a frame: the keys around it move there along the track and are mixed by their
/// distance in time. Outside of the keys the nearest one follows. Pure. `shape` has a key.
[[nodiscard]] RotoShape shape_on(const KeyedShape& shape, const CornerTrack& track, int frame,
                                 PixelAspect aspect = {});

}  // namespace weft
