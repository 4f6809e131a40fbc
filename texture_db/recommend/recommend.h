#pragma once
// Texture suggestions for a region of a frame, with reasons.

#include <optional>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "texture_db/catalogue/query.h"

namespace weft {

/// A region to suggest textures for. Views must stay valid during the call.
struct RegionRequest {
    std::string name;      ///< For messages.
    ViewU8x1 matte;        ///< Coverage, of the plate's size.
    std::string keep;      ///< Id of a texture to keep for this region, or empty.
    std::string material;  ///< A material that the artist asks for, or empty.
};

/// How the artist wants the suggestions to differ.
struct RecommendAdjustments {
    std::string like;    ///< Id: more like this one.
    float warmer = 0;    ///< −1 colder … 1 warmer.
    float brighter = 0;  ///< −1 … 1.
    float rougher = 0;   ///< −1 smoother … 1 rougher.
    float larger = 0;    ///< −1 finer … 1 larger structure.
};

struct RecommendRequest {
    ViewU8x3 plate;  ///< sRGB frame.
    std::vector<RegionRequest> regions;
    RecommendAdjustments adjust;
    int count = 12;  ///< Suggestions for each region.
    std::vector<std::string> excluded_licences;
    /// How different the suggestions are from each other: 0 the best ones, 1 as different as
    /// possible.
    float diversity = 0.35f;
};

/// The terms of a suggestion's score, each 0 … 1.
struct ScoreTerms {
    float material = 0;    ///< Similarity to the region's present surface.
    float use = 0;         ///< Usual for the region's role: a wall, the ground, a garment …
    float colour = 0;      ///< Harmony with the rest of the frame.
    float style = 0;       ///< Contrast, saturation and detail as in the rest of the frame.
    float scale = 0;       ///< Structure fits the region's size.
    float synthesis = 0;   ///< How well the sample synthesizes.
    float adjustment = 1;  ///< How well it meets the request; 1 without one.
    float coherence = 1;   ///< Coherence with the textures of the other regions; 1 with one region.
};

struct Suggestion {
    std::string id, name, material;
    float score = 0;
    ScoreTerms parts;
    std::vector<std::string> reasons;  ///< In words, the strongest first.
};

/// A group of suggestions: "Like now", "In harmony", "A contrast", …
struct SuggestionScheme {
    std::string name;
    std::string why;
    std::vector<Suggestion> suggestions;
};

struct RegionSuggestions {
    std::string region;
    /// The region's look and role, "light grey, striped; a wall"; with an image–text model also the
    /// material that it looks like.
    std::string seen_as;
    std::vector<Suggestion> suggestions;  ///< The best of all schemes, diverse.
    std::vector<SuggestionScheme> schemes;
};

/// For all regions together: one texture for each, chosen to fit each other.
struct SceneSuggestion {
    float score = 0;
    std::vector<Suggestion> per_region;  ///< In the order of the request.
    std::string why;
};

struct Recommendation {
    std::vector<RegionSuggestions> regions;
    std::vector<SceneSuggestion> together;  ///< With two regions and more; best first.
    std::string notice;  ///< A problem with the library's image–text model, if there is one.
    double seconds = 0;
};

}  // namespace weft
