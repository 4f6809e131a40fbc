#pragma once
// Licences of textures: their families, and whether a project may use them.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "texture_db/catalogue/query.h"

namespace weft {

/// A texture that a render uses, for its report and its credits.
struct TextureCredit {
    std::string region;
    std::string id;
    std::string name, material;
    std::string author, licence, source;
};

/// "GPL, CC-BY-SA" as a list.
[[nodiscard]] std::vector<std::string> licence_list(std::string_view text);

/// Returns true if `licence` matches an excluded name: equal without regard to case, or of that
/// family ("GPL" covers "GPL-2+" and "GPL-3" but not "LGPL-2.1"; "CC-BY-SA" covers "CC-BY-SA-3.0";
/// "CC-BY" does not cover "CC-BY-SA"; "copyleft", "attribution", "non-commercial" and "unknown" are
/// families too). "A or B" is excluded only if both are; "A and B" if either is.
[[nodiscard]] bool licence_excluded(std::string_view licence,
                                    const std::vector<std::string>& excluded);

/// Rejects misspelt names, because a policy with one would let excluded textures through. Errors:
/// Usage, listing the known licences and families, if `excluded` has a name that is neither one of
/// them nor one of `own`, the licences of the textures here.
[[nodiscard]] Status check_licence_names(const std::vector<std::string>& excluded,
                                         const std::vector<std::string>& own);

/// Errors: Usage for a name that is not known (check_licence_names()); Refused (exit code 7),
/// naming every texture that the project's policy excludes.
[[nodiscard]] Status check_licences(const std::vector<TextureCredit>& textures,
                                    const std::vector<std::string>& excluded);

}  // namespace weft
