#include "app/session/timeline_marks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>

#include "app/mattes/matte_layer.h"
#include "engine/metrics/pops.h"

namespace weft {
namespace {

std::string pop_text(const PopHeight& pop) {
    char text[64];
    const double size = std::abs(pop.departure);
    if (pop.kind == PopKind::kPlace)
        std::snprintf(text, sizeof text, "%s %.1f px", name_of(pop.kind), size);
    else
        std::snprintf(text, sizeof text, "%s %.0f%%", name_of(pop.kind), 100 * size);
    return text;
}

// The reference frame that was chosen for the selected region.
std::optional<int> chosen_reference(const SessionView& view) {
    const auto found = view.preview.references.find(view.selected);
    return found == view.preview.references.end() ? std::nullopt : std::optional(found->second);
}

// Fills in the marks from one source after another; what comes later counts.
class Marking {
  public:
    explicit Marking(SessionView& view) : frames_(view.plate.frames), marks_(view.marks) {
        marks_.assign(frames_.size(), {});
    }

    void plate(const std::vector<PlatePlayer::State>& states) {
        for (std::size_t k = 0; k < std::min(frames_.size(), states.size()); ++k) {
            marks_[k].plate = states[k] == PlatePlayer::State::kCached;
            marks_[k].failed = states[k] == PlatePlayer::State::kFailed;
        }
    }

    void rendered(const std::vector<int>& rendered) {
        for (const int frame : rendered)
            if (FrameMarks* mark = at(frame)) mark->result = true;
    }

    void keys(const Region& region, const MatteSource& layer, std::optional<int> chosen) {
        const auto& references = region.reference_frames;
        for (std::size_t k = 0; k < frames_.size(); ++k) {
            const int frame = frames_[k];
            marks_[k].matte_key =
                layer.keyframes.contains(frame) || layer.shape.keys.contains(frame);
            marks_[k].reference =
                references.empty()
                    ? chosen == frame
                    : std::find(references.begin(), references.end(), frame) != references.end();
        }
        for (const auto& [frame, edge] : layer.confirmed)
            if (FrameMarks* mark = at(frame); mark && !layer.keyframes.contains(frame))
                mark->confirmed = true;
    }

    void confidence(const std::map<int, float>& confidence) {
        for (const auto& [frame, value] : confidence)
            if (FrameMarks* mark = at(frame)) mark->confidence = value;
    }

    void health(const std::map<int, FrameHealth>& health) {
        for (const auto& [frame, found] : health) {
            FrameMarks* mark = at(frame);
            if (!mark) continue;
            mark->drift = found.drift;
            mark->stretch = found.stretch;
            mark->seam = found.seam;
            mark->seam_motion = found.seam_motion;
            mark->flicker = found.flicker;
            mark->flicker_plate = found.flicker_plate;
            mark->flicker_floor = found.flicker_floor;
            mark->chatter = found.chatter;
        }
    }

    void report(const QualityReport& report) {
        if (report.state != QualityReport::State::kDone) return;
        // The first row has no previous frame.
        for (std::size_t r = 1; r < report.rows.size(); ++r) {
            const QualityReport::Row& row = report.rows[r];
            FrameMarks* mark = at(row.frame);
            if (!mark) continue;
            mark->flicker = row.flicker;
            mark->flicker_plate = row.flicker_plate;
            mark->flicker_floor = row.flicker_floor;
        }
    }

    // Judges each step by those of its neighbours that are known.
    void pops(const std::map<int, FrameHealth>& health) {
        std::vector<PopSteps> steps;
        for (const auto& [frame, measured] : health)
            if (measured.steps) {
                steps.push_back(*measured.steps);
                steps.back().frame = frame;
            }
        const std::vector<std::optional<PopHeight>> pops = pop_heights(steps);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            FrameMarks* mark = pops[i] ? at(steps[i].frame) : nullptr;
            if (!mark) continue;
            mark->pop = static_cast<float>(pops[i]->height);
            mark->pop_text = pop_text(*pops[i]);
        }
    }

  private:
    FrameMarks* at(int frame) {
        const auto found = std::lower_bound(frames_.begin(), frames_.end(), frame);
        if (found == frames_.end() || *found != frame) return nullptr;
        return &marks_[static_cast<std::size_t>(found - frames_.begin())];
    }

    const std::vector<int>& frames_;
    std::vector<FrameMarks>& marks_;
};

}  // namespace

void show_marks(const std::vector<PlatePlayer::State>& plate, const PreviewReading& preview,
                SessionView& view) {
    Marking marking(view);
    marking.rendered(preview.rendered);
    marking.plate(plate);
    if (const Region* region = view.selected_region()) {
        marking.keys(*region, layer_source(*region, view.matte_layer), chosen_reference(view));
        marking.confidence(preview.confidence);
        marking.health(preview.health);
    }
    marking.report(view.report);
    marking.pops(preview.health);
}

std::vector<CorrectionHint> suggested_corrections(const SessionView& view) {
    const Region* region = view.selected_region();
    const std::vector<int>& frames = view.plate.frames;
    if (!region || frames.empty()) return {};
    std::vector<int> painted, anchored = region->reference_frames;
    for (const auto& [frame, key] : layer_source(*region, view.matte_layer).keyframes)
        painted.push_back(frame);
    for (const auto& [frame, pins] : region->corrections)
        anchored.push_back(frame);
    if (anchored.empty())
        anchored.push_back(
            chosen_reference(view).value_or(painted.empty() ? frames.front() : painted.front()));
    std::sort(anchored.begin(), anchored.end());
    return where_to_correct(frames, view.marks, painted, anchored);
}

}  // namespace weft
