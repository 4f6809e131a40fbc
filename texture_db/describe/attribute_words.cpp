// Words for measured attributes and colours.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "texture_db/describe/attributes.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

using A = TextureAttribute;

// A word applies fully from `full` on, not at all from `none` on, and in proportion between.
struct AttributeWord {
    std::string_view words;  ///< The first one is used in reasons.
    A attribute;
    float none, full;
};

constexpr std::array kWords{
    AttributeWord{"smooth sleek soft even polished plain fine-grained flat", A::kRoughness, 0.45f,
                  0.14f},
    AttributeWord{"rough bumpy rugged uneven grainy gritty craggy", A::kRoughness, 0.22f, 0.55f},
    AttributeWord{"coarse large-scale large big chunky wide", A::kScale, 0.32f, 0.62f},
    AttributeWord{"fine small small-scale tiny delicate dense", A::kScale, 0.50f, 0.22f},
    AttributeWord{
        "striped streaked lined stripes stripy streaky directional grained banded corrugated",
        A::kDirectionality, 0.25f, 0.65f},
    AttributeWord{"regular repeating patterned periodic ordered pattern geometric grid tiled",
                  A::kRegularity, 0.25f, 0.6f},
    AttributeWord{"random irregular chaotic natural organic", A::kRegularity, 0.45f, 0.12f},
    AttributeWord{"dark deep darker shadowy", A::kBrightness, 0.45f, 0.24f},
    AttributeWord{"bright light pale lighter brighter", A::kBrightness, 0.50f, 0.70f},
    AttributeWord{"warm warmer", A::kWarmth, 0.55f, 0.72f},
    AttributeWord{"cold cool colder cooler", A::kWarmth, 0.52f, 0.40f},
    AttributeWord{"colourful colorful vivid saturated multicoloured multicolored", A::kSaturation,
                  0.30f, 0.60f},
    AttributeWord{"muted dull desaturated faded colourless colorless neutral", A::kSaturation,
                  0.30f, 0.10f},
    AttributeWord{"contrasty high-contrast bold contrasting speckled spotted mottled", A::kContrast,
                  0.35f, 0.65f},
    AttributeWord{"low-contrast subtle uniform calm", A::kContrast, 0.42f, 0.14f},
    AttributeWord{"glossy shiny sparkling glittering gleaming reflective wet", A::kGloss, 0.3f,
                  0.8f},
    AttributeWord{"matte matt dusty dry", A::kGloss, 0.5f, 0.0f},
};

// Direction of lines; only for samples that have lines.
constexpr std::array<std::string_view, 3> kLines{"horizontal", "vertical", "diagonal"};

struct ColourWord {
    std::string_view name, synonyms;
    float hue_deg, hue_reach_deg;  ///< In Lab.
    float chroma_low, chroma_high;
    float l_low, l_high;
};

// Ordered: the first one wins ties.
constexpr std::array kColours{
    ColourWord{"black", "ebony jet charcoal", 0, 360, 0, 13, 0, 22},
    ColourWord{"white", "ivory snowy", 0, 360, 0, 12, 84, 101},
    ColourWord{"grey", "gray silver ashen slate-grey", 0, 360, 0, 9, 20, 86},
    ColourWord{"brown", "tan chestnut umber sepia chocolate", 62, 28, 9, 52, 12, 60},
    ColourWord{"beige", "cream sandy ecru buff", 84, 24, 8, 34, 60, 94},
    ColourWord{"red", "crimson scarlet maroon ruby burgundy", 32, 20, 26, 140, 10, 70},
    ColourWord{"orange", "terracotta rust-coloured copper", 60, 16, 38, 140, 45, 85},
    ColourWord{"yellow", "golden gold ochre mustard", 92, 18, 34, 140, 50, 101},
    ColourWord{"green", "olive emerald lime", 135, 38, 10, 140, 8, 95},
    ColourWord{"cyan", "teal turquoise aqua", 200, 28, 9, 140, 15, 95},
    ColourWord{"blue", "azure navy indigo cobalt", 268, 42, 9, 140, 8, 92},
    ColourWord{"purple", "violet lilac lavender plum", 320, 22, 10, 140, 8, 85},
    ColourWord{"pink", "rose salmon magenta fuchsia", 2, 26, 12, 90, 48, 95},
};

float fade(float v, float none, float full) {
    return std::clamp((v - none) / (full - none), 0.0f, 1.0f);
}

float inside(float v, float low, float high, float soft) {
    return std::min(fade(v, low - soft, low), fade(v, high + soft, high));
}

float colour_fit(const ColourWord& c, const LabColor& lab) {
    const float chroma = std::hypot(lab.a, lab.b);
    float fit = std::min(inside(lab.l, c.l_low, c.l_high, 10),
                         inside(chroma, c.chroma_low, c.chroma_high, 5));
    if (c.hue_reach_deg < 360) {
        const float hue = std::atan2(lab.b, lab.a) * 180 / std::numbers::pi_v<float>;
        const float away = std::abs(std::remainder(hue - c.hue_deg, 360.0f));
        fit = std::min(fit, fade(away, c.hue_reach_deg + 14, c.hue_reach_deg));
    }
    return fit;
}

bool among(std::string_view words, std::string_view word) {
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        if (words.substr(at, end - at) == word) return true;
        at = end + 1;
    }
    return false;
}

const ColourWord* find_colour(std::string_view word) {
    for (const ColourWord& c : kColours) {
        if (c.name == word || among(c.synonyms, word)) return &c;
    }
    return nullptr;
}

const AttributeWord* find_attribute(std::string_view word) {
    for (const AttributeWord& a : kWords) {
        if (among(a.words, word)) return &a;
    }
    return nullptr;
}

// "greenish" and "reddish" mean the colour, less strictly.
std::string_view without_ish(std::string_view word, std::string& kept) {
    if (word.size() < 6 || !word.ends_with("ish")) return word;
    kept = std::string(word.substr(0, word.size() - 3));
    if (find_colour(kept)) return kept;
    kept.pop_back();  // "reddish"
    return find_colour(kept) ? std::string_view(kept) : word;
}

float line_fit(std::size_t line, const TextureAttributes& a) {
    const float target = kLines[line] == "vertical" ? 0.5f : 0.0f;
    float away = std::abs(std::remainder(a[A::kLineAngle] - target, 1.0f));
    if (kLines[line] == "diagonal") away = std::abs(away - 0.25f);
    return std::min(fade(a[A::kDirectionality], 0.15f, 0.45f), fade(away, 0.2f, 0.08f));
}

}  // namespace

std::string colour_name(const LabColor& color) {
    const ColourWord* best = nullptr;
    float fit = 0.05f;
    for (const ColourWord& c : kColours) {
        const float f = colour_fit(c, color);
        if (f > fit) {
            fit = f;
            best = &c;
        }
    }
    const std::string name(best ? best->name : "grey");
    if (name == "black" || name == "white" || name == "beige") return name;
    if (color.l < 32) return "dark " + name;
    if (color.l > 72 && name != "yellow") return "light " + name;
    return name;
}

std::vector<std::string> attribute_words(const MeasuredTexture& measured) {
    std::vector<std::pair<float, std::string>> found;
    for (const AttributeWord& w : kWords) {
        const float v = measured.attributes[w.attribute];
        const float fit = fade(v, w.none, w.full);
        // "matte" is hardly informative.
        const bool plain = w.attribute == A::kGloss && w.full < w.none;
        if (fit >= 0.8f && !plain) {
            // The farther beyond the threshold, the more informative.
            found.emplace_back(-std::abs(v - w.none),
                               std::string(w.words.substr(0, w.words.find(' '))));
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> out;
    for (auto& [strength, word] : found)
        out.push_back(std::move(word));
    return out;
}

AttributeMatcher::AttributeMatcher(std::string_view word) {
    if (const auto line = std::find(kLines.begin(), kLines.end(), word); line != kLines.end()) {
        kind_ = Kind::kLines;
        index_ = static_cast<std::size_t>(line - kLines.begin());
        return;
    }
    if (const AttributeWord* a = find_attribute(word)) {
        kind_ = Kind::kAttribute;
        index_ = static_cast<std::size_t>(a - kWords.data());
        return;
    }
    std::string kept;
    if (const ColourWord* c = find_colour(without_ish(word, kept))) {
        kind_ = Kind::kColour;
        index_ = static_cast<std::size_t>(c - kColours.data());
    }
}

float AttributeMatcher::match(const MeasuredTexture& measured) const {
    switch (kind_) {
        case Kind::kLines:
            return line_fit(index_, measured.attributes);
        case Kind::kAttribute: {
            const AttributeWord& a = kWords[index_];
            return fade(measured.attributes[a.attribute], a.none, a.full);
        }
        case Kind::kColour: {
            // The accent colour counts too, but less than the mean colour.
            const ColourWord& c = kColours[index_];
            return std::max(colour_fit(c, measured.mean), 0.45f * colour_fit(c, measured.accent));
        }
        case Kind::kNone:
            break;
    }
    return -1;
}

float attribute_match(std::string_view word, const MeasuredTexture& measured) {
    return AttributeMatcher(word).match(measured);
}

bool is_attribute_word(std::string_view word) {
    return AttributeMatcher(word).known();
}

}  // namespace weft
