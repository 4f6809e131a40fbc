#include "app/session/textures/texture_choices.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/base/background.h"
#include "app/exchange/kept_textures.h"
#include "app/project/codec/project_file.h"
#include "app/session/textures/texture_pitch.h"
#include "app/textures/larger_original.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// A texture of the library, copied to `folder`.
Expected<std::string> kept_library_texture(const std::string& library, const std::string& path,
                                           const std::vector<std::string>& excluded_licences,
                                           const std::string& folder) {
    WEFT_TRY(texture, resolve_texture(library, path));
    WEFT_CHECK_OK(check_licences({texture.credit}, excluded_licences));
    return keep_texture(texture, folder);
}

// As a project in the folder `dir` names it; empty: never saved.
std::string named_from(const std::string& dir, const std::string& path) {
    return dir.empty() ? path : fs::path(path).lexically_relative(dir).string();
}

}  // namespace

std::string TextureChoices::folder() const {
    const std::string& project = use_.document.path();
    return (project.empty() ? fs::path(use_.state_folder) / "unsaved" / "textures"
                            : fs::path(use_.document.folder()) / kept_textures_name(project))
        .string();
}

void TextureChoices::apply(const std::string& path, RegionId id) {
    const Region* target = region(id);
    if (!target) {
        use_.notices.add(NoticeKind::kWarning, "Select a region for this texture.");
        return;
    }
    if (names_library_texture(path)) return fetch(path, id);
    TextureSource texture = target->texture;
    texture.sample = path;
    texture.plane.clear();
    use_.document.edit(SetTexture{{id, {}}, texture});
    auto& recent = use_.settings.recent_textures;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 24;
    if (recent.size() > kMost) recent.resize(kMost);
}

void TextureChoices::fetch(const std::string& path, RegionId id) {
    Fetching copy;
    copy.region = id;
    copy.path = in_background(
        [path, to = folder(), library = use_.library,
         excluded = licence_list(use_.document.project().settings.excluded_licences)] {
            return kept_library_texture(library, path, excluded, to);
        });
    fetching_ = std::move(copy);
}

void TextureChoices::take() {
    if (!fetching_ ||
        fetching_->path.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Fetching done = std::move(*fetching_);
    fetching_.reset();
    const auto path = done.path.get();
    if (!path) {
        use_.notices.add(NoticeKind::kError, path.error().text());
        return;
    }
    apply(named_from(use_.document.folder(), *path), done.region);
}

void TextureChoices::forget() {
    if (fetching_) use_.shutdowns.end(std::move(fetching_->path));
    fetching_.reset();
}

// Copies library textures beside the project first, then changes all regions in one step.
void TextureChoices::apply_all(const ApplyTextures& action) {
    if (action.textures.empty()) return;
    using Kept = std::vector<std::pair<RegionId, std::string>>;
    use_.tasks.start_for_document(
        [this, wanted = action.textures, to = folder(), dir = use_.document.folder(),
         library = use_.library,
         excluded = licence_list(
             use_.document.project().settings.excluded_licences)]() -> DocumentTasks::Finish {
            const auto fetch_all = [&]() -> Expected<Kept> {
                Kept kept = wanted;
                for (auto& [id, path] : kept) {
                    if (!names_library_texture(path)) continue;
                    WEFT_TRY(file, kept_library_texture(library, path, excluded, to));
                    path = named_from(dir, file);
                }
                return kept;
            };
            const auto kept = fetch_all();
            return [this, kept] {
                if (!kept) return use_.notices.add(NoticeKind::kError, kept.error().text());
                std::vector<Edit> edits;
                for (const auto& [id, path] : *kept) {
                    const Region* target = region(id);
                    if (!target) continue;
                    TextureSource texture = target->texture;
                    texture.sample = path;
                    texture.plane.clear();
                    edits.push_back(SetTexture{{id, {}}, texture});
                }
                use_.document.commit(edits, "Textures for " + std::to_string(edits.size()) +
                                                (edits.size() == 1 ? " region" : " regions"));
            };
        });
}

void TextureChoices::use_larger_original(RegionId id) {
    const Region* target = region(id);
    if (!target || target->texture.sample.empty()) {
        use_.notices.add(NoticeKind::kWarning, "Choose a texture from the library first.");
        return;
    }
    const std::string dir = use_.document.folder();
    use_.tasks.start_for_document([this, id, sample = resolve_path(dir, target->texture.sample),
                                   to = folder(), dir,
                                   library = use_.library]() -> DocumentTasks::Finish {
        const auto larger = keep_larger_original(library, sample, to);
        return [this, id, larger, dir] {
            const Region* now = region(id);
            if (!now) return;
            if (!larger) return use_.notices.add(NoticeKind::kWarning, larger.error().text());
            TextureSource texture = now->texture;
            texture.sample = named_from(dir, larger->path);
            // Same size on the plate: the original has more pixels for the same piece of surface.
            const double scale = now->placement.scale / static_cast<double>(larger->scale);
            use_.document.commit({SetTexture{{id, {}}, texture},
                                  SetRegionParameter{{id, {}}, "placement.scale", scale}},
                                 "Larger original for " + now->name);
        };
    });
}

void TextureChoices::scale_by_line(Vec2 line, double count, RegionId id) {
    const Region* target = region(id);
    if (!target || target->texture.sample.empty() || count <= 0) {
        use_.notices.add(NoticeKind::kWarning, "Choose a texture to synthesize first.");
        return;
    }
    const double length = std::hypot(static_cast<double>(line.x), static_cast<double>(line.y));
    use_.tasks.start_for_document(
        [this, path = resolve_path(use_.document.folder(), target->texture.sample), line, length,
         count, id]() -> DocumentTasks::Finish {
            const auto pitch = texture_pitch(path, line);
            return [this, pitch, length, count, id] {
                if (!pitch) return use_.notices.add(NoticeKind::kWarning, pitch.error().text());
                use_.document.edit(
                    SetRegionParameter{{id, {}}, "placement.scale", length / (count * *pitch)});
            };
        });
}

}  // namespace weft
