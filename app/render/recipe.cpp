#include "app/render/recipe.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/project/codec/project_json.h"
#include "app/render/report.h"
#include "app/shot/shot_inputs.h"
#include "engine/core/frame_range.h"
#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string joined(const std::set<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts)
        out += (out.empty() ? "" : ", ") + text;
    return out;
}

// The project reduced to settings that affect pixels.
Project pixel_settings(const Project& project) {
    Project out = map_paths(project, [](const std::string& path) {
        return names_library_texture(path) ? path : fs::path(path).filename().string();
    });
    out.name.clear();
    out.settings.frames.clear();
    out.settings.excluded_licences.clear();
    out.output.path = fs::path(project.output.path).extension().string();
    out.output.movie.clear();
    out.output.layers_path.clear();
    out.output.burn_in = false;
    std::erase_if(out.regions, [](const Leaf<Region>& region) { return !region->enabled; });
    for (Leaf<Region>& region : out.regions) {
        region = region.with([](Region& r) {
            r.name.clear();
            r.color = 0;
            // The plan has them, including those chosen automatically.
            r.reference_frames.clear();
            // Textures are hashed by their pixels.
            r.texture.sample.clear();
            r.texture.also.clear();
            r.texture.plane.clear();
        });
    }
    out.next_region_id = 0;
    return out;
}

Json textures_of(const Shot& shot) {
    Json out = Json::array();
    const auto add = [&](const ShotTexture& t) {
        out.push_back({{"id", t.id},
                       {"licence", t.licence.empty() ? "unknown" : t.licence},
                       {"author", t.author.empty() ? "unknown" : t.author}});
    };
    for (const ShotTexture& t : shot.textures) {
        add(t);
        for (const ShotTexture& further : t.also)
            add(further);
    }
    return out;
}

}  // namespace

std::string settings_hash(const Shot& shot) {
    Hasher hasher;
    // A name that is not UTF-8 cannot be written as JSON; spaces and textures are still hashed.
    if (const auto text = project_to_json(pixel_settings(shot.project))) hasher.text(*text);
    hasher.text(shot.spaces.plate.name).text(shot.spaces.working.name).text(shot.spaces.out.name);
    for (const ColorSpace& space : shot.spaces.textures)
        hasher.text(space.name);
    for (const ShotTexture& t : shot.textures) {
        hasher.text(t.id);
        for (const ShotTexture& further : t.also)
            hasher.text(further.id);
    }
    for (const RegionPlan& region : shot.plan.regions) {
        hasher.value(static_cast<std::uint64_t>(region.reference_frames.size()));
        for (const int frame : region.reference_frames)
            hasher.value(frame);
    }
    return hasher.finish().hex();
}

Metadata recipe_metadata(const Shot& shot, const std::string& backend) {
    std::set<std::string> ids, licences;
    const auto add = [&](const ShotTexture& t) {
        ids.insert(t.id);
        licences.insert(t.licence.empty() ? "unknown" : t.licence);
    };
    for (const ShotTexture& t : shot.textures) {
        add(t);
        for (const ShotTexture& further : t.also)
            add(further);
    }
    return {
        {"weft:version", kVersion},     {"weft:settings", settings_hash(shot)},
        {"weft:backend", backend},      {"weft:seed", std::to_string(shot.project.settings.seed)},
        {"weft:textures", joined(ids)}, {"weft:licences", joined(licences)}};
}

Expected<std::string> recipe_json(const Shot& shot, const JobResult& result) {
    std::error_code ignored;
    const Project absolute = map_paths(shot.project, [&](const std::string& path) {
        return names_library_texture(path) ? path : fs::absolute(path, ignored).string();
    });
    WEFT_TRY(project, project_to_json(absolute));
    Json inputs = Json::array(), frames = Json::array();
    WEFT_TRY(files, input_files(shot));
    for (const std::string& path : files) {
        WEFT_TRY(hash, shot.files->contents(path));
        inputs.push_back({{"path", fs::absolute(path, ignored).string()}, {"hash", hash.hex()}});
    }
    for (const FrameResult& f : result.frames) {
        WEFT_TRY(hash, hash_of_contents(f.path));
        frames.push_back({{"frame", f.frame},
                          {"path", fs::absolute(f.path, ignored).string()},
                          {"hash", hash.hex()}});
    }
    const Json recipe{{"schema", "weft.recipe/1"},
                      {"version", kVersion},
                      {"settings", settings_hash(shot)},
                      {"backend", result.backend},
                      {"seed", shot.project.settings.seed},
                      {"textures", textures_of(shot)},
                      {"inputs", inputs},
                      {"frames", frames},
                      {"project", Json::parse(project)}};
    return recipe.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

// One line per input and frame: 256 MB is enough for a million files.
constexpr std::uint64_t kRecipeLimit_bytes = std::uint64_t{256} << 20;

struct NamedFile {
    int frame = 0;
    std::string path, hash;
};

struct Recipe {
    std::string version, settings, backend;
    Project project;
    std::vector<NamedFile> inputs, frames;
};

Expected<Recipe> load_recipe(const std::string& path) {
    const auto bad = [&](const std::string& why) {
        return fail(ErrorCode::kUnreadable, path + " is not a recipe: " + why + ".",
                    "Give a file that a render wrote" + by({{setting::kRecipe}}) + ".");
    };
    WEFT_TRY(text, read_file(path, "The recipe", kRecipeLimit_bytes));
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || json.value("schema", Json()) != "weft.recipe/1")
        return bad("it is not of the schema weft.recipe/1");
    try {
        Recipe recipe;
        recipe.version = json.at("version").get<std::string>();
        recipe.settings = json.at("settings").get<std::string>();
        recipe.backend = json.at("backend").get<std::string>();
        for (const Json& entry : json.at("inputs")) {
            recipe.inputs.push_back(
                {0, entry.at("path").get<std::string>(), entry.at("hash").get<std::string>()});
        }
        for (const Json& entry : json.at("frames")) {
            recipe.frames.push_back({entry.at("frame").get<int>(),
                                     entry.at("path").get<std::string>(),
                                     entry.at("hash").get<std::string>()});
        }
        WEFT_TRY(project, project_from_json(json.at("project").dump()));
        recipe.project = std::move(project);
        return recipe;
    } catch (const nlohmann::json::exception&) {
        return bad("an entry is missing or of another type");
    }
}

void compare(const std::string& what, const std::string& path, const std::string& hash,
             VerifyResult& result) {
    const auto now = hash_of_contents(path);
    if (!now)
        result.differences.push_back(what + " " + path + " is not there any more");
    else if (now->hex() != hash)
        result.differences.push_back(what + " " + path + " is not what it was");
}

}  // namespace

Expected<VerifyResult> verify_recipe(const VerifyOptions& options, const CancelToken& cancel,
                                     const ProgressFn& progress) {
    WEFT_TRY(recipe, load_recipe(options.recipe));
    VerifyResult result;
    std::vector<int> wanted;
    for (const NamedFile& frame : recipe.frames)
        wanted.push_back(frame.frame);
    if (!options.frames.empty()) {
        WEFT_TRY(list, parse_frame_list(options.frames));
        wanted = std::move(list);
    }
    const auto is_wanted = [&](const NamedFile& f) {
        return std::find(wanted.begin(), wanted.end(), f.frame) != wanted.end();
    };
    if (recipe.version != kVersion) {
        result.warnings.push_back("The recipe is of weft " + recipe.version + ", this is weft " +
                                  kVersion + ": bytes may differ for that.");
    }
    for (const NamedFile& input : recipe.inputs)
        compare("The input", input.path, input.hash, result);
    result.inputs = static_cast<int>(recipe.inputs.size());
    for (const NamedFile& frame : recipe.frames) {
        if (!is_wanted(frame)) continue;
        compare("The frame", frame.path, frame.hash, result);
        ++result.frames;
    }
    if (result.frames == 0)
        return fail(ErrorCode::kUsage, "The recipe has none of the requested frames.",
                    "Choose frames that it has" + by({{setting::kFrames}}) + ".");
    if (!options.rerender) return result;

    WEFT_TRY(folder, TemporaryFolder::create());
    JobSpec spec = options.run;
    spec.project = recipe.project;
    spec.project.output.movie.clear();
    if (!spec.project.output.layers_path.empty())
        spec.project.output.layers_path =
            (fs::path(folder.path()) / "layers" / "####.exr").string();
    spec.project.output.path =
        (fs::path(folder.path()) / fs::path(recipe.project.output.path).filename()).string();
    spec.project.settings.frames = format_frame_list(wanted);
    spec.backend = recipe.backend;
    WEFT_TRY(again, run_job(spec, cancel, progress));
    WEFT_CHECK_OK(check_unchanged(again.changed_inputs));
    for (const NamedFile& frame : recipe.frames) {
        const auto at = std::find_if(again.frames.begin(), again.frames.end(),
                                     [&](const FrameResult& f) { return f.frame == frame.frame; });
        if (!is_wanted(frame) || at == again.frames.end()) continue;
        WEFT_TRY(hash, hash_of_contents(at->path));
        if (hash.hex() != frame.hash) {
            result.differences.push_back("Rendering frame " + std::to_string(frame.frame) +
                                         " again gives other bytes");
        }
    }
    return result;
}

}  // namespace weft
