// Choices of the user: textures for all regions, a larger original, an object of a Cryptomatte.
#include <algorithm>
#include <filesystem>

#include "app/base/background.h"
#include "app/exchange/kept_textures.h"
#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/textures/larger_original.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/cryptomatte_selection.h"
#include "engine/media/sequence_pattern.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Adds a name to a comma-separated list, or removes it.
std::string changed_names(const std::string& names, const std::string& name, bool subtract) {
    std::string out;
    const auto add = [&](std::string_view one) {
        out += (out.empty() ? "" : ",") + std::string(one);
    };
    for (const std::string& one : split_crypto_names(names))
        if (one != name) add(escaped_crypto_name(one));
    if (!subtract) add(escaped_crypto_name(name));
    return out;
}

}  // namespace

std::string Session::texture_folder() const {
    return (path_.empty() ? fs::path(options_.state_folder) / "unsaved" / "textures"
                          : fs::path(project_dir(path_)) / kept_textures_name(path_))
        .string();
}

// Copies library textures beside the project first, then changes all regions in one step.
void Session::apply_textures(const ApplyTextures& action) {
    if (action.textures.empty()) return;
    start_for_document(
        [this, wanted = action.textures, folder = texture_folder(), dir = project_dir(path_),
         library = options_.texture_library,
         excluded = licence_list(document().settings.excluded_licences)]() -> Finish {
            const auto fetch = [&]() -> Expected<std::vector<std::pair<RegionId, std::string>>> {
                auto kept = wanted;
                for (auto& [region, path] : kept) {
                    if (!names_library_texture(path)) continue;
                    WEFT_TRY(texture, resolve_texture(library, path));
                    WEFT_CHECK_OK(check_licences({texture.credit}, excluded));
                    WEFT_TRY(file, keep_texture(texture, folder));
                    path = dir.empty() ? file : fs::path(file).lexically_relative(dir).string();
                }
                return kept;
            };
            const auto kept = fetch();
            return [this, kept] {
                if (!kept) return notify(NoticeKind::kError, kept.error().text());
                std::vector<Edit> edits;
                for (const auto& [id, path] : *kept) {
                    const Region* region = region_by_id(document(), id);
                    if (!region) continue;
                    TextureSource texture = region->texture;
                    texture.sample = path;
                    texture.plane.clear();
                    edits.push_back(SetTexture{{id, {}}, texture});
                }
                auto changed = apply_edits(history_.current(), edits);
                if (!changed) return notify(NoticeKind::kError, changed.error().text());
                commit(std::move(*changed), "Textures for " + std::to_string(edits.size()) +
                                                (edits.size() == 1 ? " region" : " regions"));
            };
        });
}

void Session::use_larger_original(RegionId id) {
    const Region* region = region_by_id(document(), id);
    if (!region || region->texture.sample.empty()) {
        notify(NoticeKind::kWarning, "Choose a texture from the library first.");
        return;
    }
    const std::string sample = resolve_path(project_dir(path_), region->texture.sample);
    start_for_document([this, id, sample, folder = texture_folder(), dir = project_dir(path_),
                        library = options_.texture_library]() -> Finish {
        const auto larger = keep_larger_original(library, sample, folder);
        return [this, id, larger, dir] {
            const Region* now = region_by_id(document(), id);
            if (!now) return;
            if (!larger) return notify(NoticeKind::kWarning, larger.error().text());
            TextureSource texture = now->texture;
            texture.sample = dir.empty() ? larger->path
                                         : fs::path(larger->path).lexically_relative(dir).string();
            // Same size on the plate: the original has more pixels for the same piece of surface.
            auto changed = apply_edits(
                history_.current(),
                {SetTexture{{id, {}}, texture},
                 SetRegionParameter{{id, {}},
                                    "placement.scale",
                                    now->placement.scale / static_cast<double>(larger->scale)}});
            if (!changed) return notify(NoticeKind::kError, changed.error().text());
            commit(std::move(*changed), "Larger original for " + now->name);
        };
    });
}

void Session::pick_cryptomatte(const PickCryptomatte& action) {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !reader_) {
        notify(NoticeKind::kWarning, "Add a region first, then pick its objects.");
        return;
    }
    const MatteSource& source = layer_source(*region, layer_);
    const bool own = !source.select.crypto.empty() && !source.files.empty();
    const std::string files =
        own ? resolve_path(project_dir(path_), source.files) : reader_->path_of(playback_.frame());
    start_for_document([this, action, files, frame = playback_.frame(), id = region->id,
                        layer = layer_]() -> Finish {
        const auto pick = [&]() -> Expected<CryptoObject> {
            WEFT_TRY(pattern, SequencePattern::parse(files));
            return weft::pick_cryptomatte(pattern.path_for(frame), action.at.x, action.at.y);
        };
        const auto picked = pick();
        return [this, action, picked, id, layer] {
            const Region* now = region_by_id(document(), id);
            if (!now) return;
            if (!picked) return notify(NoticeKind::kWarning, picked.error().text());
            if (picked->name.empty())
                return notify(NoticeKind::kWarning, "The Cryptomatte has no object at this pixel.");
            const MatteSource& before = layer_source(*now, layer);
            MatteSource matte;
            matte.select.crypto =
                changed_names(before.select.crypto, picked->name, action.subtract);
            if (!before.select.crypto.empty()) matte.files = before.files;
            if (matte.select.crypto.empty()) matte.files.clear();
            auto changed =
                apply_edit(history_.current(), set_layer(*now, layer, matte, begun_zone_));
            if (!changed) return notify(NoticeKind::kError, changed.error().text());
            commit(std::move(*changed), (action.subtract ? "Subtract " : "Add ") + picked->name);
        };
    });
}

}  // namespace weft
