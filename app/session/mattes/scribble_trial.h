#pragma once
// What a scribble would give, while it is drawn.

#include <cstdint>
#include <functional>
#include <future>
#include <optional>

#include "app/mattes/matte_painting.h"
#include "app/session/action.h"
#include "app/session/document/shutdowns.h"
#include "app/session/mattes/matte_changes.h"
#include "app/session/mattes/paint_target.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it: the newest lines are tried when those before are
/// done.
class ScribbleTrial {
  public:
    /// The references must stay.
    struct Uses {
        const PaintTarget& target;
        const ShownPlate& plate;
        const MatteChanges& changes;
        Shutdowns& shutdowns;
    };
    explicit ScribbleTrial(Uses uses) : use_(uses) {}

    /// Without lines it ends.
    void ask(const ScribbleSelect& lines);
    /// The lines are drawn: shows what was tried until the change is made.
    void settle();
    void end();
    /// Call it in every update.
    void take();
    [[nodiscard]] bool busy() const { return running_.has_value(); }

    /// Shows what was tried in place of the matte.
    void show(SessionView& view) const;

  private:
    struct Running {
        MattePlace place;
        std::future<Matte> made;
    };
    void start();

    Uses use_;
    std::optional<ScribbleSelect> wanted_;
    std::optional<Running> running_;
    MattePlace place_;
    MattePtr made_;
    std::uint64_t version_ = 0;
    bool settling_ = false;
};

}  // namespace weft
