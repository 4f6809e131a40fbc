#pragma once
// Removes samples of packages that do not look like their material.

#include <functional>
#include <string>

#include "engine/core/error.h"

namespace weft {

class Database;
struct SampleIndex;

/// Returns true if a person has inspected the images of a package.
using PackageCheck = std::function<bool(const std::string& package)>;

/// TextureLibrary::remove_outliers() without the training before and after. The caller holds the
/// library's lock.
[[nodiscard]] Expected<int> remove_outliers(Database& database, const SampleIndex& index,
                                            const PackageCheck& was_inspected);

}  // namespace weft
