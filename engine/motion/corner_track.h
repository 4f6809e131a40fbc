#pragma once
// The motion of a plane that another program has tracked: four corners on every frame.

#include <map>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/quad.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Top left, top right, bottom right, bottom left by frame, in plate pixels.
using CornerTrack = std::map<int, Quad<double>>;

/// How the numbers of a track's file lie on the plate.
struct CornerTrackContext {
    Size plate;           ///< Nuke counts y from the bottom.
    int first_frame = 0;  ///< The plate's first frame; After Effects counts from 0 there.
};

/// Reads a track from text. What it is, is seen from the text:
/// - a Nuke CornerPin2D node (.nk): its to1 … to4 (bottom left, bottom right, top right, top left),
///   fixed or as curves, y upwards; between two keys of a curve values go in a straight line;
/// - After Effects keyframe data: Corner Pin-0001 … 0004 or CC Power Pin-0002 … 0005 (top left, top
///   right, bottom left, bottom right), scaled from the source's size to the plate's;
/// - else lines of "frame x y x y x y x y" (top left, top right, bottom right, bottom left),
/// numbers
///   between blanks, commas or semicolons; from # on a line is a comment.
/// Frames between the first and the last that the text leaves out lie on straight lines. Errors:
/// Unreadable with the line or the corner that is wrong; a track whose corners are not convex.
[[nodiscard]] Expected<CornerTrack> parse_corner_track(std::string_view text,
                                                       const CornerTrackContext& context);

/// Straight lines between the frames that a track has, and the check that all corners are convex.
[[nodiscard]] Expected<CornerTrack> completed(CornerTrack track);

/// Where the plane that has its corners at `source` had them at `target`: target_from_source over a
/// frame of size `full`. The homography, held on a lattice; beyond the plane's horizon, where it
/// has no meaning, it is bent away from it.
[[nodiscard]] LatticeField plane_motion(const Quad<double>& source, const Quad<double>& target,
                                        Size full, int spacing);

}  // namespace weft
