#pragma once
// OpenColorIO's view transforms for the screen, from linear light to a display's codes.

#include <memory>
#include <string>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/core/error.h"

namespace weft {

/// A view of one of the displays in the config of $OCIO.
struct ScreenName {
    std::string display, view;
    bool operator==(const ScreenName&) const = default;
};

/// The same transform for a graphics card.
struct ScreenShader {
    /// GLSL 1.3 or newer with a function `vec4 weft_screen(vec4 linear)`.
    std::string source;
    /// A lookup table of the source: values row by row, the first axis fastest.
    struct Table {
        std::string sampler;  ///< Name of its uniform.
        int dimensions = 1;   ///< Of the sampler, 1 to 3.
        int width = 0, height = 1, depth = 1;
        int channels = 3;  ///< 1 or 3.
        bool nearest = false;
        std::vector<float> values;
    };
    std::vector<Table> tables;
};

/// Converts scene-linear Rec. 709 to the display. Immutable; thread-safe. Nothing is clipped before
/// the view's own transform.
struct ScreenView {
    ScreenName name;
    std::shared_ptr<const ColorTransform> pixels;  ///< On the CPU.
    ScreenShader shader;
};

/// The views of the config of $OCIO: its default first, then display by display in its order; empty
/// without $OCIO. Errors: Unreadable.
[[nodiscard]] Expected<std::vector<ScreenName>> list_screens();
/// All colour spaces of the config, in its order; empty without $OCIO. Errors: Unreadable.
[[nodiscard]] Expected<std::vector<std::string>> list_color_spaces();
/// Errors: Usage if the config has no such view, or no space for Rec. 709 (see
/// make_color_transform()).
[[nodiscard]] Expected<std::shared_ptr<const ScreenView>> make_screen_view(const ScreenName& name);

}  // namespace weft
