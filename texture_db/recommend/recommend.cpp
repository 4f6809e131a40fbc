#include "engine/core/stopwatch.h"
#include "texture_db/recommend/recommend_index.h"

#include <algorithm>
#include <cmath>

#include "texture_db/recommend/region_look.h"
#include "texture_db/recommend/suggestions.h"

namespace weft {
namespace {

using A = TextureAttribute;

// How well two textures fit two regions together: distinguishable, but of one style.
float coherence_of(const IndexedSample& a, const IndexedSample& b) {
    const LabColor &p = a.measured.mean, &q = b.measured.mean;
    const float apart = std::clamp(std::hypot(p.l - q.l, p.a - q.a, p.b - q.b) / 22, 0.0f, 1.0f);
    const float harmony = ColourHarmony({{q, 1}}).with(p);
    const float saturation =
        near(a.measured.attributes[A::kSaturation] - b.measured.attributes[A::kSaturation], 0.35f);
    const float contrast =
        near(a.measured.attributes[A::kContrast] - b.measured.attributes[A::kContrast], 0.45f);
    const float same = a.id == b.id ? 0.3f : 1.0f;
    return same * (0.35f * apart + 0.35f * harmony + 0.15f * saturation + 0.15f * contrast);
}

// Materials of the region by the image–text model: the mean over its squares.
Expected<std::vector<float>> materials_by_model(ImageTextModel& model, const SampleIndex& index,
                                                ViewU8x3 plate, const RegionLook& look) {
    std::vector<std::string> names;
    for (int m = 0; m < index.materials.size(); ++m)
        names.push_back(index.materials.text(m));
    std::vector<float> out(names.size());
    for (const Recti& square : look.squares) {
        WEFT_TRY(seen, model.encode_image(plate.crop(square)));
        const std::vector<float> likely = model.likelihoods(seen, names);
        for (std::size_t m = 0; m < out.size(); ++m)
            out[m] += likely[m] / static_cast<float>(look.squares.size());
    }
    return out;
}

// Beam search over the regions, with the ten best partial scenes.
std::vector<SceneSuggestion> together(const SampleIndex& index,
                                      const std::vector<std::vector<Suggestion>>& choices,
                                      int count) {
    std::vector<SceneSuggestion> beam{{}};
    constexpr std::size_t kBeam = 60;
    for (const auto& options : choices) {
        std::vector<SceneSuggestion> next;
        for (const SceneSuggestion& scene : beam) {
            for (const Suggestion& option : options) {
                SceneSuggestion grown = scene;
                Suggestion s = option;
                float coherence = 0;
                const IndexedSample& mine = index.samples[index.by_id.at(s.id)];
                for (const Suggestion& other : scene.per_region)
                    coherence += coherence_of(mine, index.samples[index.by_id.at(other.id)]);
                if (!scene.per_region.empty())
                    s.parts.coherence = coherence / static_cast<float>(scene.per_region.size());
                grown.score += s.score * (0.4f + 0.6f * s.parts.coherence);
                grown.per_region.push_back(std::move(s));
                next.push_back(std::move(grown));
            }
        }
        std::stable_sort(next.begin(), next.end(),
                         [](const auto& a, const auto& b) { return a.score > b.score; });
        if (next.size() > kBeam) next.resize(kBeam);
        beam = std::move(next);
    }
    // Not the same scene with one texture changed: each shares at most half with a better one.
    std::vector<SceneSuggestion> out;
    for (SceneSuggestion& scene : beam) {
        const bool fresh = std::none_of(out.begin(), out.end(), [&](const SceneSuggestion& o) {
            std::size_t shared = 0;
            for (std::size_t i = 0; i < o.per_region.size(); ++i)
                shared += o.per_region[i].id == scene.per_region[i].id ? 1u : 0u;
            return 2 * shared > o.per_region.size();
        });
        if (!fresh && out.size() > 0) continue;
        scene.score /= static_cast<float>(choices.size());
        for (const Suggestion& s : scene.per_region) {
            const IndexedSample& sample = index.samples[index.by_id.at(s.id)];
            scene.why += (scene.why.empty() ? "" : " beside ") + colour_name(sample.measured.mean) +
                         " " + s.material;
        }
        out.push_back(std::move(scene));
        if (static_cast<int>(out.size()) == count) break;
    }
    return out;
}

}  // namespace

Expected<Recommendation> recommend_from(const SampleIndex& index, const DescriptorModel* model,
                                        const LibraryEmbeddings& embeddings,
                                        const RecommendRequest& request) {
    const auto start = Clock::now();
    Recommendation out;
    out.notice = embeddings.fault;
    std::vector<std::vector<Suggestion>> choices;
    for (const RegionRequest& region : request.regions) {
        WEFT_TRY(look, look_at_region(request.plate, region, model));
        if (embeddings.model && embeddings.samples) {
            WEFT_TRY(seen, materials_by_model(*embeddings.model, index, request.plate, look));
            look.materials = std::move(seen);
        }
        const RegionScorer scorer(index, request, region, look);
        out.regions.push_back(suggest_for(index, request, region, look, scorer));
        if (!region.keep.empty()) {
            choices.push_back({suggestion_kept(index, scorer, index.by_id.at(region.keep))});
        } else {
            choices.push_back(out.regions.back().suggestions);
        }
    }
    if (request.regions.size() > 1) out.together = together(index, choices, 6);
    out.seconds = seconds_since(start);
    return out;
}

}  // namespace weft
