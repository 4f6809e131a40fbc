#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// Compares the motion files of each region with the picture on up to four of its frames: a warning
/// where the picture moves otherwise, as with a wrong convention or direction. Files that cannot be
/// read are left to the render. Errors: Unreadable if a file says that nothing moves at all while
/// the surface does.
[[nodiscard]] Expected<std::vector<std::string>> check_motion(const Shot& shot);

/// What one file of motion says against the picture, both inside of the region.
struct MotionFit {
    float given_px = 0;      ///< Median length of the motion in the file.
    float estimated_px = 0;  ///< Of the motion that the picture shows.
    float apart_px = 0;      ///< Median distance of the two.
    /// Mean difference, in levels, of the frame from the other one along each motion.
    float given_error = 0, estimated_error = 0;
    bool still = false;  ///< The file says nothing but 0, in the whole picture.

    /// Does the picture show that the file is wrong, beyond what an estimate may err by?
    [[nodiscard]] bool contradicted() const;
};

/// `other_from_cur`: the file's motion from `cur` to `other`; luma, 8 bit, and the region's matte;
/// all H×W. Nothing if less than 1 % of the picture is inside. Pure.
[[nodiscard]] std::optional<MotionFit> compare_motion(const FlowField& other_from_cur, ViewU8x1 cur,
                                                      ViewU8x1 other, ViewU8x1 matte);

}  // namespace weft
