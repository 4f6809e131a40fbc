#pragma once
// What the artist draws to show the form of a surface: shapes over it, and strokes along it.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/geometry.h"
#include "engine/core/pixel_aspect.h"

namespace weft {

enum class FormGuideKind : std::uint8_t {
    // Shapes.
    kPlane,     ///< x, y of four corners of what is a rectangle on the surface, in order.
    kCylinder,  ///< ax, ay, bx, by: the axis, ra, rb: half its width there, tilt (may be left out).
    kCone,      ///< The same.
    kBall,      ///< x, y of the centre, radius.
    // Strokes.
    kParallel,  ///< x0, y0, x1, y1 of each line: a group that is parallel on the surface.
    kLevel,     ///< x0, y0, x1, y1: runs along the rows of the texture.
    kCut        ///< x0, y0, x1, y1 of each piece of the outline where the surface does not turn
                ///< away but is cut off, to be inflated.
};

struct FormGuideInfo {
    FormGuideKind kind;
    std::string_view name;
    std::size_t least, most;  ///< Numbers.
    std::size_t step;         ///< Their number is `least` and a multiple of it.
    std::size_t pixels;       ///< How many of them, from the first on, are in plate pixels.
    std::size_t places;       ///< How many of these are the x and y of places.
};
inline constexpr std::size_t kMostParallelNumbers = 64;
/// The kinds by their names in files and on the command line.
inline constexpr std::array<FormGuideInfo, 7> kFormGuides{
    {{FormGuideKind::kPlane, "plane", 8, 8, 1, 8, 8},
     {FormGuideKind::kCylinder, "cylinder", 6, 7, 1, 6, 4},
     {FormGuideKind::kCone, "cone", 6, 7, 1, 6, 4},
     {FormGuideKind::kBall, "ball", 3, 3, 1, 3, 2},
     {FormGuideKind::kParallel, "parallel", 4, kMostParallelNumbers, 4, kMostParallelNumbers,
      kMostParallelNumbers},
     {FormGuideKind::kLevel, "level", 4, 4, 1, 4, 4},
     {FormGuideKind::kCut, "cut", 4, kMostParallelNumbers, 4, kMostParallelNumbers,
      kMostParallelNumbers}}};
[[nodiscard]] constexpr const FormGuideInfo& info_of(FormGuideKind kind) {
    return kFormGuides[static_cast<std::size_t>(kind)];
}
[[nodiscard]] constexpr bool is_shape(FormGuideKind kind) {
    return kind <= FormGuideKind::kBall;
}

/// A shape or a stroke on the reference frame: places in plate pixels, radii and half widths in
/// unsqueezed ones (PixelAspect). Tilts are in degrees, above 0 where the axis' second
/// end is farther from the camera.
struct FormGuide {
    FormGuideKind kind = FormGuideKind::kPlane;
    std::vector<double> numbers;
    bool operator==(const FormGuide&) const = default;
    /// The place that two of the numbers give.
    [[nodiscard]] glm::dvec2 place(std::size_t first) const {
        return {numbers[first], numbers[first + 1]};
    }
};

/// The guide with its places unsqueezed, and with unsqueezed places squeezed again.
[[nodiscard]] FormGuide unsqueezed(FormGuide guide, PixelAspect aspect);
[[nodiscard]] FormGuide squeezed(FormGuide guide, PixelAspect aspect);

/// Whether the guide has the numbers of its kind and they make something: corners that go round a
/// convex quadrilateral, an axis and radii longer than nothing, strokes of a length, a tilt below
/// 80°. Errors: Usage with what is wrong and what to do.
[[nodiscard]] Status check_form_guide(const FormGuide& guide);

/// Guides as text, separated by ";": "plane:10,10,90,12,95,80,5,78; level:10,20,80,22". Errors:
/// Usage with the guide and what is wrong; without check_form_guide().
[[nodiscard]] Expected<std::vector<FormGuide>> parse_form_guides(std::string_view text);
/// The text that parse_form_guides() reads back to the same guides.
[[nodiscard]] std::string form_guides_text(const std::vector<FormGuide>& guides);

}  // namespace weft
