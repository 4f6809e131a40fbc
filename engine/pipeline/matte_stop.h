#pragma once
// A frame on which the walks of painted mattes stop, and how their mattes are read and stored.

#include <functional>
#include <memory>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/matte_stretch.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Picture and motion of matte_size(). Borrowed from the sweep.
struct MatteStop {
    int frame = 0;
    const ImageU8x3& plate;   ///< Of the plate's size.
    const ImageU8x3& walked;  ///< The same, or smaller.
    const FrameMotion* prev_from_cur = nullptr;
    bool cut = false;  ///< A new scene begins with it, as a walk sees it;
    std::shared_ptr<const SceneFrame> scene = {};  ///< and what it shows of the scene.

    /// `matte` of the plate's size as it is walked, which is kept in `smaller` if it is reduced.
    [[nodiscard]] const Matte& reduce(const Matte& matte, Matte& smaller) const;
    /// Where each pixel was on the stop before; null where that was of another scene.
    [[nodiscard]] const FlowField* motion_if_no_cut() const {
        return prev_from_cur != nullptr && !cut ? &prev_from_cur->get() : nullptr;
    }
};

/// Calls `visit` with what a sweep comes to, without `cut` and `scene`.
[[nodiscard]] Status stop_at(const SweepFrame& at,
                             const std::function<Status(const MatteStop&)>& visit);

/// A matte as it was painted, of the plate's size. Errors: the source's.
[[nodiscard]] Expected<Matte> painted_matte(const ShotSource& source, const MatteStretch& job,
                                            int frame);

/// What passes in front of a stretch's matte, of the plate's size; empty: nothing does.
[[nodiscard]] Expected<Matte> in_front_of(const PassContext& context, const AnalysisStore& store,
                                          const MatteStretch& job, int frame);

/// The matte of a frame from its estimate, at the plate's size and with what is confirmed.
[[nodiscard]] Expected<MatteEstimate> of_plate(const PassContext& context, MatteEstimate estimate,
                                               const MatteStretch& job, const MatteStop& at,
                                               const Matte& front);

/// Beyond a cut there is nothing to go on from: the surface may be anywhere in the new scene, and
/// most often it is not in it.
[[nodiscard]] MatteEstimate not_there(Size size);
[[nodiscard]] bool is_not_there(const MatteEstimate& estimate);

[[nodiscard]] Status put_estimate(AnalysisStore& store, const MatteStretch& job, int frame,
                                  AnalysisKind kind, MatteEstimate estimate);
[[nodiscard]] Expected<MatteEstimate> get_estimate(const AnalysisStore& store,
                                                   const MatteStretch& job, int frame,
                                                   AnalysisKind kind);

}  // namespace weft
