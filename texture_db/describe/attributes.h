#pragma once
// Attributes of a texture, measured from its pixels, that have words.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Every attribute lies in [0, 1].
enum class TextureAttribute : int {
    kBrightness,      ///< Lab L of the mean colour, 0 black, 1 white.
    kSaturation,      ///< Lab chroma of the mean colour over 60.
    kWarmth,          ///< 0.5 neutral, above: red, orange, yellow; below: blue, cyan.
    kContrast,        ///< Spread of the lightness.
    kColourVariety,   ///< Spread of the hue and chroma.
    kScale,           ///< Size of the largest common structure: 0 is 2 px, 1 is 48 px and more.
    kRoughness,       ///< Busy, high-contrast fine relief; 0 is smooth.
    kRegularity,      ///< How strongly it repeats: height of the autocorrelation's second peak.
    kDirectionality,  ///< 1: all edges run one way (striped), 0: no direction.
    kLineAngle,       ///< Direction of the lines over 180°: 0 and 1 horizontal, 0.5 vertical.
    kGloss,           ///< Small bright highlights on a darker ground.
    kCount
};
inline constexpr std::size_t kTextureAttributes =
    static_cast<std::size_t>(TextureAttribute::kCount);

struct TextureAttributes {
    std::array<float, kTextureAttributes> values{};
    [[nodiscard]] float operator[](TextureAttribute a) const {
        return values[static_cast<std::size_t>(a)];
    }
    float& operator[](TextureAttribute a) { return values[static_cast<std::size_t>(a)]; }
    bool operator==(const TextureAttributes&) const = default;
};

/// Mean colour in CIE Lab (D65), as OpenCV scales it for floats: L 0–100.
struct LabColor {
    float l = 0, a = 0, b = 0;
    bool operator==(const LabColor&) const = default;
};

struct MeasuredTexture {
    TextureAttributes attributes;
    LabColor mean;    ///< Of all pixels.
    LabColor accent;  ///< Of the tenth of the pixels that is most colourful.
};

/// Measures a picture of at least 16×16 (larger than 96×96: its middle 96×96). Deterministic, about
/// 1 ms. Thread-safe.
[[nodiscard]] MeasuredTexture measure_texture(ViewU8x3 srgb);

/// The words that fit ("rough", "dark", "striped", …), strongest first, for labels and for reasons.
[[nodiscard]] std::vector<std::string> attribute_words(const MeasuredTexture& measured);
/// The name of a colour as artists use it: "dark green", "beige", "light grey".
[[nodiscard]] std::string colour_name(const LabColor& color);

/// A word, looked up once, for matching many textures. Immutable.
class AttributeMatcher {
  public:
    explicit AttributeMatcher(std::string_view word);
    /// True if it is an attribute word. Known: smooth, rough, coarse, fine, striped, regular,
    /// random, dark, bright, warm, cold, glossy, matte, horizontal, colour names and many synonyms.
    [[nodiscard]] bool known() const { return kind_ != Kind::kNone; }
    /// How well it describes a texture, 0 … 1; negative for an unknown word.
    [[nodiscard]] float match(const MeasuredTexture& measured) const;

  private:
    enum class Kind { kNone, kAttribute, kColour, kLines };
    Kind kind_ = Kind::kNone;
    std::size_t index_ = 0;  // into the table of its kind
};

/// The same for one texture.
[[nodiscard]] float attribute_match(std::string_view word, const MeasuredTexture& measured);
[[nodiscard]] bool is_attribute_word(std::string_view word);

}  // namespace weft
