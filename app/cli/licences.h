#pragma once
// The libraries in this program, and their licences.

#include "app/cli/answer.h"

namespace weft {

/// packaging/libraries.json, each entry with "version" ("" if unknown) and "inside": whether this
/// build has it.
extern const char* const kLibrariesJson;
/// The licence of Weft itself, in words.
extern const char* const kWeftLicence;

/// `weft --version --licences`: the version, Weft's licence, and a line for each library in this
/// build.
[[nodiscard]] Answer licences_answer();

}  // namespace weft
