#pragma once
// What a stroke or a tool changes: the matte of the selected layer on the playhead's frame.

#include <optional>

#include "app/mattes/matte_painting.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/shown_mattes.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// A matte on a frame to which it is propagated, and what is confirmed of it.
struct ConfirmedMatte {
    MattePtr matte;          ///< Of the whole frame, as it is shown.
    MattePtr area;           ///< What is confirmed of it.
    std::string depends_on;  ///< Of `matte`, as PropagatedMatte has it.
};

/// How a change counts.
enum class Counts : std::uint8_t {
    kAll,     ///< The matte becomes the keyframe of its frame.
    kPart,    ///< Where it was made, on a frame to which the matte is propagated.
    kAsRight  ///< It changes what is confirmed there instead of the matte.
};

/// What a change begins with.
struct PaintBase {
    enum class State : std::uint8_t {
        kReady,
        kReading,    ///< It will be there soon.
        kUnreached,  ///< The matte has not been propagated to the frame yet.
        kNone        ///< There is nothing to change, or it cannot be read.
    };
    State state = State::kNone;
    MattePtr before;                     ///< Is changed; null: an empty matte.
    std::optional<ConfirmedMatte> part;  ///< Unless all of it counts.
    std::string error = {};              ///< Why it cannot be read.
};

/// Says with a notice why something cannot be changed.
class PaintTarget {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        ShownMattes& shown;
        Notices& notices;
    };
    explicit PaintTarget(Uses uses) : use_(uses) {}

    /// Null: no region is selected.
    [[nodiscard]] const Region* region() const {
        return use_.selection.of(use_.document.project());
    }
    /// The layer; with a region only.
    [[nodiscard]] const MatteSource& source() const;
    [[nodiscard]] MattePlace place() const {
        return {use_.selection.region, use_.selection.layer, use_.playback.frame()};
    }
    [[nodiscard]] Size size() const { return use_.plate.reader()->size(); }
    [[nodiscard]] PixelAspect aspect() const { return use_.plate.aspect(); }
    /// It stands still, and can be painted as far as is known without a word.
    [[nodiscard]] bool is_ready() const;
    [[nodiscard]] bool may_paint() const;
    /// As it is shown; its `keep` is null while it is read.
    [[nodiscard]] RegionMatteView shown() const {
        return use_.shown.matte_of(*region(), use_.selection.layer);
    }
    /// What a change at this place begins with: what is seen there, with all changes before it.
    [[nodiscard]] PaintBase base(const MattePlace& place, Counts counts) const;
    /// Says why a change with this base was not made.
    void refuse(const PaintBase& base, const MattePlace& place) const;
    /// On a keyframe or a frozen frame all of the matte counts.
    [[nodiscard]] static bool counts_as_whole(const MatteSource& source, int frame);

  private:
    [[nodiscard]] PaintBase part_base(const Region& of, const MattePlace& place,
                                      Counts counts) const;
    Uses use_;
};

}  // namespace weft
