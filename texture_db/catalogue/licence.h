#pragma once
// Licences of textures: which family one belongs to, and whether a project may use it.

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

/// Whether `licence` falls under an excluded name: equal without regard to case, or of that family
/// ("GPL" covers "GPL-2+" and "GPL-3" but not "LGPL-2.1"; "CC-BY-SA" covers "CC-BY-SA-3.0";
/// "CC-BY" does not cover "CC-BY-SA"; "copyleft", "attribution", "non-commercial" and "unknown" are
/// families too). A licence "A or B" is excluded only when both are; "A and B" when either is.
[[nodiscard]] bool licence_excluded(std::string_view licence,
                                    const std::vector<std::string>& excluded);

/// A slip in a policy would let through what it was to stop. Errors: Usage, listing the licences
/// and families that are known, when `excluded` has a name that is neither one of them nor one of
/// `own`, the licences that textures here are under.
[[nodiscard]] Status check_licence_names(const std::vector<std::string>& excluded,
                                         const std::vector<std::string>& own);

/// Errors: Usage for a name that is not known (check_licence_names()); Refused (exit code 7),
/// naming every texture that the project's policy excludes.
[[nodiscard]] Status check_licences(const std::vector<TextureCredit>& textures,
                                    const std::vector<std::string>& excluded);

}  // namespace weft
