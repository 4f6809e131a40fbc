#include "app/mattes/matte_painting.h"

#include <thread>
#include <utility>

#include "app/base/picture.h"

namespace weft {
namespace {

// Copying it takes less time than waking a thread.
bool is_small(Size size) {
    return std::int64_t{size.width} * size.height <= 1 << 18;
}

}  // namespace

ChangedMatte paint_stroke(const MattePtr& before, const Brush& brush,
                          const std::vector<PenPoint>& points) {
    auto matte = std::make_shared<Matte>(*before);
    Stroke stroke(before, brush);
    for (const PenPoint& point : points)
        (void)stroke.move_to(point.at, point.pressure, *matte);
    if (stroke.touched().empty()) return {};
    return {std::move(matte), stroke.covered()};
}

MattePainting::Current::Current() = default;

MattePainting::Copy MattePainting::copy_of(const Key& key) {
    Copy out;
    out.before = key.before ? key.before : std::make_shared<const Matte>(key.size);
    out.pixels = std::make_shared<Matte>(*out.before);
    return out;
}

// Returns null while the copy is being made.
std::shared_ptr<const MattePainting::Copy> MattePainting::copy(const Key& key) {
    if (is_small(key.size)) return std::make_shared<const Copy>(copy_of(key));
    return copier_.ask(key, [key](const CancelToken&) { return std::optional(copy_of(key)); });
}

void MattePainting::prepare(const MattePtr& before, Size size) {
    if (stroke_ || is_small(size)) return;
    const Key key{before, size, copies_};
    (void)copier_.ask(key, [key](const CancelToken&) { return std::optional(copy_of(key)); });
}

void MattePainting::begin(const MattePlace& place, Size size, const Brush& brush) {
    stroke_.emplace();
    stroke_->place = place;
    stroke_->size = size;
    stroke_->brush = brush;
}

void MattePainting::begin_on(const MattePtr& before) {
    stroke_->key = {before, stroke_->size, copies_++};
    stroke_->version = next_picture_id();
    stroke_->changed = rect_of(stroke_->size);
    update();
}

std::optional<MattePainting::Waiting> MattePainting::take_waiting() {
    if (!waits()) return std::nullopt;
    Current waiting = std::move(*std::exchange(stroke_, std::nullopt));
    return Waiting{waiting.place, waiting.size, waiting.brush, std::move(waiting.waiting)};
}

void MattePainting::update() {
    if (!stroke_ || !stroke_->key || stroke_->stroke) return;
    const auto made = copy(*stroke_->key);
    if (!made) return;
    stroke_->before = made->before;
    stroke_->canvas = made->pixels;
    stroke_->stroke.emplace(made->before, stroke_->brush);
    for (const PenPoint& point : std::exchange(stroke_->waiting, {}))
        paint(point);
}

void MattePainting::paint(PenPoint point) {
    stroke_->changed = stroke_->changed.united(
        stroke_->stroke->move_to(point.at, point.pressure, *stroke_->canvas));
    stroke_->version = next_picture_id();
}

void MattePainting::move_to(Vec2 at, float pressure) {
    if (!stroke_) return;
    update();
    if (stroke_->stroke)
        paint({at, pressure});
    else
        stroke_->waiting.push_back({at, pressure});
}

std::optional<MattePainting::Finished> MattePainting::end() {
    if (!stroke_ || !stroke_->key) return std::nullopt;
    while (!stroke_->stroke && !stroke_->waiting.empty()) {
        update();
        std::this_thread::yield();
    }
    Current done = std::move(*std::exchange(stroke_, std::nullopt));
    if (!done.stroke || done.stroke->touched().empty()) return std::nullopt;
    return Finished{done.place, done.canvas,
                    std::make_shared<const Stroke>(std::move(*done.stroke))};
}

std::optional<MattePainting::Shown> MattePainting::at(const MattePlace& place) const {
    if (!stroke_ || !stroke_->key || !(stroke_->place == place)) return std::nullopt;
    const Matte* const pixels =
        stroke_->canvas ? stroke_->canvas.get() : stroke_->key->before.get();
    Shown out;
    if (pixels) out.pixels = pixels->view();
    out.version = stroke_->version;
    out.changed = stroke_->changed;
    return out;
}

void MattePainting::shown() {
    if (stroke_) stroke_->changed = {};
}

}  // namespace weft
