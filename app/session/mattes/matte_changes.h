#pragma once
// Changes of a whole matte that are worked out in the background: fills, selections, shapes.

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "app/mattes/matte_painting.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/document/shutdowns.h"
#include "app/session/mattes/kept_mattes.h"
#include "app/session/mattes/paint_target.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"
#include "engine/core/hash.h"

namespace weft {

/// The matte of a scribble on `before`, in which scribbles may have changed `base`. Pure.
[[nodiscard]] Matte scribbled(const Matte& base, const Matte& before, const Picture& picture,
                              const ScribbleSelect& lines);

/// Scribbles on one frame that go on: each has all lines of the one before it, and begins with what
/// was there before the first.
class ScribbleRun {
  public:
    /// What a scribble on `before` begins with: that itself, unless the one that made it goes on.
    [[nodiscard]] MattePtr base_of(const MattePlace& place, const MattePtr& before,
                                   const ScribbleSelect& lines) const;
    void note(const MattePlace& place, const MattePtr& base, const ScribbleSelect& lines,
              const Matte& made);

  private:
    struct Made {
        Hash128 matte;
        ScribbleSelect lines;
    };
    MattePlace place_;
    MattePtr base_;
    std::vector<Made> made_;  // undo goes back to any of them
};

/// They are made one after another in the order in which they were asked for, each from what the
/// ones before have left. Belongs to one thread and never blocks it, except in finish().
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

    void change(std::function<Matte(const Matte&)> change, const std::string& label,
                bool here_only = false);
    /// An outline of the surface. On a frame that the matte has not reached it begins a keyframe.
    void fill(const FillPolygon& action);
    void clear();
    void flood(const FloodSelect& action);
    void scribble(const ScribbleSelect& action);
    void set_shape(const RotoShape& shape);
    /// A stroke that was drawn before its matte was there.
    void paint(const MattePainting::Waiting& stroke, Counts counts, ChangeLabels labels);
    /// What the files show on the playhead's frame becomes a painted keyframe.
    void paint_instead();

    /// A matte is being worked out, or waits for it.
    [[nodiscard]] bool busy() const { return running_.has_value() || !waiting_.empty(); }
    /// Keeps one that is done, and begins with the next. Call it in every update.
    void take();
    /// What a scribble on `before` begins with.
    [[nodiscard]] MattePtr scribble_base(const MattePlace& place, const MattePtr& before,
                                         const ScribbleSelect& lines) const {
        return run_.base_of(place, before, lines);
    }
    /// Waits until all are made.
    void finish();
    /// Another document was opened: drops all.
    void forget();

    // ---- undo and redo of what is not in the history yet ----
    /// Takes the last one back. Returns false if there is none.
    bool take_back();
    /// Asks again for the one that was taken back. Returns false if the history has to redo one.
    bool again();
    /// What undo and redo would do, where that is one of them.
    void show(SessionView& view) const;
    /// Something else was done, after which nothing can be done again.
    void forget_undone() { undone_.clear(); }

  private:
    /// Of a kind that has all of the one before in it, only the newest waits.
    enum class Replaces : std::uint8_t { kNothing, kScribble, kShape };
    struct Change {
        MattePlace place;
        Counts counts = Counts::kAll;
        ChangeLabels labels;
        // Of the matte before and of what a run of scribbles begins with; never null.
        std::function<ChangedMatte(const MattePtr&, const MattePtr&)> make;
        std::optional<RotoShape> shape = {};  // that the matte is drawn from
        bool from_nothing = false;            // whatever the matte before is
        Replaces replaces = Replaces::kNothing;
        bool outlines = false;  // the surface as a whole: a matte where none has arrived yet
        std::optional<ScribbleSelect> lines = {};  // of a scribble
    };
    struct Running {
        Change change;
        std::future<ChangedMatte> made;
        std::optional<ConfirmedMatte> part;
        MattePtr base;
    };
    /// The state of the history with which the undone ones can be done again.
    struct Undone {
        std::uint64_t made = 0;
        std::size_t redos = 0;
        bool operator==(const Undone&) const = default;
    };
    void add(Change change);
    /// Begins with the next one. Returns false if it has to wait.
    bool start();
    void keep(Running done);
    /// Remembers what a scribble has made, or says why it made nothing.
    void note_scribble(const Running& done, const ChangedMatte& made);
    void note_undone();

    Uses use_;
    ScribbleRun run_;
    std::optional<Running> running_;
    std::deque<Change> waiting_;
    std::vector<Change> undone_;  // the last one taken back is the last
    Undone undone_at_;
};

}  // namespace weft
