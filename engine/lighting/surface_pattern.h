#pragma once
// What of a surface's lightness is a pattern at all.

#include "engine/core/image.h"

namespace weft {

/// The blur that removes a pattern, of the size below which structures belong to the surface:
/// stripes of that period fall to 1 %.
constexpr float kPatternSigma = 0.5f;

/// Which marks a surface has: some that are darker than its ground, some that are lighter.
struct PrintedMarks {
    bool dark = false, light = false;
};

struct SurfacePattern {
    /// H×W: the weight that was given, and 0 on marks: lines, dots and figures all over a surface
    /// of one other paint.
    ImageF1 ground;
    /// 0 where what varies between the marks is its own shading (folds, wrinkles, facets), 1 where
    /// it is pattern.
    float presence = 0;
    PrintedMarks marks = {};
};

/// Marks are darker, or lighter, than their surroundings, nearly all by more than half of the most,
/// and in at least half of the parts of the surface; creases and shadows have every depth and their
/// places. `luma`: ln luma of H×W; `weight`: 0 to 1; `pattern_px`: the size below which structures
/// belong to the surface, in its pixels. Thread-safe, bit-identical for any number of threads.
[[nodiscard]] SurfacePattern surface_pattern(const ImageF1& luma, const ImageF1& weight,
                                             float pattern_px);

/// `weight`, and 0 on the marks of a surface of which it is known that it has such.
[[nodiscard]] ImageF1 ground_between(const PrintedMarks& marks, const ImageF1& luma,
                                     const ImageF1& weight, float pattern_px);

}  // namespace weft
