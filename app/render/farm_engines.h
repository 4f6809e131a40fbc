#pragma once
// Internal: a job in the words of each farm.

#include <string>
#include <utility>
#include <vector>

#include "app/render/farm.h"

namespace weft {

struct FarmJob {
    std::string name, file;  ///< Of the shot; the absolute path of job.json.
    std::vector<FarmStage> stages;
};

/// Names (relative to the job's folder) and texts.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> engine_files(FarmEngine engine,
                                                                            const FarmJob& job);

}  // namespace weft
