#include "app/project/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "app/project/parameters.h"
#include "engine/core/frame_range.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

/// Collects the issues of one part of the document.
class Finder {
  public:
    Finder(std::vector<Issue>& issues, std::string part)
        : issues_(issues), part_(std::move(part)) {}

    void error(std::string_view key, std::string what, std::string what_to_do) {
        add(Severity::kError, key, std::move(what), std::move(what_to_do));
    }
    void warning(std::string_view key, std::string what, std::string what_to_do) {
        add(Severity::kWarning, key, std::move(what), std::move(what_to_do));
    }

    /// Checks values that were set in a struct directly, not through the table.
    template <class Owner>
    void check_ranges(const Owner& owner, std::span<const Parameter<Owner>> table) {
        for (const Parameter<Owner>& parameter : table)
            if (const auto value = normalise(parameter, parameter.read(owner)); !value)
                error(parameter.full_key(), value.error().sentence(),
                      "Set it to a value that is allowed");
    }

  private:
    void add(Severity severity, std::string_view key, std::string what, std::string what_to_do) {
        std::string where = part_.empty() ? std::string(key) : fmt::format("{}: {}", part_, key);
        issues_.push_back({severity, std::move(what), std::move(where), std::move(what_to_do)});
    }
    std::vector<Issue>& issues_;
    std::string part_;
};

void check_keyed_shape(Finder& find, std::string_view key, const MatteSource& matte) {
    const KeyedShape& shape = matte.shape;
    if (!matte.files.empty() || !matte.keyframes.empty() || !matte.select.crypto.empty())
        find.error(key, "It is drawn from a shape, and has files or painted keyframes",
                   "Keep one of them");
    if (shape.follow != ShapeFollow::kNone && shape.track.empty())
        find.error(key, "Its shape follows a track, but none is set",
                   "Choose a track, or let the shape follow nothing");
    for (const auto& [frame, drawn] : shape.keys)
        if (drawn.points.size() != shape.keys.begin()->second.points.size())
            find.error(key,
                       fmt::format("Its shape has {} points on frame {} and {} on frame {}",
                                   shape.keys.begin()->second.points.size(),
                                   shape.keys.begin()->first, drawn.points.size(), frame),
                       "Give it the same points on every key");
}

void check_matte(Finder& find, std::string_view key, const MatteSource& matte) {
    if (matte.empty())
        find.error(key, "No matte is set",
                   "Give a pattern ('masks/####.png') or paint a keyframe (12=mask.png)");
    if (!matte.files.empty() && !matte.keyframes.empty())
        find.error(key, fmt::format("It has files ('{}') and painted keyframes", matte.files),
                   "Keep one of the two");
    for (const auto& [frame, painted] : matte.keyframes)
        if (painted.path.empty())
            find.error(key, fmt::format("The keyframe of frame {} has no path", frame),
                       "Set it or remove the keyframe");
    if (!matte.confirmed.empty() && matte.keyframes.empty())
        find.error(key, "Parts of it are confirmed, but it has no painted keyframe",
                   "Paint a keyframe, or remove what is confirmed");
    if (!matte.shape.empty()) check_keyed_shape(find, key, matte);
    if (matte.propagate_from && matte.propagate_to && *matte.propagate_from > *matte.propagate_to)
        find.error(key,
                   fmt::format("It is propagated from frame {} to frame {}", *matte.propagate_from,
                               *matte.propagate_to),
                   "Give the first frame first");
    if (matte.select.value && !matte.select.channel.empty())
        find.warning(
            key, "It selects an id and a channel",
            "An id matte has one channel; drop one of the two if the file has no such channel");
}

void check_texture(Finder& find, const Region& region) {
    const TextureSource& texture = region.texture;
    if (texture.sample.empty() && texture.plane.empty())
        find.error("texture", "No texture is set",
                   "Set a sample or a plane" + by({{setting::kSample}, {setting::kPlane}}));
    if (!texture.sample.empty() && !texture.plane.empty())
        find.error("texture", "It has both a sample and a plane",
                   "Keep the sample or the plane" + by({{setting::kSample}, {setting::kPlane}}));
    if (texture.sample.empty() && !texture.also.empty())
        find.error("texture.also", "It has further samples, but no sample",
                   "Set the first one" + by({{setting::kSample}}));
    if ((!texture.plane.empty() || shows_sample(texture.mode)) &&
        region.temporal.mode != TemporalMode::kLocked)
        find.warning(
            "temporal.mode",
            fmt::format(
                "Temporal mode '{}' synthesizes every frame, but a plane is used without synthesis",
                choice_name(region.temporal.mode)),
            "Use a sample, or the locked mode" +
                by({{setting::kSample}, {setting::kTemporalMode, "locked"}}));
}

/// Twice the signed area of the triangle at corner b.
double turn(PlatePoint a, PlatePoint b, PlatePoint c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

void check_placement(Finder& find, const Placement& placement) {
    if (!placement.corners_px) return;
    const auto& corners = *placement.corners_px;
    int clockwise = 0, counter = 0;
    constexpr double kFlatPx2 = 1e-3;
    for (std::size_t i = 0; i < 4; ++i) {
        const double area = turn(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]);
        clockwise += area > kFlatPx2 ? 1 : 0;
        counter += area < -kFlatPx2 ? 1 : 0;
    }
    if (clockwise != 4 && counter != 4)
        find.error("placement.corners_px", "The four corners do not form a convex quadrilateral",
                   "Give top left, top right, bottom right, bottom left, in this order");
}

void check_synthesis(Finder& find, const SynthesisParams& synthesis) {
    if (synthesis.feather_px > synthesis.overlap_px)
        find.warning("synthesis.feather_px",
                     fmt::format("The feather of {} px is wider than the overlap of {} px",
                                 synthesis.feather_px, synthesis.overlap_px),
                     "Lower the feather or raise the overlap" +
                         by({{setting::kFeather}, {setting::kOverlap}}));
}

void check_light(Finder& find, const LightParams& light) {
    if (light.source == LightSource::kImage && light.image.empty())
        find.error("light.image", "The light comes from an image, but none is set",
                   "Choose one" + by({{setting::kLightSource}}));
    if (light.source != LightSource::kImage && !light.image.empty())
        find.warning(
            "light.image",
            fmt::format("An image is set, but the light source is '{}'", choice_name(light.source)),
            "Set the light source to image, or remove the image");
}

void check_zone(Finder& find, const std::string& key, const Zone& zone) {
    double most = zone.value;
    for (const NumberKey& keyed : zone.value_keys.keys)
        most = std::max(most, keyed.numbers.front());
    if (most <= 1 || zone.kind == ZoneKind::kLight) return;
    if (zone.kind == ZoneKind::kDetail)
        find.warning(
            key, fmt::format("Its light detail is {:g}, and 1 is all that the plate shows", most),
            "Set it to a value from 0 (paint) to 1 (light)");
    else
        find.warning(key, fmt::format("Its amount is {:g}, and 1 is in full", most),
                     "Set it to a value from 0 (as tracked) to 1");
}

void check_region(std::vector<Issue>& issues, const Region& region, std::size_t index) {
    Finder find(issues, region.name.empty() ? fmt::format("regions[{}]", index)
                                            : fmt::format("regions[{}] '{}'", index, region.name));
    find.check_ranges(region, region_parameters());
    check_matte(find, "matte", *region.matte);
    for (std::size_t i = 0; i < region.holdouts->size(); ++i) {
        const std::string key = fmt::format("holdouts[{}]", i);
        find.check_ranges((*region.holdouts)[i], matte_parameters());
        check_matte(find, key, (*region.holdouts)[i]);
    }
    for (std::size_t i = 0; i < region.zones->size(); ++i) {
        const Zone& zone = (*region.zones)[i];
        const std::string key = fmt::format("zones[{}]", i);
        find.check_ranges(zone, zone_parameters());
        find.check_ranges(zone.matte, matte_parameters());
        check_matte(find, key + ".matte", zone.matte);
        check_zone(find, key, zone);
    }
    check_texture(find, region);
    check_placement(find, region.placement);
    check_synthesis(find, region.synthesis);
    check_light(find, region.light);
}

void check_output(Finder& find, const Project& project) {
    if (project.output.path.empty() && project.output.movie.empty())
        find.warning("output.path", "No output is set", "Set one" + by({{setting::kOutput}}));
    Project only_inputs = project;
    only_inputs.output = {};
    std::set<std::string> inputs;
    static_cast<void>(map_paths(only_inputs, [&](const std::string& path) {
        inputs.insert(path);
        return path;
    }));
    for (const std::string& path : {project.output.path, project.output.movie})
        if (!path.empty() && inputs.contains(path))
            find.error("output", fmt::format("'{}' would overwrite an input of the project", path),
                       "Write to another name");
}

void check_region_set(Finder& find, const Project& project) {
    if (project.regions.empty())
        find.error("regions", "The project has no region", "Add one" + by({{setting::kAddRegion}}));
    const auto enabled = [](const Leaf<Region>& region) { return region->enabled; };
    if (!project.regions.empty() &&
        std::none_of(project.regions.begin(), project.regions.end(), enabled))
        find.warning("regions", "Every region is disabled",
                     "Enable one; otherwise the output is the plate");
    std::set<RegionId> ids;
    std::set<std::string> names;
    for (const Leaf<Region>& region : project.regions) {
        if (region->id == 0 || !ids.insert(region->id).second)
            find.error("regions",
                       fmt::format("The region id {} is not unique or not set", region->id),
                       "Add regions by the action add_region");
        if (!region->name.empty() && !names.insert(region->name).second)
            find.warning("regions", fmt::format("Several regions are called '{}'", region->name),
                         "Rename one of them");
    }
}

std::string without_full_stop(std::string sentence) {
    if (sentence.ends_with('.')) sentence.pop_back();
    return sentence;
}

}  // namespace

std::string Issue::text() const {
    return fmt::format("{}: {}. {}", where, what, what_to_do);
}

std::vector<Issue> validate(const Project& project) {
    std::vector<Issue> issues;
    Finder find(issues, "");
    find.check_ranges(project, project_parameters());
    if (project.plate.path.empty())
        find.error(
            "plate.path", "No plate is set",
            "Choose numbered images ('frames/####.png') or a movie" + by({{setting::kPlate}}));
    if (!project.settings.frames.empty())
        if (const auto frames = parse_frame_list(project.settings.frames); !frames)
            find.error("settings.frames", without_full_stop(frames.error().message),
                       without_full_stop(frames.error().remedy));
    check_output(find, project);
    check_region_set(find, project);
    for (std::size_t i = 0; i < project.regions.size(); ++i)
        check_region(issues, *project.regions[i], i);
    return issues;
}

bool has_errors(const std::vector<Issue>& issues) {
    return std::any_of(issues.begin(), issues.end(),
                       [](const Issue& issue) { return issue.severity == Severity::kError; });
}

}  // namespace weft
