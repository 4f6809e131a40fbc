// Carries out each action.
#include <algorithm>

#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"

namespace weft {

struct Session::Actor {
    Session& s;

    // ---- the document ----
    void operator()(const DoEdit& a) const { s.edit(a.edit, true); }
    void operator()(const DoEdits& a) const {
        auto changed = apply_edits(s.history_.current(), a.edits);
        if (!changed) return s.notify(NoticeKind::kError, changed.error().text());
        s.commit(std::move(*changed), a.label);
    }
    void operator()(const TryEdit& a) const { s.edit(a.edit, false); }
    void operator()(const TryEdits& a) const {
        auto changed = apply_edits(s.history_.current(), a.edits);
        if (!changed) return s.notify(NoticeKind::kError, changed.error().text());
        s.tried_ = std::move(*changed);
        s.document_changed();
    }
    void operator()(const Undo&) const {
        // A matte that is still worked out is what was done last.
        if (s.abandon_change()) return;
        moved_in_history([&] { return s.history_.undo(); });
    }
    void operator()(const Redo&) const {
        moved_in_history([&] { return s.history_.redo(); });
    }
    void operator()(const GoToHistory& a) const {
        moved_in_history([&] { return s.history_.go_to(a.position); });
    }
    void operator()(const NewProject&) const {
        s.recovery_.clear();
        s.start_document(Project{}, "");
    }
    void operator()(const OpenProject& a) const { s.open_project(a.path); }
    void operator()(const OpenDemo&) const { s.open_demo(); }
    void operator()(const OpenAny& a) const { s.open_any(a.path); }
    void operator()(const Save&) const { s.save(s.path_); }
    void operator()(const SaveAs& a) const { s.save(a.path); }
    void operator()(const AnswerSave& a) const { s.answer_save(a); }
    void operator()(const SaveVersion&) const { s.save_version(); }
    void operator()(const CollectProject& a) const { s.collect(a.folder); }
    void operator()(const CancelCollect& /*a*/) const { s.cancel_collect(); }
    void operator()(const RelinkFiles& a) const { s.relink(a.folder); }
    void operator()(const CloseProject&) const {
        s.end_stroke();
        s.recovery_.clear();
        s.start_document(Project{}, "");
        s.open_ = false;
    }
    void operator()(const Recover& a) const { s.recover(a.accept); }
    void operator()(const TrustFolder& a) const { s.answer_trust(a.trust); }

    // ---- what is selected ----
    void operator()(const SelectRegion& a) const {
        s.end_stroke();
        if (s.selected_ != a.region) s.layer_ = 0;
        s.selected_ = a.region;
        ++s.document_version_;
        s.request_pending_ = true;
    }
    void operator()(const SoloRegion& a) const {
        s.solo_ = a.region;
        s.request_pending_ = true;
    }
    void operator()(const LockRegion& a) const {
        if (a.locked)
            s.locked_.insert(a.region);
        else
            s.locked_.erase(a.region);
    }
    void operator()(const SelectMatteLayer& a) const {
        s.end_stroke();
        const Region* region = s.painted_region();
        s.layer_ = region ? std::clamp(a.layer, first_layer(*region), last_layer(*region)) : 0;
        s.begun_zone_.kind = a.zone_kind;
        s.begun_zone_.value = a.zone_value;
    }

    // ---- frames ----
    void operator()(const GoToFrame& a) const {
        s.playback_.stop();
        s.go_to(a.frame);
    }
    void operator()(const StepFrames& a) const {
        s.playback_.stop();
        if (!s.playback_.step(a.count)) return;
        s.end_stroke();
        s.request_pending_ = true;
    }
    void operator()(const StepKeyframe& a) const { s.step_keyframe(a.direction); }
    void operator()(const Play& a) const {
        s.end_stroke();
        s.playback_.play(a.direction);
        s.request_pending_ = true;
    }
    void operator()(const SetPlayMode& a) const { s.playback_.set_mode(a.mode); }
    void operator()(const ShowOnionSkin& a) const { s.onion_skin_ = a.shown; }
    void operator()(const MarkRange& a) const {
        s.playback_.mark(a.in, a.out);
        s.request_pending_ = true;
    }

    // ---- mattes ----
    void operator()(const BeginStroke& a) const { s.begin_stroke(a); }
    void operator()(const ContinueStroke& a) const { s.painting_.move_to(a.at, a.pressure); }
    void operator()(const EndStroke&) const { s.end_stroke(); }
    void operator()(const FillPolygon& a) const {
        s.change_matte([a](const Matte& m) { return fill_polygon(m, a.points, a.subtract); },
                       a.subtract ? "Subtract shape" : "Add shape", a.here_only);
    }
    void operator()(const FloodSelect& a) const {
        const PicturePtr picture = s.view_.plate_picture;
        if (!picture) return;
        s.change_matte(
            [a, picture](const Matte& m) {
                return flood_select(m, shrink(*picture, 1 << 20), a.at, a.tolerance, a.subtract);
            },
            a.subtract ? "Subtract colour" : "Add colour", a.here_only);
    }
    void operator()(const ScribbleSelect& a) const { s.scribble(a); }
    void operator()(const SetShape& a) const { s.set_shape(a.shape); }
    void operator()(const FollowShape& a) const { s.follow_shape(a); }
    void operator()(const DetachShape&) const { s.detach_shape(); }
    void operator()(const GrowMatte& a) const {
        s.change_matte([a](const Matte& m) { return grow_matte(m, a.px); },
                       a.px > 0 ? "Grow matte" : "Shrink matte");
    }
    void operator()(const FeatherMatte& a) const {
        s.change_matte([a](const Matte& m) { return feather_matte(m, a.px); }, "Feather matte");
    }
    void operator()(const ClearMatte&) const {
        s.change_matte([](const Matte& m) { return Matte(m.size()); }, "Clear matte");
    }
    void operator()(const KeyMatteHere&) const {
        s.change_matte([](const Matte& m) { return m; }, "Add matte keyframe");
    }
    void operator()(const CopyKeyframe& a) const { s.copy_keyframe(a.from, a.to); }
    void operator()(const PaintInstead&) const { s.paint_instead(); }
    void operator()(const ExportMattes& a) const { s.export_mattes(a.pattern); }
    void operator()(const FreezeMattes& a) const { s.freeze_mattes(a.frozen); }
    void operator()(const PickCryptomatte& a) const { s.pick_cryptomatte(a); }

    // ---- textures ----
    void operator()(const ScaleByLine& a) const { s.scale_by_line(a); }
    void operator()(const ApplyTexture& a) const {
        s.apply_texture(a.path, a.region ? a.region : s.selected_);
    }
    void operator()(const ApplyTextures& a) const { s.apply_textures(a); }
    void operator()(const UseLargerOriginal& a) const {
        s.use_larger_original(a.region ? a.region : s.selected_);
    }

    // ---- what is shown ----
    void operator()(const ShowStrip& a) const { s.strip_.show(a.kind, a.textures, a.over_time); }
    void operator()(const ChooseFromStrip& a) const { s.choose_from_strip(a.card); }
    void operator()(const PauseAnalysis& a) const {
        a.paused ? s.preview_.pause() : s.preview_.resume();
    }
    void operator()(const ShowLayer& a) const { show(s.shown_layer_, a.layer); }
    void operator()(const ShowOverlay& a) const { show(s.overlay_, a.overlay); }
    void operator()(const ShowStages& a) const { show(s.stages_, a.shown); }
    void operator()(const SetPreviewQuality& a) const { show(s.preview_quality_, a.quality); }
    void operator()(const ChooseScreen& a) const { s.choose_screen(a.name, true); }

    // ---- jobs ----
    void operator()(const SubmitJob& a) const { s.submit(a); }
    void operator()(const CommandJob& a) const { s.jobs_.command(a); }
    void operator()(const MeasureResult& a) const { s.measure(a.pattern); }

  private:
    template <class Move>
    void moved_in_history(Move&& move) const {
        s.end_stroke();
        (void)s.abandon_change();
        s.tried_.reset();
        if (!move()) return;
        s.document_changed();
        s.recovery_.note({s.resolved(), s.path_, s.on_disk_});
    }
    template <class T>
    void show(T& shown, const T& wanted) const {
        shown = wanted;
        s.request_pending_ = true;
    }
};

void Session::act(const Action& action) {
    std::visit(Actor{*this}, action);
}

}  // namespace weft
