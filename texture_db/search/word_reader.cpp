#include "texture_db/search/word_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "engine/core/text.h"
#include "texture_db/describe/attributes.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/search/wordnet.h"

namespace weft {
namespace {

constexpr float kSynonym = 0.95f, kKind = 0.65f;

bool is_filler(const std::string& word) {
    static const std::vector<std::string> kFillers{
        "a",    "an",      "and",     "the",      "of",       "with",    "in",
        "for",  "some",    "texture", "textures", "like",     "very",    "material",
        "look", "looking", "or",      "surface",  "coloured", "colored", "on"};
    return std::find(kFillers.begin(), kFillers.end(), word) != kFillers.end();
}

// Phrases of two words with one meaning, and materials that an adjective implies.
struct Phrase {
    const char* words;
    const char* material;
    float weight;
};
constexpr Phrase kPhrases[]{
    {"rusty iron", "rust", 1},
    {"rusty metal", "rust", 1},
    {"rusted metal", "rust", 1},
    {"rusted steel", "rust", 1},
    {"rusty steel", "rust", 1},
    {"roof tiles", "roof", 1},
    {"roof tile", "roof", 1},
    {"tree bark", "bark", 1},
    {"stone wall", "stone", 1},
    {"cobble stone", "cobblestone", 1},
    {"paving stones", "cobblestone", 1},
    {"animal hide", "leather", 1},
    {"animal fur", "fur", 1},
    {"brushed metal", "metal", 1},
    {"oriental rug", "carpet", 1},
    {"wall paper", "wallpaper", 1},
    {"snake skin", "skin", 1},
};
constexpr Phrase kHints[]{
    {"woven", "fabric", 1},       {"woven", "straw", 0.5f},
    {"mossy", "stone", 0.4f},     {"mossy", "foliage", 0.6f},
    {"mossy", "grass", 0.4f},     {"wooden", "wood", 1},
    {"furry", "fur", 1},          {"hairy", "fur", 1},
    {"grassy", "grass", 1},       {"leafy", "foliage", 1},
    {"snowy", "snow", 1},         {"sandy", "sand", 1},
    {"muddy", "dirt", 1},         {"icy", "ice", 1},
    {"icy", "snow", 0.7f},        {"metallic", "metal", 1},
    {"fluffy", "fur", 0.8f},      {"fluffy", "carpet", 0.5f},
    {"cracked", "dirt", 0.4f},    {"cracked", "concrete", 0.4f},
    {"cracked", "plaster", 0.4f}, {"cracked", "leather", 0.3f},
    {"veined", "marble", 0.9f},
};

// Optimal string alignment (Damerau 1964; Levenshtein 1966): substitutions, deletions, insertions
// and swaps of neighbours; stops above `most`.
int edit_distance(std::string_view a, std::string_view b, int most) {
    const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
    if (std::abs(n - m) > most) return most + 1;
    std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        d[i][0] = static_cast<int>(i);
    for (std::size_t j = 0; j <= b.size(); ++j)
        d[0][j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                                d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

void raise(std::map<std::string, float>& materials, const std::string& material, float weight) {
    float& w = materials[material];
    w = std::max(w, weight);
}

}  // namespace

Expected<WordReader> WordReader::load(Database& database, const SampleIndex& index) {
    WordReader reader;
    for (const MaterialEntry& entry : material_table()) {
        const std::string name(entry.name);
        raise(reader.meanings_[name], name, 1);
        for (const std::string& word : split_words(entry.synonyms))
            raise(reader.meanings_[word], name, kSynonym);
        for (const std::string& word : split_words(entry.kinds))
            raise(reader.meanings_[word], name, kKind);
    }
    for (int m = 0; m < index.materials.size(); ++m)  // an artist's own materials
        raise(reader.meanings_[lower_case(index.materials.text(m))], index.materials.text(m), 1);
    for (const Phrase& hint : kHints)
        raise(reader.meanings_[hint.words], hint.material, hint.weight);
    for (const auto& [word, meaning] : reader.meanings_)
        reader.vocabulary_[word] = 1'000'000;  // before any word of a file's name
    WEFT_TRY(words, database.query("SELECT term, doc FROM sample_word"));
    for (;;) {
        WEFT_TRY(more, words.step());
        if (!more) break;
        reader.vocabulary_.emplace(words.text(0), static_cast<int>(words.integer(1)));
    }
    return reader;
}

bool WordReader::understand(const std::string& word, ReadTerm& term) const {
    bool known = false;
    for (const std::string& form : {word, singular(word)}) {
        if (const auto at = meanings_.find(form); at != meanings_.end()) {
            for (const auto& [material, weight] : at->second)
                raise(term.materials, material, weight);
            known = true;
        }
        if (is_attribute_word(form)) {
            term.attributes.push_back(form);
            known = true;
        }
        if (vocabulary_.contains(form)) {
            term.text = form;
            known = true;
        }
        if (known) {
            term.word = form;
            return true;
        }
    }
    return false;
}

std::string WordReader::corrected(const std::string& word) const {
    if (word.size() < 4) return {};
    const int most = word.size() >= 8 ? 2 : word.size() >= 5 ? 2 : 1;
    std::string best;
    int best_distance = most + 1, best_count = -1;
    const auto offer = [&](const std::string& candidate, int count) {
        if (candidate.size() < 3) return;
        int distance = edit_distance(word, candidate, most);
        if (distance > most) return;
        // A wrong first letter is rare, as are two mistakes in a short word.
        if (candidate[0] != word[0]) ++distance;
        if (distance > most) return;
        if (distance < best_distance || (distance == best_distance && count > best_count)) {
            best = candidate;
            best_distance = distance;
            best_count = count;
        }
    };
    for (const auto& [candidate, count] : vocabulary_)
        offer(candidate, count);
    for (const char* attribute :
         {"smooth",   "rough",    "coarse", "striped",   "regular", "random",   "bright",
          "glossy",   "shiny",    "matte",  "colourful", "vivid",   "speckled", "horizontal",
          "vertical", "diagonal", "yellow", "orange",    "purple",  "brown",    "beige",
          "green",    "black",    "white",  "grey",      "dark",    "light"})
        offer(attribute, 500'000);
    return best;
}

std::vector<ReadTerm> WordReader::read(std::string_view text,
                                       std::vector<std::string>& ignored) const {
    std::vector<std::string> words;
    for (std::string& word : split_words(lower_case(text))) {
        std::erase_if(
            word, [](char c) { return c == '"' || c == '\'' || c == '*' || c == '(' || c == ')'; });
        if (!word.empty()) words.push_back(std::move(word));
    }
    std::vector<ReadTerm> terms;
    auto net = WordNet::open();
    bool negate_next = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string word = words[i];
        if (word == "not" || word == "no" || word == "without") {
            negate_next = true;
            continue;
        }
        ReadTerm term;
        term.negated = std::exchange(negate_next, false);
        if (word.size() > 1 && word[0] == '-') {
            term.negated = true;
            word.erase(0, 1);
        }
        if (is_filler(word)) continue;
        term.typed = word;
        if (i + 1 < words.size()) {
            const std::string pair = word + " " + words[i + 1];
            const auto* phrase = std::find_if(std::begin(kPhrases), std::end(kPhrases),
                                              [&](const Phrase& p) { return pair == p.words; });
            if (phrase != std::end(kPhrases)) {
                term.typed = term.word = pair;
                raise(term.materials, phrase->material, phrase->weight);
                term.explanation = pair + " → " + phrase->material;
                terms.push_back(std::move(term));
                ++i;
                continue;
            }
        }
        bool known = understand(word, term);
        if (!known && net) {
            for (const std::string& noun : {word, singular(word)}) {
                for (const RelatedWord& r : net->related(noun)) {
                    const auto at = meanings_.find(r.word);
                    if (at == meanings_.end()) continue;
                    const float weight = 0.85f * std::pow(0.8f, static_cast<float>(r.steps));
                    for (const auto& [material, w] : at->second)
                        if (w >= kSynonym) raise(term.materials, material, weight * w);
                    if (term.explanation.empty() && !term.materials.empty())
                        term.explanation = word + " → " + r.word;
                }
                if (!term.materials.empty()) break;
            }
            term.word = word;
            known = !term.materials.empty();
        }
        if (!known) {
            const std::string better = corrected(word);
            if (!better.empty()) {
                known = understand(better, term);
                term.explanation = word + " → " + better;
            }
        }
        if (!known) {
            ignored.push_back(word);
            continue;
        }
        if (term.explanation.empty() && !term.materials.empty() &&
            !term.materials.contains(term.word)) {
            term.explanation = word + " →";
            for (const auto& [material, weight] : term.materials)
                term.explanation += " " + material;
        }
        terms.push_back(std::move(term));
    }
    return terms;
}

}  // namespace weft
