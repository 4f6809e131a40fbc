#pragma once
// Internal to SurfaceWalker: what a walk knows, in surface_walker.cpp while the surface is seen and
// in walk_search.cpp while it is not.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/temporal/anchors.h"
#include "engine/temporal/exposure_match.h"
#include "engine/temporal/following_doubt.h"
#include "engine/temporal/jointed_parts.h"
#include "engine/temporal/lost_places.h"
#include "engine/temporal/rigid_plane.h"
#include "engine/temporal/step_motion.h"
#include "engine/temporal/stretch_limit.h"
#include "engine/temporal/surface_walker.h"

namespace weft {

/// Pixels that are covered by at least a half.
[[nodiscard]] std::int64_t visible_pixels(ViewU8x1 visible);

/// What a walk knows. Not thread-safe.
struct SurfaceWalker::State {
    SurfaceWalkerOptions options;
    LatticeField ref_from_cur, prev_from_cur;
    std::shared_ptr<const StepFrame> last;

    AnchorSet anchors;
    LatticeField anchor_from_cur;  // of the present anchor
    // Against which outlines are registered: the last reference frame, and its position.
    std::shared_ptr<const StepFrame> drawing;
    LatticeField ref_from_drawing;
    MotionChoice choice;
    ExposureMatch exposure;
    LostPlaces lost_places;
    FollowingDoubt doubt;
    RigidPlane plane;
    int since_older_tried = 0;  // frames

    // Once any is found, they walk in place of the whole.
    JointedParts parts;
    bool is_part = false;  // parts are told by the walk of the whole

    // After the texture was released to its own shape: its previous track, continued for the
    // frames over which a seam hides the change.
    LatticeField relaxed_at_event, stretched_at_event, stretched;
    int hiding_left = 0, hiding_frames = kReanchorFrames;
    bool hide_reanchoring = false;

    bool lost = false;                     // not visible, or not found again yet
    int hidden_for = 0, searched_for = 0;  // frames
    std::int64_t first_px = 0;             // the visible area in the frame where the walk begins
    std::int64_t largest_px = 0;           // the largest visible area in any frame
    // The last frame that showed enough of the surface to determine its motion as a whole.
    LatticeField steady_ref_from_cur, steady_step;
    int since_steady = 0;  // frames
    // Frames on which it was visible while it was searched, each with the step from the frame
    // before.
    struct Searched {
        std::shared_ptr<const StepFrame> frame;
        LatticeField prev_from_cur;
        bool a_sliver = false;
    };
    std::vector<Searched> searched;
    std::vector<LatticeField> found_late;

    void become_anchor(std::shared_ptr<const StepFrame> frame) {
        const int generation = anchors.empty() ? 0 : anchors.present().generation + 1;
        anchors.add({std::move(frame), ref_from_cur, generation, prev_from_cur});
        anchor_from_cur = LatticeField(frame_size(), options.spacing_px);
    }
    void become_drawing() {
        drawing = last;
        ref_from_drawing = ref_from_cur;
    }
    [[nodiscard]] Size frame_size() const { return last->size(); }

    // The position of the frame on an anchor, from the positions of both on the reference frame.
    [[nodiscard]] LatticeField predicted(const Anchor& anchor) const {
        return compose(ref_from_cur, inverse(anchor.ref_from_anchor));
    }
    void follow(LatticeField step) {
        prev_from_cur = std::move(step);
        // The frame where the walk begins, whose own motion nobody knows, goes on as it came.
        if (anchors.present().motion.empty()) anchors.set_motion(inverse(prev_from_cur));
        anchor_from_cur = compose(prev_from_cur, anchor_from_cur);
        ref_from_cur = compose(anchor_from_cur, anchors.present().ref_from_anchor);
    }
    void correct(std::size_t anchor, LatticeField field) {
        anchors.use(anchor);
        anchor_from_cur = std::move(field);
        ref_from_cur = compose(anchor_from_cur, anchors.present().ref_from_anchor);
    }

    [[nodiscard]] bool is_hidden(std::int64_t visible_px);
    // True if too little of the surface is visible to determine its motion.
    [[nodiscard]] bool is_sliver(std::int64_t visible_px) const {
        return 6 * visible_px < largest_px;
    }
    [[nodiscard]] StretchLimits stretch_limits(ViewU8x1 visible) const;
    [[nodiscard]] LatticeField believed_step(const LatticeField& measured, ViewU8x1 visible) const;
    bool reanchor(ViewU8x1 visible);
    void slide_back(ViewU8x1 visible);
    void advance_stretched();
    void note_steady(ViewU8x1 visible, std::int64_t visible_px);
    // A frame against an anchor, by what the walk goes by. `motion`: of the step to it.
    [[nodiscard]] Registered against(const Anchor& anchor, const StepFrame& cur,
                                     const LatticeField& motion, const LatticeField& initial) const;
    [[nodiscard]] Registered against_present(const StepFrame& cur);
    // Whether the surface may have parts that move by themselves, as far as it is known.
    [[nodiscard]] bool may_have_parts() const;
    void find_late(const std::shared_ptr<const StepFrame>& cur);
    void wait_out_of_view();
    void search(const std::shared_ptr<const StepFrame>& cur, std::int64_t visible_px);
    [[nodiscard]] bool asks_outline() const { return !plane.believed() || !plane.is_borne_out(); }
    [[nodiscard]] const StepEvidence& evidence_of(const WalkStep& to) const;
    void note_step(const StepFrame& cur);
    std::optional<RegistrationFit> lay_as_plane(const StepFrame& cur, const Registered& found);
    std::optional<RegistrationFit> lay_as_settled_plane(const StepFrame& cur);
    void leave_plane(const StepFrame& cur);
    void lay(const LatticeField& expected, const LatticeField& registered, ViewU8x1 visible);
    bool take_rest(const WalkStep& to);
    void register_frame(const std::shared_ptr<const StepFrame>& cur);
    void register_drawing(const StepFrame& cur);
    bool advance_parts(const SurfaceWalker& whole, const WalkStep& to);
    bool try_others(const StepFrame& cur, int generation_below, double share_above);
};

}  // namespace weft
