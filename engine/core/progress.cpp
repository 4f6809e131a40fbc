#include "engine/core/progress.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft {
namespace {

// In the order of WorkStage.
constexpr std::array<const char*, 9> kStages{
    "analyse", "motion", "wait", "synthesise", "render", "export", "collect", "measure", ""};
static_assert(kStages.size() == static_cast<std::size_t>(WorkStage::kOther) + 1);

}  // namespace

const char* name_of(WorkStage stage) {
    return kStages[static_cast<std::size_t>(stage)];
}

std::optional<WorkStage> work_stage(std::string_view name) {
    const auto* const at = std::find(kStages.begin(), kStages.end(), name);
    if (name.empty() || at == kStages.end()) return std::nullopt;
    return static_cast<WorkStage>(at - kStages.begin());
}

}  // namespace weft
