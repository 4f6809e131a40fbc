#include "app/session/viewer/shown_plate.h"

#include <utility>

namespace weft {
namespace {

constexpr double kUsualFps = 24;

const char* depth_name(PixelDepth depth) {
    switch (depth) {
        case PixelDepth::kU8:
            return "8 bit";
        case PixelDepth::kU16:
            return "16 bit";
        case PixelDepth::kHalf:
            return "16-bit float";
        case PixelDepth::kFloat:
            return "32-bit float";
    }
    return "";
}

}  // namespace

void ShownPlate::open(const Plate& plate) {
    if (!opener_.open(plate)) return;
    reading_ = {};
    // In the background, because a worker may be decoding a large frame.
    if (player_) shutdowns_.end(std::exchange(player_, nullptr));
    reader_.reset();
    drawn_.reset();
    playback_.close();
    view_ = {};
    // The new plate may open at once, and its first frame be decoded later.
    picture_.reset();
}

bool ShownPlate::take() {
    const auto taken = opener_.take();
    if (!taken) return false;
    const Expected<OpenedPlate>& opened = *taken;
    if (!opened) {
        view_.state = PlateView::State::kFailed;
        view_.error = opened.error().text();
        return false;
    }
    reader_ = opened->reader;
    drawn_ =
        std::make_shared<const DrawnMattes>(reader_->size(), reader_->frames().front(), aspect());
    player_ = std::make_shared<PlatePlayer>(reader_, opened->srgb, opened->linear, budget_bytes_);
    view_.space = opened->space;
    playback_.open(reader_->frames());
    return true;
}

void ShownPlate::advance(double now_s) {
    if (!player_) return;
    playback_.advance(now_s, view_.fps > 0 ? view_.fps : kUsualFps, reading_.states);
    (void)player_->try_want(playback_.upcoming());  // if it fails, retried in the next frame
}

void ShownPlate::update(const Plate& plate) {
    view_.path = plate.path;
    view_.budget_bytes = budget_bytes_;
    if (opener_.busy()) {
        view_.state = PlateView::State::kOpening;
        view_.counted = opener_.counted();
    }
    if (plate.path.empty()) view_.state = PlateView::State::kNone;
    if (!reader_) {
        picture_.reset();
        return;
    }
    describe(plate);
    read();
}

void ShownPlate::describe(const Plate& plate) {
    if (view_.state != PlateView::State::kOpen) {
        view_.state = PlateView::State::kOpen;
        view_.error.clear();
        view_.size = reader_->size();
        view_.pixel_aspect = reader_->pixel_aspect();
        view_.frames = reader_->frames();
        view_.depth = depth_name(reader_->depth());
    }
    view_.fps = plate.fps > 0 ? plate.fps : reader_->fps() > 0 ? reader_->fps() : kUsualFps;
}

// The previous picture is kept while a frame is decoded, to avoid a black flash.
void ShownPlate::read() {
    if (!player_->try_read(playback_.frame(), reading_) && reading_.frame != playback_.frame()) {
        reading_.picture.reset();
        reading_.error.clear();
    }
    view_.cached_bytes = reading_.bytes;
    if (reading_.picture) picture_ = reading_.picture;
    if (!reading_.error.empty()) picture_.reset();
}

void ShownPlate::show(SessionView& view) const {
    view.plate = view_;
    view.plate_picture = picture_;
}

void ShownPlate::show_frame(SessionView& view) const {
    view.frame = playback_.frame();
    view.playing = playback_.direction();
    view.play_fps = playback_.shown_fps();
    view.play_mode = playback_.mode();
    view.mark_in = playback_.mark_in();
    view.mark_out = playback_.mark_out();
    view.frame_error = reader_ ? reading_.error : std::string();
    view.frame_file = reader_ ? reader_->path_of(playback_.frame()) : std::string();
}

}  // namespace weft
