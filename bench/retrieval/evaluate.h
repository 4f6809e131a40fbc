#pragma once
// How well a library recognises materials of photographs that it has not seen.

#include <map>
#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace weft {

/// What is left out of the library before a photograph is asked for.
enum class LeaveOut {
    kPhotographs,  ///< The photographs themselves and pictures that are nearly the same.
    kSeries,       ///< And those whose names differ from theirs by numbers and single letters only,
                   ///< where such a name has two words or more ("wall brick").
    kStem          ///< And such names of one word ("carpet").
};

struct EvaluationOptions {
    /// Folder of folders of photographs, whose names speak of materials; with a manifest.csv (file,
    /// category, package, path in the package, …) where that is known. Empty: the library's own
    /// samples from packages, in five parts by name, each asked of the other four.
    std::string folder;
    LeaveOut leave_out = LeaveOut::kSeries;
    std::map<std::string, std::string> renamed;  ///< Folder → material, where its name is none.
};

/// One material, or the macro-average over those of ten photographs and more. `merged`: sand with
/// dirt, stone with cobblestone and tiles, rust with metal.
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

/// Learns the descriptor on what is not left out, and asks as TextureLibrary::similar() answers: is
/// the right material first, is it among the first five? The file is only read. Errors: Unreadable;
/// Usage where nothing can be asked.
[[nodiscard]] Expected<EvaluationReport> evaluate_library(const std::string& library_path,
                                                          const EvaluationOptions& options,
                                                          const CancelToken& cancel = {},
                                                          const ProgressFn& progress = {});

}  // namespace weft
