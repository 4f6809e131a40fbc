#pragma once
// Whether pictures that are given as mattes are coverage: ids, colours and video levels are not.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// What one picture shows where it is read as coverage.
struct MatteLook {
    float least = 1, most = 0;  ///< Of all pixels, white = 1.
    double coloured = 0;        ///< Share of the pixels whose R, G and B differ clearly.
};

/// Of a picture that is read by its luma; `alpha`, if not empty, is read instead.
[[nodiscard]] MatteLook look_at_matte(ViewF3 rgb, const ImageF1& alpha);

/// Judges the mattes of one source, for which neither a channel nor a value is named.
class MatteJudge {
  public:
    void add(const MatteLook& look);
    /// A picture with a full and an empty part and without colours was seen: no more are needed.
    [[nodiscard]] bool is_satisfied() const { return satisfied_; }
    /// `name`: of the matte, for messages. Errors: Unreadable for colours, of which none is known
    /// to be the coverage, and for values that hardly cover anything, which are ids.
    [[nodiscard]] Status check(const std::string& name) const;
    /// That no pixel is empty or none is full, in a sentence; empty: nothing to say.
    [[nodiscard]] std::string warning(const std::string& name) const;

  private:
    bool satisfied_ = false;
    MatteLook all_;
};

/// Judges up to 24 of the files, spread over all, until one satisfies. `channel`: "A", or empty or
/// "Y" for luma. Files that cannot be read are left out. Returns the warning. Errors: as
/// MatteJudge::check().
[[nodiscard]] Expected<std::string> judge_mattes(const std::string& name,
                                                 const std::vector<std::string>& paths,
                                                 const std::string& channel);

}  // namespace weft
