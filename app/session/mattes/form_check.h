#pragma once
// Whether the forms that were drawn can be used, before anything is analysed.

#include <map>
#include <string>
#include <vector>

#include "app/session/document/document.h"
#include "app/session/mattes/shown_mattes.h"
#include "app/session/session_view.h"
#include "app/session/viewer/preview_desk.h"

namespace weft {

/// Belongs to one thread. A check takes some milliseconds and is made once for each change.
class FormCheck {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const ShownPlate& plate;
        const PreviewDesk& preview;  ///< Has chosen reference frames.
        ShownMattes& shown;
    };
    explicit FormCheck(Uses uses) : use_(uses) {}

    /// Why a render would refuse the region's form; empty: it would not, or that is not known, as
    /// the matte on the reference frame is not.
    [[nodiscard]] std::string problem(const Region& region);
    /// The regions that have such a problem.
    void show(SessionView& view);

  private:
    struct Checked {
        std::vector<FormGuide> guides;
        std::optional<double> fov_deg;
        PixelAspect aspect;
        MattePtr matte;
        std::string problem;
    };
    [[nodiscard]] MattePtr matte_on_reference(const Region& region);

    Uses use_;
    std::map<RegionId, Checked> checked_;
};

}  // namespace weft
