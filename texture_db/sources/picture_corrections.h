#pragma once
// Internal: what people saw in pictures whose names mislead.

#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// The lines of pictures_looked_at.tsv.
[[nodiscard]] std::string_view pictures_looked_at();

/// The material that a picture of a package shows, "-" when it shows none; nothing where its name
/// was found right, or nobody has looked. Thread-safe.
[[nodiscard]] std::optional<std::string> corrected_material(const std::string& package,
                                                            const std::string& source);
/// Whether a package's pictures were all looked at.
[[nodiscard]] bool was_inspected(const std::string& package);

}  // namespace weft
