#pragma once
// The motion of a surface between any two frames of a shot, from its analysis.

#include <map>
#include <memory>
#include <mutex>

#include "engine/motion/lattice_field.h"
#include "engine/pipeline/motion_zones.h"

namespace weft {

/// Refers to its arguments, which must outlive it. The shot is analysed in locked mode on all
/// frames that are asked for. Keeps a few of its results. Thread-safe as its arguments are.
class RegionMotion {
  public:
    RegionMotion(const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store,
                 int region)
        : source_(source), plan_(plan), store_(source, plan, store), region_(region) {}

    [[nodiscard]] int region() const { return region_; }
    [[nodiscard]] const RegionPlan& plan() const { return region_of(plan_, region_); }
    [[nodiscard]] Size size() const { return source_.size(); }
    /// to_from_from: where what `from` shows of the surface lies on `to`, px; zero for one and the
    /// same frame. Nothing is followed again: both frames' places on the region's reference frame
    /// are joined. Errors: those of the store and of motion zones.
    [[nodiscard]] Expected<LatticeField> between(int from, int to) const;
    /// Where a frame shows the surface, holdouts taken off. Errors: those of shown_matte().
    [[nodiscard]] Expected<Matte> visible(int frame) const;
    /// The confidence of a frame's propagated matte, 0–1; 1 of one from files. Errors: those of the
    /// store.
    [[nodiscard]] Expected<float> confidence(int frame) const;

  private:
    [[nodiscard]] Expected<std::shared_ptr<const LatticeField>> ref_from(int frame) const;

    const ShotSource& source_;
    const ShotPlan& plan_;
    ZonedAnalysis store_;
    int region_;
    mutable std::mutex mutex_;
    mutable std::map<int, std::shared_ptr<const LatticeField>> kept_;  // ref_from_cur by frame
};

}  // namespace weft
