#pragma once
// Imports an artist's own pictures into a library.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "texture_db/library/library.h"

namespace weft {

struct ImportOptions {
    std::string material;  ///< Empty: from the names of file and folder, else "other".
    std::vector<std::string> tags;
    std::string author;
    std::string licence = "unknown";
    int most_per_picture = 30;
    /// Skips pictures that do not look like a texture; else only ones that are too small.
    bool strict = false;
    bool keep_originals = false;  ///< Copy the pictures into the library; else refer to the files.
};

struct ImportReport {
    int pictures = 0, samples = 0;
    int skipped = 0;  ///< Pictures that were imported before, or are maps other than colour.
    std::vector<std::pair<std::string, std::string>> refused;  ///< Path and reason.
    double seconds = 0;
};

/// Imports files and folders (with all subfolders; the subfolder becomes the category), in any
/// format that OpenImageIO reads. Of Poly Haven and ambientCG sets only the colour map is imported.
/// Pictures that cannot be read are reported and skipped. After an interruption the next call
/// continues; unchanged files are skipped. Errors: Unreadable if a given path does not exist; those
/// of the library; cancellation.
[[nodiscard]] Expected<ImportReport> import_pictures(TextureLibrary& library,
                                                     const std::vector<std::string>& paths,
                                                     const ImportOptions& options,
                                                     const CancelToken& cancel = {},
                                                     const ProgressFn& progress = {});

/// Imports a folder again whenever it changes (checked every `every_s` seconds), until cancelled.
/// Reports each round that found something.
[[nodiscard]] Status watch_folder(TextureLibrary& library, const std::string& folder,
                                  const ImportOptions& options, const CancelToken& cancel,
                                  const std::function<void(const ImportReport&)>& on_import,
                                  double every_s = 2);

/// Returns true if a file's name says normals, roughness, height and the like, not colour.
[[nodiscard]] bool is_other_map(const std::string& file_name);

}  // namespace weft
