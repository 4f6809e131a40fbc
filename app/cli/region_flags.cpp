#include "app/cli/region_flags.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/cli/zone_texts.h"
#include "app/project/codec/project_json.h"
#include "engine/core/input_file.h"

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

// The placeholder of a value in --help. The description gives the unit.
std::string placeholder(const ParameterInfo& info) {
    switch (info.kind) {
        case ParameterKind::kInteger:
            return "N";
        case ParameterKind::kNumber:
            return info.unit == "deg" ? "DEG" : info.unit == "px" ? "PX" : "X";
        case ParameterKind::kPoint:
        case ParameterKind::kCorners:
            return "X,Y";
        case ParameterKind::kRgb:
            return "R,G,B";
        case ParameterKind::kFrames:
            return "FRAMES";
        case ParameterKind::kPath:
        case ParameterKind::kPaths:
        case ParameterKind::kWarp:
            return "PATH";
        default:
            return info.is_path || !info.path_key.empty() ? "PATH" : "NAME";
    }
}

bool begins_with_any(std::string_view flag, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), flag) != names.end();
}

bool is_plate_flag(std::string_view flag) {
    return begins_with_any(flag, {"--plate", "--plate-layer", "--movie-start", "--plate-space",
                                  "--fps", "--pixel-aspect", "--missing"});
}

bool is_output_flag(std::string_view flag) {
    return begins_with_any(flag,
                           {"--output", "--depth", "--jpeg-quality", "--exr-compression", "--movie",
                            "--out-space", "--burn-in", "--layers", "--layers-output"});
}

bool is_matte_flag(std::string_view flag) {
    return begins_with_any(
        flag, {"--matte-value", "--matte-channel", "--matte-invert", "--matte-stabilize",
               "--matte-frozen", "--matte-frozen-files", "--matte-propagate", "--matte-from",
               "--matte-to", "--matte-min-island", "--matte-min-hole", "--matte-smooth",
               "--matte-choke", "--matte-choke-keys", "--matte-feather", "--matte-feather-keys",
               "--matte-blur", "--matte-blur-keys"});
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
    option->type_name(placeholder(parameter));
    if (parameter.old_flag.empty()) return;
    command.add_option(std::string(parameter.old_flag), given.texts)
        ->expected(1)
        ->multi_option_policy(option->get_multi_option_policy())
        ->group("");
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
        const auto add_repeatable = [&](const char* name, std::vector<std::string>& into,
                                        const char* help, const char* type) {
            command.add_option(name, into, help)
                ->type_name(type)
                ->expected(1)
                ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        };
        add_repeatable("--matte", mattes_,
                       "Matte for every frame ('masks/####.png', or a movie), a painted keyframe "
                       "(12=a.png, repeatable), or objects of a Cryptomatte (crypto:NAME)",
                       "PATH");
        add_repeatable("--matte-confirmed", confirmed_,
                       "Parts of a propagated matte that are right on a frame: the frame's matte "
                       "and the area in which it is (30=matte.png,area.png, repeatable)",
                       "FRAME=MATTE,AREA");
        add_repeatable("--holdout", holdouts_,
                       "Matte of what passes in front of the surface: a pattern, painted keyframes "
                       "(12=a.png), or crypto:NAME; repeatable",
                       "PATH");
        add_repeatable("--zone", zones_,
                       "Where the light has another strength: light=VALUE@MATTE, VALUE 0 to 2, "
                       "MATTE a pattern, painted keyframes (12=a.png) or crypto:NAME; repeatable",
                       "ZONE");
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

// Joins the values given to one flag in the form that the table parses: the last value, all values
// of a repeatable flag, or four corners.
std::string joined(const ParameterInfo& info, const std::vector<std::string>& texts) {
    if (!info.repeatable && info.kind != ParameterKind::kCorners) return texts.back();
    std::string out;
    for (const std::string& t : texts) {
        if (!out.empty())
            out += info.kind == ParameterKind::kCorners  ? ' '
                   : info.kind == ParameterKind::kPaths  ? '\n'
                   : info.kind == ParameterKind::kGuides ? ';'
                                                         : ',';
        out += t;
    }
    return out;
}

// A grid warp comes from a file as well, which holds what a project has under placement.warp.
template <class Owner>
Status set_text(Owner& owner, const Parameter<Owner>& parameter, const std::string& text) {
    if (parameter.kind != ParameterKind::kWarp || !text.ends_with(".json"))
        return set_parameter_text(owner, parameter, text);
    WEFT_TRY(json, read_file(text, "The grid warp"));
    auto warp = grid_warp_from_json(json);
    if (!warp) return fail_in(std::move(warp).error(), text);
    return set_parameter(owner, parameter, std::move(*warp));
}

template <class Owner, class List>
Status apply_given(Owner& owner, const List& given) {
    for (const auto& g : given) {
        if (g.parameter->kind == ParameterKind::kFlag) {
            if (g.option->count() > 0)
                WEFT_CHECK_OK(set_parameter_text(owner, *g.parameter, g.flag ? "true" : "false"));
        } else if (!g.texts.empty()) {
            WEFT_CHECK_OK(set_text(owner, *g.parameter, joined(*g.parameter, g.texts)));
        }
    }
    return {};
}

}  // namespace

bool ProjectFlags::given(std::string_view key) const {
    return std::any_of(project_.begin(), project_.end(), [&](const Given<Project>& g) {
        return g.parameter->full_key() == key && g.is_given();
    });
}

bool ProjectFlags::gives_region() const {
    return !mattes_.empty() || !confirmed_.empty() || !holdouts_.empty() || !zones_.empty() ||
           !crypto_files_.empty() ||
           std::any_of(region_.begin(), region_.end(),
                       [](const Given<Region>& g) { return g.is_given(); });
}

Status ProjectFlags::apply(Project& project) const {
    return apply_given(project, project_);
}

Status ProjectFlags::apply(Region& region) const {
    WEFT_CHECK_OK(apply_given(region, region_));
    if (!mattes_.empty()) {
        MatteSource matte = *region.matte;  // keeps channel, value and inversion
        matte.files.clear();
        matte.keyframes.clear();
        matte.confirmed.clear();
        matte.shape = {};
        matte.select.crypto.clear();
        for (const std::string& text : mattes_)
            WEFT_CHECK_OK(add_matte_text(matte, text));
        if (!matte.select.crypto.empty()) matte.files = crypto_files_;
        region.matte = matte;
    }
    if (!confirmed_.empty()) {
        MatteSource matte = *region.matte;
        matte.confirmed.clear();
        for (const std::string& text : confirmed_)
            WEFT_CHECK_OK(add_confirmed_text(matte, text));
        region.matte = matte;
    }
    if (!holdouts_.empty()) {
        std::vector<MatteSource> holdouts;
        for (const std::string& text : holdouts_) {
            MatteSource holdout;
            WEFT_CHECK_OK(add_matte_text(holdout, text));
            if (!holdout.select.crypto.empty()) holdout.files = crypto_files_;
            // Keyframes on several frames form one holdout layer.
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
    if (!zones_.empty()) {
        WEFT_TRY(zones, parse_zones(zones_, crypto_files_));
        region.zones = std::move(zones);
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

}  // namespace weft
