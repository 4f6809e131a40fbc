#pragma once
// Internal: scores every sample of a library for one region, by terms; suggestions.h selects the
// ones to show.

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "texture_db/catalogue/index.h"
#include "texture_db/recommend/recommend.h"
#include "texture_db/recommend/region_look.h"

namespace weft {

// exp(−d²/2w²), the exponent alone: products of several take one exp.
[[nodiscard]] inline float away(float difference, float width) {
    return difference * difference / (2 * width * width);
}
/// 1 where there is no difference, down to 0.
[[nodiscard]] inline float near(float difference, float width) {
    return std::exp(-away(difference, width));
}

struct ScoredSample {
    std::uint32_t sample = 0;  ///< Position in the index.
    ScoreTerms parts;
    float stands_out = 0;  ///< 0 … 1: differs in lightness or hue from the region now.
};

/// Judges samples for one region. The references given must outlive it; immutable once made.
class RegionScorer {
  public:
    /// `request.adjust.like` is a full id or empty.
    RegionScorer(const SampleIndex& index, const RecommendRequest& request,
                 const RegionRequest& region, const RegionLook& look);

    [[nodiscard]] ScoredSample score(std::size_t sample) const;
    /// Every sample that the licences and the requested material allow, in the order of the index.
    [[nodiscard]] std::vector<ScoredSample> score_all() const;
    /// The image–text model's likelihood of each material of the index, with what is usual for the
    /// region's role: 1 is the likeliest. Empty without such a model.
    [[nodiscard]] const std::vector<float>& material_likelihoods() const { return likelihoods_; }
    [[nodiscard]] std::optional<float> material_likelihood(std::size_t sample) const {
        if (likelihoods_.empty()) return {};
        return likelihoods_[static_cast<std::size_t>(material(sample))];
    }
    /// The region's most likely role in the picture.
    [[nodiscard]] SurfaceRole role() const;
    /// How likely that is, 0 … 1.
    [[nodiscard]] float likely_role() const { return role_[static_cast<std::size_t>(role())]; }
    [[nodiscard]] const RoleWeights& roles() const { return role_; }
    /// True if a sample's material is usual for a role.
    [[nodiscard]] bool serves(std::size_t sample, std::size_t role) const {
        return usual(material(sample))[role] >= 0.6f;
    }
    [[nodiscard]] int material(std::size_t sample) const { return index_.looks[sample].material; }
    /// How usual a material of the index is for each role.
    [[nodiscard]] const RoleWeights& usual(int material) const {
        return materials_[static_cast<std::size_t>(material)];
    }
    /// How well a material suits a region of these roles, in comparison with other materials.
    [[nodiscard]] float suits(int material, const RoleWeights& roles) const;
    /// 0 … 1: how similar two samples are; 1 for two samples of one picture.
    [[nodiscard]] float likeness(std::size_t a, std::size_t b) const;

  private:
    void find_neighbours();
    void find_role();
    void find_materials();

    const SampleIndex& index_;
    const RecommendRequest& request_;
    const RegionRequest& region_;
    const RegionLook& look_;
    ColourHarmony harmony_;
    std::vector<float> likelihoods_, use_;  // by material
    std::vector<RoleWeights> materials_;    // by material
    std::vector<float> favour_;             // by material: by the region's colour
    RoleWeights role_{};                    // sums to 1
    std::vector<float> squared_;            // distance to the nearest patch, by sample
    float typical_ = 1;                     // distance of a near neighbour
    std::size_t like_ = 0;                  // the sample of `like`, or the index's size
};

}  // namespace weft
