#pragma once
// Internal: manual corrections for pictures whose names mislead.

#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// The lines of pictures_looked_at.tsv.
[[nodiscard]] std::string_view pictures_looked_at();

/// The material of a package's picture, "-" if it shows none. Empty if its name was found right, or
/// nobody has inspected it. Thread-safe.
[[nodiscard]] std::optional<std::string> corrected_material(const std::string& package,
                                                            const std::string& source);
/// Returns true if all pictures of a package were inspected.
[[nodiscard]] bool was_inspected(const std::string& package);

}  // namespace weft
