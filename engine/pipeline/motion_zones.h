#pragma once
// Zones that change the motion of a region: where rendering reads the surface, it lies as the
// artist said.

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"
#include "engine/temporal/zone_motion.h"

namespace weft {

/// The analysis as frames are rendered from it: kCoords, kTrackBefore and kTrackAfter of
/// regions with motion zones are changed inside of these, on the way out. Nothing is written: the
/// analysis itself (light, form, highlights) stays that of the surface as it was followed, so that
/// nothing changes outside of the zones. Refers to its arguments, which must outlive it; keeps what
/// it has computed. Thread-safe as its arguments are.
class ZonedAnalysis final : public AnalysisStore {
  public:
    ZonedAnalysis(const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store)
        : source_(source), plan_(plan), store_(store) {}

    [[nodiscard]] bool has(const AnalysisKey& key) const override { return store_.has(key); }
    [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override;
    /// Errors: those of the store and of the mattes.
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override;

  private:
    [[nodiscard]] Expected<LatticeField> followed(const AnalysisKey& key) const;
    [[nodiscard]] Expected<LatticeField> placed_on(int region, int frame) const;
    [[nodiscard]] Expected<LatticeField> changed_in(int region, int zone, int frame,
                                                    const Matte& surface, LatticeField field) const;
    [[nodiscard]] Expected<std::vector<OtherFrame>> frames_around(int region, int frame) const;

    const ShotSource& source_;
    const ShotPlan& plan_;
    const AnalysisStore& store_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, int>, LatticeField> placed_;  // by region and frame
};

/// The surroundings of a zone on a frame: what lies around it in the picture within 6 % of the
/// plate's width, without the region's holdouts. Errors: those of the mattes.
[[nodiscard]] Expected<Matte> zone_surroundings(const ShotSource& source, const ShotPlan& plan,
                                                const AnalysisStore& store, int region, int zone,
                                                int frame);

}  // namespace weft
