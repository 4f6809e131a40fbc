#include <algorithm>
#include <cmath>

#include "texture_db/features.h"
#include "texture_db/library_state.h"

namespace weft {
namespace {

// How much the distance to the middle of a sample's material counts beside that to the sample
// itself. A material is known better by its middle than by whichever of its samples comes near.
constexpr float kMiddle = 0.6f;
constexpr std::size_t kFirst = 5;

SearchHit hit_of(const SampleIndex& index, std::size_t i, float distance) {
    const IndexedSample& s = index.samples[i];
    return {s.id,
            s.name,
            index.materials.text(s.material),
            1 / (1 + 0.25f * distance),
            {"looks alike"}};
}

struct Ranked {
    float distance = 0;
    std::size_t sample = 0;
    bool operator<(const Ranked& o) const {
        return distance != o.distance ? distance < o.distance : sample < o.sample;
    }
};

// The first one is the nearest of all; then the nearest of each of the likeliest other materials,
// since what a picture shows is not sure; then all others by distance.
std::vector<Ranked> ranked(const SampleIndex& index, const DescriptorModel& model,
                           const std::vector<float>& descriptor, std::size_t count) {
    const std::vector<float> middle = model.distances_to_centres(descriptor);
    std::vector<float> by_material(static_cast<std::size_t>(index.materials.size()), 1e4f);
    for (std::size_t m = 0; m < model.materials.size(); ++m) {
        if (const int i = index.materials.find(model.materials[m]); i >= 0)
            by_material[static_cast<std::size_t>(i)] = middle[m];
    }
    const std::vector<float> squared = index.squared_distances(descriptor);
    std::vector<Ranked> all, best(by_material.size(), {SampleIndex::kFar, 0});
    for (std::size_t i = 0; i < squared.size(); ++i) {
        if (squared[i] >= SampleIndex::kFar) continue;
        const auto material = static_cast<std::size_t>(index.looks[i].material);
        all.push_back({std::sqrt(squared[i]) + kMiddle * by_material[material], i});
        best[material] = std::min(best[material], all.back());
    }
    if (all.empty()) return {};
    const auto shown = std::min(all.size(), count + kFirst);
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), all.end());
    std::vector<std::size_t> likely(by_material.size());
    for (std::size_t m = 0; m < likely.size(); ++m)
        likely[m] = m;
    std::stable_sort(likely.begin(), likely.end(),
                     [&](std::size_t a, std::size_t b) { return by_material[a] < by_material[b]; });
    std::vector<Ranked> out{all[0]};
    const auto first = static_cast<std::size_t>(index.looks[all[0].sample].material);
    for (std::size_t k = 0; k < likely.size() && out.size() < std::min(kFirst, count); ++k) {
        if (likely[k] != first && best[likely[k]].distance < SampleIndex::kFar)
            out.push_back(best[likely[k]]);
    }
    const std::size_t led = out.size();
    for (std::size_t k = 0; k < shown && out.size() < count; ++k) {
        const bool taken = std::any_of(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(led),
                                       [&](const Ranked& r) { return r.sample == all[k].sample; });
        if (!taken) out.push_back(all[k]);
    }
    return out;
}

}  // namespace

Expected<std::vector<SearchHit>> TextureLibrary::similar(const std::string& given, int count) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    WEFT_TRY(id, state_->full_id(given));
    const SampleIndex& index = *state_->index;
    const std::size_t self = index.by_id.at(id);
    std::vector<SearchHit> out;
    if (index.descriptor_size == 0) return out;
    for (const Neighbour& n : nearest(index, index.descriptor(self), count + 1)) {
        if (n.sample == self || static_cast<int>(out.size()) >= count) continue;
        out.push_back(hit_of(index, n.sample, n.distance));
    }
    return out;
}

Expected<std::vector<SearchHit>> TextureLibrary::similar(ViewU8x3 picture, int count) {
    if (picture.width() < 32 || picture.height() < 32) {
        return fail(ErrorCode::kUsage,
                    "The picture is smaller than 32x32 pixels. Give a larger one.");
    }
    const std::vector<float> features = texture_features(middle_sample(picture));
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    std::vector<SearchHit> out;
    if (!state_->model || count < 1) return out;
    const std::vector<float> descriptor = state_->model->describe(features);
    for (const Ranked& r :
         ranked(*state_->index, *state_->model, descriptor, static_cast<std::size_t>(count)))
        out.push_back(hit_of(*state_->index, r.sample, r.distance));
    return out;
}

}  // namespace weft
