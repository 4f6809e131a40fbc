#pragma once
// Internal: the vocabulary of materials and the handling of words and names.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A material of the vocabulary, with the words that mean it.
struct MaterialEntry {
    std::string_view name;      ///< "stone"
    std::string_view synonyms;  ///< Space separated: "rock boulder granite"
    std::string_view kinds;     ///< Wider words: "mineral natural hard"
};
[[nodiscard]] const std::vector<MaterialEntry>& material_table();

/// Splits at white space and commas.
[[nodiscard]] std::vector<std::string> split_words(std::string_view text);
[[nodiscard]] std::string joined_words(const std::vector<std::string>& words);
/// "wall_bricks005_d.jpg" → "wall bricks 005"; "BrickOldRound" → "brick old round".
[[nodiscard]] std::string words_of_name(std::string_view name);
/// "bricks" → "brick", "grasses" → "grass", "leaves" → "leaf".
[[nodiscard]] std::string singular(const std::string& word);

/// The material that the words of a path name (the file name before folders, later words before
/// earlier ones), or empty.
[[nodiscard]] std::string material_of_path(std::string_view path);

}  // namespace weft
