#pragma once
// The mattes that the view shows: painted, propagated, drawn and from files.

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "app/mattes/edged_matte.h"
#include "app/mattes/matte_painting.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/session/document/document.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/propagated_mattes.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it: mattes are read in the background.
class ShownMattes {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        MatteShelf& shelf;
        PropagatedMattes& propagated;
        const MattePainting& painting;  ///< The stroke that is shown in place of a matte.
    };
    explicit ShownMattes(Uses uses) : use_(uses) {}

    /// A matte on the playhead's frame.
    [[nodiscard]] RegionMatteView matte_of(const Region& region, int layer) {
        return matte_of(region, layer, use_.playback.frame(), Place::kFrame);
    }
    /// What is painted on a frame begins with this.
    struct Base {
        MattePtr matte;          ///< Null: empty, unless it is being read.
        bool reading = false;    ///< It will be there soon.
        bool reached = true;     ///< False: it has not been propagated to the frame yet.
        std::string depends_on;  ///< As PropagatedMatte has it.
    };
    [[nodiscard]] Base base_of(const Region& region, int layer, int frame);
    /// What is confirmed of a propagated matte. Null: nothing is, or it is still being read.
    [[nodiscard]] MattePtr confirmed_area(const Region& region, int layer, int frame);
    /// Why that cannot be read; empty: it can, or it is still being read.
    [[nodiscard]] std::string confirmed_error(const Region& region, int layer, int frame) const;

    void show_onion_skin(bool shown) { onion_skin_ = shown; }
    /// Another document was opened.
    void forget();
    /// All mattes, onion skin and confirmed parts.
    void show(SessionView& view);

  private:
    /// Several mattes of a layer are shown at the same time, each in its own place.
    enum class Place : std::uint8_t { kFrame, kBefore, kAfter, kConfirmed };
    struct Shown {
        EdgedMatte edged;
        MattePtr matte;  // as the view shows it
        std::uint64_t version = 0;
    };
    /// How a matte is got from the shelf.
    struct Wanted {
        RegionMatteView::Kind kind = RegionMatteView::Kind::kNone;
        std::string name;
        MatteShelf::Reader read;
    };
    [[nodiscard]] RegionMatteView matte_of(const Region& region, int layer, int frame, Place place);
    [[nodiscard]] Expected<Wanted> wanted(const Region& region, int layer, int frame);
    [[nodiscard]] Wanted drawn(const MatteSource& source, int frame) const;
    [[nodiscard]] Expected<Wanted> from_files(const std::string& files, const MatteSelect& select,
                                              int frame) const;
    [[nodiscard]] bool is_propagated(const MatteSource& source, int frame) const;
    [[nodiscard]] std::string find(const Region& region, int layer, RegionMatteView& out);
    [[nodiscard]] std::string find_propagated(const Region& region, int layer,
                                              RegionMatteView& out);
    void show_onion(const Region* region, SessionView& view);
    void show_confirmed(const Region* region, SessionView& view);

    Uses use_;
    bool onion_skin_ = false;
    std::map<std::tuple<RegionId, int, Place>, Shown> shown_;  // by region, layer and place
};

/// The shape over time of a matte, with the track's whole path. `folder`: of the project.
[[nodiscard]] KeyedShape absolute_shape(const MatteSource& source, const std::string& folder);

}  // namespace weft
