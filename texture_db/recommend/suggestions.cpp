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
    {"Like now", "surfaces that look much like the region's", 3.2f, 0.8f, 0.6f, 0.7f, 0.7f},
    {"In harmony", "colours that go with the rest of the frame", 0.9f, 3.0f, 1.0f, 0.7f, 0.8f},
    {"Same style", "as busy, as contrasty and as colourful as the rest of the frame", 0.8f, 1.0f,
     3.0f, 0.8f, 0.8f},
    {"A contrast", "stands out: another lightness or the opposite hue", 0.5f, 1.6f, 0.5f, 0.7f,
     0.8f},
    {"Another material", "something else that would look at home here", -1.0f, 1.8f, 1.6f, 0.8f,
     0.8f},
};
constexpr float kUnlikely = 0.06f;  // a less likely role gets no place
constexpr float kServed = 0.6f;     // of a role's wish for a place, by a material usual for it
constexpr float kAgain = 0.5f;      // of a material's chance of a place, for each that it has
constexpr float kLikely = 0.5f;     // from here on the role is named
// The descriptor finds a plain shirt like stone and wood; an eye does not if the colour is another.
constexpr float kMuchAlike = 0.25f;
constexpr float kGrowsWell = 0.55f;  // synthesis above this is good enough
constexpr std::size_t kLikeNow = 0, kContrast = 3, kOther = 4;

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
    const float likelihood = scorer.material_likelihood(c.sample).value_or(0.0f);
    if (likelihood > 0.6f)
        found.emplace_back(likelihood, "is " + material + ", which the region looks like now");
    else if (c.parts.material > 0.5f && c.stands_out < kMuchAlike)
        found.emplace_back(c.parts.material, "its surface is much like the region's");
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
    if (!likelihoods.empty()) {
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
        if (scheme == kOther && scorer.material_likelihood(c.sample).value_or(0.0f) > 0.5f)
            score *= 0.3f;
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

// Whose turn it is among the materials. What the region is is uncertain, so each place goes to the
// material that most probably suits it if all before do not: a place takes from the likelihood of
// the roles that its material serves.
class Turns {
  public:
    Turns(const SampleIndex& index, const RegionScorer& scorer)
        : scorer_(scorer),
          left_(scorer.roles()),
          chance_(static_cast<std::size_t>(index.materials.size()), 1.0f) {
        for (float& l : left_)
            l = l < kUnlikely ? 0 : l;
    }
    // Nothing once all are excluded.
    [[nodiscard]] std::optional<int> next() const {
        std::optional<int> best;
        float most = 0;
        for (std::size_t m = 0; m < chance_.size(); ++m) {
            const float claim = chance_[m] * scorer_.suits(static_cast<int>(m), left_);
            if (claim > most) most = claim, best = static_cast<int>(m);
        }
        return best;
    }
    void give(int material) {
        const RoleWeights& usual = scorer_.usual(material);
        for (std::size_t r = 0; r < left_.size(); ++r)
            left_[r] *= 1 - kServed * usual[r];
        chance_[static_cast<std::size_t>(material)] *= kAgain;
    }
    void exclude(int material) { chance_[static_cast<std::size_t>(material)] = 0; }

  private:
    const RegionScorer& scorer_;
    RoleWeights left_;
    std::vector<float> chance_;  // by material
};

// The candidates of a scheme. Maximal marginal relevance (Carbonell & Goldstein 1998): the best is
// good and unlike those chosen before.
class Pool {
  public:
    Pool(std::vector<Scored> candidates, const RegionScorer& scorer)
        : candidates_(std::move(candidates)),
          scorer_(scorer),
          likest_(candidates_.size(), 0.0f),
          taken_(candidates_.size(), false) {}
    // Of one material, or of all; null if none is left.
    [[nodiscard]] const Scored* best(float diversity, std::optional<int> material) const {
        const Scored* best = nullptr;
        float most = 0;
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            if (taken_[i] ||
                (material && scorer_.material(candidates_[i].candidate->sample) != *material))
                continue;
            const float value = (1 - diversity) * candidates_[i].score - diversity * likest_[i];
            if (!best || value > most) most = value, best = &candidates_[i];
        }
        return best;
    }
    // Whether it is one of these or not.
    void choose(std::uint32_t sample) {
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            const std::uint32_t own = candidates_[i].candidate->sample;
            if (own == sample) taken_[i] = true;
            if (!taken_[i]) likest_[i] = std::max(likest_[i], scorer_.likeness(own, sample));
        }
    }

  private:
    std::vector<Scored> candidates_;
    const RegionScorer& scorer_;
    std::vector<float> likest_;
    std::vector<bool> taken_;
};

// The next of a pool: of the material whose turn it is, or of any.
const Scored* next_of(const Pool& pool, float diversity, Turns& turns) {
    while (const std::optional<int> material = turns.next()) {
        if (const Scored* found = pool.best(diversity, material)) {
            turns.give(*material);
            return found;
        }
        turns.exclude(*material);
    }
    return pool.best(diversity, std::nullopt);
}

// In the order of choice; without `turns` the materials do not matter.
std::vector<Scored> diverse(Pool pool, int count, float diversity, std::optional<Turns> turns) {
    std::vector<Scored> out;
    while (static_cast<int>(out.size()) < count) {
        const Scored* next =
            turns ? next_of(pool, diversity, *turns) : pool.best(diversity, std::nullopt);
        if (!next) break;
        out.push_back(*next);
        pool.choose(next->candidate->sample);
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

// The best of all schemes in turn, each texture once.
std::vector<Scored> best_of_all(std::vector<Pool> pools, int count, float diversity, Turns turns) {
    std::vector<Scored> out;
    for (std::size_t turn = 0; static_cast<int>(out.size()) < count; ++turn) {
        const Scored* next = next_of(pools[turn % pools.size()], diversity, turns);
        if (!next) break;
        out.push_back(*next);
        for (Pool& pool : pools)
            pool.choose(out.back().candidate->sample);
    }
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
    const Turns turns(index, scorer);
    const auto suggestions = [&](const std::vector<Scored>& chosen) {
        std::vector<Suggestion> list;
        list.reserve(chosen.size());
        for (const Scored& one : chosen)
            list.push_back(suggestion_of(index, scorer, *one.candidate, one.score));
        return list;
    };
    std::vector<Pool> pools;
    for (std::size_t s = 0; s < std::size(kSchemes); ++s) {
        pools.emplace_back(best_of(index, scorer, candidates, s), scorer);
        const bool mixed = s != kLikeNow && diversity > 0;
        auto list = suggestions(diverse(pools.back(), request.count, diversity,
                                        mixed ? std::optional(turns) : std::nullopt));
        if (!list.empty())
            out.schemes.push_back({kSchemes[s].name, kSchemes[s].why, std::move(list)});
    }
    out.suggestions = suggestions(best_of_all(std::move(pools), request.count, diversity, turns));
    bring_cloth_forward(scorer, out.schemes, out.suggestions);
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
