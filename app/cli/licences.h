#pragma once
// The linked libraries and their licences.

#include "app/cli/answer.h"

namespace weft {

/// packaging/libraries.json; each entry also has "version" ("" if unknown) and "inside" (true if
/// this build links it).
extern const char* const kLibrariesJson;
/// The licence of Weft itself, as text.
extern const char* const kWeftLicence;

/// `weft --version --licences`: the version, Weft's licence, and a line for each library in this
/// build.
[[nodiscard]] Answer licences_answer();

}  // namespace weft
