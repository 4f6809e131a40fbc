#pragma once
// A matte in the document: from files, painted on keyframes, or drawn from a shape.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/project/leaf.h"
#include "app/project/matte_edge_params.h"
#include "engine/mask/matte_reach.h"
#include "engine/mask/roto_shape.h"
#include "engine/media/image_files.h"

namespace weft {

/// A matte painted on one frame.
struct MatteKeyframe {
    std::string path;
    std::optional<RotoShape> shape = {};  ///< The roto shape that the matte was drawn from.
    bool shape_between = false;  ///< The shape was interpolated between those of other frames.
    Extras extra = {};
    bool operator==(const MatteKeyframe&) const = default;
};

/// Parts of a propagated matte that are confirmed on a frame: inside of the area it is as here.
struct ConfirmedEdge {
    std::string path;  ///< The frame's whole matte, as it was when a part was confirmed.
    std::string area;  ///< An image of the plate's size: what is confirmed is above half.
    Extras extra = {};
    bool operator==(const ConfirmedEdge&) const = default;
};

/// A matte over time: a file for each frame, or painted keyframes that are propagated.
struct MatteSource {
    std::string files;                       ///< Pattern; empty: keyframes.
    std::map<int, MatteKeyframe> keyframes;  ///< By frame number.
    /// By frame number; on a keyframe they say nothing, since all of it is right.
    std::map<int, ConfirmedEdge> confirmed;
    /// A roto shape over time, from which every frame's matte is drawn: no files, no keyframes.
    KeyedShape shape;
    MatteSelect select;
    double steadiness = 0.5;   ///< 0–1: reduction of boil in propagated mattes.
    std::vector<int> frozen;   ///< Frames whose mattes are read, not propagated,
    std::string frozen_files;  ///< from files of this pattern.
    /// Direction and range in which painted mattes are propagated; unset ends: the shot's.
    PropagationDirection propagate_direction = PropagationDirection::kBoth;
    std::optional<int> propagate_from, propagate_to;
    MatteEdgeParams edge;
    Extras extra;
    [[nodiscard]] bool empty() const {
        return files.empty() && keyframes.empty() && select.crypto.empty() && shape.empty();
    }
    /// There is a matte for every frame, and none is painted or propagated.
    [[nodiscard]] bool by_frame() const { return !files.empty() || !shape.empty(); }
    bool operator==(const MatteSource&) const = default;
};

}  // namespace weft
