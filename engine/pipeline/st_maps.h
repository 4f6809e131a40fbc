#pragma once
// ST-maps between the reference frame and the others, for compositors.

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// A map as Nuke's STMap node takes it. H×W of the plate.
struct StMap {
    /// The place of the other picture that comes to each pixel: s = x / W, t = 1 − y / H, with the
    /// centre of pixel (x, y) at (x + 0.5, y + 0.5), so 0–1 from the lower left corner; beyond the
    /// picture it goes on. Where `visible` is 0 it goes on for two pixels (st_rim.h), then it is 0.
    ImageF2 st;
    ImageF1 visible;  ///< How much of the surface the frame shows there, 0–1, holdouts taken off.
};

/// Both directions of a frame. Where regions overlap the topmost one counts, each with its own
/// (first) reference frame.
struct StMaps {
    StMap warp;       ///< By pixels of the frame: brings the reference frame's picture to it.
    StMap stabilize;  ///< By pixels of the reference frame: brings the frame's picture back to it.
};

/// The maps of a frame that has been analysed in locked mode. Where the surface folds over, a place
/// of the reference frame that the frame does not show once is not visible in `stabilize`. Errors:
/// those of the source and the store. Thread-safe; bit-identical everywhere.
[[nodiscard]] Expected<StMaps> st_maps(const ShotSource& source, const ShotPlan& plan,
                                       const AnalysisStore& store, int frame);

/// The maps of one surface between any two frames: `there` takes the reference frame's place.
/// `visible`: where `here` shows it. Thread-safe; bit-identical everywhere.
[[nodiscard]] StMaps st_maps_of(const LatticeField& there_from_here, const Matte& visible);

}  // namespace weft
