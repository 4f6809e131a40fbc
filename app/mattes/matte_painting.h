#pragma once
// The stroke under the pen, and the matte that it changes.

#include <memory>
#include <optional>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/mattes/matte_shelf.h"
#include "app/mattes/paint.h"
#include "app/project/project.h"

namespace weft {

/// A region's matte (`layer` 0) or its holdout `layer` − 1, on a frame.
struct MattePlace {
    RegionId region = 0;
    int layer = 0, frame = 0;
    bool operator==(const MattePlace&) const = default;
};

/// A stroke changes a copy of the matte that it begins on. A whole matte is never copied in the
/// calling thread, unless it is small: the copy is made in the background, ahead of the stroke.
/// Where the pen is faster, its points wait for the copy and are painted then. One thread.
class MattePainting {
  public:
    /// The matte that a stroke would begin on; null: an empty one of `size`. Called in every frame
    /// in which a stroke could begin.
    void prepare(const MattePtr& before, Size size);

    /// Ends the stroke before, whose result is lost.
    void begin(const MattePlace& place, const MattePtr& before, Size size, const Brush& brush);
    /// The first call makes a dot. Without a stroke nothing happens.
    void move_to(Vec2 at, float pressure);
    /// Paints the points that waited, once the copy is there. To be called in every frame.
    void update();
    /// Forgets the stroke.
    void cancel() { stroke_.reset(); }

    struct Finished {
        MattePlace place;
        MattePtr matte;
    };
    /// The new matte; nothing where the stroke changed nothing. Waits for the copy where points
    /// still wait for it.
    [[nodiscard]] std::optional<Finished> end();

    [[nodiscard]] bool active() const { return stroke_.has_value(); }
    /// The matte as painted so far, where there is a stroke at this place.
    struct Shown {
        ViewU8x1 pixels;            ///< Until the next call of a member that is not const.
        std::uint64_t version = 0;  ///< Another number: other pixels.
        Recti changed;              ///< Since shown().
    };
    [[nodiscard]] std::optional<Shown> at(const MattePlace& place) const;
    /// What at() gave is on the screen.
    void shown();

  private:
    struct Copy {
        MattePtr before;
        std::shared_ptr<Matte> pixels;
    };
    struct Key {
        MattePtr before;
        Size size;
        int number = 0;  // of the copy: each is painted on once
        bool operator==(const Key&) const = default;
    };
    struct PenPoint {
        Vec2 at;
        float pressure = 1;
    };
    struct Current {
        MattePlace place;
        Key key;
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
