#pragma once
// Pops: sudden steps of a result from one frame to the next that the plate does not have.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

enum class PopKind { kSharpness, kLight, kGrain, kPlace };
inline constexpr std::size_t kPopKinds = 4;
/// "sharpness", "light", "grain" or "place", for reports.
[[nodiscard]] const char* name_of(PopKind kind);

/// From which step on a pop counts: 3 % of sharpness, light and grain, pixels of place; and this
/// many deviations of the meter.
inline constexpr double kLeastPop = 0.03, kLeastPlacePop_px = 0.3, kPopDeviations = 3;

/// Two neighbouring frames. Lumas in 8-bit units, all H×W. The motion lies on `from`'s pixels;
/// `visible` (255 or 0, there too) marks what both show.
struct PopPair {
    int frame = 0;  ///< The later one of the two.
    ViewF1 result_from, result_to, source_from, source_to;
    const FlowField* to_from_from = nullptr;
    ViewU8x1 visible;
    bool forward = true;  ///< `from` is the earlier frame.
};

/// How a result steps from the frame before to this one beyond the plate: 0 while it steps no
/// further than the plate does, in the same direction. As logarithms of ratios, so 0.03 is 3 %; of
/// place in pixels. Empty where too little is seen.
struct PopSteps {
    struct Step {
        double beyond = 0;
        double own = 0, plate = 0;  ///< The result's step, and the plate's.
        double error = 0;           ///< Deviation of `own` by chance alone, where that is known.
    };
    int frame = 0;
    std::array<std::optional<Step>, kPopKinds> step;
    [[nodiscard]] const std::optional<Step>& of(PopKind kind) const {
        return step[static_cast<std::size_t>(kind)];
    }
};

/// Measures one pair:
/// - sharpness: the root of the gradients' energy of Y / its local mean, over what both frames
///   show, each on its own pixels, so that nothing is resampled;
/// - light: mean luma there;
/// - grain: the weaker responses of a filter that sees noise only (Immerkær 1996) where the
///   picture is flattest;
/// - place: the mean length of the motion that is left between the two when moved onto each other.
[[nodiscard]] PopSteps pop_steps(const PopPair& pair);

/// The pops of one kind.
struct PopsOfKind {
    double largest = 0;       ///< The largest departure of a step from those around it.
    int frame = 0;            ///< Of that; the later frame of the two.
    double deviation = 0;     ///< Of the meter; 0: nothing was measured.
    std::vector<int> frames;  ///< Where it is kLeastPop and kPopDeviations · deviation or more.
};

struct Pops {
    std::array<PopsOfKind, kPopKinds> kinds;
    [[nodiscard]] const PopsOfKind& of(PopKind kind) const {
        return kinds[static_cast<std::size_t>(kind)];
    }
    /// The frames with a pop of any kind.
    [[nodiscard]] std::vector<int> frames() const;
};

/// How far a step beyond the plate departs from the median of those up to three frames away: a pull
/// of focus or a fade that goes on over several frames is none. Ascending frames.
[[nodiscard]] std::vector<std::optional<double>> departures(const std::vector<PopSteps>& steps,
                                                            PopKind kind);
/// A step against the one from which it counts as a pop: 1 or more is one.
struct PopHeight {
    double height = 0;
    PopKind kind = PopKind::kSharpness;  ///< Of which it is the highest.
    double departure = 0;                ///< As departures().
};
[[nodiscard]] std::vector<std::optional<PopHeight>> pop_heights(const std::vector<PopSteps>& steps);

/// The pops of a clip. The deviation of the meter is that of the result's own steps, or of their
/// differences from the plate's, whichever is less, about the steps around them: of a normal
/// distribution with their lower quarter of lengths, so that most frames of a clip may pop without
/// hiding it; and no less than chance alone gives.
[[nodiscard]] Pops find_pops(const std::vector<PopSteps>& steps);

}  // namespace weft
