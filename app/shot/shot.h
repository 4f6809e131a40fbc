#pragma once
// An opened project: its files are found, spaces resolved and textures read.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "app/shot/fingerprints.h"
#include "app/shot/input_watch.h"
#include "app/shot/painted_mattes.h"
#include "app/shot/reference_choice.h"
#include "app/shot/scene_cuts.h"
#include "engine/media/frame_cache.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"
#include "engine/synthesis/sample_kind.h"

namespace weft {

/// The colour spaces of a shot, set or derived from the file types.
struct ShotSpaces {
    ColorSpace plate, working, out;
    std::vector<ColorSpace> textures;  ///< One per region.
};

/// A texture as listed in the report.
struct ShotTexture {
    std::string region, path, id;  ///< id: hash of the decoded pixels.
    Size size;
    bool is_plane = false;
    SampleKind sample_kind = SampleKind::kStochastic;  ///< Of a sample, with the reason for it.
    std::string sample_reason;
    /// For library textures; empty: not known.
    std::string library_id, author, licence, source;
    std::vector<ShotTexture> also;  ///< Further samples that are used together with it.
};

/// The reference frame of a region.
struct ShotReference {
    int frame = 0;
    bool by_default = true;      ///< choose_reference() chose it.
    bool shows_nothing = false;  ///< The matte is empty on it.
    std::optional<int> better;   ///< If so, a frame that shows the surface, if any.
};

/// Everything needed to analyse and render a shot. Shared, immutable and thread-safe.
struct Shot {
    Project project;                        ///< With absolute paths.
    std::vector<std::size_t> region_index;  ///< Index in the project of each planned region.
    std::shared_ptr<const CachedReader> plate;
    std::shared_ptr<const ShotSource> source;
    ShotPlan plan;
    ShotSpaces spaces;
    std::vector<ShotTexture> textures;
    std::vector<ShotReference> references;  ///< One per planned region.
    std::vector<std::string> notes;         ///< Automatic choices that the user should know.
    std::vector<std::string> warnings;
    std::shared_ptr<CutWatch> cuts;      ///< Has examined every plate frame that was read.
    std::shared_ptr<InputWatch> inputs;  ///< Records every file that is read; null: disabled.
    /// What is known of its files; never null.
    std::shared_ptr<Fingerprints> files = std::make_shared<Fingerprints>();
    PaintedMattes painted;  ///< Mattes that are read from memory.
};

/// The depth of the output: set by the user, or derived from the plate and the format.
[[nodiscard]] PixelDepth output_depth(const Output& output, PixelDepth plate);

struct OpenShotOptions {
    std::size_t cache_bytes = 256u << 20;  ///< Cache for decoded plates.
    bool textures = true;       ///< False: skip textures; sufficient for propagating mattes.
    bool watch_inputs = false;  ///< Creates Shot::inputs.
    /// Frames to leave out where they only serve to measure light, grain or motion blur.
    std::vector<int> leave_out;
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    /// Visibility scores from another version of the shot; null: none.
    std::shared_ptr<VisibilityCache> visibility;
    /// Becomes Shot::files; null: new ones that are not kept.
    std::shared_ptr<Fingerprints> files;
    /// Painted mattes that may not be on the disk yet.
    PaintedMattes painted;
    /// The project's plate if it is already open; null: open it.
    std::shared_ptr<const CachedReader> plate;
};

/// Opens the plate, resolves frames, spaces and textures, and checks that every file needed by the
/// render exists. `project` has resolved paths. Errors: Usage (contradictory settings, frames that
/// the plate lacks), Unreadable, MissingFrames (with the numbers).
[[nodiscard]] Expected<std::shared_ptr<const Shot>> open_shot(const Project& project,
                                                              const OpenShotOptions& options = {});

/// The shot's project with the default reference frames written into it.
[[nodiscard]] Project with_references(const Shot& shot);

/// The warning about a reference frame that does not show the region.
[[nodiscard]] std::string empty_reference_text(const std::string& region,
                                               const ShotReference& reference);

/// Checks licences. Errors: Refused, naming every texture whose licence the project excludes.
[[nodiscard]] Status check_texture_licences(const Shot& shot);

}  // namespace weft
