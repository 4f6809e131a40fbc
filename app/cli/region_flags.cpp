#include "app/cli/region_flags.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "app/session/memory_plan.h"
#include "engine/media/decode_limit.h"

namespace weft {
namespace {

std::string help_of(const ParameterInfo& info) {
    std::string help(info.help);
    const std::string allowed = allowed_values(info);
    if (!allowed.empty() && info.kind != ParameterKind::kFrames) help += " (" + allowed + ")";
    const std::string standard = format_parameter(info, info.default_value);
    if (!standard.empty() && info.kind != ParameterKind::kFlag) help += " [" + standard + "]";
    return help;
}

bool begins_with_any(std::string_view flag, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), flag) != names.end();
}

bool is_plate_flag(std::string_view flag) {
    return begins_with_any(
        flag, {"--plate", "--plate-layer", "--movie-start", "--plate-space", "--fps", "--missing"});
}

bool is_output_flag(std::string_view flag) {
    return begins_with_any(flag,
                           {"--output", "--depth", "--jpeg-quality", "--exr-compression", "--movie",
                            "--out-space", "--burn-in", "--layers", "--layers-output"});
}

bool is_matte_flag(std::string_view flag) {
    return begins_with_any(flag, {"--matte-value", "--matte-channel", "--matte-invert",
                                  "--matte-steadiness", "--matte-frozen", "--matte-frozen-files",
                                  "--matte-carry", "--matte-from", "--matte-to"});
}

}  // namespace

template <class Owner>
void ProjectFlags::add(CLI::App& command, const Parameter<Owner>& parameter,
                       std::list<Given<Owner>>& into) {
    into.push_back({&parameter, {}, false, nullptr});
    Given<Owner>& given = into.back();
    std::string names(parameter.flag);
    if (names == "--output") names = "-o," + names;
    if (parameter.kind == ParameterKind::kFlag) {
        given.option = command.add_flag(names, given.flag, help_of(parameter));
        return;
    }
    CLI::Option* option = command.add_option(names, given.texts, help_of(parameter));
    if (parameter.kind == ParameterKind::kCorners) {
        option->expected(4);
    } else {
        option->expected(1);
        option->multi_option_policy(parameter.repeatable ? CLI::MultiOptionPolicy::TakeAll
                                                         : CLI::MultiOptionPolicy::TakeLast);
    }
    option->type_name(parameter.is_path        ? "PATH"
                      : parameter.unit.empty() ? ""
                                               : std::string(parameter.unit));
}

ProjectFlags::ProjectFlags(CLI::App& command, const Which& which) {
    for (const auto& parameter : project_parameters()) {
        if (parameter.flag.empty() || parameter.flag == "--project-name") continue;
        const bool plate = is_plate_flag(parameter.flag), output = is_output_flag(parameter.flag);
        if (plate    ? which.plate
            : output ? which.output
                     : which.render || (which.plate && parameter.flag == "--frames")) {
            add(command, parameter, project_);
        }
    }
    if (which.matte) {
        command
            .add_option("--matte", mattes_,
                        "Matte for every frame ('masks/####.png'), a painted keyframe "
                        "(12=a.png, repeatable), or objects of a Cryptomatte (crypto:NAME)")
            ->type_name("PATH")
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command
            .add_option(
                "--holdout", holdouts_,
                "Matte of what passes in front of the surface: a pattern, painted keyframes "
                "(12=a.png), or crypto:NAME; repeatable")
            ->type_name("PATH")
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command
            .add_option("--crypto-files", crypto_files_,
                        "EXR files with the Cryptomatte; default the plate")
            ->type_name("PATH");
    }
    for (const auto& parameter : region_parameters()) {
        if (parameter.flag.empty()) continue;
        if (is_matte_flag(parameter.flag) ? which.matte : which.region)
            add(command, parameter, region_);
    }
}

namespace {

// One flag's texts as the table reads them: the last one, all of a repeatable one, four corners.
std::string joined(const ParameterInfo& info, const std::vector<std::string>& texts) {
    if (!info.repeatable && info.kind != ParameterKind::kCorners) return texts.back();
    std::string out;
    for (const std::string& t : texts) {
        if (!out.empty())
            out += info.kind == ParameterKind::kCorners ? ' '
                   : info.kind == ParameterKind::kPaths ? '\n'
                                                        : ',';
        out += t;
    }
    return out;
}

template <class Owner, class List>
Status apply_given(Owner& owner, const List& given) {
    for (const auto& g : given) {
        if (g.parameter->kind == ParameterKind::kFlag) {
            if (g.option->count() > 0)
                WEFT_CHECK_OK(set_parameter_text(owner, *g.parameter, g.flag ? "true" : "false"));
        } else if (!g.texts.empty()) {
            WEFT_CHECK_OK(set_parameter_text(owner, *g.parameter, joined(*g.parameter, g.texts)));
        }
    }
    return {};
}

}  // namespace

Status ProjectFlags::apply(Project& project) const {
    return apply_given(project, project_);
}

Status ProjectFlags::apply(Region& region) const {
    WEFT_CHECK_OK(apply_given(region, region_));
    if (!mattes_.empty()) {
        MatteSource matte = *region.matte;  // how it is read stays
        matte.files.clear();
        matte.keyframes.clear();
        matte.select.crypto.clear();
        for (const std::string& text : mattes_)
            WEFT_CHECK_OK(add_matte_text(matte, text));
        if (!matte.select.crypto.empty()) matte.files = crypto_files_;
        region.matte = matte;
    }
    if (!holdouts_.empty()) {
        std::vector<MatteSource> holdouts;
        for (const std::string& text : holdouts_) {
            MatteSource holdout;
            WEFT_CHECK_OK(add_matte_text(holdout, text));
            if (!holdout.select.crypto.empty()) holdout.files = crypto_files_;
            // What is painted on several frames is one layer.
            const auto painted =
                std::find_if(holdouts.begin(), holdouts.end(),
                             [](const MatteSource& h) { return !h.keyframes.empty(); });
            if (!holdout.keyframes.empty() && painted != holdouts.end())
                painted->keyframes.insert(holdout.keyframes.begin(), holdout.keyframes.end());
            else
                holdouts.push_back(std::move(holdout));
        }
        region.holdouts = std::move(holdouts);
    }
    return {};
}

Expected<Project> ProjectFlags::project() const {
    Project project;
    WEFT_CHECK_OK(apply(project));
    Region region;
    region.id = project.next_region_id++;
    region.name = "region";
    WEFT_CHECK_OK(apply(region));
    project.regions.emplace_back(std::move(region));
    return project;
}

namespace {

void add_library_option(CLI::App& command, std::string& library) {
    command
        .add_option("--db", library,
                    "Library of the textures 'db:ID'; default: the user's own (weft texture)")
        ->type_name("FILE");
}

}  // namespace

std::shared_ptr<std::string> add_library_flag(CLI::App& command) {
    auto library = std::make_shared<std::string>();
    add_library_option(command, *library);
    return library;
}

void add_progress_flags(CLI::App& command, RunOptions& run) {
    const std::map<std::string, ProgressStyle> styles{{"plain", ProgressStyle::kPlain},
                                                      {"json", ProgressStyle::kJson},
                                                      {"none", ProgressStyle::kNone},
                                                      {"openjd", ProgressStyle::kOpenJd}};
    command.add_option("--progress", run.progress, "plain, json, openjd or none [plain]")
        ->transform(CLI::CheckedTransformer(styles))
        ->type_name("");
    command.add_flag("--json", run.json, "One JSON object on stdout; progress goes to stderr");
}

namespace {

void add_memory_flag(CLI::App& command, RunOptions& run) {
    command
        .add_option_function<std::string>(
            "--memory",
            [&run](const std::string& text) {
                const auto bytes = parse_bytes(text);
                if (!bytes) throw CLI::ValidationError("--memory", bytes.error().message);
                run.memory_bytes = *bytes;
                set_decode_limit_bytes(*bytes / 2);  // before any picture is opened
            },
            "Memory to keep to (3G, 800M): fewer frames are worked on side by side")
        ->type_name("BYTES");
}

}  // namespace

void add_map_flag(CLI::App& command, RunOptions& run) {
    command
        .add_option_function<std::vector<std::string>>(
            "--map",
            [&run](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    const auto map = parse_root_map(text);
                    if (!map) throw CLI::ValidationError("--map", map.error().message);
                    run.maps.push_back(*map);
                }
            },
            "FROM=TO: paths below FROM are below TO on this machine; repeatable")
        ->type_name("")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string assets_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto installed = program.parent_path().parent_path() / "share" / "weft" / "assets";
    if (!error && std::filesystem::exists(installed, error)) return installed.string();
    return WEFT_ASSETS_DIR;
}

void add_run_flags(CLI::App& command, RunOptions& run, bool renders) {
    command.add_option("--threads", run.threads, "Threads to use; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--cache", run.cache.folder,
                    "Folder for analyses that later runs find again [~/.cache/weft]")
        ->type_name("PATH");
    command.add_flag("!--no-cache", run.cache.keep, "Keep nothing of the analysis");
    command.add_flag("--overwrite", run.overwrite, "Replace output files that exist");
    add_progress_flags(command, run);
    if (!renders) return;
    command.add_flag("--skip-existing", run.skip_existing,
                     "Keep frames that are there and can be read");
    command.add_flag("--resume", run.resume,
                     "Keep frames that are there and were rendered with these very settings");
    add_map_flag(command, run);
    command
        .add_option_function<std::string>(
            "--stage",
            [&run](const std::string& text) {
                const auto stage = parse_job_stage(text);
                if (!stage) throw CLI::ValidationError("--stage", stage.error().message);
                run.stage = *stage;
            },
            "A part of the render, for a farm: motion, analyse, planes, frames, encode [all]")
        ->type_name("");
    command.add_flag("--version-up", run.version_up,
                     "Write to the next free version: v003 in the output's path becomes v004");
    command.add_flag("--restart", run.overwrite, "As --overwrite: render all frames again");
    command.add_option("--recipe", run.recipe, "Write what 'weft verify' needs here")
        ->type_name("PATH");
    add_memory_flag(command, run);
    add_library_option(command, run.texture_library);
    command.add_option("--backend", run.backend, "auto, cpu or cuda [auto]")->type_name("");
    command.add_option("--report", run.report, "Write a JSON report here")->type_name("PATH");
    command.add_flag("--dry-run", run.dry_run, "Say what would be rendered, and stop");
}

}  // namespace weft
