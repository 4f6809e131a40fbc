#include "app/exchange/kept_textures.h"

#include <filesystem>
#include <map>
#include <vector>

#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Copies every library texture of the project. Returns the file of each "db:ID".
Expected<std::map<std::string, std::string>> keep_all(const Project& project,
                                                      const std::string& folder,
                                                      const std::string& library,
                                                      const WriteRule& rule) {
    std::vector<TextureCredit> credits;
    std::map<std::string, ResolvedTexture> textures;
    for (const Leaf<Region>& region : project.regions) {
        std::vector<std::string> names{region->texture.sample, region->texture.plane};
        names.insert(names.end(), region->texture.also.begin(), region->texture.also.end());
        for (const std::string& name : names) {
            if (!names_library_texture(name)) continue;
            auto texture = resolve_texture(library, name);
            if (!texture)
                return fail_in(std::move(texture).error(), "Region '" + region->name + "'");
            texture->credit.region = region->name;
            credits.push_back(texture->credit);
            textures.emplace(name, std::move(*texture));
        }
    }
    WEFT_CHECK_OK(check_licences(credits, licence_list(project.settings.excluded_licences)));
    std::map<std::string, std::string> files;
    for (const auto& [name, texture] : textures) {
        WEFT_TRY(path, keep_texture(texture, folder, rule));
        files.emplace(name, fs::path(path).filename().string());
    }
    return files;
}

}  // namespace

std::string kept_textures_name(const std::string& project_path) {
    return fs::path(project_path).stem().string() + "_textures";
}

Expected<Project> keep_library_textures(const Project& project, const std::string& folder,
                                        const std::string& named, const std::string& library,
                                        const WriteRule& rule) {
    WEFT_TRY(files, keep_all(project, folder, library, rule));
    if (files.empty()) return project;
    Project out = project;
    for (Leaf<Region>& leaf : out.regions) {
        leaf = leaf.with([&](Region& region) {
            const auto rename = [&](std::string& path) {
                if (const auto file = files.find(path); file != files.end())
                    path = (fs::path(named) / file->second).string();
            };
            rename(region.texture.sample);
            rename(region.texture.plane);
            for (std::string& path : region.texture.also)
                rename(path);
        });
    }
    return out;
}

Expected<Project> keep_library_textures(const Project& project, const std::string& project_path,
                                        const std::string& library, const WriteRule& rule) {
    const std::string name = kept_textures_name(project_path);
    const fs::path folder = fs::path(project_path).parent_path() / name;
    return keep_library_textures(project, folder.string(), name, library, rule);
}

}  // namespace weft
