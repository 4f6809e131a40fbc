#pragma once
// Internal to MatteWalker: what a walk knows, and what a step does with it.

#include <optional>
#include <vector>

#include "engine/mask/background_plate.h"
#include "engine/mask/boundary_refiner.h"
#include "engine/mask/confirmed_part.h"
#include "engine/mask/departure.h"
#include "engine/mask/flat_fills.h"
#include "engine/mask/followed.h"
#include "engine/mask/key_exposure.h"
#include "engine/mask/left_behind.h"
#include "engine/mask/matte_propagation.h"
#include "engine/mask/motion_return.h"
#include "engine/mask/motion_sides.h"
#include "engine/mask/newcomers.h"
#include "engine/mask/part_return.h"
#include "engine/mask/resting_scene.h"
#include "engine/mask/shape_transport.h"
#include "engine/mask/surface_palette.h"
#include "engine/mask/surface_return.h"
#include "engine/mask/uncovered.h"
#include "engine/mask/unseen_ground.h"

namespace weft {

/// What a walk knows. Not thread-safe.
struct MatteWalker::State {
    ImageU8x3 frame;  ///< The last frame of the walk, as exposed on the keyframe …
    ImageF1 phi;      ///< … and the signed distance of its matte's boundary, pixels.
    ImageU8x3 key_frame;
    ImageF1 key_phi;
    ImageF1 seen, key_seen;  ///< As both, 0 where something in front hides it; empty: nowhere.
    ImageF2 key_from_prev;   ///< Where each pixel's surface lay on the keyframe, pixels.
    RefineScale scale;
    BackgroundPlate plate;
    SurfacePalette palette;
    MatteOptions options;
    float confidence = 1;
    ImageF1 key_softness;    ///< Half the width of the keyframe's edge, pixels.
    float clearance_px = 0;  ///< Nearer to the boundary, colours are not used.
    Matte last;              ///< The matte of the walk's last frame.
    SurfaceReturn hidden;
    FlatFills fills;
    Departure departure;
    MotionReturn lost;
    PartReturn part_lost;
    RestingScene scene;
    UnseenGround ground;
    KeyExposure exposure = {};
    MotionSides sides = {};
    Uncovered uncovered = {};
    Newcomers newcomers = {};
    LeftBehind left_behind = {};
    ConfirmedPlaces confirmed = {};
    std::optional<Followed> followed = {};  ///< Where walks are merged.
    float since_confidence = 1;             ///< Of what was confirmed last.
    bool soft_edges = false;                ///< Whether key_softness is anything but 0.
    bool at_key = true;                     ///< No step has been made.
    std::vector<Matte> late = {};           ///< Of the frames before, by blocks.

    void leave_frame(const FlowField& prev_from_cur);
    [[nodiscard]] Matte soften(ViewU8x3 part, const RefinedBoundary& found, ViewF2 key_from_cur,
                               ViewF2 prev_from_cur, const Recti& area) const;
    void take_back(ViewU8x3 now, const FlowField& prev_from_cur, ImageF1& distance, Matte& matte);
    [[nodiscard]] MatteEstimate estimate(Matte matte) const;
    void take_whole_fills(ViewU8x3 now, ImageF1& distance, Matte& matte);
    void take_as_scene(ViewU8x3 now, const FlowField& prev_from_cur, const Matte& covered,
                       ImageF1& distance, Matte& matte);
    void take_ground(const GroundStep& step, ImageF1& distance, Matte& matte);
    [[nodiscard]] Matte drop_islands(ViewU8x3 now, const FlowField& prev_from_cur,
                                     ViewF2 background, ImageF1& distance, Matte& matte);
    LocalColorField fit_colors(ViewU8x3 part, const TransportedShape& shape, ViewF2 key_from_cur,
                               const Recti& area, Matte covered) const;
    RefinedBoundary find_boundary(ViewU8x3 part, const TransportedShape& shape, ViewF2 key_from_cur,
                                  const FlowField& prev_from_cur, const Recti& area,
                                  const Matte& covered);
    [[nodiscard]] const ImageF1& seen_phi() const { return seen.empty() ? phi : seen; }
};

}  // namespace weft
