#include "engine/pipeline/walk_along.h"

#include <cstdint>
#include <memory>

#include "engine/pipeline/walk_memory.h"

namespace weft {
namespace {

// What a walk did at a frame, in its name.
enum class Did : std::uint8_t { kBegin, kStep, kStepHiding, kHold, kAnchor };

class Name {
  public:
    explicit Name(Did did) { hasher_.value(static_cast<std::uint8_t>(did)); }
    Name& add(SurfaceKind kind) {
        hasher_.value(static_cast<std::uint8_t>(kind));
        return *this;
    }
    Name& add(const Hash128& hash) {
        hasher_.value(hash.high).value(hash.low);
        return *this;
    }
    Name& add(const LatticeField& field) {
        hasher_.value(field.spacing()).image(field.nodes());
        return *this;
    }
    [[nodiscard]] Hash128 finish() const { return hasher_.finish(); }

  private:
    Hasher hasher_;
};

// What an earlier walk of this surface has refuted is not believed again.
SurfaceKind kind_of(SurfaceJob& job) {
    // What lies around a zone is another surface.
    const SurfaceKind said = job.layer == 0 ? job.plan->surface : SurfaceKind::kFound;
    const bool open = said == SurfaceKind::kFound || said == SurfaceKind::kRigid;
    job.bends = job.bends || (job.track && !job.track->is_plane());
    if (!open || !job.bends) return said;
    return said == SurfaceKind::kFound ? SurfaceKind::kBody : SurfaceKind::kCloth;
}

void walk_step(SurfaceJob& job, const SurfaceStop& stop, bool hide, const ShotPlan& plan) {
    const bool named = plan.walks && job.walk && stop.key;
    if (!named) {
        job.walk.reset();
        job.track->hide_reanchoring(hide);
        job.track->advance(*stop.step);
        return;
    }
    const auto after = [&](Did did) { return Name(did).add(*job.walk).add(*stop.key).finish(); };
    const Hash128 plainly = after(Did::kStep), name = hide ? after(Did::kStepHiding) : plainly;
    std::shared_ptr<const SurfaceTrack> track = plan.walks->find_track(name);
    if (track) {
        job.track = *track;
    } else {
        job.track->hide_reanchoring(hide);
        job.track->advance(*stop.step);
        if (plan.keep_walks) track = std::make_shared<const SurfaceTrack>(*job.track);
    }
    // Where no seam had to hide anything, the walk is one that does not hide.
    job.walk = job.track->stretched() ? name : plainly;
    if (!plan.keep_walks) return;
    plan.walks->keep_track(name, track);
    if (!job.track->stretched()) plan.walks->keep_track(plainly, track);
}

}  // namespace

void begin_walk(SurfaceJob& job, const PlateViews& views, const SurfaceStop& stop,
                FlowQuality quality, const LatticeField* base) {
    const SurfaceKind kind = kind_of(job);
    job.walk.reset();
    *job.asks_outline = true;
    if (stop.key) {
        Name name(Did::kBegin);
        name.add(kind).add(*stop.key);
        if (base) name.add(*base);
        job.walk = name.finish();
    }
    job.track.emplace(views, stop.visible, stop.extent, motion_of(*job.plan), kind, quality, base,
                      stop.step ? stop.step->frame : nullptr);
}

void walk_on(SurfaceJob& job, const SurfaceStop& stop, bool hide, const ShotPlan& plan) {
    walk_step(job, stop, hide, plan);
    *job.asks_outline = job.track->asks_outline();
}

void hold_walk(SurfaceJob& job) {
    if (job.walk) job.walk = Name(Did::kHold).add(*job.walk).finish();
    job.track->hold();
}

void anchor_walk(SurfaceJob& job, const LatticeField* placed) {
    if (job.walk) {
        Name name(Did::kAnchor);
        name.add(*job.walk);
        if (placed) name.add(*placed);
        job.walk = name.finish();
    }
    job.track->anchor_here(placed);
}

}  // namespace weft
