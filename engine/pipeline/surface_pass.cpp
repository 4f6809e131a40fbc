#include "engine/pipeline/surface_pass.h"

#include <algorithm>
#include <optional>
#include <set>

#include "engine/core/follow_up.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/pipeline/light_pass.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/surface_stop.h"
#include "engine/pipeline/walk_along.h"
#include "engine/temporal/shutter.h"
#include "engine/temporal/track_seam.h"

namespace weft {
namespace {

// What the three legs do at each frame.
class Follower {
  public:
    Follower(const PassContext& context, AnalysisStore& store) : context_(context), store_(store) {}

    // Goes through a leg, one frame behind its preparation.
    Status run(const std::optional<SweepOptions>& options, SurfaceLeg leg,
               std::vector<SurfaceJob>& jobs) {
        if (!options) return {};
        leg_ = leg;
        SurfaceStops stops(context_, store_, jobs, leg);
        const auto prepare = [&](const SweepFrame& at) { return stops.prepare(at); };
        const auto visit_all = [&](const SweepFrame& at) -> Status {
            WEFT_TRY(here, stops.take());
            WEFT_CHECK_OK(parallel_try(jobs.size(), [&](std::size_t k) {
                return here[k] ? visit(jobs[k], at, *here[k]) : Status{};
            }));
            return measure_later(jobs, at, here);
        };
        SweepOptions ahead = *options;
        ahead.ahead = stops.ahead();
        ahead.known = context_.plan.walks.get();
        WEFT_CHECK_OK(sweep(context_, ahead, visit_all, prepare));
        return measuring_.finish();
    }

  private:
    [[nodiscard]] bool walking_back() const { return leg_ == SurfaceLeg::kBackward; }

    Status visit(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        if (stop.held) job.held_frames.insert(walking_back() ? at.frame + 1 : at.frame);
        switch (leg_) {
            case SurfaceLeg::kForward:
                return forward(job, at, stop);
            case SurfaceLeg::kBackward:
                return backward(job, at, stop);
            case SurfaceLeg::kAgain:
                return again(job, at, stop);
        }
        return {};
    }

    // Leg 1: forwards from the primary reference.
    Status forward(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        WEFT_CHECK_OK(begins(job, leg_, at.frame) ? start(job, at, stop, nullptr)
                                                  : advance(job, at, stop));
        return keep_track(job, at, stop);
    }

    // Leg 2: backwards from the references after the primary one, through it, to the beginning.
    Status backward(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        if (begins(job, leg_, at.frame)) {
            WEFT_CHECK_OK(restart(job, at, stop));
            // Shading before the primary reference continues from what leg 1 stored there.
            if (at.frame == job.primary && job.shading && !job.gathers_light()) {
                WEFT_TRY(bytes, store_.get({job.region, at.frame, AnalysisKind::kShading}));
                WEFT_TRY(shading, decode_shading(bytes));
                job.last_shading = std::move(shading);
            }
            return {};
        }
        WEFT_CHECK_OK(advance(job, at, stop));
        return at.frame > job.primary
                   ? blend(job, at.frame, stop.visible, job.track->ref_from_cur())
                   : keep_track(job, at, stop);
    }

    // Leg 3: forwards from the references before the primary one.
    Status again(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        if (begins(job, leg_, at.frame)) return restart(job, at, stop);
        WEFT_CHECK_OK(advance(job, at, stop));
        return blend(job, at.frame, stop.visible, job.track->ref_from_cur());
    }

    // What is measured on a frame from the step that led to it, in the order of the frames: light,
    // grain and shutter. Nothing waits for it, so the next frame is visited meanwhile.
    Status measure_later(std::vector<SurfaceJob>& jobs, const SweepFrame& at,
                         const SurfaceStops::Stops& here) {
        struct Measured {
            SurfaceJob* job;
            Matte visible;
            LatticeField prev_from_cur;
        };
        auto all = std::make_shared<std::vector<Measured>>();
        for (std::size_t k = 0; k < jobs.size(); ++k) {
            const bool whole = leg_ == SurfaceLeg::kForward ||
                               (leg_ == SurfaceLeg::kBackward && at.frame < jobs[k].primary);
            if (here[k] && whole)
                all->push_back({&jobs[k], here[k]->visible, jobs[k].track->prev_from_cur()});
        }
        if (all->empty()) return {};
        return measuring_.run([this, at, all]() -> Status {
            return parallel_try(all->size(), [&](std::size_t k) {
                const Measured& m = (*all)[k];
                return measure(*m.job, at, m.visible, m.prev_from_cur);
            });
        });
    }

    Status measure(SurfaceJob& job, const SweepFrame& at, const Matte& visible,
                   const LatticeField& prev_from_cur) {
        if (leg_ == SurfaceLeg::kForward) {
            WEFT_CHECK_OK(measure_grain(job, at, prev_from_cur));
            WEFT_CHECK_OK(measure_shutter(job, at, visible, prev_from_cur));
        }
        return measure_light(job, at, visible, prev_from_cur);
    }

    Status start(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop,
                 const LatticeField* base) {
        const SurfaceTrack::Motion motion = motion_of(*job.plan);
        std::optional<LatticeField> placed;
        if (const auto* pins = pins_at(job, at.frame); pins && !base) {
            const Size size = context_.source.size();
            placed = corrected(LatticeField(size, SurfaceTrack::spacing_for(size, motion)), *pins);
            base = &*placed;
        }
        begin_walk(job, *at.views, stop, context_.plan.motion_quality, base);
        job.walked_to = job.anchored_at = at.frame;
        if (job.paper && at.frame == job.primary) {
            job.painter.emplace(*job.plan, context_.plan.seed, context_.source.size(),
                                context_.backend);
            WEFT_TRY(picture, job.painter->start(at.frame, context_.cancel));
            return keep(job, at.frame, AnalysisKind::kPaperTexture, encode(picture));
        }
        return {};
    }

    // The artist's pins on this frame, or null.
    [[nodiscard]] static const std::vector<SurfacePin>* pins_at(const SurfaceJob& job, int frame) {
        const auto pins = job.plan->corrections.find(frame);
        const bool surface = job.coords && job.layer == 0;
        return surface && pins != job.plan->corrections.end() ? &pins->second : nullptr;
    }

    // At a reference frame whose coordinates an earlier leg has found.
    Status restart(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        if (!job.coords || at.frame == job.primary) return start(job, at, stop, nullptr);
        WEFT_TRY(bytes, store_.get({job.region, at.frame, AnalysisKind::kCoords}));
        WEFT_TRY(base, decode_lattice(bytes));
        return start(job, at, stop, &base);
    }

    Status advance(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        const Matte& visible = stop.visible;
        if (!job.plan->track.empty()) {
            follow_track(job, at, visible);
        } else if (job.plan->true_motion) {
            job.track->advance(*stop.step);
        } else if (stop.held) {
            hold_walk(job);
        } else {
            const bool between =
                at.frame > job.references.front() && at.frame < job.references.back();
            const bool hide = job.coords && job.layer == 0 && !between;
            walk_on(job, stop, hide, context_.plan);
        }
        WEFT_CHECK_OK(keep_found_late(job, at.frame));
        if (const auto* pins = pins_at(job, at.frame)) {
            const LatticeField placed = corrected(job.track->ref_from_cur(), *pins);
            anchor_walk(job, &placed);
            job.anchored_at = at.frame;
        } else if (job.is_reference(at.frame)) {
            anchor_walk(job, nullptr);
            job.anchored_at = at.frame;
        }
        job.walked_to = at.frame;
        if (job.painter) {
            WEFT_TRY(picture,
                     job.painter->advance(at.frame, job.track->prev_from_cur(), context_.cancel));
            return keep(job, at.frame, AnalysisKind::kPaperTexture, encode(picture));
        }
        return {};
    }

    // Stores better coordinates for frames that were passed.
    Status keep_found_late(SurfaceJob& job, int frame) {
        const auto found = job.track->take_found_late();
        if (!job.coords && !job.gathers_light()) return {};
        for (const LatticeField& ref_from_frame : found) {
            frame += walking_back() ? 1 : -1;
            // Legs 2 and 3 blend their result with that of leg 1.
            const bool between = walking_back() ? frame > job.primary : frame < job.primary;
            if (!between) {
                WEFT_CHECK_OK(keep(job, frame, job.coords_kind(frame), encode(ref_from_frame)));
                continue;
            }
            WEFT_TRY(extent,
                     extent_matte(context_.source, context_.plan, store_, job.region, frame));
            WEFT_TRY(holdout,
                     holdout_matte(context_.source, context_.plan, store_, job.region, frame));
            WEFT_CHECK_OK(blend(job, frame, without_holdout(extent, holdout), ref_from_frame));
        }
        return {};
    }

    // The track gives the motion to any frame directly, so errors do not add up.
    void follow_track(SurfaceJob& job, const SweepFrame& at, const Matte& visible) const {
        const auto motion_to = [&](int frame) {
            return plane_motion(job.plan->track.at(at.frame), job.plan->track.at(frame),
                                context_.source.size(), job.track->ref_from_cur().spacing());
        };
        job.track->advance_known(*at.views, visible, motion_to(job.walked_to),
                                 motion_to(job.anchored_at));
    }

    // While a seam hides that a stretched texture returned to its shape, both tracks are stored for
    // it.
    Status keep_stretched(const SurfaceJob& job, int frame, bool held) {
        const LatticeField* stretched = job.track->stretched();
        if (!stretched || !job.coords) return {};
        const LatticeField& relaxed = job.track->ref_from_cur();
        const bool back = walking_back();
        if (held)
            WEFT_CHECK_OK(
                keep(job, back ? frame + 1 : frame, AnalysisKind::kHeldBetween, encode(1.0f)));
        WEFT_CHECK_OK(keep(job, frame, AnalysisKind::kHidingFrames,
                           encode(static_cast<float>(job.track->hiding_frames()))));
        WEFT_CHECK_OK(
            keep(job, frame, AnalysisKind::kTrackBefore, encode(back ? relaxed : *stretched)));
        return keep(job, frame, AnalysisKind::kTrackAfter, encode(back ? *stretched : relaxed));
    }

    Status keep_track(SurfaceJob& job, const SweepFrame& at, const SurfaceStop& stop) {
        WEFT_CHECK_OK(keep_stretched(job, at.frame, stop.held));
        if (!job.coords && !job.gathers_light()) return {};
        return keep(job, at.frame, job.coords_kind(at.frame), encode(job.track->ref_from_cur()));
    }

    Status measure_light(SurfaceJob& job, const SweepFrame& at, const Matte& visible,
                         const LatticeField& prev_from_cur) {
        if (!job.shading) return {};
        WEFT_TRY(working, working_plate(context_.source, context_.plan, at.frame, *at.plate));
        const Size size = working.size();
        const ShadingOptions options = shading_options(context_.plan, size);
        const SurfaceSample sample =
            job.light.measure(working, visible, options, at.frame, job.primary);
        if (job.gathers_light())
            return keep(job, at.frame, AnalysisKind::kLightSample, encode(sample));
        Shading shading = shading_of(sample, options);
        if (job.last_shading && at.frame != job.primary) {
            shading =
                steady_shading(shading, *job.last_shading, prev_from_cur.dense(rect_of(size)));
        }
        WEFT_CHECK_OK(keep(job, at.frame, AnalysisKind::kShading, encode(shading)));
        job.last_shading = std::move(shading);
        return {};
    }

    // Grain comes from the camera, so the whole plate is measured.
    Status measure_grain(SurfaceJob& job, const SweepFrame& at, const LatticeField& prev_from_cur) {
        if (!job.grain || at.frame > job.plan->grain_frames.back()) return {};
        ImageF3 display = transformed(*at.plate, *context_.plan.display_from_plate);
        Matte metered(display.size(), 255);
        drop_nonfinite(metered, at.views->finite);
        if (at.frame == job.primary) job.meter.emplace(context_.plan.plate_quantum);
        if (at.shows() && !job.last_display.empty()) {
            job.meter->add(display, job.last_display, metered, job.last_metered,
                           prev_from_cur.dense(rect_of(display.size())));
        }
        if (at.shows()) {
            job.last_display = std::move(display);
            job.last_metered = std::move(metered);
        }
        if (at.frame < job.plan->grain_frames.back()) return {};
        const GrainModel grain = job.meter->model();
        job.meter.reset();
        job.last_display = {};
        return keep(job, job.primary, AnalysisKind::kGrain, encode(grain));
    }

    Status measure_shutter(SurfaceJob& job, const SweepFrame& at, const Matte& visible,
                           const LatticeField& prev_from_cur) {
        const std::vector<int>& frames = job.plan->shutter_evidence;
        if (!job.shutter || at.frame > frames.back()) return {};
        if (at.frame > job.primary && at.shows())
            job.shutter_meter.add(at.views->luma, visible, prev_from_cur);
        if (at.frame < frames.back()) return {};
        return keep(job, job.primary, AnalysisKind::kShutter, encode(job.shutter_meter.degrees()));
    }

    // A frame's position between two references, 0 to 1. Frames of one drawing have the same
    // position.
    static float position_between(const SurfaceJob& job, int frame, int before, int after) {
        int first = frame, last = frame + 1;
        while (first > before && job.held_frames.contains(first))
            --first;
        while (last <= after && job.held_frames.contains(last))
            ++last;
        if (first > before && last > after) return 1;
        return static_cast<float>(first - before) / static_cast<float>(after - before);
    }

    // Between two references the tracks from both are stored. Their difference is spread over the
    // interval; where it is too large for that, both are stored for a seam to choose.
    Status blend(SurfaceJob& job, int frame, const Matte& visible, const LatticeField& found) {
        if (!job.coords) return {};
        const auto after = std::upper_bound(job.references.begin(), job.references.end(), frame);
        const float smooth = smooth_rise(position_between(job, frame, *(after - 1), *after));
        WEFT_TRY(bytes, store_.get({job.region, frame, AnalysisKind::kCoordsOneWay}));
        WEFT_TRY(other, decode_lattice(bytes));
        // One may follow parts by themselves, on a finer lattice.
        const int spacing = std::min(other.spacing(), found.spacing());
        const LatticeField mine = found.spacing() == spacing ? found : found.resampled(spacing);
        if (other.spacing() != spacing) other = other.resampled(spacing);
        // Walking backwards, the walker comes from the reference after.
        const LatticeField& from_before = walking_back() ? other : mine;
        const LatticeField& from_after = walking_back() ? mine : other;
        constexpr float kSlowestPx = 0.2f;  // per frame, at a plate 854 px wide: not visible
        const float limit_px = kSlowestPx * static_cast<float>(context_.source.size().width) /
                               854.0f * static_cast<float>(*after - *(after - 1));
        const TrackLayers layers =
            spread_disagreement(from_before, from_after, smooth, limit_px, visible);
        if (layers.apart) {
            if (job.held_frames.contains(frame))
                WEFT_CHECK_OK(keep(job, frame, AnalysisKind::kHeldBetween, encode(1.0f)));
            WEFT_CHECK_OK(keep(job, frame, AnalysisKind::kTrackBefore, encode(layers.before)));
            WEFT_CHECK_OK(keep(job, frame, AnalysisKind::kTrackAfter, encode(layers.after)));
        }
        return keep(job, frame, AnalysisKind::kCoords,
                    encode(mix(from_before, from_after, smooth)));
    }

    Status keep(const SurfaceJob& job, int frame, AnalysisKind kind, const Bytes& bytes) {
        return store_.put({job.region, frame, kind, job.layer}, bytes);
    }

    const PassContext& context_;
    AnalysisStore& store_;
    SurfaceLeg leg_ = SurfaceLeg::kForward;
    FollowUp measuring_;  // destroyed first
};

}  // namespace

ShadingOptions shading_options(const ShotPlan& plan, Size plate) {
    ShadingOptions options;
    options.pattern_px *= static_cast<float>(plate.width) / 854.0f;
    options.downscale = plan.quality == FlowQuality::kDraft ? 4 : 2;
    return options;
}

int count_surface_steps(const ShotPlan& plan, const AnalysisStore& store) {
    const std::vector<SurfaceJob> jobs = surface_jobs(plan, store);
    if (jobs.empty()) return 0;
    const SurfaceLegs legs = surface_legs(jobs);
    return legs.steps();
}

Status follow_surfaces(const PassContext& context, AnalysisStore& store) {
    std::vector<SurfaceJob> jobs = surface_jobs(context.plan, store);
    if (jobs.empty()) return {};
    const SurfaceLegs legs = surface_legs(jobs);
    Follower follower(context, store);
    WEFT_CHECK_OK(follower.run(legs.forward, SurfaceLeg::kForward, jobs));
    WEFT_CHECK_OK(follower.run(legs.backward, SurfaceLeg::kBackward, jobs));
    WEFT_CHECK_OK(follower.run(legs.again, SurfaceLeg::kAgain, jobs));
    for (const SurfaceJob& job : jobs) {
        if (job.gathers_light())
            WEFT_CHECK_OK(
                estimate_light(context, job.region, {job.span.first, job.span.last}, store));
    }
    return {};
}

}  // namespace weft
