#pragma once
#include <string>

#include "app/mattes/matte_shelf.h"
#include "engine/mask/matte_edge.h"

namespace weft {

/// A matte with its edge tools, made in the background for the viewer. While a slider moves, the
/// last edge that was made is shown and those between are left out. For one thread.
class EdgedMatte {
  public:
    /// Returns `matte` with `edge`, or as it was made last; null without edge tools, and until the
    /// first is made. `name`: of the matte on the shelf.
    [[nodiscard]] MattePtr of(const MattePtr& matte, const MatteEdge& edge, const std::string& name,
                              MatteShelf& shelf);

  private:
    MattePtr matte_, shown_;
    std::string pending_;  // name of what is being made
};

}  // namespace weft
