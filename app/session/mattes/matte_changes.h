#pragma once
// Changes of a whole matte that are worked out in the background: fills, selections, shapes.

#include <functional>
#include <future>
#include <optional>
#include <string>

#include "app/mattes/matte_painting.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/document/shutdowns.h"
#include "app/session/mattes/kept_mattes.h"
#include "app/session/mattes/paint_target.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// One at a time. Belongs to one thread and never blocks it.
class MatteChanges {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const PaintTarget& target;
        KeptMattes& kept;
        Notices& notices;
        Shutdowns& shutdowns;
        std::function<void()> end_stroke;
    };
    explicit MatteChanges(Uses uses) : use_(std::move(uses)) {}

    void change(std::function<Matte(const Matte&)> change, std::string label,
                bool here_only = false);
    void flood(const FloodSelect& action);
    void scribble(const ScribbleSelect& action);
    void set_shape(const RotoShape& shape);
    /// What the files show on the playhead's frame becomes a painted keyframe.
    void paint_instead();

    /// A matte is being worked out.
    [[nodiscard]] bool busy() const { return changing_.has_value(); }
    /// Drops it. Returns true if there was one.
    bool abandon();
    /// Keeps one that is done. Call it in every update.
    void take();

  private:
    struct Changing {
        std::future<Matte> matte;
        MattePlace place;
        std::string label;
        std::optional<RotoShape> shape;      // shape that the matte is drawn from
        std::optional<ConfirmedMatte> part;  // before the change, if it counts in part only
    };
    /// Returns true if a matte is being changed; then `again` follows, if the artist is still
    /// there.
    bool follows(std::function<void()> again);
    [[nodiscard]] bool may_change() const;

    Uses use_;
    std::optional<Changing> changing_;
    /// A scribble or shape that came while the one before was worked out; the newest counts.
    std::function<void()> after_;
};

}  // namespace weft
