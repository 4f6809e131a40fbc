#pragma once
// The current brush stroke and the matte that it changes.

#include <memory>
#include <optional>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/mattes/matte_shelf.h"
#include "app/mattes/paint.h"
#include "app/project/project.h"

namespace weft {

/// A frame of a region's matte (`layer` 0) or of its holdout `layer` − 1.
struct MattePlace {
    RegionId region = 0;
    int layer = 0, frame = 0;
    bool confirmed = false;  ///< What is confirmed of it there, instead of the matte.
    bool operator==(const MattePlace&) const = default;
};

/// A point of a stroke.
struct PenPoint {
    Vec2 at;
    float pressure = 1;
};

/// A matte that was changed, and where: 255, else 0.
struct ChangedMatte {
    MattePtr matte;
    Matte where;
};
/// A whole stroke on a matte, as MattePainting paints it; null if it changed nothing. Pure.
[[nodiscard]] ChangedMatte paint_stroke(const MattePtr& before, const Brush& brush,
                                        const std::vector<PenPoint>& points);

/// A stroke changes a copy of its matte. The copy is made in the background before the stroke,
/// except for small mattes; points that arrive earlier are queued, also while the matte itself is
/// not known. Belongs to one thread.
class MattePainting {
  public:
    /// Sets the matte for the next stroke; null: an empty one of `size`. Call it in every frame in
    /// which a stroke could begin.
    void prepare(const MattePtr& before, Size size);

    /// Begins a stroke, which waits for begin_on(), and discards an unfinished one.
    void begin(const MattePlace& place, Size size, const Brush& brush);
    /// What the stroke changes; null: an empty matte.
    void begin_on(const MattePtr& before);
    /// A stroke waits for begin_on().
    [[nodiscard]] bool waits() const { return stroke_ && !stroke_->key; }
    [[nodiscard]] const MattePlace& place() const { return stroke_->place; }  ///< While active().
    /// Takes a stroke that still waits; it is no longer active.
    struct Waiting {
        MattePlace place;
        Size size;
        Brush brush;
        std::vector<PenPoint> points;
    };
    [[nodiscard]] std::optional<Waiting> take_waiting();
    /// Adds a point; the first one makes a dot. Does nothing without a stroke.
    void move_to(Vec2 at, float pressure);
    /// Paints queued points once the copy is ready. Call it in every frame.
    void update();
    /// Discards the stroke.
    void cancel() { stroke_.reset(); }

    struct Finished {
        MattePlace place;
        MattePtr matte;
        std::shared_ptr<const Stroke> stroke;  ///< Says where it painted.
    };
    /// Ends the stroke and returns the new matte; nothing if the stroke changed nothing. Waits for
    /// the copy if points are queued.
    [[nodiscard]] std::optional<Finished> end();

    [[nodiscard]] bool active() const { return stroke_.has_value(); }
    /// The matte as painted so far; null if there is no stroke at this place.
    struct Shown {
        ViewU8x1 pixels;            ///< Valid until the next non-const call.
        std::uint64_t version = 0;  ///< Changes with the pixels.
        Recti changed;              ///< Since shown().
    };
    [[nodiscard]] std::optional<Shown> at(const MattePlace& place) const;
    /// Marks the pixels of at() as shown.
    void shown();

  private:
    struct Copy {
        MattePtr before;
        std::shared_ptr<Matte> pixels;
    };
    struct Key {
        MattePtr before;
        Size size;
        int number = 0;  // number of the copy; each copy is painted on once
        bool operator==(const Key&) const = default;
    };
    struct Current {
        Current();  // defined where this class is complete, as its initializers need
        MattePlace place;
        Size size;
        std::optional<Key> key;
        Brush brush;
        MattePtr before;                // null while the copy is made
        std::shared_ptr<Matte> canvas;  // likewise
        std::optional<Stroke> stroke;   // likewise
        std::vector<PenPoint> waiting;
        std::uint64_t version = 0;
        Recti changed;
    };
    [[nodiscard]] static Copy copy_of(const Key& key);
    [[nodiscard]] std::shared_ptr<const Copy> copy(const Key& key);
    void paint(PenPoint point);

    int copies_ = 0;
    std::optional<Current> stroke_;
    LatestWorker<Key, Copy> copier_{{}, WorkerPriority::kWindow};
};

}  // namespace weft
