#include "texture_db/search/ranking.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Weight of the distance to the centre of a sample's material against that to the sample itself. A
// material's centre is more reliable than whichever of its samples happens to be near.
constexpr float kMiddle = 0.7f;
// Procedural textures resemble photographs less than their features suggest. Tried from 0 to 8.
constexpr float kDrawn = 3;
constexpr std::size_t kFirst = 5;

SearchHit hit_of(const SampleIndex& index, std::size_t i, float distance) {
    const IndexedSample& s = index.samples[i];
    return {s.id,
            s.name,
            index.materials.text(s.material),
            1 / (1 + 0.25f * distance),
            {"looks alike"}};
}

// Every sample with its own distance plus that of its material's centre.
std::vector<Neighbour> judged(const SampleIndex& index, const DescriptorModel& model,
                              std::span<const float> descriptor) {
    const std::vector<float> middle = model.distances_to_centres(descriptor);
    std::vector<float> by_material(static_cast<std::size_t>(index.materials.size()), 1e4f);
    for (std::size_t m = 0; m < model.materials.size(); ++m) {
        if (const int i = index.materials.find(model.materials[m]); i >= 0)
            by_material[static_cast<std::size_t>(i)] = middle[m];
    }
    const std::vector<float> squared = index.squared_distances(descriptor);
    std::vector<Neighbour> all;
    for (std::size_t i = 0; i < squared.size(); ++i) {
        if (squared[i] >= SampleIndex::kFar) continue;
        const auto material = static_cast<std::size_t>(index.looks[i].material);
        const bool drawn = index.samples[i].origin == TextureOrigin::kProcedural;
        all.push_back(
            {i, std::sqrt(squared[i]) + kMiddle * by_material[material] + (drawn ? kDrawn : 0)});
    }
    return all;
}

bool nearer(const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.sample < b.sample;
}

// The nearest of each material.
std::vector<Neighbour> best_of_each(const SampleIndex& index, const std::vector<Neighbour>& all) {
    std::vector<Neighbour> best(static_cast<std::size_t>(index.materials.size()),
                                {0, SampleIndex::kFar});
    for (const Neighbour& n : all) {
        Neighbour& own = best[static_cast<std::size_t>(index.looks[n.sample].material)];
        if (n.distance < own.distance) own = n;
    }
    return best;
}

}  // namespace

std::vector<Neighbour> rank_for_picture(const SampleIndex& index, const DescriptorModel& model,
                                        std::span<const float> descriptor, std::size_t count) {
    std::vector<Neighbour> all = judged(index, model, descriptor);
    if (all.empty()) return {};
    const auto shown = std::min(all.size(), count + kFirst);
    std::vector<Neighbour> best = best_of_each(index, all);
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), all.end(),
                      nearer);
    std::sort(best.begin(), best.end(), nearer);
    std::vector<Neighbour> out;
    for (const Neighbour& n : best) {
        if (out.size() == std::min(kFirst, count) || n.distance >= SampleIndex::kFar) break;
        out.push_back(n);
    }
    const std::size_t led = out.size();
    for (std::size_t k = 0; k < shown && out.size() < count; ++k) {
        const bool taken =
            std::any_of(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(led),
                        [&](const Neighbour& r) { return r.sample == all[k].sample; });
        if (!taken) out.push_back(all[k]);
    }
    return out;
}

std::vector<SearchHit> similar_to_sample(const SampleIndex& index, std::size_t sample, int count) {
    std::vector<SearchHit> out;
    if (index.descriptor_size == 0) return out;
    for (const Neighbour& n : nearest(index, index.descriptor(sample), count + 1)) {
        if (n.sample == sample || static_cast<int>(out.size()) >= count) continue;
        out.push_back(hit_of(index, n.sample, n.distance));
    }
    return out;
}

std::vector<SearchHit> similar_to_picture(const SampleIndex& index, const DescriptorModel& model,
                                          std::span<const float> features, int count) {
    std::vector<SearchHit> out;
    if (count < 1) return out;
    const std::vector<float> descriptor = model.describe(features);
    for (const Neighbour& r :
         rank_for_picture(index, model, descriptor, static_cast<std::size_t>(count)))
        out.push_back(hit_of(index, r.sample, r.distance));
    return out;
}

}  // namespace weft
