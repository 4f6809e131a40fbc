#pragma once
// The geometry of drawn form: what a drag draws, its handles and its lines in the viewer.

#include <optional>
#include <string>
#include <vector>

#include "app/project/edit.h"
#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"

namespace weft::ui {

// All places are in pixels of the plate, whose shape is `aspect`; circles, widths and angles are
// those of the picture unsqueezed.

/// What a drag draws: a plane between opposite corners, a cylinder or cone along its axis, as wide
/// as `matte` is there (a quarter of its length where the matte is empty), a ball from its centre,
/// a stroke. Nothing if check_form_guide() refuses it.
[[nodiscard]] std::optional<FormGuide> guide_of_drag(FormGuideKind kind, Vec2 from, Vec2 to,
                                                     const ViewU8x1& matte,
                                                     PixelAspect aspect = {});

/// A handle of a guide.
struct GuideHandle {
    std::string name;
    Vec2 at;
    bool filled = true;  ///< Hollow: a width.
};
[[nodiscard]] std::vector<GuideHandle> handles_of(const FormGuide& guide, PixelAspect aspect = {});
/// The guide after one of its handles was dragged.
[[nodiscard]] FormGuide with_handle_at(const FormGuide& guide, std::size_t handle, Vec2 to,
                                       PixelAspect aspect = {});

/// Lines that show the guide: a plane's grid, the sides and ends of a round shape, the strokes.
[[nodiscard]] std::vector<std::vector<Vec2>> lines_of(const FormGuide& guide,
                                                      PixelAspect aspect = {});

/// Adds a parallel stroke to the group whose direction is within 45° of its own, or begins the
/// second group, which is at right angles to the first.
void add_parallel(const FormGuide& stroke, std::vector<FormGuide>& strokes,
                  PixelAspect aspect = {});
/// Removes line `line` of stroke `index`, and the stroke with its last line.
void remove_line(std::size_t index, std::size_t line, std::vector<FormGuide>& strokes);

/// The edits that give a region this form. The source becomes one that reads it.
[[nodiscard]] std::vector<Edit> edits_of_form(const Region& region,
                                              const std::vector<FormGuide>& shape,
                                              const std::vector<FormGuide>& strokes);

}  // namespace weft::ui
