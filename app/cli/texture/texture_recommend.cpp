// weft texture recommend: for mattes on a plate, or for regions of a project.

#include <algorithm>

#include "app/cli/console.h"
#include "app/cli/texture/texture_console.h"
#include "app/cli/texture/texture_json.h"
#include "app/cli/texture/texture_sheet.h"
#include "app/project/codec/project_file.h"
#include "engine/media/frame_reader.h"
#include "engine/media/matte_files.h"

namespace weft {
namespace {

// A frame and the mattes of its regions.
struct Scene {
    ImageU8x3 plate;
    std::vector<std::string> names;
    std::vector<Matte> mattes;
    std::vector<std::string> excluded;  ///< Licences that the project excludes.
};

Expected<ImageU8x3> shown_frame(const FrameReader& plate, int frame) {
    WEFT_TRY(picture, plate.read(frame));
    return display_pixels(picture.rgb, plate.display_encoded());
}

Expected<Scene> scene_of_files(const TextureRecommendOptions& o) {
    Scene scene;
    WEFT_TRY(plate, open_plate(o.plate, {}));
    const int frame = o.frame >= 0 ? o.frame : plate->frames().front();
    WEFT_TRY(pixels, shown_frame(*plate, frame));
    scene.plate = std::move(pixels);
    for (const std::string& path : o.mattes) {
        WEFT_TRY(files, MatteFiles::parse(path, plate->frames().front()));
        WEFT_TRY(matte, files.read(frame, {}, scene.plate.size()));
        scene.mattes.push_back(std::move(matte));
        scene.names.push_back(path);
    }
    return scene;
}

// A frame with a matte for the region: a keyframe if it is painted.
Expected<int> frame_of(const Region& region, const FrameReader& plate) {
    const std::vector<int>& frames = plate.frames();
    const auto in_plate = [&](int f) {
        return std::binary_search(frames.begin(), frames.end(), f);
    };
    for (const int frame : region.reference_frames)
        if (in_plate(frame) &&
            (region.matte->keyframes.empty() || region.matte->keyframes.contains(frame)))
            return frame;
    for (const auto& [frame, key] : region.matte->keyframes)
        if (in_plate(frame)) return frame;
    return frames.front();
}

Expected<MatteFiles> matte_of(const Region& region, int frame, int first) {
    if (!region.matte->shape.empty())
        return fail(
            ErrorCode::kUsage,
            "Region '" + region.name + "' is drawn from a shape, which this command does not draw.",
            "Give its matte as a file with --matte.");
    if (region.matte->files.empty()) {
        const auto key = region.matte->keyframes.find(frame);
        if (key != region.matte->keyframes.end()) return MatteFiles::single(key->second.path);
        return fail(ErrorCode::kUsage,
                    "Region '" + region.name + "' has no matte painted on frame " +
                        std::to_string(frame) + ".",
                    "Give another --frame.");
    }
    return MatteFiles::parse(region.matte->files, first);
}

Expected<Scene> scene_of_project(const TextureRecommendOptions& o) {
    WEFT_TRY(loaded, load_project(o.project));
    const Project project = resolve_paths(loaded, project_dir(o.project));
    std::vector<std::size_t> chosen;
    for (const std::string& name : o.regions) {
        WEFT_TRY(index, find_region(project, name));
        chosen.push_back(index);
    }
    for (std::size_t i = 0; o.regions.empty() && i < project.regions.size(); ++i)
        chosen.push_back(i);
    if (chosen.empty())
        return fail(ErrorCode::kUsage, "The project " + o.project + " has no region.");
    ReadOptions reading;
    reading.layer = project.plate.layer;
    reading.movie_start = project.plate.movie_start;
    WEFT_TRY(plate, open_plate(project.plate.path, reading));
    int frame = o.frame;
    if (frame < 0) {
        WEFT_TRY(shown, frame_of(*project.regions[chosen.front()], *plate));
        frame = shown;
    }
    Scene scene;
    WEFT_TRY(pixels, shown_frame(*plate, frame));
    scene.plate = std::move(pixels);
    for (const std::size_t i : chosen) {
        const Region& region = *project.regions[i];
        WEFT_TRY(files, matte_of(region, frame, plate->frames().front()));
        WEFT_TRY(matte, files.read(frame, region.matte->select, scene.plate.size()));
        scene.mattes.push_back(std::move(matte));
        scene.names.push_back(region.name);
    }
    scene.excluded = licence_list(project.settings.excluded_licences);
    return scene;
}

}  // namespace

CommandResult texture_recommend_command(const TextureCommandOptions& common,
                                        const TextureRecommendOptions& o) {
    const bool files = !o.plate.empty() && !o.mattes.empty();
    if (files == !o.project.empty()) {
        return fail(ErrorCode::kUsage, "Give either --plate with --matte, or --project.");
    }
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(scene, files ? scene_of_files(o) : scene_of_project(o));
    RecommendRequest request;
    request.plate = scene.plate;
    const auto given = [](const std::vector<std::string>& list, std::size_t i) {
        return i < list.size() && list[i] != "-" ? list[i] : std::string();
    };
    for (std::size_t i = 0; i < scene.mattes.size(); ++i)
        request.regions.push_back(
            {scene.names[i], scene.mattes[i].view(), given(o.keeps, i), given(o.materials, i)});
    request.adjust = o.adjust;
    request.count = o.count;
    request.diversity = o.diversity;
    request.excluded_licences = o.excluded_licences;
    request.excluded_licences.insert(request.excluded_licences.end(), scene.excluded.begin(),
                                     scene.excluded.end());
    WEFT_CHECK_OK(check_exclusions(*library, request.excluded_licences));
    WEFT_TRY(advice, library->recommend(request));
    if (!advice.notice.empty()) print(stderr, "weft: " + advice.notice + "\n");
    if (!o.sheet.empty()) {
        WEFT_TRY(sheet, recommendation_sheet(*library, scene.plate, scene.mattes, advice));
        std::vector<std::string> reads = o.mattes;
        reads.insert(reads.end(), {o.plate, o.project});
        WEFT_TRY(rule, write_rule(o.write, reads));
        WEFT_CHECK_OK(write_picture(o.sheet, sheet, rule));
    }
    Answer answer{to_json(advice)};
    for (const RegionSuggestions& region : advice.regions) {
        answer.text += region.region + " looks like: " + region.seen_as + "\n";
        for (const Suggestion& s : region.suggestions)
            answer.text += "  " + texture_hit_line(s.id, s.score, s.material, s.name, s.reasons);
    }
    for (const SceneSuggestion& s : advice.together)
        answer.text += "together: " + s.why + "\n";
    return answer;
}

}  // namespace weft
