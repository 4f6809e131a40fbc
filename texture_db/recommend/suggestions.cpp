#include "texture_db/recommend/suggestions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft {
namespace {

// The pool for diverse suggestions: the best of a scheme, and the best of every material.
constexpr std::size_t kPool = 120, kOfMaterial = 6;

// The weight of each term in a scheme.
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
constexpr float kUnlikely = 0.1f;    // a less likely role gets no place
constexpr float kLikely = 0.5f;      // from here on the role is named
constexpr float kGrowsWell = 0.55f;  // synthesis above this is good enough
constexpr std::size_t kKeep = 0, kContrast = 3, kOther = 4;

float score_of(const ScoredSample& c, const Weights& w) {
    const ScoreTerms& p = c.parts;
    const float material =
        w.material >= 0 ? w.material * p.material : -w.material * (1 - p.material);
    const float sum = material + w.colour * p.colour + w.style * p.style + w.scale * p.scale +
                      w.synthesis * std::min(p.synthesis / kGrowsWell, 1.0f);
    const float weight = std::abs(w.material) + w.colour + w.style + w.scale + w.synthesis;
    // Requests are strict, and a sample that is invisible at this size or does not synthesize is
    // useless. Synthesis only counts where it is bad; otherwise evenly drawn textures would always
    // win.
    const float grows = std::min(p.synthesis / kGrowsWell, 1.0f);
    return sum / weight * p.adjustment * (0.25f + 0.75f * p.use) * (0.35f + 0.65f * p.scale) *
           (0.5f + 0.5f * grows) * p.coherence;
}

std::vector<std::string> reasons_of(const SampleIndex& index, const RegionScorer& scorer,
                                    const ScoredSample& c) {
    const std::string& material = index.materials.text(index.looks[c.sample].material);
    std::vector<std::pair<float, std::string>> found;
    const float likelihood = scorer.material_likelihood(c.sample);
    if (likelihood > 0.6f)
        found.emplace_back(likelihood, "is " + material + ", which the region looks like now");
    else if (c.parts.material > 0.5f)
        found.emplace_back(c.parts.material, "its surface is much like the region's");
    else if (c.parts.material < 0.15f)
        found.emplace_back(0.3f, "a different material: " + material);
    if (scorer.likely_role() >= kLikely &&
        scorer.serves(c.sample, static_cast<std::size_t>(scorer.role())))
        found.emplace_back(0.55f, "usual for " + std::string(role_name(scorer.role())));
    const std::string colour = colour_name(index.looks[c.sample].mean);
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
        found.emplace_back(0.6f * c.parts.synthesis, "synthesizes without visible seams");
    if (c.parts.synthesis < 0.35f) found.emplace_back(0.3f, "uneven: may show repeats");
    if (c.parts.adjustment < 1 && c.parts.adjustment > 0.6f)
        found.emplace_back(1, "meets the request");
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> out;
    for (auto& [weight, text] : found)
        out.push_back(std::move(text));
    return out;
}

Suggestion suggestion_of(const SampleIndex& index, const RegionScorer& scorer,
                         const ScoredSample& c, float score) {
    const IndexedSample& s = index.samples[c.sample];
    return {s.id,  s.name,  index.materials.text(s.material),
            score, c.parts, reasons_of(index, scorer, c)};
}

std::string seen_as(const SampleIndex& index, const RegionScorer& scorer, const RegionLook& look) {
    std::string out;
    const std::vector<float>& likelihoods = scorer.material_likelihoods();
    if (!likelihoods.empty() && !look.descriptors.empty()) {
        const auto best =
            std::max_element(likelihoods.begin(), likelihoods.end()) - likelihoods.begin();
        out = index.materials.text(static_cast<int>(best)) + ", ";
    }
    out += colour_name(look.inside.mean);
    const auto words = attribute_words(look.inside);
    for (std::size_t i = 0; i < std::min<std::size_t>(2, words.size()); ++i)
        out += ", " + words[i];
    if (scorer.likely_role() >= kLikely) out += "; " + std::string(role_name(scorer.role()));
    return out;
}

struct Scored {
    float score = 0;
    const ScoredSample* candidate = nullptr;
};

// The best of a scheme, best first, ties by id.
std::vector<Scored> best_of(const SampleIndex& index, const RegionScorer& scorer,
                            const std::vector<ScoredSample>& candidates, std::size_t scheme) {
    std::vector<Scored> pool;
    pool.reserve(candidates.size());
    for (const ScoredSample& c : candidates) {
        float score = score_of(c, kSchemes[scheme]);
        if (scheme == kContrast) score *= 0.25f + 0.75f * c.stands_out;
        if (scheme == kOther && scorer.material_likelihood(c.sample) > 0.5f) score *= 0.3f;
        pool.push_back({score, &c});
    }
    const auto better = [&](const Scored& a, const Scored& b) {
        if (a.score != b.score) return a.score > b.score;
        return index.samples[a.candidate->sample].id < index.samples[b.candidate->sample].id;
    };
    if (pool.size() > kPool) {
        std::nth_element(pool.begin(), pool.begin() + kPool, pool.end(), better);
        std::vector<std::vector<Scored>> rest(static_cast<std::size_t>(index.materials.size()));
        for (auto at = pool.begin() + kPool; at != pool.end(); ++at)
            rest[static_cast<std::size_t>(index.looks[at->candidate->sample].material)].push_back(
                *at);
        pool.resize(kPool);
        for (std::vector<Scored>& of_one : rest) {
            const auto most =
                of_one.begin() + static_cast<std::ptrdiff_t>(std::min(kOfMaterial, of_one.size()));
            std::partial_sort(of_one.begin(), most, of_one.end(), better);
            pool.insert(pool.end(), of_one.begin(), most);
        }
    }
    std::sort(pool.begin(), pool.end(), better);
    return pool;
}

// Distributes places over the region's possible roles in proportion to their likelihood
// (Sainte-Laguë 1910). The role is uncertain, so no role takes all places.
class Places {
  public:
    explicit Places(const RoleWeights& likely) : likely_(likely) {
        for (float& l : likely_)
            l = l < kUnlikely ? 0 : l;
    }
    // The role that gets the next place.
    [[nodiscard]] std::size_t next() const {
        std::size_t best = 0;
        for (std::size_t r = 1; r < likely_.size(); ++r) {
            if (claim(r) > claim(best)) best = r;
        }
        return best;
    }
    void give(std::size_t role) { given_[role] += 1; }

  private:
    [[nodiscard]] float claim(std::size_t r) const { return likely_[r] / (2 * given_[r] + 1); }
    RoleWeights likely_, given_{};
};

// Maximal marginal relevance (Carbonell & Goldstein 1998) among the samples of the role that gets
// the next place; among all without `places`.
std::vector<Scored> diverse(const std::vector<Scored>& pool, const RegionScorer& scorer, int count,
                            float diversity, std::optional<Places> places) {
    std::vector<Scored> out;
    std::vector<float> likest(pool.size(), 0);
    std::vector<bool> taken(pool.size(), false);
    while (static_cast<int>(out.size()) < count && out.size() < pool.size()) {
        const std::size_t role = places ? places->next() : 0;
        const auto best_among = [&](bool all) {
            std::size_t best = pool.size();
            float best_value = -1e9f;
            for (std::size_t i = 0; i < pool.size(); ++i) {
                if (taken[i] || (!all && !scorer.serves(pool[i].candidate->sample, role))) continue;
                const float value = (1 - diversity) * pool[i].score - diversity * likest[i];
                if (value > best_value) {
                    best_value = value;
                    best = i;
                }
            }
            return best;
        };
        std::size_t best = best_among(!places);
        if (best == pool.size()) best = best_among(true);
        if (places) places->give(role);
        taken[best] = true;
        out.push_back(pool[best]);
        for (std::size_t i = 0; i < pool.size(); ++i) {
            if (!taken[i])
                likest[i] = std::max(likest[i], scorer.likeness(pool[i].candidate->sample,
                                                                pool[best].candidate->sample));
        }
    }
    return out;
}

// Whoever dresses somebody looks for cloth first: with none among the first three, the best one
// moves up to the third place.
void bring_cloth_forward(const RegionScorer& scorer, const std::vector<SuggestionScheme>& schemes,
                         std::vector<Suggestion>& suggestions) {
    constexpr std::ptrdiff_t kFirst = 3;
    constexpr float kPerhaps = 0.25f;  // a bedspread that lies along the bottom
    const auto garment = static_cast<std::size_t>(SurfaceRole::kGarment);
    if (scorer.roles()[garment] < kPerhaps || std::ssize(suggestions) < kFirst) return;
    const auto is_cloth = [](const Suggestion& s) {
        return s.material == "fabric" || s.material == "knit";
    };
    const auto third = suggestions.begin() + kFirst - 1;
    if (std::any_of(suggestions.begin(), third + 1, is_cloth)) return;
    if (const auto later = std::find_if(third + 1, suggestions.end(), is_cloth);
        later != suggestions.end()) {
        std::rotate(third, later, later + 1);
        return;
    }
    for (const SuggestionScheme& scheme : schemes) {
        const auto found = std::ranges::find_if(scheme.suggestions, is_cloth);
        if (found == scheme.suggestions.end()) continue;
        suggestions.insert(third, *found);
        suggestions.pop_back();
        return;
    }
}

// The best of all schemes in turn, each texture once, each for the role that gets the next place.
std::vector<Suggestion> best_of_all(const SampleIndex& index, const RegionScorer& scorer,
                                    const std::vector<SuggestionScheme>& schemes, int count) {
    std::vector<Suggestion> out;
    Places places(scorer.roles());
    const auto take = [&](const SuggestionScheme& scheme, std::optional<std::size_t> role) {
        for (const Suggestion& s : scheme.suggestions) {
            const bool there = std::any_of(out.begin(), out.end(),
                                           [&](const Suggestion& o) { return o.id == s.id; });
            if (there || (role && !scorer.serves(index.by_id.at(s.id), *role))) continue;
            out.push_back(s);
            return true;
        }
        return false;
    };
    int idle = 0;  // consecutive schemes without a suggestion
    for (std::size_t turn = 0;
         static_cast<int>(out.size()) < count && idle < static_cast<int>(schemes.size()); ++turn) {
        const SuggestionScheme& scheme = schemes[turn % schemes.size()];
        const std::size_t role = places.next();
        const bool taken = take(scheme, role) || take(scheme, std::nullopt);
        if (taken) places.give(role);
        idle = taken ? 0 : idle + 1;
    }
    bring_cloth_forward(scorer, schemes, out);
    return out;
}

}  // namespace

RegionSuggestions suggest_for(const SampleIndex& index, const RecommendRequest& request,
                              const RegionRequest& region, const RegionLook& look,
                              const RegionScorer& scorer) {
    RegionSuggestions out;
    out.region = region.name;
    out.seen_as = seen_as(index, scorer, look);
    const std::vector<ScoredSample> candidates = scorer.score_all();
    const float diversity = std::clamp(request.diversity, 0.0f, 1.0f);
    for (std::size_t s = 0; s < std::size(kSchemes); ++s) {
        SuggestionScheme scheme{kSchemes[s].name, kSchemes[s].why, {}};
        const auto pool = best_of(index, scorer, candidates, s);
        const bool mixed = s != kKeep && diversity > 0;
        const auto places = mixed ? std::optional(Places(scorer.roles())) : std::nullopt;
        for (const Scored& one : diverse(pool, scorer, request.count, diversity, places))
            scheme.suggestions.push_back(suggestion_of(index, scorer, *one.candidate, one.score));
        if (!scheme.suggestions.empty()) out.schemes.push_back(std::move(scheme));
    }
    out.suggestions = best_of_all(index, scorer, out.schemes, request.count);
    return out;
}

Suggestion suggestion_kept(const SampleIndex& index, const RegionScorer& scorer,
                           std::size_t sample) {
    const ScoredSample c = scorer.score(sample);
    Suggestion s = suggestion_of(index, scorer, c, score_of(c, kSchemes[1]));
    s.reasons.insert(s.reasons.begin(), "kept as requested");
    return s;
}

}  // namespace weft
