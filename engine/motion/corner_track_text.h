#pragma once
// A planar track as text for other programs, which parse_corner_track() reads again.

#include <string>
#include <string_view>

#include "engine/motion/corner_track.h"

namespace weft {

/// What a program has to know besides the corners.
struct CornerTextContext {
    Size plate;               ///< Pixels.
    int first_frame = 0;      ///< The plate's first frame, which is frame 0 in After Effects.
    int reference = 0;        ///< The frame that the corners start from; `track` has it.
    double fps = 24;          ///< Frames a second.
    double pixel_aspect = 1;  ///< Width of a pixel over its height.
    std::string_view name = "corner_pin";  ///< Letters, digits and _ only: the node's name.
};

// Numbers have 4 decimals of a pixel, of the picture's size in Blender 7. Equal tracks give equal
// bytes on every machine. Pure and thread-safe. `track` is not empty and has every frame of its
// range (completed()).

/// A CornerPin2D node to paste into Nuke: `from` holds the corners on the reference frame, `to` has
/// a key for each frame, y upwards.
[[nodiscard]] std::string nuke_corner_pin(const CornerTrack& track,
                                          const CornerTextContext& context);

/// Adobe After Effects 8.0 Keyframe Data of the effect Corner Pin, as Mocha exports it and After
/// Effects pastes it.
[[nodiscard]] std::string after_effects_corner_pin(const CornerTrack& track,
                                                   const CornerTextContext& context);

/// A Python script that adds a keyed Corner Pin node to the compositor of Blender's open scene.
[[nodiscard]] std::string blender_corner_pin(const CornerTrack& track,
                                             const CornerTextContext& context);

}  // namespace weft
