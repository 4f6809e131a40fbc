#include "texture_db/search/wordnet.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "engine/core/text.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

// The line that begins at `offset`, without its end; false at the end of the file.
bool line_at(const InputFile& file, long offset, std::string& line) {
    constexpr std::size_t kLongest = std::size_t{1} << 16;
    line.clear();
    char block[512];
    while (line.size() < kLongest) {
        const std::uint64_t at = static_cast<std::uint64_t>(offset) + line.size();
        const std::size_t got = file.read_at(at, block, sizeof block).value_or(0);
        if (got == 0) return !line.empty();
        const std::string_view text(block, got);
        const std::size_t end = text.find('\n');
        line.append(text.substr(0, end));
        if (end != std::string_view::npos) return true;
    }
    return true;
}

}  // namespace

std::optional<WordNet> WordNet::open(const std::string& folder) {
    auto index = InputFile::open(folder + "/index.noun");
    auto data = InputFile::open(folder + "/data.noun");
    if (!index || !data) return std::nullopt;
    return WordNet(std::move(*index), std::move(*data));
}

// index.noun is sorted by lemma: binary search over byte positions, each moved to the line's start.
std::vector<long> WordNet::senses(const std::string& noun) const {
    long low = 0, high = static_cast<long>(index_.bytes());
    std::string line;
    const auto line_after = [&](long at) {
        if (at > 0) {  // the rest of a line begun before
            if (!line_at(index_, at, line)) return false;
            at += static_cast<long>(line.size()) + 1;
        }
        return line_at(index_, at, line);
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

WordNet::Synset WordNet::synset(long offset) const {
    Synset out;
    std::string line;
    if (offset < 0 || !line_at(data_, offset, line)) return out;
    // offset lex_filenum type word_count(hex) word lex_id … pointer_count symbol offset pos source
    // …
    std::istringstream in(line);
    std::string skip, type, word, count;
    in >> skip >> skip >> type >> count;
    const long words = std::strtol(count.c_str(), nullptr, 16);
    for (long i = 0; i < words && in >> word >> skip; ++i)
        out.words.push_back(lower_case(word));
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
