#pragma once
// A draft's plates and mattes at a fraction of their size, and what is found on them.

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// By how much the plate is reduced for a draft (1, 2, 4 or 8): to at most 240,000 pixels, so 2 at
/// 854×480 and 4 at 1920×1080. 1 where a region's motion is given in pixels of the plate.
[[nodiscard]] int draft_factor(const ShotPlan& plan, Size plate);

/// Refers to `source`. Has what mattes and motion are found from, and nothing else.
class DraftSource final : public ShotSource {
  public:
    DraftSource(const ShotSource& source, int factor) : source_(source), factor_(factor) {}

    [[nodiscard]] Size size() const override;
    [[nodiscard]] Expected<std::shared_ptr<const ImageF3>> plate(int frame) const override;
    [[nodiscard]] Expected<PlateAlpha> alpha(int frame) const override;
    [[nodiscard]] Expected<Matte> matte(int region, int frame) const override;
    [[nodiscard]] Expected<Matte> matte_key(int region, int frame) const override;
    [[nodiscard]] Expected<Matte> holdout_key(int region, int painted, int frame) const override;
    [[nodiscard]] Expected<ConfirmedPart> confirmed_part(int region, int layer,
                                                         int frame) const override;
    [[nodiscard]] Expected<std::optional<Matte>> holdout(int region, int frame) const override;
    [[nodiscard]] Expected<FlowField> motion(int region, int frame) const override;

  private:
    [[nodiscard]] Expected<Matte> reduced(Expected<Matte> full) const;

    const ShotSource& source_;
    int factor_;
};

/// What was found on the reduced plates, at the plate's size: mattes and lattices are enlarged when
/// they are asked for. Thread-safe.
class DraftStore final : public AnalysisStore {
  public:
    DraftStore(int factor, Size plate) : factor_(factor), plate_(plate) {}

    [[nodiscard]] bool has(const AnalysisKey& key) const override { return small_.has(key); }
    /// Of the reduced size.
    [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override {
        return small_.put(key, bytes);
    }
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override;
    /// As it was found; for the analysis itself.
    [[nodiscard]] MemoryAnalysisStore& small() { return small_; }

  private:
    int factor_;
    Size plate_;
    MemoryAnalysisStore small_;
};

}  // namespace weft
