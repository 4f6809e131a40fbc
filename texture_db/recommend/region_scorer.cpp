#include "texture_db/recommend/region_scorer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "texture_db/catalogue/licence.h"

namespace weft {
namespace {

using A = TextureAttribute;

constexpr int kNeighbours = 9;
// An image–text model counts less than the region's position: a photograph's grey feathers are as
// near to marble as to fur.
constexpr float kAppearanceWeight = 0.4f, kLeastAppearance = 0.08f;
// What is green like plants is the ground so much more often, and a plant's texture suits it so
// much better.
constexpr float kGreenGround = 2, kGreenPlant = 5;
constexpr float kNameless = 0.04f;  // the weight of roles that the region's name does not name

float ramp(float v) {
    return 1 / (1 + std::exp(-v));
}

float scale_fit(const SampleLook& sample, const RegionLook& look) {
    const float repeats = look.short_side_px / sample.structure_px;
    // Fewer than three of its structures do not read as the texture; above sixty it looks like
    // noise.
    const float enough = std::clamp((repeats - 1) / 3, 0.0f, 1.0f);
    return repeats > 60 ? enough * near(std::log2(repeats / 60), 1.2f) : enough;
}

// The geometric mean of three similarities.
float style_fit(const SampleLook& sample, const RegionLook& look) {
    return std::exp(-(away(sample.contrast - std::min(look.rest_contrast, 0.8f), 0.35f) +
                      away(sample.saturation - look.rest_saturation, 0.25f) +
                      away(sample.roughness - look.rest_roughness, 0.35f)) /
                    3);
}

float adjustment_fit(const RecommendAdjustments& w, const TextureAttributes& base,
                     const TextureAttributes& a) {
    float fit = 1;
    const auto apply = [&](float wanted, A attribute, float reach) {
        if (wanted != 0)
            fit *= ramp(3.0f * (wanted * (a[attribute] - base[attribute]) / reach - 0.5f));
    };
    apply(w.warmer, A::kWarmth, 0.12f);
    apply(w.brighter, A::kBrightness, 0.15f);
    apply(w.rougher, A::kRoughness, 0.18f);
    apply(w.larger, A::kScale, 0.18f);
    return fit;
}

// 0 … 1: how surely a mean colour is that of plants in daylight, green to yellow-green.
float greenery(const LabColor& mean) {
    return std::clamp((mean.b - 8) / 12, 0.0f, 1.0f) * std::clamp((-mean.a - 1) / 8, 0.0f, 1.0f);
}

float distance(std::span<const float> x, std::span<const float> y) {
    float d = 0;
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
        d += (x[k] - y[k]) * (x[k] - y[k]);
    return std::sqrt(d);
}

}  // namespace

RegionScorer::RegionScorer(const SampleIndex& index, const RecommendRequest& request,
                           const RegionRequest& region, const RegionLook& look)
    : index_(index),
      request_(request),
      region_(region),
      look_(look),
      harmony_(look.surroundings),
      squared_(index.samples.size(), SampleIndex::kFar) {
    const auto like = index.by_id.find(request.adjust.like);
    like_ = like == index.by_id.end() ? index.samples.size() : like->second;
    find_neighbours();
    find_role();
    find_materials();
}

// How near every sample is to the nearest of the region's patches, and how near near ones are.
void RegionScorer::find_neighbours() {
    std::vector<float> near_ones;
    for (const auto& descriptor : look_.descriptors) {
        const std::vector<float> squared = index_.squared_distances(descriptor);
        for (std::size_t i = 0; i < squared.size(); ++i)
            squared_[i] = std::min(squared_[i], squared[i]);
        const auto neighbours = lowest(squared, kNeighbours);
        if (neighbours.size() > 8) near_ones.push_back(neighbours[8].distance);
    }
    if (near_ones.empty()) return;
    std::sort(near_ones.begin(), near_ones.end());
    typical_ = std::max(near_ones[near_ones.size() / 2], 1e-3f);
}

// The region's role in the picture, from its position, its colour and its name; and how usual each
// material is for that role. The library's own descriptor has no say: it takes almost everything on
// film, which is smaller, softer and lit unevenly, for metal, marble or tiles.
void RegionScorer::find_role() {
    const float green = greenery(look_.inside.mean);
    for (int m = 0; m < index_.materials.size(); ++m) {
        const std::string& name = index_.materials.text(m);
        materials_.push_back(roles_of_material(name));
        const bool plant = name == "grass" || name == "foliage";
        favour_.push_back(plant ? 1 + kGreenPlant * green : 1.0f);
    }
    role_ = roles_of_place(look_.place);
    role_[static_cast<std::size_t>(SurfaceRole::kGround)] *= 1 + kGreenGround * green;
    float seen = 0;
    for (const float v : look_.materials)
        seen += v;
    for (std::size_t r = 0; seen > 0 && r < kSurfaceRoles; ++r) {
        float usual = 0;
        for (std::size_t m = 0; m < materials_.size(); ++m)
            usual += look_.materials[m] * materials_[m][r];
        role_[r] *= std::pow(std::max(usual / seen, kLeastAppearance), kAppearanceWeight);
    }
    const RoleWeights named = roles_of_name(region_.name);
    for (std::size_t r = 0; r < kSurfaceRoles; ++r)
        role_[r] *= kNameless + (1 - kNameless) * named[r];
    const float sum = std::accumulate(role_.begin(), role_.end(), 0.0f);
    for (float& r : role_)
        r = sum > 0 ? r / sum : 1.0f / kSurfaceRoles;
    for (int m = 0; m < index_.materials.size(); ++m)
        use_.push_back(suits(m, role_));
    const float best = use_.empty() ? 0 : *std::max_element(use_.begin(), use_.end());
    for (float& u : use_)
        u = best > 0 ? u / best : 1;
}

// What the image–text model sees, among the materials that such a region has.
void RegionScorer::find_materials() {
    likelihoods_ = look_.materials;
    for (std::size_t m = 0; m < likelihoods_.size(); ++m)
        likelihoods_[m] *= use_[m];
    const float most =
        likelihoods_.empty() ? 0 : *std::max_element(likelihoods_.begin(), likelihoods_.end());
    for (float& v : likelihoods_)
        v = most > 0 ? v / most : 0;
}

float RegionScorer::suits(int material, const RoleWeights& roles) const {
    const RoleWeights& usual = materials_[static_cast<std::size_t>(material)];
    return favour_[static_cast<std::size_t>(material)] *
           std::inner_product(roles.begin(), roles.end(), usual.begin(), 0.0f);
}

SurfaceRole RegionScorer::role() const {
    return static_cast<SurfaceRole>(std::max_element(role_.begin(), role_.end()) - role_.begin());
}

ScoredSample RegionScorer::score(std::size_t i) const {
    const SampleLook& s = index_.looks[i];
    ScoredSample c;
    c.sample = static_cast<std::uint32_t>(i);
    const float beyond = std::max(0.0f, std::sqrt(squared_[i]) - typical_) / typical_;
    c.parts.material = near(beyond, 0.8f);
    if (const std::optional<float> likelihood = material_likelihood(i))
        c.parts.material = 0.45f * c.parts.material + 0.55f * *likelihood;
    c.parts.use = use_[static_cast<std::size_t>(s.material)];
    c.parts.colour = harmony_.with(s.chroma, s.hue_deg);
    c.parts.style = style_fit(s, look_);
    c.parts.scale = scale_fit(s, look_);
    c.parts.synthesis = s.synthesis;
    const bool like = like_ < index_.samples.size();
    const RecommendAdjustments& w = request_.adjust;
    if (like || w.warmer != 0 || w.brighter != 0 || w.rougher != 0 || w.larger != 0) {
        const TextureAttributes& base =
            like ? index_.samples[like_].measured.attributes : look_.inside.attributes;
        c.parts.adjustment = adjustment_fit(w, base, index_.samples[i].measured.attributes);
        if (like)
            c.parts.adjustment *=
                near(distance(index_.descriptor(i), index_.descriptor(like_)) / typical_, 1.5f);
    }
    const float lightness = std::abs(s.mean.l - look_.inside.mean.l) / 40;
    const float hue = hue_difference_deg(s.mean, look_.inside.mean) / 150;
    c.stands_out = std::min(1.0f, std::max(lightness, hue));
    return c;
}

std::vector<ScoredSample> RegionScorer::score_all() const {
    std::vector<bool> excluded;
    for (int i = 0; i < index_.licences.size(); ++i)
        excluded.push_back(licence_excluded(index_.licences.text(i), request_.excluded_licences));
    const int material = region_.material.empty() ? -1 : index_.materials.find(region_.material);
    std::vector<ScoredSample> out;
    if (!region_.material.empty() && material < 0) return out;
    for (std::size_t i = 0; i < index_.looks.size(); ++i) {
        const SampleLook& s = index_.looks[i];
        if (excluded[static_cast<std::size_t>(s.licence)]) continue;
        if (material >= 0 && s.material != material) continue;
        out.push_back(score(i));
    }
    return out;
}

float RegionScorer::likeness(std::size_t i, std::size_t j) const {
    const IndexedSample &a = index_.samples[i], &b = index_.samples[j];
    if (a.origin != TextureOrigin::kProcedural && a.package == b.package && a.source == b.source)
        return 1;
    const LabColor &p = index_.looks[i].mean, &q = index_.looks[j].mean;
    const float apart = distance(index_.descriptor(i), index_.descriptor(j));
    const float material = index_.looks[i].material == index_.looks[j].material ? 1.0f : 0.0f;
    return 0.4f * near(apart / typical_, 0.8f) +
           0.3f * near(std::hypot(p.l - q.l, p.a - q.a, p.b - q.b), 9) + 0.3f * material;
}

}  // namespace weft
