#include "engine/pipeline/provisional.h"

#include <algorithm>
#include <set>

#include "engine/composite/grain.h"
#include "engine/lighting/shading.h"
#include "engine/pipeline/focus_pass.h"
#include "engine/pipeline/form_pass.h"
#include "engine/pipeline/gloss_pass.h"
#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/surface_job.h"
#include "engine/pipeline/surface_pass.h"
#include "engine/pipeline/sweep.h"
#include "engine/pipeline/zone_kind.h"
#include "engine/temporal/correction.h"

namespace weft {
namespace {

bool is_track(AnalysisKind kind) {
    return kind == AnalysisKind::kTrackBefore || kind == AnalysisKind::kTrackAfter;
}

// Seams between tracks need the tracks of all their frames, which a region that is still
// being analysed does not have.
class OverlayStore final : public AnalysisStore {
  public:
    OverlayStore(const AnalysisStore& known, std::set<int> unfinished)
        : known_(known), unfinished_(std::move(unfinished)) {}

    [[nodiscard]] bool has(const AnalysisKey& key) const override {
        return beneath_.has(key) || (!hidden(key) && known_.has(key));
    }
    [[nodiscard]] Status put(const AnalysisKey&, const Bytes&) override {
        return fail(ErrorCode::kRenderFailed, "A provisional picture keeps no analysis.");
    }
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override {
        if (hidden(key)) return beneath_.get(key);
        if (auto bytes = known_.get(key)) return bytes;
        return beneath_.get(key);
    }
    void put_beneath(const AnalysisKey& key, const Bytes& bytes) { (void)beneath_.put(key, bytes); }
    // A matte that is to hold whatever the analysis finds meanwhile.
    void leave_out(int region) { left_out_.insert(region); }

  private:
    [[nodiscard]] bool hidden(const AnalysisKey& key) const {
        if (left_out_.contains(key.region)) return true;
        return is_track(key.kind) && unfinished_.contains(key.region);
    }

    const AnalysisStore& known_;
    std::set<int> unfinished_, left_out_;
    MemoryAnalysisStore beneath_;
};

// The regions whose analysis for this frame is not complete.
std::set<int> unfinished_regions(const ShotPlan& plan, const AnalysisStore& known, int frame) {
    std::set<int> out;
    ShotPlan one = plan;
    one.frames = {frame};
    for (const SurfaceJob& job : surface_jobs(one, known))
        out.insert(job.region);
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k)
        if (lacks_form(plan, known, k) || lacks_still_surface(plan, known, k)) out.insert(k);
    return out;
}

class FrameFiller {
  public:
    FrameFiller(const ShotSource& source, ShotPlan& plan, OverlayStore& store, int frame,
                const std::vector<EarlierAnalysis>& earlier, const CancelToken& cancel)
        : source_(source),
          plan_(plan),
          store_(store),
          frame_(frame),
          earlier_(earlier),
          cancel_(cancel) {}

    // Returns false if the region cannot be shown on the frame.
    Expected<bool> fill(int index) {
        if (cancel_.cancelled()) return cancelled(cancel_);
        const RegionPlan& region = region_at(index);
        const int reference = region.reference_frames.front();
        for (const int at : {frame_, reference, region.light_reference()}) {
            WEFT_TRY(there, fill_mattes(index, at));
            if (!there) return false;
        }
        fill_zones(index);
        WEFT_TRY(placed, fill_texture(index, reference));
        if (!placed) return false;
        WEFT_CHECK_OK(fill_light(index, frame_));
        WEFT_CHECK_OK(fill_light(index, region.light_reference()));
        WEFT_CHECK_OK(fill_form(index, reference));
        fill_camera(index, reference);
        WEFT_CHECK_OK(fill_focus(index));
        return true;
    }

    // render_frame() skips a region with an empty matte.
    void leave_out(int index) {
        RegionPlan& region = region_at(index);
        region.matte_keys = {frame_};
        region.matte_confirmed.clear();
        region.has_holdout = false;
        region.painted_holdouts.clear();
        region.zones.clear();
        store_.leave_out(index);
        store_.put_beneath({index, frame_, AnalysisKind::kMatte},
                           encode(StoredMatte{Matte(source_.size()), 1.0f}));
    }

  private:
    RegionPlan& region_at(int index) { return plan_.regions[static_cast<std::size_t>(index)]; }

    // Puts what an earlier analysis has under this key, if one does whose region is `alike`.
    template <class Alike>
    bool fill_from_earlier(const AnalysisKey& key, Alike&& alike) {
        for (const EarlierAnalysis& earlier : earlier_) {
            const int index = earlier.region_of[static_cast<std::size_t>(key.region)];
            if (index < 0 || !alike(earlier.plan->regions[static_cast<std::size_t>(index)]))
                continue;
            const auto bytes = earlier.store->get({index, key.frame, key.kind, key.layer});
            if (!bytes) continue;
            store_.put_beneath(key, *bytes);
            return true;
        }
        return false;
    }
    bool fill_from_earlier(const AnalysisKey& key) {
        return fill_from_earlier(key, [](const RegionPlan&) { return true; });
    }

    // The same, of where the texture lies, with the pins of now.
    bool fill_track_from_earlier(const AnalysisKey& key) {
        const RegionPlan& now = region_at(key.region);
        std::vector<SurfacePin> before;
        const auto alike = [&](const RegionPlan& then) {
            const auto pins = then.corrections.find(key.frame);
            before = pins == then.corrections.end() ? std::vector<SurfacePin>() : pins->second;
            return then.temporal == now.temporal && motion_of(then) == motion_of(now) &&
                   then.reference_frames.front() == now.reference_frames.front();
        };
        if (!fill_from_earlier(key, alike)) return false;
        const auto pins = now.corrections.find(key.frame);
        const std::vector<SurfacePin> after =
            pins == now.corrections.end() ? std::vector<SurfacePin>() : pins->second;
        if (before == after) return true;
        const auto bytes = store_.get(key);
        const auto field = bytes ? decode_lattice(*bytes) : tl::unexpected(bytes.error());
        if (!field) return false;
        store_.put_beneath(key, encode(recorrected(*field, before, after)));
        return true;
    }

    // The matte of one layer, if it is known on the frame: propagated already, or painted there, or
    // as it was when a part of it was confirmed there.
    template <class ReadKey>
    Expected<bool> fill_painted(const AnalysisKey& key, const std::vector<int>& painted_on,
                                const std::vector<int>& confirmed_on, ReadKey&& read) {
        if (store_.has(key)) return true;
        if (std::binary_search(confirmed_on.begin(), confirmed_on.end(), key.frame)) {
            WEFT_TRY(part, source_.confirmed_part(key.region, key.layer, key.frame));
            store_.put_beneath(key, encode(StoredMatte{std::move(part.matte), 1.0f}));
            return true;
        }
        if (!std::binary_search(painted_on.begin(), painted_on.end(), key.frame)) {
            const std::size_t holdouts = region_at(key.region).painted_holdouts.size();
            return fill_from_earlier(key, [&](const RegionPlan& then) {
                return key.layer <= 0 || then.painted_holdouts.size() == holdouts;
            });
        }
        WEFT_TRY(matte, read());
        store_.put_beneath(key, encode(StoredMatte{std::move(matte), 1.0f}));
        return true;
    }

    Expected<bool> fill_mattes(int index, int frame) {
        const RegionPlan& region = region_at(index);
        if (region.propagated()) {
            WEFT_TRY(there, fill_painted({index, frame, AnalysisKind::kMatte}, region.matte_keys,
                                         region.matte_confirmed,
                                         [&] { return source_.matte_key(index, frame); }));
            if (!there) return false;
        }
        for (int k = 0; k < static_cast<int>(region.painted_holdouts.size()); ++k) {
            const PaintedMatte& holdout = region.painted_holdouts[static_cast<std::size_t>(k)];
            WEFT_TRY(there, fill_painted({index, frame, AnalysisKind::kMatte, k + 1}, holdout.keys,
                                         holdout.confirmed,
                                         [&] { return source_.holdout_key(index, k, frame); }));
            if (!there && frame == frame_) return false;
            // On other frames it only keeps what it hides out of light and form, as before it was
            // painted.
            if (!there)
                store_.put_beneath({index, frame, AnalysisKind::kMatte, k + 1},
                                   encode(StoredMatte{Matte(source_.size()), 1.0f}));
        }
        return true;
    }

    // A zone whose matte is not known yet has no effect.
    void fill_zones(int index) {
        const std::vector<ZonePlan>& zones = region_at(index).zones;
        for (int k = 0; k < static_cast<int>(zones.size()); ++k) {
            const ZonePlan& zone = zones[static_cast<std::size_t>(k)];
            if (!zone.propagated()) continue;
            const AnalysisKey key{index, frame_, AnalysisKind::kMatte, zone_layer(k)};
            const auto there = fill_painted(key, zone.painted.keys, zone.painted.confirmed,
                                            [&] { return source_.zone_key(index, k, frame_); });
            if (!there || !*there)
                store_.put_beneath(key, encode(StoredMatte{Matte(source_.size()), 1.0f}));
        }
    }

    // Where the texture lies on the frame; in the paper mode the texture itself.
    Expected<bool> fill_texture(int index, int reference) {
        const RegionPlan& region = region_at(index);
        if (region.temporal == TemporalMode::kNone || region.has_uv) return true;
        const bool paper = region.temporal == TemporalMode::kPaper;
        const AnalysisKey key{index, frame_,
                              paper ? AnalysisKind::kPaperTexture : AnalysisKind::kCoords};
        if (store_.has(key)) return true;
        if (frame_ != reference) return !paper && fill_track_from_earlier(key);
        if (paper) {
            PaperWalker painter(region, plan_.seed, source_.size(), nullptr);
            WEFT_TRY(picture, painter.start(frame_, cancel_));
            store_.put_beneath(key, encode(picture));
            return true;
        }
        store_.put_beneath(key, encode(still_on(region, frame_)));
        return true;
    }

    // Where the texture lies on the reference frame, with the artist's pins.
    [[nodiscard]] LatticeField still_on(const RegionPlan& region, int reference) const {
        const LatticeField still(source_.size(),
                                 SurfaceTrack::spacing_for(source_.size(), motion_of(region)));
        const auto pins = region.corrections.find(reference);
        return pins == region.corrections.end() ? still : corrected(still, pins->second);
    }

    Status fill_light(int index, int frame) {
        const RegionPlan& region = region_at(index);
        const AnalysisKey key{index, frame, AnalysisKind::kShading};
        if (!region.estimates_light() || store_.has(key) || fill_from_earlier(key)) return {};
        WEFT_TRY(plate, source_.plate(frame));
        WEFT_TRY(extent, extent_matte(source_, plan_, store_, index, frame));
        WEFT_TRY(holdout, holdout_matte(source_, plan_, store_, index, frame));
        Matte visible = without_holdout(extent, holdout);
        drop_nonfinite(visible, make_views(*plate, *plan_.display_from_plate).finite);
        WEFT_TRY(working, working_plate(source_, plan_, frame, *plate));
        store_.put_beneath(key, encode(estimate_shading(working, visible,
                                                        shading_options(plan_, source_.size()))));
        return {};
    }

    // The form as it was found before, else as the reference frame alone shows it.
    Status fill_form(int index, int reference) {
        RegionPlan& region = region_at(index);
        const AnalysisKey key{index, reference, AnalysisKind::kForm};
        if (!region.has_form() || store_.has(key)) return {};
        const auto alike = [&](const RegionPlan& then) {
            return then.form_from == region.form_from && then.surface == region.surface &&
                   then.reference_frames.front() == reference;
        };
        if (fill_from_earlier(key, alike)) return {};
        const AnalysisKey still{index, reference, AnalysisKind::kCoords};
        if (!store_.has(still)) store_.put_beneath(still, encode(still_on(region, reference)));
        const PassContext context{source_, plan_, cancel_, {}, nullptr};
        WEFT_TRY(form, form_from(context, store_, index, {reference}));
        store_.put_beneath(key, encode(form));
        return {};
    }

    // Grain and motion blur, which a single frame does not show.
    void fill_camera(int index, int reference) {
        RegionPlan& region = region_at(index);
        const auto known = [&](int frame, AnalysisKind kind) {
            const AnalysisKey key{index, frame, kind};
            return store_.has(key) || fill_from_earlier(key);
        };
        if (!known(reference, AnalysisKind::kGrain))
            store_.put_beneath({index, reference, AnalysisKind::kGrain}, encode(GrainModel()));
        const int neighbour = frame_ > reference ? frame_ - 1 : frame_ + 1;
        const AnalysisKey beside{index, neighbour, AnalysisKind::kCoords};
        const bool measured =
            !region.estimates_shutter() || known(reference, AnalysisKind::kShutter);
        if (measured && (store_.has(beside) || fill_track_from_earlier(beside))) return;
        region.shutter_deg = 0.0f;
        region.shutter_evidence.clear();
    }

    // The focus that this frame alone shows, where the others have not been read.
    Status fill_focus(int index) {
        RegionPlan& region = region_at(index);
        if (!(region.focus > 0) || focus_on(plan_, store_, index, frame_)) return {};
        region.focus_frames = {frame_};
        const AnalysisKey key{index, frame_, AnalysisKind::kFocus};
        if (store_.has(key)) return {};
        WEFT_TRY(reading, focus_reading(source_, plan_, store_, index, frame_));
        store_.put_beneath(key, encode(reading));
        return {};
    }

    const ShotSource& source_;
    ShotPlan& plan_;
    OverlayStore& store_;
    int frame_;
    const std::vector<EarlierAnalysis>& earlier_;
    const CancelToken& cancel_;
};

}  // namespace

bool ProvisionalFrame::shows_anything() const {
    return std::find(shown.begin(), shown.end(), true) != shown.end();
}

Expected<ProvisionalFrame> provisional_frame(const ShotSource& source, const ShotPlan& plan,
                                             const AnalysisStore& known, int frame,
                                             const std::vector<EarlierAnalysis>& earlier,
                                             const CancelToken& cancel) {
    ProvisionalFrame out;
    out.plan = plan;
    auto store = std::make_unique<OverlayStore>(known, unfinished_regions(plan, known, frame));
    FrameFiller filler(source, out.plan, *store, frame, earlier, cancel);
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        WEFT_TRY(shown, filler.fill(k));
        if (!shown) filler.leave_out(k);
        out.shown.push_back(shown);
    }
    out.store = std::move(store);
    return out;
}

}  // namespace weft
