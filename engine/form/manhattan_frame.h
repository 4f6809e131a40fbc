#pragma once
// Directions at right angles, as the lines of one picture show them.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/picture_lines.h"
#include "engine/form/rigid_fit.h"

namespace weft {

/// Three directions at right angles, the columns of a rotation in view space (x right, y down, z
/// away), seen by a lens: a Manhattan frame (Straub et al. 2018).
struct ManhattanFrame {
    glm::dmat3 axes{1};
    double tangent = 0.91;  ///< Long side over focal length.
};

/// A turn (a rotation vector in view space, radians) and a change of the tangent.
using FrameStep = std::array<double, 4>;
using FrameMatrix = std::array<std::array<double, 4>, 4>;

/// The frame after a step.
[[nodiscard]] ManhattanFrame stepped(const ManhattanFrame& frame, const FrameStep& step);

/// How lines speak for a frame. A line towards the vanishing point of an axis gains ln of how much
/// likelier it is there than at any angle, by the errors of its ends (0.7 px at 960 px) and of
/// lenses (0.3°); one that runs to none gains nothing, however far it is off (Coughlan & Yuille
/// 2003, with normal errors cut off). Lines of one surface are alike, so together they count as
/// `most` at most. Const access is thread-safe; bit-identical everywhere.
class ManhattanLines {
  public:
    /// `axes`: how many of a frame's axes lines run along: 2 on a plane, whose normal is the third,
    /// or 3 in a scene.
    ManhattanLines(const std::vector<PictureLine>& lines, Size picture, int axes, double most);

    struct Line {
        glm::dvec2 middle;     ///< From the picture's centre, in long sides.
        glm::dvec2 direction;  ///< Unit.
        double sigma;          ///< Of its direction, radians.
        double weight;
        double most_gain;  ///< Of a line straight at a vanishing point.
    };
    [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
    [[nodiscard]] int axes() const { return axes_; }
    /// The same, whose directions are known less well by `radians`: for a search in steps.
    [[nodiscard]] ManhattanLines blurred(double radians) const;

    [[nodiscard]] double gain(const ManhattanFrame& frame) const;
    /// ln of the likelihood of all lines, next to lines at any angle, under the first `axes` of the
    /// frame's and the share of stray lines that suits them best: what rival explanations are
    /// compared by.
    [[nodiscard]] double log_likelihood(const ManhattanFrame& frame, int axes) const;
    /// The same for what is no such frame but looks a little like it: directions that are the
    /// frame's by 3° to 11° only, as on what is curved.
    [[nodiscard]] double loose_likelihood(const ManhattanFrame& frame) const;
    /// The share of the lines' weight that gains something.
    [[nodiscard]] double explained(const ManhattanFrame& frame) const;
    /// Adds ½ the Hessian of −2 · gain over a step, and the right side of its normal equations.
    void linearise(const ManhattanFrame& frame, FrameMatrix& matrix, FrameStep& right) const;

  private:
    ManhattanLines() = default;
    void set_most_gains();
    // The axis that explains a line best, and its gain; −1: none.
    [[nodiscard]] std::pair<int, double> best_axis(const Line& line,
                                                   const ManhattanFrame& frame) const;

    std::vector<Line> lines_;
    int axes_ = 3;
};

/// The sine of the angle between a line and the direction to the vanishing point of an axis.
[[nodiscard]] double off_axis(const ManhattanLines::Line& line, const glm::dvec3& axis,
                              double tangent);

}  // namespace weft
