#pragma once
// Internal: interprets an artist's query. A word may be a material, a synonym of one, a hypernym of
// several, an attribute or colour, or any word of the catalogue; spelling mistakes are corrected.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/index.h"

namespace weft {

/// The meaning of one word (or of two that belong together: "rusty iron", "dark green").
struct ReadTerm {
    std::string typed, word;                 ///< As typed; as corrected.
    std::map<std::string, float> materials;  ///< Materials that it means, with weights 0 … 1.
    std::vector<std::string> attributes;     ///< Attributes that the pixels must have.
    std::string text;                        ///< Word to find in names and tags, or empty.
    bool negated = false;                    ///< "not mossy", "-mossy".
    std::string explanation;  ///< "timbr → timber → wood"; empty: nothing to explain.
};

class WordReader {
  public:
    /// Collects the words of the catalogue. Reads WordNet if it is installed. Errors: those of the
    /// file.
    [[nodiscard]] static Expected<WordReader> load(Database& database, const SampleIndex& index);
    /// The terms of a query; words without any meaning go to `ignored`.
    [[nodiscard]] std::vector<ReadTerm> read(std::string_view text,
                                             std::vector<std::string>& ignored) const;

  private:
    [[nodiscard]] bool understand(const std::string& word, ReadTerm& term) const;
    [[nodiscard]] std::string corrected(const std::string& word) const;

    std::map<std::string, std::map<std::string, float>> meanings_;  // word → materials
    std::map<std::string, int> vocabulary_;                         // word → how often
};

}  // namespace weft
