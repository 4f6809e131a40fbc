#pragma once
// Numbers over time, as the document writes them: "1:1 24:0.3", "1:0,0 24:10,5".

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace weft {

using KeyedValues = std::map<int, std::vector<double>>;  ///< By frame.

/// Empty for an empty text, and for one that is none.
[[nodiscard]] KeyedValues read_keyed(const std::string& text, std::size_t count);
[[nodiscard]] std::string keyed_text(const KeyedValues& keys);
/// In a straight line between two keys, the nearest one's outside of them. `keys` has one or more.
[[nodiscard]] std::vector<double> keyed_at(const KeyedValues& keys, int frame);

}  // namespace weft
