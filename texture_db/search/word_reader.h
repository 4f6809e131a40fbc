#pragma once
// Internal: reads what an artist types. A word may be a material, a synonym of one, a hypernym of
// several, an attribute or colour, or any word of the catalogue; misspellings are forgiven.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/index.h"

namespace weft {

/// How one word (or two that belong together: "rusty iron", "dark green") is understood.
struct ReadTerm {
    std::string typed, word;                 ///< As typed; as corrected.
    std::map<std::string, float> materials;  ///< That it means, with weight 0 … 1.
    std::vector<std::string> attributes;     ///< That must be seen in the pixels.
    std::string text;                        ///< Word to find in names and tags, or empty.
    bool negated = false;                    ///< "not mossy", "-mossy".
    std::string explanation;  ///< "timbr → timber → wood"; empty: nothing to explain.
};

class WordReader {
  public:
    /// Takes the words of the catalogue. WordNet is read where it is installed.
    [[nodiscard]] static Expected<WordReader> load(Database& database, const SampleIndex& index);
    /// The terms of a query; what cannot be understood at all goes to `ignored`.
    [[nodiscard]] std::vector<ReadTerm> read(std::string_view text,
                                             std::vector<std::string>& ignored) const;

  private:
    [[nodiscard]] bool understand(const std::string& word, ReadTerm& term) const;
    [[nodiscard]] std::string corrected(const std::string& word) const;

    std::map<std::string, std::map<std::string, float>> meanings_;  // word → materials
    std::map<std::string, int> vocabulary_;                         // word → how often
};

}  // namespace weft
