#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace weft {

enum class WorkStage : std::uint8_t {
    kAnalyse,
    kMotion,  ///< The estimated motion between neighbours, for a farm.
    kWait,    ///< For what another program computes.
    kSynthesise,
    kRender,
    kExport,
    kCollect,
    kMeasure,
    kOther  ///< Named by ProgressEvent::title alone.
};

/// "analyse", "render", …; empty for kOther.
[[nodiscard]] const char* name_of(WorkStage stage);
/// Empty for another word.
[[nodiscard]] std::optional<WorkStage> work_stage(std::string_view name);

/// One step of a longer work. `done` never falls and never exceeds `total`, in units of the work.
struct ProgressEvent {
    WorkStage stage = WorkStage::kOther;
    std::int64_t done = 0;
    std::int64_t total = 0;
    int frame = 0;           ///< The frame that was just finished, where the stage has frames.
    double seconds = 0;      ///< What that frame took.
    std::string title = {};  ///< In place of the stage's name; empty: that.

    [[nodiscard]] static ProgressEvent titled(std::string title, std::int64_t done,
                                              std::int64_t total) {
        return {WorkStage::kOther, done, total, 0, 0, std::move(title)};
    }
    /// The title, or the stage's name.
    [[nodiscard]] std::string name() const { return title.empty() ? name_of(stage) : title; }
};

/// Called from the thread that finishes a step, one call at a time.
using ProgressFn = std::function<void(const ProgressEvent&)>;

}  // namespace weft
