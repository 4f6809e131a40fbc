#pragma once
// How an artist names Cryptomatte objects in one line of text.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Stands for any text in a selected name; no object's name can hold it.
inline constexpr char kAnyText = '\0';

/// The names in `text`, which commas separate. Spaces around a name do not count. A name in double
/// quotes is taken as it stands; elsewhere `*` becomes kAnyText, and a backslash before a comma, a
/// quote, a star or a backslash takes that character as it stands.
[[nodiscard]] std::vector<std::string> split_crypto_names(std::string_view text);

/// `name` such that split_crypto_names() gives it back.
[[nodiscard]] std::string escaped_crypto_name(std::string_view name);

}  // namespace weft
