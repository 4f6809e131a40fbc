#pragma once
// Brings an artist's own pictures into a library.

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
    bool strict = false;  ///< Leave out what looks like no texture; else only too small ones.
    bool keep_originals = false;  ///< Copy the pictures into the library; else refer to the files.
};

struct ImportReport {
    int pictures = 0, samples = 0;
    int skipped = 0;  ///< Pictures that were in already, or are maps other than colour.
    std::vector<std::pair<std::string, std::string>> refused;  ///< Path and why.
    double seconds = 0;
};

/// Files and folders (searched through all their subfolders; the subfolder becomes the category).
/// Any format that OpenImageIO reads. Of Poly Haven and ambientCG sets only the colour map is
/// taken. Pictures that cannot be read are reported and left out. Interrupted, the next call goes
/// on where this one stopped; files that have not changed since are skipped. Errors: Unreadable
/// when a given path does not exist; those of the library; cancellation.
[[nodiscard]] Expected<ImportReport> import_pictures(TextureLibrary& library,
                                                     const std::vector<std::string>& paths,
                                                     const ImportOptions& options,
                                                     const CancelToken& cancel = {},
                                                     const ProgressFn& progress = {});

/// Imports a folder again whenever something in it changes (looked at every `every_s` seconds),
/// until cancelled. Each round that found something is reported.
[[nodiscard]] Status watch_folder(TextureLibrary& library, const std::string& folder,
                                  const ImportOptions& options, const CancelToken& cancel,
                                  const std::function<void(const ImportReport&)>& on_import,
                                  double every_s = 2);

/// Whether a file's name says that it holds normals, roughness, heights and the like, not colour.
[[nodiscard]] bool is_other_map(const std::string& file_name);

}  // namespace weft
