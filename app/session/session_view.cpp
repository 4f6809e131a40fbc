// Updates the view that the panels show.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/session/session_measuring.h"
#include "engine/media/frame_reader.h"
#include "engine/metrics/pops.h"

namespace weft {
namespace {

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

std::string pop_text(const PopHeight& pop) {
    char text[64];
    const double size = std::abs(pop.departure);
    if (pop.kind == PopKind::kPlace)
        std::snprintf(text, sizeof text, "%s %.1f px", name_of(pop.kind), size);
    else
        std::snprintf(text, sizeof text, "%s %.0f%%", name_of(pop.kind), 100 * size);
    return text;
}

template <class Frames>
void mark_rendered(const std::vector<int>& frames, const Frames& rendered,
                   std::vector<FrameMarks>& marks) {
    for (const int frame : rendered)
        if (const auto at = std::lower_bound(frames.begin(), frames.end(), frame);
            at != frames.end())
            marks[static_cast<std::size_t>(at - frames.begin())].result = true;
}

// Judges each step by those of its neighbours that are known.
void mark_pops(const std::vector<int>& frames, const std::map<int, FrameHealth>& health,
               std::vector<FrameMarks>& marks) {
    std::vector<PopSteps> steps;
    for (const auto& [frame, measured] : health)
        if (measured.steps) {
            steps.push_back(*measured.steps);
            steps.back().frame = frame;
        }
    const std::vector<std::optional<PopHeight>> pops = pop_heights(steps);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto at = std::lower_bound(frames.begin(), frames.end(), steps[i].frame);
        if (!pops[i] || at == frames.end() || *at != steps[i].frame) continue;
        FrameMarks& mark = marks[static_cast<std::size_t>(at - frames.begin())];
        mark.pop = static_cast<float>(pops[i]->height);
        mark.pop_text = pop_text(*pops[i]);
    }
}

}  // namespace

void Session::show_document() {
    view_.now_s = now_s_;
    view_.open = open_;
    view_.document = document_id_;
    view_.selected = selected_;
    view_.solo = solo_;
    view_.locked.assign(locked_.begin(), locked_.end());
    view_.mark_in = playback_.mark_in();
    view_.mark_out = playback_.mark_out();
    view_.recent = settings_->recent;
    view_.collecting.reset();
    if (collecting_)
        view_.collecting =
            CollectView{collecting_->folder, collecting_->done(), collecting_->total()};
    view_.recovery.reset();
    if (!recoverable_.empty())
        view_.recovery = {recoverable_[0].project_path, recoverable_[0].when};
    view_.modified = history_.modified();
    if (shown_version_ == document_version_) return;
    shown_version_ = document_version_;
    view_.project = document();
    view_.path = path_;
    view_.title = !path_.empty()             ? std::filesystem::path(path_).stem().string()
                  : !document().name.empty() ? document().name
                                             : "Untitled";
    view_.history = history_.labels();
    view_.history_position = history_.position();
    view_.undo_label = history_.undo_label();
    view_.redo_label = history_.redo_label();
    view_.issues = validate(document());
    view_.unready.clear();
    for (const Leaf<Region>& region : document().regions) {
        if (region->matte->empty()) {
            view_.unready[region->id] = "Paint its matte on the frame";
        } else if (region->texture.sample.empty() && region->texture.plane.empty()) {
            view_.unready[region->id] = "Choose a texture for it";
        }
    }
}

void Session::show_plate() {
    PlateView& plate = view_.plate;
    plate.path = resolve_path(project_dir(path_), document().plate.path);
    plate.budget_bytes = options_.plate_budget_bytes;
    if (opener_.busy()) plate.state = PlateView::State::kOpening;
    if (document().plate.path.empty()) plate.state = PlateView::State::kNone;
    view_.frame = playback_.frame();
    view_.playing = playback_.direction();
    view_.play_fps = playback_.shown_fps();
    view_.play_mode = playback_.mode();
    view_.frame_error.clear();
    view_.frame_file.clear();
    if (!reader_) {
        view_.plate_picture.reset();
        return;
    }
    if (plate.state != PlateView::State::kOpen) {
        plate.state = PlateView::State::kOpen;
        plate.error.clear();
        plate.size = reader_->size();
        plate.pixel_aspect = reader_->pixel_aspect();
        plate.frames = reader_->frames();
        plate.depth = depth_name(reader_->depth());
    }
    plate.fps = document().plate.fps > 0 ? document().plate.fps
                : reader_->fps() > 0     ? reader_->fps()
                                         : 24;
    // Keep the previous picture while a frame is decoded, to avoid a black flash.
    if (!player_->try_read(playback_.frame(), plate_reading_) &&
        plate_reading_.frame != playback_.frame()) {
        plate_reading_.picture.reset();
        plate_reading_.error.clear();
    }
    plate.cached_bytes = plate_reading_.bytes;
    if (plate_reading_.picture) view_.plate_picture = plate_reading_.picture;
    view_.frame_error = plate_reading_.error;
    if (!view_.frame_error.empty()) view_.plate_picture.reset();
    view_.frame_file = reader_->path_of(playback_.frame());
}

void Session::show_mattes() {
    view_.mattes.clear();
    view_.painting = painting_.active();
    view_.matte_busy = changing_.has_value();
    view_.matte_layer = 0;
    view_.holdouts.clear();
    view_.zones.clear();
    if (!open_) return;
    for (const Leaf<Region>& region : document().regions)
        view_.mattes.push_back(matte_of(*region, 0, playback_.frame()));
    const Region* region = painted_region();
    // The layer may have been removed by undo.
    if (!region || layer_ < first_layer(*region) || layer_ > last_layer(*region)) layer_ = 0;
    view_.matte_layer = layer_;
    view_.begun_zone = begun_zone_;
    if (region) {
        for (int layer = 1; layer < last_layer(*region) || layer <= layer_; ++layer)
            view_.holdouts.push_back(matte_of(*region, layer, playback_.frame()));
        for (int layer = -1; layer > first_layer(*region) || layer >= layer_; --layer)
            view_.zones.push_back(matte_of(*region, layer, playback_.frame()));
    }
    show_onion_skin();
    show_confirmed();
    prepare_stroke();
}

// The nearest keyframes on both sides; each has a place of its own among the shown mattes, so that
// it is uploaded once.
void Session::show_onion_skin() {
    view_.onion.clear();
    view_.onion_skin = onion_skin_;
    const Region* region = painted_region();
    if (!onion_skin_ || !region || playback_.direction() != 0) return;
    const auto& keys = layer_source(*region, layer_).keyframes;
    constexpr int kBefore = 1, kAfter = 2;
    if (const auto next = keys.lower_bound(playback_.frame()); next != keys.begin())
        view_.onion.push_back(matte_of(*region, layer_, std::prev(next)->first, kBefore));
    if (const auto next = keys.upper_bound(playback_.frame()); next != keys.end())
        view_.onion.push_back(matte_of(*region, layer_, next->first, kAfter));
}

void Session::act_now(const std::vector<Action>& actions) {
    for (const Action& action : actions)
        act(action);
    show_mattes();
    painting_.shown();
}

void Session::show_result() {
    if (!preview_.try_read(playback_.frame(), selected_, layer_, preview_reading_) &&
        view_.frame != read_frame_)
        preview_reading_.frame = {};
    read_frame_ = view_.frame;
    view_.preview = preview_reading_.view;
    view_.analysis_paused = preview_reading_.paused;
    view_.preview_quality = preview_quality_;
    view_.overlay = overlay_;
    view_.stages_shown = stages_;
    view_.layer = shown_layer_;
    view_.stages = preview_reading_.frame;
    const PicturePtr& final = view_.stages.stages[static_cast<std::size_t>(Stage::kFinal)];
    view_.result_current = final && !view_.stages.provisional;
    if (final) {
        last_result_ = final;
        last_result_frame_ = playback_.frame();
    }
    // An older result of this frame stays until the new one is ready, and is marked as outdated.
    view_.result_picture =
        view_.result_wanted && last_result_frame_ == playback_.frame() ? last_result_ : nullptr;
    view_.overlay_picture = preview_reading_.overlay;
    if (view_.overlay_picture && view_.overlay_picture->frame != playback_.frame())
        view_.overlay_picture.reset();
    if (measuring_) {
        const std::lock_guard lock(measuring_->mutex);
        view_.report = measuring_->report;
    }
}

void Session::show_marks() {
    const auto& frames = view_.plate.frames;
    view_.marks.assign(reader_ ? frames.size() : 0, {});
    view_.to_correct.clear();
    if (!reader_) return;
    const Region* region = region_by_id(document(), selected_);
    const auto chosen = view_.preview.references.find(selected_);
    const std::map<int, float>& confidence = preview_reading_.confidence;
    const std::map<int, FrameHealth>& health = preview_reading_.health;
    mark_rendered(frames, preview_reading_.rendered, view_.marks);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        FrameMarks& mark = view_.marks[k];
        if (k < plate_reading_.states.size()) {
            mark.plate = plate_reading_.states[k] == PlatePlayer::State::kCached;
            mark.failed = plate_reading_.states[k] == PlatePlayer::State::kFailed;
        }
        if (!region) continue;
        const MatteSource& layer = layer_source(*region, layer_);
        mark.matte_key =
            layer.keyframes.contains(frames[k]) || layer.shape.keys.contains(frames[k]);
        mark.reference =
            region->reference_frames.empty()
                ? chosen != view_.preview.references.end() && chosen->second == frames[k]
                : std::find(region->reference_frames.begin(), region->reference_frames.end(),
                            frames[k]) != region->reference_frames.end();
        if (const auto found = confidence.find(frames[k]); found != confidence.end())
            mark.confidence = found->second;
        if (const auto found = health.find(frames[k]); found != health.end()) {
            mark.drift = found->second.drift;
            mark.stretch = found->second.stretch;
            mark.seam = found->second.seam;
            mark.seam_motion = found->second.seam_motion;
            mark.flicker = found->second.flicker;
            mark.flicker_plate = found->second.flicker_plate;
            mark.flicker_floor = found->second.flicker_floor;
            mark.chatter = found->second.chatter;
        }
    }
    if (view_.report.state == QualityReport::State::kDone) {
        // The first row has no previous frame.
        for (std::size_t r = 1; r < view_.report.rows.size(); ++r) {
            const QualityReport::Row& row = view_.report.rows[r];
            const auto at = std::lower_bound(frames.begin(), frames.end(), row.frame);
            if (at == frames.end() || *at != row.frame) continue;
            FrameMarks& mark = view_.marks[static_cast<std::size_t>(at - frames.begin())];
            mark.flicker = row.flicker;
            mark.flicker_plate = row.flicker_plate;
            mark.flicker_floor = row.flicker_floor;
        }
    }
    mark_pops(frames, health, view_.marks);
    if (!region) return;
    std::vector<int> painted, anchored = region->reference_frames;
    for (const auto& [frame, key] : layer_source(*region, layer_).keyframes)
        painted.push_back(frame);
    for (const auto& [frame, pins] : region->corrections)
        anchored.push_back(frame);
    if (anchored.empty()) {
        anchored.push_back(chosen != view_.preview.references.end() ? chosen->second
                           : painted.empty()                        ? frames.front()
                                                                    : painted.front());
    }
    std::sort(anchored.begin(), anchored.end());
    view_.to_correct = where_to_correct(frames, view_.marks, painted, anchored);
}

}  // namespace weft
