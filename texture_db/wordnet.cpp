#include "texture_db/wordnet.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "texture_db/material_words.h"

namespace weft {

std::optional<WordNet> WordNet::open(const std::string& folder) {
    WordNet net;
    net.index_ = std::make_unique<std::ifstream>(folder + "/index.noun", std::ios::binary);
    net.data_ = std::make_unique<std::ifstream>(folder + "/data.noun", std::ios::binary);
    if (!*net.index_ || !*net.data_) return std::nullopt;
    return net;
}

// index.noun is sorted by lemma: binary search over byte positions, each moved to the line's start.
std::vector<long> WordNet::senses(const std::string& noun) {
    index_->clear();
    index_->seekg(0, std::ios::end);
    long low = 0, high = static_cast<long>(index_->tellg());
    std::string line;
    const auto line_after = [&](long at) {
        index_->clear();
        index_->seekg(at);
        if (at > 0) std::getline(*index_, line);  // the rest of a line begun before
        return static_cast<bool>(std::getline(*index_, line));
    };
    while (low < high) {
        const long middle = low + (high - low) / 2;
        const bool there = line_after(middle);
        const std::string lemma = there ? line.substr(0, line.find(' ')) : std::string();
        if (there && (line.starts_with(' ') || lemma < noun))
            low = middle + 1;
        else
            high = middle;
    }
    for (const long from : {std::max(0l, low - 1), low}) {
        if (!line_after(from) || line.substr(0, line.find(' ')) != noun) continue;
        // lemma pos synset_cnt p_cnt [ptr_symbol…] sense_cnt tagsense_cnt offset…
        std::istringstream words(line);
        std::string lemma, pos, symbol;
        int synsets = 0, pointers = 0, skip = 0;
        words >> lemma >> pos >> synsets >> pointers;
        for (int i = 0; i < pointers; ++i)
            words >> symbol;
        words >> skip >> skip;
        std::vector<long> out;
        long offset = 0;
        while (words >> offset)
            out.push_back(offset);
        return out;
    }
    return {};
}

WordNet::Synset WordNet::synset(long offset) {
    Synset out;
    data_->clear();
    data_->seekg(offset);
    std::string line;
    if (!std::getline(*data_, line)) return out;
    // offset lex_filenum type word_count(hex) word lex_id … pointer_count symbol offset pos source
    // …
    std::istringstream in(line);
    std::string skip, type, word, count;
    in >> skip >> skip >> type >> count;
    const long words = std::strtol(count.c_str(), nullptr, 16);
    for (long i = 0; i < words && in >> word >> skip; ++i)
        out.words.push_back(lowered(word));
    int pointers = 0;
    in >> pointers;
    for (int i = 0; i < pointers; ++i) {
        std::string symbol, pos, source;
        long target = 0;
        if (!(in >> symbol >> target >> pos >> source)) break;
        if ((symbol == "@" || symbol == "@i") && pos == "n") out.wider.push_back(target);
    }
    return out;
}

std::vector<RelatedWord> WordNet::related(const std::string& noun, int most_steps) {
    constexpr std::size_t kSenses = 4;
    std::vector<RelatedWord> out;
    std::vector<long> level = senses(noun);
    if (level.size() > kSenses) level.resize(kSenses);
    for (int steps = 0; steps <= most_steps && !level.empty(); ++steps) {
        std::vector<long> wider;
        for (const long offset : level) {
            const Synset s = synset(offset);
            for (const std::string& word : s.words) {
                const bool known = std::any_of(
                    out.begin(), out.end(), [&](const RelatedWord& r) { return r.word == word; });
                if (!known && word != noun) out.push_back({word, steps});
            }
            wider.insert(wider.end(), s.wider.begin(), s.wider.end());
        }
        level = std::move(wider);
    }
    return out;
}

}  // namespace weft
