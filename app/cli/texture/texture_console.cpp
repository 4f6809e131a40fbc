#include "app/cli/texture/texture_console.h"

#include <cstdio>

#include "app/cli/console.h"
#include "engine/core/parallel.h"
#include "engine/core/printable.h"
#include "texture_db/catalogue/licence.h"

namespace weft {

std::string texture_library_path(const TextureCommandOptions& common) {
    return common.db.empty() ? default_library_path() : common.db;
}

// Commands that only read do not create a library, except the default one, which is filled with the
// starter textures on first use.
Expected<std::shared_ptr<TextureLibrary>> open_texture_library(const TextureCommandOptions& common,
                                                               bool create) {
    set_thread_count(common.threads);
    LibraryOptions options;
    options.create = create || common.db.empty();
    WEFT_TRY(library, TextureLibrary::open(texture_library_path(common), options));
    if (!create && common.db.empty()) {
        WEFT_TRY(size, library->size());
        if (size == 0) {
            print(stderr, "weft: first use: making the starter textures (under a minute)\n");
            WEFT_CHECK_OK(
                add_starter_textures(*library, cancel_on_signals(), [](const ProgressEvent& e) {
                    if (e.done % 640 == 0 || e.done == e.total) {
                        print(stderr, "weft: starter textures " + std::to_string(e.done) + "/" +
                                          std::to_string(e.total) + "\n");
                    }
                }));
        }
    }
    return library;
}

Status check_exclusions(TextureLibrary& library, const std::vector<std::string>& excluded) {
    if (excluded.empty()) return {};
    WEFT_TRY(stats, library.stats());
    std::vector<std::string> own;
    for (const FacetCount& licence : stats.licences)
        own.push_back(licence.value);
    return check_licence_names(excluded, own);
}

std::string texture_hit_line(const std::string& id, float score, const std::string& material,
                             const std::string& name, const std::vector<std::string>& reasons) {
    char head[96];
    std::snprintf(head, sizeof head, "%s  %.2f  %-12s ", id.substr(0, 12).c_str(),
                  static_cast<double>(score), material.c_str());
    std::string line = head + printable(name);
    for (std::size_t i = 0; i < reasons.size(); ++i)
        line += (i == 0 ? "  (" : "; ") + printable(reasons[i]);
    return line + (reasons.empty() ? "\n" : ")\n");
}

}  // namespace weft
