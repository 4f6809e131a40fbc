#pragma once
// The frames against which a walk is registered.

#include <memory>
#include <utility>
#include <vector>

#include "engine/motion/lattice_field.h"
#include "engine/motion/optical_flow.h"
#include "engine/motion/photometric_register.h"
#include "engine/temporal/step_motion.h"

namespace weft {

/// A frame of the walk whose position on the reference frame is known.
struct Anchor {
    std::shared_ptr<const StepFrame> frame;
    LatticeField ref_from_anchor;
    int generation = 0;        ///< Number of anchors between it and the reference frame.
    LatticeField motion = {};  ///< Of the step to it (of the first one: from it); empty: not known.
};

/// True if the picture shows the surface at all: unrelated pictures leave a residual of about 0.7.
[[nodiscard]] inline bool shows_surface(const RegistrationFit& fit) {
    return fit.residual < 0.45 && fit.share > 0.5;
}

/// A frame registered against one anchor.
struct Registered {
    LatticeField anchor_from_cur;
    RegistrationFit fit;
    bool planar = false;  ///< By a homography.
    [[nodiscard]] bool holds() const { return shows_surface(fit); }
};

/// What is compared of an anchor and a frame: the colours, if both have any and `by_color`, else
/// the lumas. Refers to both.
struct RegisteredPictures {
    const RegistrationPicture &there, &here;
    ViewU8x1 luma;  ///< What `here` was made of.
};
[[nodiscard]] RegisteredPictures pictures_of(const Anchor& anchor, const StepFrame& cur,
                                             bool by_color);
/// How homographies are registered.
[[nodiscard]] RegistrationOptions planar_options(FlowQuality quality);

/// Registers a frame against an anchor from an initial field: by a smooth correction, or by a
/// homography where that explains the frame as well. `by_color`: as in pictures_of(). Pure;
/// deterministic.
[[nodiscard]] Registered register_against(const Anchor& anchor, const StepFrame& cur, bool by_color,
                                          const LatticeField& initial, FlowQuality quality);

/// The anchors of one walk: the first, which is the reference frame or replaces it, and the latest
/// few. Not thread-safe.
class AnchorSet {
  public:
    /// Makes `anchor` the present one.
    void add(Anchor anchor);
    [[nodiscard]] const Anchor& present() const { return anchors_[present_]; }
    /// How the present anchor's frame moves, found later.
    void set_motion(LatticeField motion) { anchors_[present_].motion = std::move(motion); }
    void use(std::size_t index) { present_ = index; }
    /// Calls change(anchor) for each.
    template <class Change>
    void each(const Change& change) {
        for (Anchor& anchor : anchors_)
            change(anchor);
    }
    /// Drops all anchors, because their mapping to the reference frame is no longer valid.
    void clear() { anchors_.clear(); }
    [[nodiscard]] bool empty() const { return anchors_.empty(); }
    [[nodiscard]] std::size_t present_index() const { return present_; }
    /// All, oldest first.
    [[nodiscard]] const std::vector<Anchor>& all() const { return anchors_; }

  private:
    std::vector<Anchor> anchors_;
    std::size_t present_ = 0;
};

}  // namespace weft
