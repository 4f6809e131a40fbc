#include "texture_db/recommend.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "texture_db/features.h"
#include "texture_db/library_state.h"
#include "texture_db/region_look.h"

namespace weft {
namespace {

using A = TextureAttribute;
using Clock = std::chrono::steady_clock;

constexpr int kNeighbours = 40;
constexpr std::size_t kPool = 160;  // best of a scheme, from which the diverse ones are taken

// How much each part counts in a scheme.
struct Weights {
    const char* name;
    const char* why;
    float material, colour, style, scale, synthesis;
};
constexpr Weights kSchemes[]{
    {"Keep the material", "the same kind of surface as now, other looks", 3.2f, 0.8f, 0.6f, 0.7f,
     0.7f},
    {"In harmony", "colours that go with the rest of the frame", 0.9f, 3.0f, 1.0f, 0.7f, 0.8f},
    {"Same style", "as busy, as contrasty and as colourful as the rest of the frame", 0.8f, 1.0f,
     3.0f, 0.8f, 0.8f},
    {"A contrast", "stands out: another lightness or the opposite hue", 0.5f, 1.6f, 0.5f, 0.7f,
     0.8f},
    {"Another material", "something else that would look at home here", -1.0f, 1.8f, 1.6f, 0.8f,
     0.8f},
};
constexpr std::size_t kContrast = 3, kOther = 4;

struct Candidate {
    std::size_t sample = 0;
    SuitParts parts;
    float stands_out = 0;
};

float near(float difference, float width) {
    return std::exp(-difference * difference / (2 * width * width));
}

float ramp(float v) {
    return 1 / (1 + std::exp(-v));
}

// Which materials the region looks like, 0 … 1, by its neighbours in the descriptor.
std::vector<float> materials_of(const RegionLook& look, const SampleIndex& index,
                                std::vector<float>& distance, float& typical) {
    std::vector<float> vote(static_cast<std::size_t>(index.materials.size()));
    distance.assign(index.samples.size(), 1e9f);
    std::vector<float> nearest_ones;
    for (const auto& descriptor : look.descriptors) {
        const auto all = nearest(index, descriptor, static_cast<int>(index.samples.size()));
        for (std::size_t i = 0; i < all.size(); ++i) {
            distance[all[i].sample] = std::min(distance[all[i].sample], all[i].distance);
            if (i < kNeighbours) {
                vote[static_cast<std::size_t>(index.samples[all[i].sample].material)] +=
                    1.0f / (1.0f + 0.15f * static_cast<float>(i));
            }
        }
        if (all.size() > 8) nearest_ones.push_back(all[8].distance);
    }
    typical = 1;
    if (!nearest_ones.empty()) {
        std::sort(nearest_ones.begin(), nearest_ones.end());
        typical = std::max(nearest_ones[nearest_ones.size() / 2], 1e-3f);
    }
    // A material with many samples has more of them anywhere: that must not decide.
    std::vector<float> count(vote.size());
    for (const IndexedSample& s : index.samples)
        count[static_cast<std::size_t>(s.material)] += 1;
    for (std::size_t m = 0; m < vote.size(); ++m)
        vote[m] /= std::sqrt(std::max(count[m], 1.0f));
    const float most = vote.empty() ? 0 : *std::max_element(vote.begin(), vote.end());
    for (float& v : vote)
        v = most > 0 ? v / most : 0;
    return vote;
}

float scale_fit(const MeasuredTexture& m, const RegionLook& look) {
    const float structure_px = 2 * std::pow(24.0f, m.attributes[A::kScale]);
    const float repeats = look.short_side_px / structure_px;
    // Fewer than three of its structures do not read as the texture; above sixty it is noise.
    const float enough = std::clamp((repeats - 1) / 3, 0.0f, 1.0f);
    const float not_too_fine = repeats > 60 ? near(std::log2(repeats / 60), 1.2f) : 1.0f;
    return enough * not_too_fine;
}

float style_fit(const TextureAttributes& a, const RegionLook& look) {
    const float contrast = near(a[A::kContrast] - std::min(look.rest_contrast, 0.8f), 0.35f);
    const float saturation = near(a[A::kSaturation] - look.rest_saturation, 0.25f);
    const float detail = near(a[A::kRoughness] - look.rest_roughness, 0.35f);
    return std::cbrt(contrast * saturation * detail);
}

float wish_fit(const RecommendWish& w, const TextureAttributes& base, const TextureAttributes& a) {
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

class Adviser {
  public:
    Adviser(const SampleIndex& index, const RecommendRequest& request, const RegionToSuit& region,
            const RegionLook& look)
        : index_(index), request_(request), region_(region), look_(look) {
        vote_ = materials_of(look, index, distance_, typical_);
        const auto like = index.by_id.find(request.wish.like);
        like_ = like == index.by_id.end() ? index.samples.size() : like->second;
        for (int i = 0; i < index.licences.size(); ++i)
            excluded_.push_back(
                licence_excluded(index.licences.text(i), request.excluded_licences));
        for (std::size_t i = 0; i < index.samples.size(); ++i)
            consider(i);
    }

    [[nodiscard]] RegionSuggestions advise() const {
        RegionSuggestions out;
        out.region = region_.name;
        out.seen_as = seen_as();
        for (std::size_t s = 0; s < std::size(kSchemes); ++s) {
            SuggestionScheme scheme{kSchemes[s].name, kSchemes[s].why, {}};
            for (const auto& [score, candidate] : diverse(s, request_.count))
                scheme.suggestions.push_back(suggestion(candidate, score));
            if (!scheme.suggestions.empty()) out.schemes.push_back(std::move(scheme));
        }
        // The best of all schemes in turn, each texture once.
        for (std::size_t rank = 0; static_cast<int>(out.suggestions.size()) < request_.count;
             ++rank) {
            bool any = false;
            for (const SuggestionScheme& scheme : out.schemes) {
                if (rank >= scheme.suggestions.size()) continue;
                any = true;
                const Suggestion& s = scheme.suggestions[rank];
                const bool there = std::any_of(out.suggestions.begin(), out.suggestions.end(),
                                               [&](const Suggestion& o) { return o.id == s.id; });
                if (!there && static_cast<int>(out.suggestions.size()) < request_.count)
                    out.suggestions.push_back(s);
            }
            if (!any) break;
        }
        return out;
    }

    [[nodiscard]] Suggestion kept(std::size_t sample) const {
        Candidate c = judged(sample);
        Suggestion s = suggestion(c, score_of(c, kSchemes[1]));
        s.reasons.insert(s.reasons.begin(), "kept, as you wished");
        return s;
    }

  private:
    void consider(std::size_t i) {
        const IndexedSample& s = index_.samples[i];
        if (excluded_[static_cast<std::size_t>(s.licence)]) return;
        if (!region_.material.empty() && index_.materials.text(s.material) != region_.material)
            return;
        candidates_.push_back(judged(i));
    }

    [[nodiscard]] Candidate judged(std::size_t i) const {
        const IndexedSample& s = index_.samples[i];
        Candidate c;
        c.sample = i;
        const float likeness = near(std::max(0.0f, distance_[i] - typical_) / typical_, 0.8f);
        c.parts.material =
            std::max(0.45f * likeness + 0.55f * vote_[static_cast<std::size_t>(s.material)], 0.0f);
        c.parts.colour = colour_harmony(s.measured.mean, look_.surroundings);
        c.parts.style = style_fit(s.measured.attributes, look_);
        c.parts.scale = scale_fit(s.measured, look_);
        c.parts.synthesis = s.synthesis;
        const TextureAttributes& base = like_ < index_.samples.size()
                                            ? index_.samples[like_].measured.attributes
                                            : look_.inside.attributes;
        c.parts.wish = wish_fit(request_.wish, base, s.measured.attributes);
        if (like_ < index_.samples.size()) {
            float d = 0;
            const auto x = index_.descriptor(i), y = index_.descriptor(like_);
            for (std::size_t k = 0; k < x.size(); ++k)
                d += (x[k] - y[k]) * (x[k] - y[k]);
            c.parts.wish *= near(std::sqrt(d) / typical_, 1.5f);
        }
        const float lightness = std::abs(s.measured.mean.l - look_.inside.mean.l) / 40;
        const float hue = hue_difference_deg(s.measured.mean, look_.inside.mean) / 150;
        c.stands_out = std::min(1.0f, std::max(lightness, hue));
        return c;
    }

    static float score_of(const Candidate& c, const Weights& w) {
        const SuitParts& p = c.parts;
        const float material =
            w.material >= 0 ? w.material * p.material : -w.material * (1 - p.material);
        const float sum = material + w.colour * p.colour + w.style * p.style + w.scale * p.scale +
                          w.synthesis * p.synthesis;
        const float weight = std::abs(w.material) + w.colour + w.style + w.scale + w.synthesis;
        // A wish is a demand, and what cannot be seen at this size or does not grow is no use.
        return sum / weight * p.wish * (0.35f + 0.65f * p.scale) * (0.5f + 0.5f * p.synthesis) *
               p.company;
    }

    [[nodiscard]] float scheme_score(const Candidate& c, std::size_t scheme) const {
        float score = score_of(c, kSchemes[scheme]);
        if (scheme == kContrast) score *= 0.25f + 0.75f * c.stands_out;
        if (scheme == kOther &&
            vote_[static_cast<std::size_t>(index_.samples[c.sample].material)] > 0.5f)
            score *= 0.3f;
        return score;
    }

    // Maximal marginal relevance (Carbonell & Goldstein 1998).
    [[nodiscard]] std::vector<std::pair<float, Candidate>> diverse(std::size_t scheme,
                                                                   int count) const {
        std::vector<std::pair<float, Candidate>> pool;
        for (const Candidate& c : candidates_)
            pool.emplace_back(scheme_score(c, scheme), c);
        const std::size_t size = std::min(kPool, pool.size());
        std::partial_sort(pool.begin(), pool.begin() + static_cast<std::ptrdiff_t>(size),
                          pool.end(), [&](const auto& a, const auto& b) {
                              if (a.first != b.first) return a.first > b.first;
                              return index_.samples[a.second.sample].id <
                                     index_.samples[b.second.sample].id;
                          });
        pool.resize(size);
        std::vector<std::pair<float, Candidate>> out;
        std::vector<float> likest(size, 0);
        std::vector<bool> taken(size, false);
        const float diversity = std::clamp(request_.diversity, 0.0f, 1.0f);
        while (static_cast<int>(out.size()) < count && out.size() < size) {
            std::size_t best = size;
            float best_value = -1e9f;
            for (std::size_t i = 0; i < size; ++i) {
                if (taken[i]) continue;
                const float value = (1 - diversity) * pool[i].first - diversity * likest[i];
                if (value > best_value) {
                    best_value = value;
                    best = i;
                }
            }
            taken[best] = true;
            out.push_back(pool[best]);
            for (std::size_t i = 0; i < size; ++i)
                likest[i] =
                    std::max(likest[i], likeness(pool[i].second.sample, pool[best].second.sample));
        }
        return out;
    }

    // 1 for two pieces of one picture, less the more two samples differ.
    [[nodiscard]] float likeness(std::size_t i, std::size_t j) const {
        const IndexedSample &a = index_.samples[i], &b = index_.samples[j];
        if (a.source == b.source && a.package == b.package &&
            a.origin != TextureOrigin::kProcedural)
            return 1;
        float d = 0;
        if (index_.descriptor_size > 0) {
            const auto x = index_.descriptor(i), y = index_.descriptor(j);
            for (std::size_t k = 0; k < x.size(); ++k)
                d += (x[k] - y[k]) * (x[k] - y[k]);
        }
        const LabColor &p = a.measured.mean, &q = b.measured.mean;
        const float colour = std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
        return 0.6f * near(std::sqrt(d) / typical_, 0.8f) + 0.4f * near(colour, 9);
    }

    [[nodiscard]] Suggestion suggestion(const Candidate& c, float score) const {
        const IndexedSample& s = index_.samples[c.sample];
        return {s.id, s.name, index_.materials.text(s.material), score, c.parts, reasons(c)};
    }

    [[nodiscard]] std::vector<std::string> reasons(const Candidate& c) const {
        const IndexedSample& s = index_.samples[c.sample];
        const std::string& material = index_.materials.text(s.material);
        std::vector<std::pair<float, std::string>> found;
        const float vote = vote_[static_cast<std::size_t>(s.material)];
        if (vote > 0.6f)
            found.emplace_back(vote, "is " + material + ", which the region looks like now");
        else if (c.parts.material > 0.5f)
            found.emplace_back(c.parts.material, "its surface is much like the region's");
        else if (c.parts.material < 0.15f)
            found.emplace_back(0.3f, "a different material: " + material);
        const std::string colour = colour_name(s.measured.mean);
        if (c.parts.colour > 0.75f)
            found.emplace_back(c.parts.colour, colour + " goes with the colours around it");
        if (c.stands_out > 0.6f)
            found.emplace_back(0.7f * c.stands_out, "stands out from what is there now");
        if (c.parts.style > 0.8f)
            found.emplace_back(0.9f * c.parts.style,
                               "as detailed and colourful as the rest of the frame");
        if (c.parts.scale > 0.9f) found.emplace_back(0.5f, "its structure fits the region's size");
        if (c.parts.scale < 0.4f)
            found.emplace_back(0.45f, "its structure is large for the region: scale it down");
        if (c.parts.synthesis > 0.7f)
            found.emplace_back(0.6f * c.parts.synthesis, "grows without visible seams");
        if (c.parts.synthesis < 0.35f)
            found.emplace_back(0.3f, "uneven: may show repeats when it grows");
        if (c.parts.wish < 1 && c.parts.wish > 0.6f) found.emplace_back(1, "meets your wish");
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        std::vector<std::string> out;
        for (auto& [weight, text] : found)
            out.push_back(std::move(text));
        return out;
    }

    [[nodiscard]] std::string seen_as() const {
        std::string out;
        if (!vote_.empty() && !look_.descriptors.empty()) {
            const auto best = std::max_element(vote_.begin(), vote_.end()) - vote_.begin();
            out = index_.materials.text(static_cast<int>(best)) + ", ";
        }
        out += colour_name(look_.inside.mean);
        const auto words = attribute_words(look_.inside);
        for (std::size_t i = 0; i < std::min<std::size_t>(2, words.size()); ++i)
            out += ", " + words[i];
        return out;
    }

    const SampleIndex& index_;
    const RecommendRequest& request_;
    const RegionToSuit& region_;
    const RegionLook& look_;
    std::vector<float> vote_, distance_;
    std::vector<bool> excluded_;
    float typical_ = 1;
    std::size_t like_ = 0;
    std::vector<Candidate> candidates_;
};

// How two textures for two regions go together: told apart, but of one world.
float company_of(const IndexedSample& a, const IndexedSample& b) {
    const LabColor &p = a.measured.mean, &q = b.measured.mean;
    const float apart = std::clamp(std::hypot(p.l - q.l, p.a - q.a, p.b - q.b) / 22, 0.0f, 1.0f);
    const float harmony = colour_harmony(p, {{q, 1}});
    const float saturation =
        near(a.measured.attributes[A::kSaturation] - b.measured.attributes[A::kSaturation], 0.35f);
    const float contrast =
        near(a.measured.attributes[A::kContrast] - b.measured.attributes[A::kContrast], 0.45f);
    const float same = a.id == b.id ? 0.3f : 1.0f;
    return same * (0.35f * apart + 0.35f * harmony + 0.15f * saturation + 0.15f * contrast);
}

// Beam search over the regions: the ten best beginnings are carried on.
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
                float company = 0;
                const IndexedSample& mine = index.samples[index.by_id.at(s.id)];
                for (const Suggestion& other : scene.per_region)
                    company += company_of(mine, index.samples[index.by_id.at(other.id)]);
                if (!scene.per_region.empty())
                    s.parts.company = company / static_cast<float>(scene.per_region.size());
                grown.score += s.score * (0.4f + 0.6f * s.parts.company);
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

Expected<Recommendation> TextureLibrary::recommend(const RecommendRequest& given) {
    const auto start = Clock::now();
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    const SampleIndex& index = *state_->index;
    if (index.samples.empty()) {
        return fail(ErrorCode::kUsage, "The texture library " + state_->path +
                                           " is empty. Fill it with 'weft texture build' or import "
                                           "pictures.");
    }
    RecommendRequest request = given;
    request.count = std::clamp(request.count, 1, 100);
    if (!request.wish.like.empty()) {
        WEFT_TRY(id, state_->full_id(request.wish.like));
        request.wish.like = id;
    }
    Recommendation out;
    std::vector<std::vector<Suggestion>> choices;
    for (const RegionToSuit& region : request.regions) {
        WEFT_TRY(look,
                 look_at_region(request.plate, region, state_->model ? &*state_->model : nullptr));
        const Adviser adviser(index, request, region, look);
        out.regions.push_back(adviser.advise());
        if (!region.keep.empty()) {
            WEFT_TRY(id, state_->full_id(region.keep));
            choices.push_back({adviser.kept(index.by_id.at(id))});
        } else {
            choices.push_back(out.regions.back().suggestions);
        }
    }
    if (request.regions.size() > 1) out.together = together(index, choices, 6);
    out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return out;
}

}  // namespace weft
