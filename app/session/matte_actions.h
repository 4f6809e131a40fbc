#pragma once
// What an artist can ask the session to do with mattes: part of app/session/action.h.

#include <cstdint>
#include <string>
#include <vector>

#include "app/mattes/paint.h"
#include "app/project/project.h"
#include "engine/mask/shape_matte.h"

namespace weft {

/// What is painted from now on: 0 the selected region's matte, k its holdout k − 1, −1 − k its zone
/// k; one more than it has begins a new one with the first stroke, a zone of this kind and value.
struct SelectMatteLayer {
    int layer = 0;
    ZoneKind zone_kind = ZoneKind::kLight;
    double zone_value = 0;
    bool operator==(const SelectMatteLayer&) const = default;
};
/// What a stroke does on a frame to which the matte is propagated.
enum class StrokeKind : std::uint8_t {
    kKeyframe,  ///< The whole frame becomes a keyframe.
    kHere,      ///< It counts where it was painted; the rest is propagated as before.
    kConfirm    ///< Says where the propagated matte is right.
};
struct BeginStroke {
    Brush brush;
    Vec2 at{0, 0};
    float pressure = 1;
    StrokeKind kind = StrokeKind::kKeyframe;
    bool operator==(const BeginStroke&) const = default;
};
struct ContinueStroke {
    Vec2 at{0, 0};
    float pressure = 1;
    bool operator==(const ContinueStroke&) const = default;
};
struct EndStroke {
    bool operator==(const EndStroke&) const = default;
};
// `here_only`: as StrokeKind::kHere, where the matte changes.
struct FillPolygon {
    std::vector<Vec2> points;
    bool subtract = false;
    bool here_only = false;
    bool operator==(const FillPolygon&) const = default;
};
struct FloodSelect {
    Vec2i at{0, 0};
    int tolerance = 24;
    bool subtract = false;
    bool here_only = false;
    bool operator==(const FloodSelect&) const = default;
};
struct GrowMatte {
    float px = 1;
    bool operator==(const GrowMatte&) const = default;
};
struct FeatherMatte {
    float px = 2;
    bool operator==(const FeatherMatte&) const = default;
};
struct ClearMatte {
    bool operator==(const ClearMatte&) const = default;
};
/// Finds a surface from lines that lie surely inside and surely outside of it.
struct ScribbleSelect {
    std::vector<std::vector<Vec2>> keep, drop;
    bool here_only = false;
    bool operator==(const ScribbleSelect&) const = default;
};
/// Shows what a scribble would give, without making it; without lines, no more.
struct TryScribble {
    ScribbleSelect lines;
    bool operator==(const TryScribble&) const = default;
};
/// The matte of this frame is what lies inside the shape.
struct SetShape {
    RotoShape shape;
    bool operator==(const SetShape&) const = default;
};
/// From now on the layer's mattes are drawn from its shape on every frame: between the frames on
/// which it was drawn it moves along a track, and the rest is interpolated. Without a track (and
/// unless it follows nothing) the motion of the region's surface is taken, as it was analysed.
struct FollowShape {
    ShapeFollow follow = ShapeFollow::kNone;
    std::string track = {};  ///< A file; empty: the one it has, else the surface's motion.
    bool again = false;      ///< Takes the surface's motion anew.
    bool operator==(const FollowShape&) const = default;
};
/// The other way: the shapes become painted keyframes, which are propagated.
struct DetachShape {
    bool operator==(const DetachShape&) const = default;
};
/// Makes the matte shown on this frame a painted keyframe (a correction of a propagated one).
struct KeyMatteHere {
    bool operator==(const KeyMatteHere&) const = default;
};
/// The painted keyframe of one frame to another.
struct CopyKeyframe {
    int from = 0, to = 0;
    bool operator==(const CopyKeyframe&) const = default;
};
/// Adds the Cryptomatte object at this plate pixel to what is painted, or takes it away.
struct PickCryptomatte {
    Vec2i at{0, 0};
    bool subtract = false;
    bool operator==(const PickCryptomatte&) const = default;
};
/// Leaves the files of the selected region's matte and paints on from what they show here.
struct PaintInstead {
    bool operator==(const PaintInstead&) const = default;
};
struct PauseAnalysis {
    bool paused = true;
    bool operator==(const PauseAnalysis&) const = default;
};

/// Shows the painted layer's keyframes before and after the frame, for drawing between them.
struct ShowOnionSkin {
    bool shown = false;
    bool operator==(const ShowOnionSkin&) const = default;
};

/// Writes the selected region's mattes of the marked range (else of the whole shot).
struct ExportMattes {
    std::string pattern;
    bool operator==(const ExportMattes&) const = default;
};
/// Keeps the mattes of that range as they are now, or lets them follow again.
struct FreezeMattes {
    bool frozen = true;
    bool operator==(const FreezeMattes&) const = default;
};

}  // namespace weft
