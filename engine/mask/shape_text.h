#pragma once
// Shapes over time as text for other programs.

#include <string>
#include <string_view>
#include <vector>

#include "engine/mask/outline_lives.h"

namespace weft {

/// What a program has to know besides the shapes.
struct ShapeTextContext {
    Size plate;                      ///< Pixels.
    std::string_view name = "roto";  ///< Letters, digits and _ only.
};

/// "outline_1", or "hole_2" of an odd level: the shape's number from 1 on.
[[nodiscard]] std::string shape_name(const std::vector<MatteShape>& shapes, std::size_t index);

// Numbers have 3 decimals of a pixel, 7 of the picture's size. Equal shapes give equal bytes on
// every machine. Each shape is seen on the frames from its first key to its last one. Pure and
// thread-safe. `shapes` are sorted by level and have keys.

/// A Python script that builds Roto nodes in Nuke, one for each level, and stencils holes out of
/// what is around them.
[[nodiscard]] std::string nuke_shapes(const std::vector<MatteShape>& shapes,
                                      const ShapeTextContext& context);

/// A Python script that adds a mask to Blender's open file: a layer for each shape, holes
/// subtracted, every point keyed.
[[nodiscard]] std::string blender_shapes(const std::vector<MatteShape>& shapes,
                                         const ShapeTextContext& context);

/// JSON: what makes the picture transparent, and for each shape what MLT's filter `rotoscoping` is
/// given. `spline` is its property: by frame from `in` on, for each point the handle before, the
/// point and the handle after, of the picture's size and from its top left. `in` and `out` count
/// from `first_frame`.
[[nodiscard]] std::string mlt_shapes(const std::vector<MatteShape>& shapes,
                                     const ShapeTextContext& context, int first_frame);

}  // namespace weft
