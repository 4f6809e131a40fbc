#pragma once
// A project opened for work: its files found, its spaces and textures read.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "app/shot/input_watch.h"
#include "app/shot/painted_mattes.h"
#include "app/shot/reference_choice.h"
#include "app/shot/scene_cuts.h"
#include "engine/media/frame_cache.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The colour spaces that a shot works in, given or by the file types.
struct ShotSpaces {
    ColorSpace plate, working, out;
    std::vector<ColorSpace> textures;  ///< One a region.
};

/// A texture as the report names it.
struct ShotTexture {
    std::string region, path, id;  ///< id: hash of the decoded pixels.
    Size size;
    bool is_plane = false;
    /// Of a texture that came from a library; empty: not known.
    std::string library_id, author, licence, source;
    std::vector<ShotTexture> also;  ///< Further samples that are grown together with it.
};

/// Where a region's texture is placed.
struct ShotReference {
    int frame = 0;
    bool by_default = true;      ///< choose_reference() chose it.
    bool shows_nothing = false;  ///< The matte is known to be empty there.
    std::optional<int> better;   ///< Then a frame that shows the surface, if there is one.
};

/// Everything that analysing and rendering need. Shared and immutable once made; thread-safe.
struct Shot {
    Project project;                        ///< With absolute paths.
    std::vector<std::size_t> region_index;  ///< Of each planned region in the project.
    std::shared_ptr<const CachedReader> plate;
    std::shared_ptr<const ShotSource> source;
    ShotPlan plan;
    ShotSpaces spaces;
    std::vector<ShotTexture> textures;
    std::vector<ShotReference> references;  ///< One a planned region.
    std::vector<std::string> notes;         ///< What was decided by itself and is worth knowing.
    std::vector<std::string> warnings;
    std::shared_ptr<CutWatch> cuts;      ///< Has seen every plate that was read.
    std::shared_ptr<InputWatch> inputs;  ///< Has seen every file that was read; null: not asked.
    PaintedMattes painted;               ///< Mattes that are read from memory.
};

/// The depth that the output will have: what the user chose, or what the plate and the format
/// suggest.
[[nodiscard]] PixelDepth output_depth(const Output& output, PixelDepth plate);

struct OpenShotOptions {
    std::size_t cache_bytes = 256u << 20;  ///< For decoded plates.
    bool textures = true;                  ///< Without: enough to propagate mattes.
    bool watch_inputs = false;             ///< Makes Shot::inputs.
    /// Frames to do without where they only serve to measure light, grain or motion blur.
    std::vector<int> leave_out;
    std::string texture_library;  ///< For "db:ID"; empty: the user's own.
    /// Mattes that were looked at for another version of the shot; null: none.
    std::shared_ptr<VisibilityCache> visibility;
    /// Painted mattes that may not be on the disk yet.
    PaintedMattes painted;
    /// The plate of this very project, when it is open already; null: it is opened.
    std::shared_ptr<const CachedReader> plate;
};

/// Opens the plate, resolves the frames, spaces and textures, and checks that every file that the
/// render will want is there. `project` has its paths resolved. Errors: Usage (contradictory
/// settings, frames that the plate has not), Unreadable, MissingFrames (with the numbers).
[[nodiscard]] Expected<std::shared_ptr<const Shot>> open_shot(const Project& project,
                                                              const OpenShotOptions& options = {});

/// The shot's project with the reference frames that were chosen by default written into it.
[[nodiscard]] Project with_references(const Shot& shot);

/// The warning about a reference frame that shows nothing of the region.
[[nodiscard]] std::string empty_reference_text(const std::string& region,
                                               const ShotReference& reference);

/// Errors: Refused, naming every texture under a licence that the project excludes.
[[nodiscard]] Status check_texture_licences(const Shot& shot);

}  // namespace weft
