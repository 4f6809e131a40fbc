#pragma once
// Internal: a job in the format of each farm.

#include <string>
#include <utility>
#include <vector>

#include "app/farm/farm.h"

namespace weft {

struct FarmJob {
    std::string name, file;  ///< Name of the shot; absolute path of job.json.
    std::vector<FarmStage> stages;
};

/// File names (relative to the job's folder) and contents.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> engine_files(FarmEngine engine,
                                                                            const FarmJob& job);

}  // namespace weft
