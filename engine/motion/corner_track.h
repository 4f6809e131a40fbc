#pragma once
// The motion of a plane from another program's track: four corners on every frame.

#include <map>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/quad.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Top left, top right, bottom right, bottom left by frame, in plate pixels.
using CornerTrack = std::map<int, Quad<double>>;

/// How the numbers of a track file relate to the plate.
struct CornerTrackContext {
    Size plate;           ///< Nuke counts y from the bottom.
    int first_frame = 0;  ///< The plate's first frame, which is frame 0 in After Effects.
    bool points = false;  ///< The track of one point is accepted as well: an upright square.
};

/// Reads a track from text, in one of these formats, which it detects:
/// - a Nuke CornerPin2D node (.nk): its to1 … to4 (bottom left, bottom right, top right, top left),
///   fixed or as curves, y upwards; linear between two keys of a curve;
/// - After Effects keyframe data: Corner Pin-0001 … 0004 or CC Power Pin-0002 … 0005 (top left, top
///   right, bottom left, bottom right), scaled from the source's size to the plate's;
/// - lines of "frame x y x y x y x y" (top left, top right, bottom right, bottom left) with blanks,
///   commas or semicolons between the numbers; # begins a comment.
/// With `points` also lines of "frame x y", and After Effects' Position or Feature Center.
/// Missing frames between the first and the last are interpolated linearly. Errors: Unreadable with
/// the line or the corner that is wrong, or if the corners are not convex.
[[nodiscard]] Expected<CornerTrack> parse_corner_track(std::string_view text,
                                                       const CornerTrackContext& context);

/// Fills missing frames linearly and checks that all corners are convex.
[[nodiscard]] Expected<CornerTrack> completed(CornerTrack track);

/// The motion of a plane whose corners lie at `source` and `target`: target_from_source over a
/// frame of size `full`, a homography on a lattice. It is altered near and beyond the plane's
/// horizon, where it has no meaning.
[[nodiscard]] LatticeField plane_motion(const Quad<double>& source, const Quad<double>& target,
                                        Size full, int spacing);

}  // namespace weft
