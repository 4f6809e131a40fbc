#pragma once
// One still picture of a region's surface, to be painted on in other programs.

#include <optional>
#include <string>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "app/exchange/input_files.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/pipeline/flat_layout.h"

namespace weft {

struct FlattenSpec {
    Project project;     ///< With absolute paths.
    std::string region;  ///< Name or id; empty: the only enabled one.
    std::string path;    ///< .png, .tif, .exr or .ora.
    int scale = 0;       ///< Texels a plate pixel, 1 or 2; 0: 2 for plates up to 2048 px wide.
    std::optional<int> margin_px;  ///< Empty: what the frames show beyond the reference frame.
    std::string frames;  ///< A frame list to gather from; empty: up to 32 of all of the project.
    bool overwrite = false;
    AnalysisCacheOptions cache;
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    int threads = 0;              ///< 0: one per processor.
    WriteLimits limits;
};

struct FlattenResult {
    std::string region;
    int reference = 0;
    FlatLayout layout;
    std::vector<int> frames;  ///< That were gathered.
    double covered = 0;       ///< Share of the picture that a frame shows.
    /// Of the texels covered: that two frames or fewer show, so that their grain stays.
    double few_frames = 0;
    std::vector<std::string> layers;  ///< Of an .ora, bottom first.
    std::vector<std::string> notes, warnings;
};

/// Analyses what is missing, as a render of the project with the plate's light would, and gathers
/// the picture: gather_flat_surface(). PNG and .ora have 8 bits, TIFF 16, EXR 32-bit floats
/// in linear light; all have the coverage as alpha. An .ora has the surface, above it, hidden, the
/// region's texture as it lies there (if it has one), and an empty layer to paint on. The file
/// appears whole or not at all, and its bytes depend on neither threads nor time. Sets the
/// process's thread count. Errors: those of opening the shot and analysing it; Usage (no such
/// region, one that is not in locked mode, a margin or a kind of file that there is not, a file
/// that exists), MissingFrames, RenderFailed if no frame shows the surface, NoSpace; an input that
/// changed meanwhile; cancellation.
[[nodiscard]] Expected<FlattenResult> run_flatten(const FlattenSpec& spec,
                                                  const CancelToken& cancel,
                                                  const ProgressFn& progress);

}  // namespace weft
