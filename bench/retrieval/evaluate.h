#pragma once
// How well a library recognises the materials of photographs that are not in it.

#include <map>
#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace weft {

/// The samples that are left out of the library for each query.
enum class LeaveOut {
    kPhotographs,  ///< The query photographs themselves and nearly equal pictures.
    /// And pictures whose names differ only by numbers and single letters, for names of two words
    /// or more ("wall brick").
    kSeries,
    kStem  ///< And pictures with such names of one word ("carpet").
};

struct EvaluationOptions {
    /// Folder of folders of photographs, named after materials; with a manifest.csv (file,
    /// category, package, path in the package, …) if known. Empty: the library's own samples from
    /// packages, in five parts by name, each queried against the other four.
    std::string folder;
    LeaveOut leave_out = LeaveOut::kSeries;
    std::map<std::string, std::string> renamed;  ///< Folder → material, for other names.
};

/// The scores of one material, or their average over materials of at least ten photographs.
/// `merged`: sand with dirt, stone with cobblestone and tiles, rust with metal.
struct RetrievalScore {
    std::string material;
    int asked = 0;
    double first = 0, among_five = 0, merged_first = 0, merged_among_five = 0;
};

struct EvaluationReport {
    int samples = 0, left_out = 0, asked = 0;
    std::vector<RetrievalScore> materials;  ///< By name.
    RetrievalScore average;
};

/// Trains the descriptor on the remaining samples and queries it as TextureLibrary::similar() does:
/// is the right material first, is it among the first five? Only reads the file. Errors:
/// Unreadable; Usage if there are no queries.
[[nodiscard]] Expected<EvaluationReport> evaluate_library(const std::string& library_path,
                                                          const EvaluationOptions& options,
                                                          const CancelToken& cancel = {},
                                                          const ProgressFn& progress = {});

}  // namespace weft
