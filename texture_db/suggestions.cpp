#include "texture_db/suggestions.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

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

float score_of(const SuitedSample& c, const Weights& w) {
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

std::vector<std::string> reasons_of(const SampleIndex& index, const RegionJudge& judge,
                                    const SuitedSample& c) {
    const std::string& material = index.materials.text(index.looks[c.sample].material);
    std::vector<std::pair<float, std::string>> found;
    const float vote = judge.vote_of(c.sample);
    if (vote > 0.6f)
        found.emplace_back(vote, "is " + material + ", which the region looks like now");
    else if (c.parts.material > 0.5f)
        found.emplace_back(c.parts.material, "its surface is much like the region's");
    else if (c.parts.material < 0.15f)
        found.emplace_back(0.3f, "a different material: " + material);
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

Suggestion suggestion_of(const SampleIndex& index, const RegionJudge& judge, const SuitedSample& c,
                         float score) {
    const IndexedSample& s = index.samples[c.sample];
    return {s.id,  s.name,  index.materials.text(s.material),
            score, c.parts, reasons_of(index, judge, c)};
}

std::string seen_as(const SampleIndex& index, const RegionJudge& judge, const RegionLook& look) {
    std::string out;
    const std::vector<float>& votes = judge.votes();
    if (!votes.empty() && !look.descriptors.empty()) {
        const auto best = std::max_element(votes.begin(), votes.end()) - votes.begin();
        out = index.materials.text(static_cast<int>(best)) + ", ";
    }
    out += colour_name(look.inside.mean);
    const auto words = attribute_words(look.inside);
    for (std::size_t i = 0; i < std::min<std::size_t>(2, words.size()); ++i)
        out += ", " + words[i];
    return out;
}

struct Scored {
    float score = 0;
    const SuitedSample* candidate = nullptr;
};

// The best of a scheme, best first, ties by id.
std::vector<Scored> best_of(const SampleIndex& index, const RegionJudge& judge,
                            const std::vector<SuitedSample>& candidates, std::size_t scheme) {
    std::vector<Scored> pool;
    pool.reserve(candidates.size());
    for (const SuitedSample& c : candidates) {
        float score = score_of(c, kSchemes[scheme]);
        if (scheme == kContrast) score *= 0.25f + 0.75f * c.stands_out;
        if (scheme == kOther && judge.vote_of(c.sample) > 0.5f) score *= 0.3f;
        pool.push_back({score, &c});
    }
    const auto better = [&](const Scored& a, const Scored& b) {
        if (a.score != b.score) return a.score > b.score;
        return index.samples[a.candidate->sample].id < index.samples[b.candidate->sample].id;
    };
    if (pool.size() > kPool) {
        std::nth_element(pool.begin(), pool.begin() + kPool, pool.end(), better);
        pool.resize(kPool);
    }
    std::sort(pool.begin(), pool.end(), better);
    return pool;
}

// Maximal marginal relevance (Carbonell & Goldstein 1998).
std::vector<Scored> diverse(const std::vector<Scored>& pool, const RegionJudge& judge, int count,
                            float diversity) {
    std::vector<Scored> out;
    std::vector<float> likest(pool.size(), 0);
    std::vector<bool> taken(pool.size(), false);
    while (static_cast<int>(out.size()) < count && out.size() < pool.size()) {
        std::size_t best = pool.size();
        float best_value = -1e9f;
        for (std::size_t i = 0; i < pool.size(); ++i) {
            if (taken[i]) continue;
            const float value = (1 - diversity) * pool[i].score - diversity * likest[i];
            if (value > best_value) {
                best_value = value;
                best = i;
            }
        }
        taken[best] = true;
        out.push_back(pool[best]);
        for (std::size_t i = 0; i < pool.size(); ++i) {
            if (!taken[i])
                likest[i] = std::max(likest[i], judge.likeness(pool[i].candidate->sample,
                                                               pool[best].candidate->sample));
        }
    }
    return out;
}

// The best of all schemes in turn, each texture once.
std::vector<Suggestion> best_of_all(const std::vector<SuggestionScheme>& schemes, int count) {
    std::vector<Suggestion> out;
    for (std::size_t rank = 0; static_cast<int>(out.size()) < count; ++rank) {
        bool any = false;
        for (const SuggestionScheme& scheme : schemes) {
            if (rank >= scheme.suggestions.size()) continue;
            any = true;
            const Suggestion& s = scheme.suggestions[rank];
            const bool there = std::any_of(out.begin(), out.end(),
                                           [&](const Suggestion& o) { return o.id == s.id; });
            if (!there && static_cast<int>(out.size()) < count) out.push_back(s);
        }
        if (!any) break;
    }
    return out;
}

}  // namespace

RegionSuggestions suggest_for(const SampleIndex& index, const RecommendRequest& request,
                              const RegionToSuit& region, const RegionLook& look,
                              const RegionJudge& judge) {
    RegionSuggestions out;
    out.region = region.name;
    out.seen_as = seen_as(index, judge, look);
    const std::vector<SuitedSample> candidates = judge.judge_all();
    const float diversity = std::clamp(request.diversity, 0.0f, 1.0f);
    for (std::size_t s = 0; s < std::size(kSchemes); ++s) {
        SuggestionScheme scheme{kSchemes[s].name, kSchemes[s].why, {}};
        const auto pool = best_of(index, judge, candidates, s);
        for (const Scored& one : diverse(pool, judge, request.count, diversity))
            scheme.suggestions.push_back(suggestion_of(index, judge, *one.candidate, one.score));
        if (!scheme.suggestions.empty()) out.schemes.push_back(std::move(scheme));
    }
    out.suggestions = best_of_all(out.schemes, request.count);
    return out;
}

Suggestion suggestion_kept(const SampleIndex& index, const RegionJudge& judge, std::size_t sample) {
    const SuitedSample c = judge.judge(sample);
    Suggestion s = suggestion_of(index, judge, c, score_of(c, kSchemes[1]));
    s.reasons.insert(s.reasons.begin(), "kept, as you wished");
    return s;
}

}  // namespace weft
