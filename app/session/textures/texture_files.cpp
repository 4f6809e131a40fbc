#include "app/session/textures/texture_files.h"

#include <algorithm>
#include <filesystem>

#include "app/project/codec/project_file.h"
#include "texture_db/library/library.h"

namespace weft {

void TextureFiles::follow() {
    std::vector<std::string> paths;
    for (const auto& region : document_.project().regions) {
        for (const std::string& path : {region->texture.sample, region->texture.plane}) {
            if (path.empty() || names_library_texture(path)) continue;
            paths.push_back(resolve_path(document_.folder(), path));
        }
    }
    std::sort(paths.begin(), paths.end());
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    if (paths == followed_) return;
    followed_ = paths;
    watch_.follow(std::move(paths));
}

std::vector<std::string> TextureFiles::take() {
    if (watch_.changes() == version_) return {};
    std::vector<std::string> saved = watch_.take();
    version_ += saved.size();
    for (const std::string& path : saved)
        notices_.add(NoticeKind::kInfo, "Shows " + std::filesystem::path(path).filename().string() +
                                            " as it was saved just now.");
    return saved;
}

}  // namespace weft
