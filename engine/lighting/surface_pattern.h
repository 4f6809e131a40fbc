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
/// places. They are looked for in `luma`, ln luma of H×W, because a colour of their own explains
/// only a part of them; `undecided`: the same without what colours explain. `weight`: 0 to 1;
/// `pattern_px`: the size below which structures belong to the surface, in its pixels. Thread-safe,
/// bit-identical for any number of threads.
[[nodiscard]] SurfacePattern surface_pattern(const ImageF1& luma, const ImageF1& undecided,
                                             const ImageF1& weight, float pattern_px);

/// `weight`, and 0 on the marks in `luma` of a surface of which it is known that it has such.
[[nodiscard]] ImageF1 ground_between(const PrintedMarks& marks, const ImageF1& luma,
                                     const ImageF1& weight, float pattern_px);

/// Where `weight` is above 0 and `ground` is not, `light` becomes a membrane over the marks: each
/// place the mean of its neighbours, so that shade runs on across a line instead of changing at it.
/// All H×W, in place; for what is wider than a mark it is only smooth. Thread-safe, bit-identical
/// for any number of threads.
void bridge_marks(ImageF1& light, const ImageF1& weight, const ImageF1& ground);

}  // namespace weft
