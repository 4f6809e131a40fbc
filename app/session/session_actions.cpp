// Routes each action to the part that carries it out.
#include <algorithm>
#include <iterator>
#include <set>

#include "app/base/next_region.h"
#include "app/mattes/matte_layer.h"
#include "app/mattes/paint.h"
#include "app/project/key_rows.h"
#include "app/session/session_parts.h"

namespace weft {

struct Session::Parts::Actor {
    Parts& s;

    // ---- the document ----
    void operator()(const DoEdit& a) const {
        if (!s.document_.edit(a.edit)) return;
        if (const auto* added = std::get_if<AddRegion>(&a.edit)) select_added(*added);
    }
    void operator()(const DoEdits& a) const { s.document_.commit(a.edits, a.label); }
    void operator()(const TryEdit& a) const { s.document_.try_edit(a.edit); }
    void operator()(const TryEdits& a) const { s.document_.try_edits(a.edits); }
    void operator()(const Undo&) const {
        s.end_stroke();
        // A matte that is still worked out is what was done last.
        if (!s.changes_.take_back()) s.document_.undo();
    }
    void operator()(const Redo&) const {
        s.end_stroke();
        if (!s.changes_.again()) s.document_.redo();
    }
    void operator()(const GoToHistory& a) const {
        s.end_stroke();
        while (s.changes_.take_back()) {
        }
        s.document_.go_to(a.position);
    }
    void operator()(const NewProject&) const { s.opening_.open_new(); }
    void operator()(const OpenProject& a) const { s.opening_.open_project(a.path); }
    void operator()(const OpenDemo&) const { s.opening_.open_demo(); }
    void operator()(const OpenAny& a) const { s.opening_.open_any(a.path); }
    void operator()(const Save&) const { s.saving_.save(s.document_.path()); }
    void operator()(const SaveAs& a) const { s.saving_.save(a.path); }
    void operator()(const AnswerSave& a) const { s.saving_.answer(a); }
    void operator()(const SaveVersion&) const { s.saving_.save_version(); }
    void operator()(const CollectProject& a) const { s.files_.collect(a.folder); }
    void operator()(const CancelCollect&) const { s.files_.cancel_collect(); }
    void operator()(const RelinkFiles& a) const { s.files_.relink(a.folder); }
    void operator()(const CloseProject&) const {
        s.end_stroke();
        s.opening_.close();
    }
    void operator()(const Recover& a) const { s.opening_.recover(a.accept); }
    void operator()(const TrustFolder& a) const { s.trust_.answer(a.trust); }

    // ---- what is selected ----
    void operator()(const SelectRegion& a) const {
        s.end_stroke();
        if (s.selection_.region != a.region) s.selection_.layer = 0;
        s.selection_.region = a.region;
        s.document_.touch();
        s.preview_desk_.ask();
    }
    void operator()(const SoloRegion& a) const {
        s.selection_.solo = a.region;
        s.preview_desk_.ask();
    }
    void operator()(const LockRegion& a) const {
        if (a.locked)
            s.selection_.locked.insert(a.region);
        else
            s.selection_.locked.erase(a.region);
    }
    void operator()(const SelectMatteLayer& a) const {
        s.end_stroke();
        const Region* region = s.selection_.of(s.document_.project());
        s.selection_.layer =
            region ? std::clamp(a.layer, first_layer(*region), last_layer(*region)) : 0;
        s.selection_.begun_zone.kind = a.zone_kind;
        s.selection_.begun_zone.value = a.zone_value;
    }

    // ---- frames ----
    void operator()(const GoToFrame& a) const {
        s.playback_.stop();
        go_to(a.frame);
    }
    void operator()(const StepFrames& a) const {
        s.playback_.stop();
        if (s.playback_.step(a.count)) moved();
    }
    void operator()(const StepKeyframe& a) const {
        const Region* region = s.selection_.of(s.document_.project());
        if (!region) return;
        std::set<int> stops;
        for (const KeyRow& row : key_rows(*region))
            for (const KeyMark& key : row.keys)
                stops.insert(key.frame);
        if (a.direction > 0) {
            const auto next = stops.upper_bound(s.playback_.frame());
            if (next != stops.end()) go_to(*next);
        } else {
            const auto next = stops.lower_bound(s.playback_.frame());
            if (next != stops.begin()) go_to(*std::prev(next));
        }
    }
    void operator()(const Play& a) const {
        s.end_stroke();
        s.playback_.play(a.direction);
        s.preview_desk_.ask();
    }
    void operator()(const SetPlayMode& a) const { s.playback_.set_mode(a.mode); }
    void operator()(const ShowOnionSkin& a) const { s.shown_mattes_.show_onion_skin(a.shown); }
    void operator()(const MarkRange& a) const {
        s.playback_.mark(a.in, a.out);
        s.preview_desk_.ask();
    }

    // ---- mattes ----
    void operator()(const BeginStroke& a) const {
        if (a.kind != StrokeKind::kConfirm && !a.brush.subtract) begin_region();
        s.strokes_.begin(a);
    }
    void operator()(const ContinueStroke& a) const { s.strokes_.go_on(a); }
    void operator()(const EndStroke&) const { s.end_stroke(); }
    void operator()(const FillPolygon& a) const {
        if (!a.subtract) begin_region();
        s.changes_.fill(a);
    }
    void operator()(const FloodSelect& a) const {
        if (!a.subtract) begin_region();
        s.changes_.flood(a);
    }
    void operator()(const ScribbleSelect& a) const {
        if (!a.keep.empty()) begin_region();
        s.changes_.scribble(a);
        s.trial_.settle();
    }
    void operator()(const TryScribble& a) const { s.trial_.ask(a.lines); }
    void operator()(const SetShape& a) const {
        begin_region();
        s.changes_.set_shape(a.shape);
    }
    void operator()(const FollowShape& a) const { s.shapes_.follow(a); }
    void operator()(const DetachShape&) const { s.shapes_.detach(); }
    void operator()(const GrowMatte& a) const {
        s.changes_.change([a](const Matte& m) { return grow_matte(m, a.px); },
                          a.px > 0 ? "Grow matte" : "Shrink matte");
    }
    void operator()(const FeatherMatte& a) const {
        s.changes_.change([a](const Matte& m) { return feather_matte(m, a.px); }, "Feather matte");
    }
    void operator()(const ClearMatte&) const { s.changes_.clear(); }
    void operator()(const KeyMatteHere&) const {
        s.changes_.change([](const Matte& m) { return m; }, "Add matte keyframe");
    }
    void operator()(const CopyKeyframe& a) const { s.kept_mattes_.copy_keyframe(a.from, a.to); }
    void operator()(const PaintInstead&) const { s.changes_.paint_instead(); }
    void operator()(const ExportMattes& a) const { s.matte_export_.export_to(a.pattern); }
    void operator()(const FreezeMattes& a) const {
        a.frozen ? s.matte_export_.freeze() : s.matte_export_.thaw();
    }
    void operator()(const PickCryptomatte& a) const { s.cryptomatte_.pick(a); }

    // ---- textures ----
    void operator()(const ScaleByLine& a) const {
        s.textures_.scale_by_line(s.plate_.aspect().unsqueezed(a.to - a.from), a.count,
                                  s.selection_.region);
    }
    void operator()(const ApplyTexture& a) const {
        s.textures_.apply(a.path, a.region ? a.region : s.selection_.region);
    }
    void operator()(const ApplyTextures& a) const { s.textures_.apply_all(a); }
    void operator()(const UseLargerOriginal& a) const {
        s.textures_.use_larger_original(a.region ? a.region : s.selection_.region);
    }

    // ---- what is shown ----
    void operator()(const ShowStrip& a) const { s.strip_.choose_kind(a); }
    void operator()(const ChooseFromStrip& a) const {
        if (const auto choice = s.strip_.choice(a.card)) s.act(*choice);
    }
    void operator()(const PauseAnalysis& a) const {
        a.paused ? s.preview_.pause() : s.preview_.resume();
    }
    void operator()(const ShowLayer& a) const { s.preview_desk_.show_layer(a.layer); }
    void operator()(const ShowOverlay& a) const { s.preview_desk_.show_overlay(a.overlay); }
    void operator()(const ShowStages& a) const { s.preview_desk_.show_stages(a.shown); }
    void operator()(const SetPreviewQuality& a) const { s.preview_desk_.set_quality(a.quality); }
    void operator()(const ChooseScreen& a) const { s.screens_.choose(a.name); }

    // ---- jobs ----
    void operator()(const SubmitJob& a) const {
        for (const Leaf<Region>& region : s.document_.project().regions)
            if (const std::string why = s.form_check_.problem(*region);
                region->enabled && !why.empty())
                return s.notices_.add(NoticeKind::kError, "Region '" + region->name + "': " + why);
        s.renders_.submit(a);
    }
    void operator()(const CommandJob& a) const { s.renders_.command(a); }
    void operator()(const MeasureResult& a) const { s.measurement_.start(a.pattern); }
    void operator()(const PaintFlat& a) const { s.flat_painting_.paint(a); }
    void operator()(const StopPaintFlat&) const { s.flat_painting_.stop(); }

  private:
    // What is painted on a shot without regions is the matte of its first one.
    void begin_region() const {
        const Project& project = s.document_.project();
        if (!s.document_.is_open() || !s.plate_.reader() || !project.regions.empty()) return;
        const AddRegion first{next_region(project), {}};
        if (s.document_.edit(first)) select_added(first);
    }
    void select_added(const AddRegion& added) const {
        const auto& regions = s.document_.project().regions;
        if (regions.empty()) return;
        const bool inside = added.index && *added.index < static_cast<int>(regions.size());
        s.selection_.region =
            inside ? regions[static_cast<std::size_t>(*added.index)]->id : regions.back()->id;
        s.selection_.layer = 0;
    }
    void go_to(int frame) const {
        if (s.playback_.go_to(frame)) moved();
    }
    // A stroke that was begun on the frame before is kept there.
    void moved() const {
        s.end_stroke();
        s.preview_desk_.ask();
    }
};

void Session::Parts::act(const Action& action) {
    std::visit(Actor{*this}, action);
    show_answers();
}

void Session::Parts::act_now(const std::vector<Action>& actions) {
    for (const Action& action : actions)
        act(action);
    show_mattes();
    painting_.shown();
}

}  // namespace weft
