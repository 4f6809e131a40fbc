#include "app/render/composite_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "app/composites/composite.h"
#include "app/render/job_frames.h"
#include "app/render/plane_file.h"
#include "engine/color/grade.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/exr_frame.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

enum class TreeKind { kNuke, kFusion, kBlender };

std::optional<TreeKind> tree_kind(const std::string& path) {
    const std::string extension = lower_case(fs::path(path).extension().string());
    if (extension == ".nk") return TreeKind::kNuke;
    if (extension == ".comp") return TreeKind::kFusion;
    if (extension == ".py") return TreeKind::kBlender;
    return std::nullopt;
}

// The number in the name of a frame's file.
struct NumberInName {
    std::size_t begin = 0, length = 0;
};

// The digits of `path` that are its frame's number, which another frame's path confirms. None in a
// picture or a movie for all frames.
std::optional<NumberInName> number_in_name(const std::string& path, int frame,
                                           const std::string& other, int other_frame) {
    const std::size_t name = path.find_last_of('/') + 1;
    for (std::size_t end = path.size(); end > name; --end) {
        if (!std::isdigit(static_cast<unsigned char>(path[end - 1]))) continue;
        std::size_t begin = end;
        while (begin > name && std::isdigit(static_cast<unsigned char>(path[begin - 1])))
            --begin;
        int value = -1;
        std::from_chars(path.data() + begin, path.data() + end, value);
        const std::string after = path.substr(0, begin) +
                                  fmt::format("{:0{}d}", other_frame, end - begin) +
                                  path.substr(end);
        if (value == frame && after == other) return NumberInName{begin, end - begin};
        end = begin + 1;
    }
    return std::nullopt;
}

CompositePictures pictures_of(const std::string& path, std::optional<NumberInName> number,
                              const std::string& folder) {
    const auto seen_from = [&](const std::string& what) {
        const fs::path file(what);
        return (fs::path(real_path(file.string())).lexically_relative(folder)).generic_string();
    };
    CompositePictures out;
    out.first = seen_from(path);
    out.pattern = out.first;
    out.numbered = number.has_value();
    if (number)
        out.pattern.replace(out.first.size() - (path.size() - number->begin), number->length,
                            fmt::format("%0{}d", number->length));
    return out;
}

std::optional<NumberInName> plate_number(const CompositeSources& in) {
    const int first = in.frames.front(), last = in.frames.back();
    const FrameReader& plate = *in.shot.plate;
    return number_in_name(plate.path_of(first), first, plate.path_of(last), last);
}

std::optional<NumberInName> layers_number(const CompositeSources& in) {
    const int first = in.frames.front(), last = in.frames.back();
    return number_in_name(in.layers.path_for(first), first, in.layers.path_for(last), last);
}

std::optional<PlateCurve> plate_curve(const ShotSpaces& spaces) {
    if (spaces.plate == spaces.working) return PlateCurve::kNone;
    if (spaces.working.name != "linear") return std::nullopt;
    if (spaces.plate.name == "srgb") return PlateCurve::kSrgb;
    if (spaces.plate.name == "cineon") return PlateCurve::kCineon;
    return std::nullopt;
}

std::string plane_name(const std::string& tree, int id, bool one_region) {
    fs::path path(tree);
    // A number at the end would be taken for a frame's.
    const std::string region = one_region ? "" : "_region" + std::to_string(id);
    return path.replace_filename(path.stem().string() + region + "_plane.exr").string();
}

Composite composite_at(const std::string& file, const std::vector<std::string>& files,
                       const CompositeSources& in) {
    const Shot& shot = in.shot;
    const std::string folder = fs::path(real_path(file)).parent_path().string();
    Composite out;
    out.size = shot.plate->size();
    out.pixel_aspect = shot.plate->pixel_aspect();
    out.fps = movie_fps(shot);
    out.first = in.frames.front();
    out.last = in.frames.back();
    out.plate = pictures_of(shot.plate->path_of(out.first), plate_number(in), folder);
    out.layers = pictures_of(in.layers.path_for(out.first), layers_number(in), folder);
    out.plate_layer = shot.project.plate.layer;
    out.curve = plate_curve(shot.spaces).value_or(PlateCurve::kNone);
    out.one_region = in.plan.regions.size() == 1;
    for (std::size_t k = 0; k < in.plan.regions.size(); ++k) {
        const RegionPlan& region = in.plan.regions[k];
        if (!has_plane(region)) continue;
        const int id = static_cast<int>(region.random_key);
        const std::string plane = plane_name(files.front(), id, out.one_region);
        out.planes.push_back(
            {shot.project.regions[shot.region_index[k]]->name, id,
             fs::path(real_path(plane)).lexically_relative(folder).generic_string()});
    }
    return out;
}

// Blender and Fusion take the last number of a name for the frame's.
Status check_number(const std::string& what, const std::string& path,
                    const std::optional<NumberInName>& number) {
    if (!number) return {};
    const std::size_t dot = path.find_last_of('.');
    for (std::size_t k = number->begin + number->length; k < dot && k < path.size(); ++k)
        if (std::isdigit(static_cast<unsigned char>(path[k])))
            return fail(ErrorCode::kUsage,
                        fmt::format("{} {} has another number after the frame's, which Fusion and "
                                    "Blender would take for it.",
                                    what, path),
                        "Rename the files so that the frame's number is the last.");
    return {};
}

Status check_plate(const CompositeSources& in) {
    const std::string path = in.shot.plate->path_of(in.frames.front());
    const bool one = in.frames.size() > 1 && path == in.shot.plate->path_of(in.frames.back());
    if (one || (!plate_number(in) && in.frames.size() > 1))
        return fail(
            ErrorCode::kUsage,
            path + " is not a numbered picture, and a composite reads the plate from those.",
            "Convert it to a numbered sequence, such as 'plate/####.exr'.");
    if (!plate_curve(in.shot.spaces))
        return fail(ErrorCode::kUsage,
                    "A composite cannot convert the plate from " + in.shot.spaces.plate.name +
                        " to " + in.shot.spaces.working.name + " in other programs.",
                    "Work in the plate's own space" +
                        by({{"color.working_space", in.shot.spaces.plate.name}}) + ".");
    if (is_exr(path) && !is_exr_with_colour(path, in.shot.project.plate.layer))
        return fail(ErrorCode::kUsage,
                    "A composite needs the name of the plate's layer in " + path + ".",
                    "Name it" + by({{setting::kPlateLayer}}) + ".");
    WEFT_TRY(frame, in.shot.plate->read(in.frames.front()));
    if (frame.alpha.empty() || frame.alpha_kind == AlphaKind::kAssociated) return {};
    const float* alpha = frame.alpha.data();
    const std::size_t pixels = frame.alpha.size_bytes() / sizeof(float);
    if (std::all_of(alpha, alpha + pixels, [](float a) { return a == 1; })) return {};
    return fail(ErrorCode::kUsage,
                path + " has an alpha and straight colours, which a composite does not support.",
                "Convert the plate to EXR, whose colours are premultiplied.");
}

std::string tree_text(TreeKind kind, const Composite& composite) {
    if (kind == TreeKind::kNuke) return nuke_composite(composite);
    if (kind == TreeKind::kFusion) return fusion_composite(composite);
    return blender_composite(composite);
}

}  // namespace

Project with_composite_layers(Project project, const std::vector<std::string>& files) {
    if (files.empty()) return project;
    for (const LayerKind kind :
         {LayerKind::kPatch, LayerKind::kEdge, LayerKind::kLight, LayerKind::kGloss, LayerKind::kSt,
          LayerKind::kMatte, LayerKind::kId, LayerKind::kTexture, LayerKind::kFinish}) {
        std::vector<LayerKind>& layers = project.output.layers;
        if (std::find(layers.begin(), layers.end(), kind) == layers.end()) layers.push_back(kind);
    }
    return project;
}

std::vector<std::string> composite_outputs(const std::vector<std::string>& files,
                                           const ShotPlan& plan) {
    std::vector<std::string> out = files;
    if (files.empty()) return out;
    for (const RegionPlan& region : plan.regions)
        if (has_plane(region))
            out.push_back(plane_name(files.front(), static_cast<int>(region.random_key),
                                     plan.regions.size() == 1));
    return out;
}

bool is_composite_of_weft(const std::string& path) {
    const auto file = InputFile::open(path);
    if (!file) return false;
    std::string head(4096, '\0');
    head.resize(file->read_at(0, head.data(), head.size()).value_or(0));
    return head.find(kCompositeMark) != std::string::npos;
}

Status check_composites(const std::vector<std::string>& files, const CompositeSources& sources) {
    if (files.empty()) return {};
    for (const std::string& file : files) {
        const auto kind = tree_kind(file);
        if (!kind)
            return fail(ErrorCode::kUsage,
                        "A composite is a Nuke script (.nk), a Fusion composition (.comp) or a "
                        "script for Blender (.py), and " +
                            file + " is none.",
                        "Choose one of them.");
        if (*kind == TreeKind::kNuke) continue;
        WEFT_CHECK_OK(check_number("The plate", sources.shot.plate->path_of(sources.frames.front()),
                                   plate_number(sources)));
        WEFT_CHECK_OK(check_number("The output", sources.layers.path_for(sources.frames.front()),
                                   layers_number(sources)));
        const bool nested = sources.shot.project.plate.layer.find('.') != std::string::npos;
        if (*kind == TreeKind::kBlender && nested && !sources.apart)
            return fail(
                ErrorCode::kUsage,
                "Blender shows no other layers of a file than those of its own renders, and "
                "the plate is one.",
                "Write the layers to files of their own" +
                    by({{setting::kLayersOutput, "layers/####.exr"}}) + ".");
        if (*kind == TreeKind::kBlender && plate_curve(sources.shot.spaces) == PlateCurve::kCineon)
            return fail(ErrorCode::kUsage, "Blender cannot read film log, and the plate is in it.",
                        "Convert the plate to linear EXR, or write a .nk or .comp.");
    }
    return check_plate(sources);
}

Status write_composites(const std::vector<std::string>& files, const CompositeSources& sources,
                        const std::vector<RegionScene>& scenes, const WriteOptions& write,
                        const std::vector<WriteRule>& rules) {
    if (files.empty()) return {};
    std::size_t written = files.size();  // planes come after the trees
    for (std::size_t k = 0; k < sources.plan.regions.size(); ++k) {
        const RegionPlan& region = sources.plan.regions[k];
        if (!has_plane(region)) continue;
        const std::string path = composite_outputs(files, sources.plan)[written];
        WriteOptions options = write;
        options.rule = rules[written++];
        if (!scenes.empty()) {
            WEFT_CHECK_OK(
                write_graded_plane(path, scenes[k].plane, grade_on(region, scenes[k]), options));
        } else if (std::error_code ignored; !fs::exists(path, ignored)) {
            return fail(ErrorCode::kUsage,
                        "All frames are kept, and " + path + " is made with the frames.",
                        "Render them again" + by({{setting::kOverwrite}}) + ".");
        }
    }
    for (std::size_t k = 0; k < files.size(); ++k)
        WEFT_CHECK_OK(write_file_atomically(
            files[k], tree_text(*tree_kind(files[k]), composite_at(files[k], files, sources)),
            rules[k]));
    return {};
}

}  // namespace weft
