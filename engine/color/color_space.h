#pragma once
// Colour spaces by name and the transforms between them.

#include <memory>
#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// "srgb" (sRGB primaries, encoded by the piecewise sRGB curve), "linear" (the same primaries,
/// scene linear), "cineon" (the same, encoded by the log curve of film scans: black at code 95 of
/// 1023, white at 685, gamma 0.6), or the name of a space, role or alias of the OpenColorIO config
/// in $OCIO.
struct ColorSpace {
    std::string name = "srgb";
    bool operator==(const ColorSpace&) const = default;
};

/// Checks a colour-space name. Errors: Usage if it is neither built in nor known to $OCIO (the
/// message lists some known names); Unreadable if the config of $OCIO cannot be loaded. "srgb",
/// "linear" and "cineon", in lower case, are always the built-in spaces. "sRGB" is the config's
/// space if it has one, else the built-in one.
[[nodiscard]] Expected<ColorSpace> parse_color_space(const std::string& name);

/// A fixed conversion of RGB pixels. Immutable; thread-safe. Between the built-in spaces apply() is
/// exact to about 2e-7 relative, so all 8-bit and 16-bit codes survive a round trip. Values are not
/// clipped to [0, 1], and NaN and infinity are kept: the sRGB curve continues above 1 and,
/// mirrored, below 0.
class ColorTransform {
  public:
    virtual ~ColorTransform() = default;
    /// Converts every pixel in place.
    virtual void apply(ImageView<float, 3> rgb) const = 0;
    [[nodiscard]] virtual bool identity() const = 0;
};

/// Errors: Usage when either space is unknown or OpenColorIO has no conversion between them.
/// The built-in spaces meet OpenColorIO spaces through the config's space with linear Rec.709/sRGB
/// primaries, found under a usual name ("Linear Rec.709 (sRGB)", "lin_srgb", "lin_rec709",
/// "Utility - Linear - sRGB", "Utility - Linear - Rec.709", …, or "linear" where that is the role
/// scene_linear), else through its sRGB texture space ("sRGB - Texture", "srgb_tx",
/// "Utility - sRGB - Texture", …). Where there is neither, the message says so.
[[nodiscard]] Expected<std::shared_ptr<const ColorTransform>> make_color_transform(
    const ColorSpace& from, const ColorSpace& to);

/// The piecewise sRGB curve (IEC 61966-2-1), continued above 1 and mirrored below 0.
[[nodiscard]] float srgb_to_linear(float encoded);
[[nodiscard]] float linear_to_srgb(float linear);

}  // namespace weft
