#include "texture_db/search/search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/core/stopwatch.h"
#include "texture_db/catalogue/licence.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

constexpr float kNameHit = 0.8f;
constexpr float kLeast = 0.05f;  // least score of every word, for a hit

struct Scored {
    std::size_t sample = 0;
    float score = 1;
};

// A word, and the samples whose names and tags contain it.
struct TermHits {
    ReadTerm term;
    std::vector<std::int64_t> keys;  // ascending
    std::vector<float> by_material;  // weight of each material of the index
    std::vector<AttributeMatcher> looks;

    [[nodiscard]] float look(const MeasuredTexture& measured) const {
        float best = 0;
        for (const AttributeMatcher& matcher : looks)
            best = std::max(best, matcher.match(measured));
        return best;
    }
};

Expected<std::vector<std::int64_t>> find_text(Database& database, const std::string& word) {
    std::vector<std::int64_t> keys;
    // Quoted, so that no part of it is FTS5 syntax. Singular and plural are the same word.
    std::string letters;
    for (const char c : word) {
        letters += c;
        if (c == '"') letters += c;
    }
    const std::string quoted = '"' + letters + "\" OR \"" + letters + "s\"";
    WEFT_TRY(query, database.query(
                        "SELECT rowid FROM sample_text WHERE sample_text MATCH ? ORDER BY rowid"));
    query.bind(quoted);
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return keys;
        keys.push_back(query.integer(0));
    }
}

float term_score(const TermHits& hits, const IndexedSample& s) {
    float score = hits.by_material[static_cast<std::size_t>(s.material)];
    score = std::max(score, hits.look(s.measured));
    if (score < kNameHit && std::binary_search(hits.keys.begin(), hits.keys.end(), s.key))
        score = kNameHit;
    return hits.term.negated ? (score >= 0.5f ? 0.0f : 1.0f - score) : score;
}

class Filter {
  public:
    Filter(const SearchQuery& query, const SampleIndex& index, std::set<std::string> members)
        : query_(query), members_(std::move(members)) {
        allow(query.materials, index.materials, materials_);
        allow(query.packages, index.packages, packages_);
        allow(query.categories, index.categories, categories_);
        allow(query.licences, index.licences, licences_);
        if (query.excluded_licences.empty()) return;
        if (licences_.empty())
            licences_.assign(static_cast<std::size_t>(index.licences.size()), true);
        for (int i = 0; i < index.licences.size(); ++i) {
            if (licence_excluded(index.licences.text(i), query.excluded_licences))
                licences_[static_cast<std::size_t>(i)] = false;
        }
    }
    [[nodiscard]] bool passes(const IndexedSample& s) const {
        const auto in = [](const std::vector<bool>& allowed, int i) {
            return allowed.empty() || allowed[static_cast<std::size_t>(i)];
        };
        return in(materials_, s.material) && in(packages_, s.package) &&
               in(categories_, s.category) && in(licences_, s.licence) &&
               (!query_.favourites_only || s.favourite) && s.rating >= query_.min_rating &&
               (query_.origins.empty() || std::find(query_.origins.begin(), query_.origins.end(),
                                                    s.origin) != query_.origins.end()) &&
               (query_.collection.empty() || members_.contains(s.id));
    }

  private:
    static void allow(const std::vector<std::string>& wanted, const StringTable& table,
                      std::vector<bool>& out) {
        if (wanted.empty()) return;
        out.assign(static_cast<std::size_t>(table.size()), false);
        for (const std::string& text : wanted) {
            if (const int i = table.find(text); i >= 0) out[static_cast<std::size_t>(i)] = true;
        }
    }
    const SearchQuery& query_;
    std::set<std::string> members_;
    std::vector<bool> materials_, packages_, categories_, licences_;
};

// How certainly the image–text model finds the words in a sample: 0 … 1 from its similarity in
// standard deviations. With normally distributed similarities, 2 % of a library lie above kSeen.
constexpr float kSeen = 2;
float certainty_of(float deviations) {
    return 1 / (1 + std::exp(-2 * (deviations - kSeen)));
}

// `seen` is empty, or the image–text model's score of each sample.
std::vector<Scored> score_all(const SampleIndex& index, const Filter& filter,
                              const std::vector<TermHits>& terms, bool all_words,
                              const std::vector<float>& seen) {
    std::vector<Scored> out;
    for (std::size_t i = 0; i < index.samples.size(); ++i) {
        const IndexedSample& s = index.samples[i];
        if (!filter.passes(s)) continue;
        float product = 1, sum = 0;
        bool every = true;
        for (const TermHits& hits : terms) {
            const float v = term_score(hits, s);
            every = every && v > kLeast;
            product *= std::max(v, 0.0f);
            sum += std::max(v, 0.0f);
        }
        if (terms.empty()) {
            // The model's score counts for words that the library itself does not know.
            if (seen.empty())
                out.push_back({i, 1});
            else if (seen[i] > kSeen)
                out.push_back({i, certainty_of(seen[i])});
        } else if (all_words && every) {
            const float words = std::pow(product, 1.0f / static_cast<float>(terms.size()));
            out.push_back({i, seen.empty() ? words : 0.7f * words + 0.3f * certainty_of(seen[i])});
        } else if (all_words && !seen.empty() && seen[i] > kSeen) {
            out.push_back({i, 0.6f * certainty_of(seen[i])});
        } else if (!all_words && sum > 0.5f) {
            out.push_back({i, 0.9f * sum / static_cast<float>(terms.size())});
        }
    }
    return out;
}

float hue_turn(const LabColor& c) {
    if (std::hypot(c.a, c.b) < 6) return 2 + c.l / 1000;  // greys after all hues
    const float turn = std::atan2(c.b, c.a) / (2 * std::numbers::pi_v<float>);
    return turn < 0 ? turn + 1 : turn;
}

// Each order ends with the id, which is practically random, so that samples of one photograph are
// not shown side by side.
void sort_hits(std::vector<Scored>& hits, const SampleIndex& index, TextureSort sort, bool down) {
    const auto before = [&](const Scored& x, const Scored& y) {
        const IndexedSample &a = index.samples[x.sample], &b = index.samples[y.sample];
        const auto by = [&](const auto& u, const auto& v) { return u < v ? -1 : v < u ? 1 : 0; };
        int order = 0;
        switch (sort) {
            case TextureSort::kRelevance:
                // In steps, so that favourites and samples that synthesize well come first among
                // equals.
                order = by(std::lround(-y.score * 50), std::lround(-x.score * 50));
                order = order != 0 ? -order : 0;
                if (order == 0) order = by(b.rating + 2 * b.favourite, a.rating + 2 * a.favourite);
                break;
            case TextureSort::kName:
                order = by(a.name, b.name);
                break;
            case TextureSort::kMaterial:
                order = by(index.materials.text(a.material), index.materials.text(b.material));
                break;
            case TextureSort::kNewest:
                order = by(b.added, a.added);
                if (order == 0) order = by(b.key, a.key);
                break;
            case TextureSort::kRating:
                order = by(b.rating, a.rating);
                break;
            case TextureSort::kBrightness:
                order = by(a.measured.mean.l, b.measured.mean.l);
                break;
            case TextureSort::kHue:
                order = by(hue_turn(a.measured.mean), hue_turn(b.measured.mean));
                break;
            case TextureSort::kScale:
                order = by(a.measured.attributes[TextureAttribute::kScale],
                           b.measured.attributes[TextureAttribute::kScale]);
                break;
        }
        if (order != 0) return down ? order > 0 : order < 0;
        return a.id < b.id;
    };
    std::sort(hits.begin(), hits.end(), before);
}

std::vector<FacetCount> ordered(const std::vector<int>& counts, const StringTable& names) {
    std::vector<FacetCount> out;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) out.push_back({names.text(static_cast<int>(i)), counts[i]});
    }
    std::sort(out.begin(), out.end(), [](const FacetCount& a, const FacetCount& b) {
        return a.count != b.count ? a.count > b.count : a.value < b.value;
    });
    return out;
}

void count_facets(const std::vector<Scored>& hits, const SampleIndex& index, SearchResult& out) {
    const auto count = [&](const StringTable& names, auto member) {
        std::vector<int> counts(static_cast<std::size_t>(names.size()));
        for (const Scored& hit : hits)
            ++counts[static_cast<std::size_t>(index.samples[hit.sample].*member)];
        return ordered(counts, names);
    };
    out.materials = count(index.materials, &IndexedSample::material);
    out.packages = count(index.packages, &IndexedSample::package);
    out.licences = count(index.licences, &IndexedSample::licence);
    out.categories = count(index.categories, &IndexedSample::category);
    out.colours = count(index.colours, &IndexedSample::colour);
    std::erase_if(out.packages, [](const FacetCount& f) { return f.value.empty(); });
    std::erase_if(out.categories, [](const FacetCount& f) { return f.value.empty(); });
    StringTable origins;
    for (const TextureOrigin o :
         {TextureOrigin::kProcedural, TextureOrigin::kPackage, TextureOrigin::kFile})
        origins.number_of(name_of(o));
    std::vector<int> counts(3);
    for (const Scored& hit : hits)
        ++counts[static_cast<std::size_t>(index.samples[hit.sample].origin)];
    out.origins = ordered(counts, origins);
}

std::vector<std::string> reasons_of(const std::vector<TermHits>& terms, const SampleIndex& index,
                                    const IndexedSample& s) {
    std::vector<std::string> out;
    for (const TermHits& hits : terms) {
        if (hits.term.negated) {
            out.push_back("not " + hits.term.word);
            continue;
        }
        const std::string& material = index.materials.text(s.material);
        const float look = hits.look(s.measured);
        if (hits.by_material[static_cast<std::size_t>(s.material)] > kLeast) {
            out.push_back("material " + material +
                          (hits.term.word == material ? "" : " (" + hits.term.typed + ")"));
        } else if (look > kLeast) {
            out.push_back("looks " + hits.term.word);
        } else if (std::binary_search(hits.keys.begin(), hits.keys.end(), s.key)) {
            out.push_back("named '" + hits.term.text + "'");
        }
    }
    return out;
}

// The words of a query that a sample does not match.
std::vector<std::string> words_missed(const std::vector<TermHits>& terms, const IndexedSample& s) {
    std::vector<std::string> out;
    for (const TermHits& hits : terms)
        if (!(term_score(hits, s) > kLeast)) out.push_back(hits.term.typed);
    return out;
}

// What the words of a query mean in this library; `out` gets the explanation.
Expected<std::vector<TermHits>> read_terms(Database& database, const SampleIndex& index,
                                           const WordReader& words, const SearchQuery& query,
                                           SearchResult& out) {
    std::vector<TermHits> terms;
    for (ReadTerm& term : words.read(query.text, out.ignored)) {
        TermHits hits;
        if (!term.text.empty()) {
            WEFT_TRY(keys, find_text(database, term.text));
            hits.keys = std::move(keys);
        }
        hits.by_material.resize(static_cast<std::size_t>(index.materials.size()));
        for (const auto& [material, weight] : term.materials) {
            if (const int i = index.materials.find(material); i >= 0)
                hits.by_material[static_cast<std::size_t>(i)] = weight;
        }
        for (const std::string& word : term.attributes)
            hits.looks.emplace_back(word);
        if (!term.explanation.empty()) out.understood.push_back(term.explanation);
        hits.term = std::move(term);
        terms.push_back(std::move(hits));
    }
    return terms;
}

// The ids of a collection; empty without a name.
Expected<std::set<std::string>> members_of(Database& database, const std::string& collection) {
    std::set<std::string> members;
    if (collection.empty()) return members;
    WEFT_TRY(rows, database.query("SELECT id FROM collection WHERE name = ?"));
    rows.bind(collection);
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) return members;
        members.insert(rows.text(0));
    }
}

}  // namespace

Expected<SearchResult> search_index(Database& database, const SampleIndex& index,
                                    const WordReader& words, const OpenEmbeddings& open_embeddings,
                                    const SearchQuery& query) {
    const auto start = Clock::now();
    SearchResult out;
    WEFT_TRY(terms, read_terms(database, index, words, query, out));
    WEFT_TRY(members, members_of(database, query.collection));
    const Filter filter(query, index, std::move(members));
    // A query of unknown words only finds nothing instead of everything.
    const bool nothing = terms.empty() && !out.ignored.empty();
    std::vector<float> seen;
    LibraryEmbeddings embeddings;
    if (!terms.empty() || nothing) {
        WEFT_TRY(opened, open_embeddings());
        embeddings = opened;
        if (embeddings.samples)
            seen =
                similarity_to_words(*embeddings.samples, embeddings.model->encode_text(query.text));
        if (!embeddings.fault.empty()) out.understood.push_back(embeddings.fault);
    }
    std::vector<Scored> hits = nothing && seen.empty()
                                   ? std::vector<Scored>()
                                   : score_all(index, filter, terms, true, seen);
    if (hits.empty() && terms.size() > 1) {
        hits = score_all(index, filter, terms, false, {});
        const auto best =
            std::max_element(hits.begin(), hits.end(),
                             [](const Scored& a, const Scored& b) { return a.score < b.score; });
        if (best != hits.end()) out.missing = words_missed(terms, index.samples[best->sample]);
    }
    out.total = static_cast<int>(hits.size());
    if (query.facets) count_facets(hits, index, out);
    sort_hits(hits, index, query.sort, query.descending);
    const auto from = static_cast<std::size_t>(std::clamp(query.offset, 0, out.total));
    const std::size_t to =
        std::min(hits.size(), from + static_cast<std::size_t>(std::max(0, query.limit)));
    for (std::size_t i = from; i < to; ++i) {
        const IndexedSample& s = index.samples[hits[i].sample];
        std::vector<std::string> reasons = reasons_of(terms, index, s);
        if (!seen.empty() && seen[hits[i].sample] > kSeen)
            reasons.push_back("matches according to " + embeddings.model->name());
        out.hits.push_back(
            {s.id, s.name, index.materials.text(s.material), hits[i].score, std::move(reasons)});
    }
    out.seconds = seconds_since(start);
    return out;
}

}  // namespace weft
