#include "app/exchange/look.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/project/codec/project_file.h"
#include "app/project/codec/project_json.h"
#include "app/project/edit.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kLookSchema = "weft.look/1";

// Paths below `folder` become relative to it; others are unchanged.
std::string relative_to(const std::string& path, const fs::path& folder, bool also_beside) {
    if (names_library_texture(path)) return path;
    std::error_code error;
    const fs::path whole = fs::absolute(path, error).lexically_normal();
    const fs::path base = fs::absolute(folder.empty() ? fs::path(".") : folder, error);
    const fs::path relative = whole.lexically_relative(base.lexically_normal());
    const bool below = !relative.empty() && *relative.begin() != "..";
    return below || (also_beside && !relative.empty()) ? relative.string() : whole.string();
}

// Copies the look of `from` to the region `to`.
Region with_look_of(Region to, const Region& from) {
    to.texture = from.texture;
    const Placement shot = to.placement;
    to.placement = from.placement;
    to.placement.uv = shot.uv;
    to.placement.uv_layer = shot.uv_layer;
    to.placement.warp = shot.warp;
    to.form.amount = from.form.amount;
    to.form.amount_keys = from.form.amount_keys;
    to.synthesis = from.synthesis;
    to.temporal = from.temporal;
    const LightParams passes = to.light;
    to.light = from.light;
    to.light.albedo = passes.albedo;
    to.light.lighting = passes.lighting;
    to.light.pass_layer = passes.pass_layer;
    to.light.exact = passes.exact;
    to.grade = from.grade;
    to.layer = from.layer;
    to.finish = from.finish;
    return to;
}

Expected<Project> load_look(const std::string& path) {
    const auto bad = [&](const std::string& why) {
        return fail(ErrorCode::kUnreadable, path + " is not a look: " + why + ".",
                    "Give a saved look" + by({{setting::kSaveLook}}) + ".");
    };
    WEFT_TRY(text, read_file(path, "The look"));
    const OrderedJson json = OrderedJson::parse(text, nullptr, false);
    if (!json.is_object() || json.value("schema", OrderedJson()) != kLookSchema ||
        !json.contains("look"))
        return bad(std::string("it is not of the schema ") + kLookSchema);
    auto look = project_from_json(json["look"].dump());
    if (!look) return fail_in(std::move(look).error(), path);
    if (look->regions.empty()) return bad("it has no region");
    return resolve_paths(*look, project_dir(path));
}

}  // namespace

Status save_look(const std::string& path, const Project& project, const std::string& region,
                 const WriteRule& rule) {
    Project look;
    if (region.empty()) {
        look.regions = project.regions;
    } else {
        WEFT_TRY(index, find_region(project, region));
        look.regions = {project.regions[index]};
    }
    if (look.regions.empty()) return fail(ErrorCode::kUsage, "The project has no region.");
    for (Leaf<Region>& leaf : look.regions) {
        Region only = with_look_of(Region{}, *leaf);
        only.id = leaf->id;
        only.name = leaf->name;
        look.next_region_id = std::max(look.next_region_id, only.id + 1);
        leaf = std::move(only);
    }
    look = map_paths(look, [&](const std::string& file) {
        return relative_to(file, fs::path(path).parent_path(), true);
    });
    WEFT_TRY(text, project_to_json(look));
    const OrderedJson json{{"schema", kLookSchema}, {"look", OrderedJson::parse(text)}};
    WEFT_CHECK_OK(make_folder_of(path, rule));
    return write_file_atomically(path, json.dump(2) + "\n", rule);
}

Expected<Project> apply_look(const std::string& path, const Project& project,
                             const std::string& folder, const std::string& region) {
    WEFT_TRY(look, load_look(path));
    look =
        map_paths(look, [&](const std::string& file) { return relative_to(file, folder, false); });
    Project out = project;
    int fitting = 0;
    for (const Leaf<Region>& from : look.regions) {
        const bool single = look.regions.size() == 1;
        const bool only = single && region.empty() && project.regions.size() == 1;
        const std::string name = single && !region.empty() ? region : from->name;
        const auto index = only ? Expected<std::size_t>(std::size_t{0}) : find_region(out, name);
        if (!index) continue;
        ++fitting;
        const Region& was = *out.regions[*index];
        WEFT_TRY(changed, apply_edits(out, region_edits(was, with_look_of(was, *from))));
        out = std::move(changed);
    }
    if (fitting > 0) return out;
    return fail(ErrorCode::kUsage, "No region of the project has the name of one of the look's.",
                "Choose a region" + by({{setting::kRegion}}) + ".");
}

}  // namespace weft
