#pragma once
// A surface's motion from one frame to the next: by the picture inside it, or by its outline.

#include <memory>
#include <mutex>
#include <optional>

#include "engine/motion/color_picture.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/moving_parts.h"
#include "engine/motion/optical_flow.h"
#include "engine/motion/outline_register.h"

namespace weft {

/// One frame of a walk: copies of its pictures, and what registration makes of them, computed when
/// it is first asked for. Const access is thread-safe.
class StepFrame {
  public:
    /// `luma`, `visible` (the matte without holdouts), `extent` (the full matte): H×W.
    StepFrame(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 extent);
    /// With `display`, sRGB codes, H×W, which is shared: its colours too, if the surface has any.
    /// `before`: the frame that the walk comes from, whose axis is kept; null: this one begins the
    /// walk.
    StepFrame(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 extent,
              std::shared_ptr<const ImageU8x3> display, const StepFrame* before);

    [[nodiscard]] Size size() const { return luma_.size(); }
    [[nodiscard]] OutlineView view() const { return {luma_, extent_, visible_}; }
    [[nodiscard]] const RegistrationPicture& picture() const;
    /// Whether color() shows anything.
    [[nodiscard]] bool has_color() const { return !color_.empty(); }
    /// The colours (color_picture()) as 8-bit luma; empty if there are none.
    [[nodiscard]] ViewU8x1 color() const { return color_; }
    /// The plate as displayed; empty if it was not given.
    [[nodiscard]] const ImageU8x3& display() const;
    /// The same frame as a walk along a part of the surface sees it. `visible`: the part, H×W;
    /// `before`: as above.
    [[nodiscard]] std::shared_ptr<const StepFrame> part(ViewU8x1 visible,
                                                        const StepFrame* before) const;
    /// As picture(), of the colours. Call it only if there are any.
    [[nodiscard]] const RegistrationPicture& color_picture() const;
    [[nodiscard]] const OutlineShape& outline() const;

  private:
    Matte luma_, extent_, visible_, color_;
    std::shared_ptr<const ImageU8x3> display_;
    std::optional<ColorAxis> axis_;
    mutable std::once_flag picture_made_, color_picture_made_, outline_made_;
    mutable std::optional<RegistrationPicture> picture_, color_picture_;
    mutable std::optional<OutlineShape> outline_;
};

class OutlineEvidence;

/// What two neighbouring frames of a walk say of the step between them. It does not depend on where
/// the walk has led, so it can be gathered ahead of it.
struct StepEvidence {
    LatticeField by_picture;  ///< prev_from_cur of the picture inside, from the plate's raw motion.
    /// The same from pictures that are freed of light, where that may explain more.
    std::optional<LatticeField> by_freed;
    std::optional<double> freed_lead;  ///< Before by_picture, standard errors; where searched.
    std::optional<LatticeField> by_outline;  ///< The outline's, where structure is faint;
    double lead = 0;                         ///< then picture_lead().
    /// Where the picture shows lines of one direction (stripes_of()): the picture's motion across
    /// them and the outline's along them, then how far the picture's own leads (picture_lead()).
    std::optional<LatticeField> by_lines = {};
    double lines_lead = 0;
    /// As by_picture, from colours, which light does not change, where lumas do not agree
    /// everywhere.
    std::optional<LatticeField> by_color = {};
    double color_lead = 0;  ///< Before what luma finds, as colours judge it, standard errors.
    /// Parts that seem to move by themselves (find_moving_parts()), where there is some structure,
    /// and the plate's raw motion, from which they are told (set by who has it; null: no parts).
    MovingParts parts = {};
    std::shared_ptr<const FlowField> raw = {};
    /// What the outline adds to this, where nobody has asked for it yet; else null.
    std::shared_ptr<const OutlineEvidence> open = {};
    /// Whether there is so little structure inside that the picture may show light alone.
    bool faint = false;
};

/// How far motion that was fitted to two pictures leads before the outline's, in standard errors
/// (registration_lead()) beyond what it gains by being fitted to the very pictures that judge it:
/// on a shining car it follows the light. 0 if too little can be compared. Pure.
[[nodiscard]] double picture_lead(const RegistrationPicture& before, const RegistrationPicture& now,
                                  const LatticeField& picture, const LatticeField& outline);

/// Gathers it. Pictures that are freed of light (estimate_surface_flow()) are searched where the
/// plate's raw motion `prev_from_cur` does not find the surface again almost everywhere; how far
/// they lead is registration_lead(), and what their motion gains in places that are consistent
/// there and back. The outline's motion is measured where structure is faint
/// (structure_to_noise()) or runs in one direction. Pure, but for the caches of the frames.
[[nodiscard]] StepEvidence gather_evidence(const StepFrame& prev, const StepFrame& cur,
                                           const FlowField& prev_from_cur, FlowQuality quality,
                                           int spacing_px);

/// The same without the outline, which takes most of the time: that is left open. The result shares
/// what is passed.
[[nodiscard]] StepEvidence picture_evidence(std::shared_ptr<const StepFrame> prev,
                                            std::shared_ptr<const StepFrame> cur,
                                            std::shared_ptr<const FlowField> prev_from_cur,
                                            FlowQuality quality, int spacing_px);

/// Which motion a surface follows: of the picture inside it, from the plate or freed of light, or
/// of its outline. One frame says little, so leads are averaged, and a choice changes only where
/// the other one leads clearly. Not thread-safe.
class MotionChoice {
  public:
    /// How far the picture's motion leads before the outline's in one step (picture_lead()).
    void note(double lead);
    /// How far that of pictures freed of light leads before the plate's (StepEvidence::freed_lead).
    void note_freed(double lead);
    /// How far the motion of colours leads before that of lumas (StepEvidence::color_lead).
    void note_color(double lead);
    /// How far the picture's motion along its lines leads before the outline's.
    void note_lines(double lead);
    [[nodiscard]] bool by_lines() const { return lines_.leads; }
    [[nodiscard]] bool by_outline() const { return !picture_.leads; }
    [[nodiscard]] bool freed() const { return freed_.leads; }
    [[nodiscard]] bool by_color() const { return color_.leads; }

  private:
    struct Lead {
        double mean = 0;  // of the last frames
        int noted = 0;    // of them
        bool leads = false;

        void note(double lead, int frames, double above, double below);
    };
    // As after three frames of indifference: a walk begins by the outline unless the picture leads
    // clearly.
    Lead picture_{0, 3, false}, freed_, color_, lines_{0, 3, false};
};

struct StepMotion {
    LatticeField prev_from_cur;
    bool by_outline = false;  ///< There is nothing inside to register either.
    bool by_color = false;    ///< Colours are what is registered, too.
};

/// The surface's motion: of those that were measured the one that `choice` takes after what the
/// pictures bear out.
[[nodiscard]] StepMotion choose_motion(const StepEvidence& evidence, MotionChoice& choice);

/// What exact motion says of a step: it is followed closely, and nothing else is asked.
[[nodiscard]] StepEvidence exact_evidence(const StepFrame& cur, const FlowField& prev_from_cur,
                                          int spacing_px);

}  // namespace weft
