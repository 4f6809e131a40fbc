#pragma once
// Internal: the noun files of WordNet 3 (Fellbaum 1998), read in place, word by word.

#include <optional>
#include <string>
#include <vector>

#include "engine/core/input_file.h"

namespace weft {

/// A word near another one: `steps` synsets away upwards (0: a synonym).
struct RelatedWord {
    std::string word;
    int steps = 0;
};

/// Not thread-safe.
class WordNet {
  public:
    /// Empty if the database (Debian: wordnet-base) is not installed.
    [[nodiscard]] static std::optional<WordNet> open(
        const std::string& folder = "/usr/share/wordnet");
    /// Synonyms and hypernyms of a noun's first senses, nearest first; empty for an unknown word.
    [[nodiscard]] std::vector<RelatedWord> related(const std::string& noun, int most_steps = 3);

  private:
    WordNet(InputFile index, InputFile data) : index_(std::move(index)), data_(std::move(data)) {}
    struct Synset {
        std::vector<std::string> words;
        std::vector<long> wider;
    };
    [[nodiscard]] std::vector<long> senses(const std::string& noun) const;
    [[nodiscard]] Synset synset(long offset) const;
    InputFile index_, data_;
};

}  // namespace weft
