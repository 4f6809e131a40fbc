#include "app/motion_export/motion_manifest.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/frame_range.h"
#include "engine/mask/shape_text.h"

namespace weft {
namespace {

using OrderedJson = nlohmann::ordered_json;

double rounded(double value) {
    return std::round(1e4 * value) / 1e4;
}

OrderedJson corner_pin_json(const MotionPaths& paths, const RegionCorners& corners, int reference) {
    OrderedJson at = OrderedJson::array();
    for (const glm::dvec2 corner : corners.track.at(reference)) {
        at.push_back(rounded(corner.x));
        at.push_back(rounded(corner.y));
    }
    return {{"nuke", paths.nuke},
            {"after_effects", paths.after_effects},
            {"blender", paths.blender},
            {"weft", paths.track},
            {"corners_px", at},
            {"on_form", corners.on_form},
            {"off_plane_px",
             {{"median", rounded(static_cast<double>(corners.off_median_px))},
              {"p90", rounded(static_cast<double>(corners.off_p90_px))}}}};
}

OrderedJson roto_json(const MotionPaths& paths, const RegionShapes& found) {
    OrderedJson shapes = OrderedJson::array();
    for (std::size_t k = 0; k < found.shapes.size(); ++k) {
        const auto& keys = found.shapes[k].keys;
        shapes.push_back({{"name", shape_name(found.shapes, k)},
                          {"hole", found.shapes[k].level % 2 == 1},
                          {"first", keys.begin()->first},
                          {"last", keys.rbegin()->first},
                          {"points", keys.begin()->second.points.size()}});
    }
    return {{"nuke", paths.nuke_shapes},
            {"blender", paths.blender_shapes},
            {"mlt", paths.mlt_shapes},
            {"shapes", shapes},
            {"off_matte_px",
             {{"mean", rounded(static_cast<double>(found.off_mean_px))},
              {"worst_frame", rounded(static_cast<double>(found.off_worst_px))}}}};
}

OrderedJson region_json(const MotionManifest::Entry& entry, StConvention st) {
    const MotionPaths& paths = entry.paths;
    OrderedJson out{{"name", entry.region.name},
                    {"folder", paths.folder},
                    {"reference_frame", entry.region.reference}};
    if (!paths.st_map.empty())
        out["st_maps"] = {{"convention", name_of(st)},
                          {"match_move", paths.st_map},
                          {"stabilize", paths.stabilize.empty() ? paths.st_map : paths.stabilize}};
    for (const auto& [convention, path] : paths.vectors)
        out["vectors"].push_back({{"convention", name_of(convention)}, {"path", path}});
    if (entry.corners)
        out["corner_pin"] = corner_pin_json(paths, *entry.corners, entry.region.reference);
    if (entry.mesh)
        out["mesh"] = {{"obj", paths.mesh_obj},      {"pc2", paths.mesh_pc2},
                       {"usd", paths.mesh_usd},      {"corners", entry.mesh->corners},
                       {"faces", entry.mesh->faces}, {"depth", entry.mesh->depth}};
    if (entry.shapes) out["roto"] = roto_json(paths, *entry.shapes);
    return out;
}

}  // namespace

std::string manifest_text(const MotionManifest& manifest) {
    OrderedJson out{{"schema", "weft.motion/1"},
                    {"complete", manifest.complete},
                    {"frames", format_frame_list(manifest.frames)},
                    {"frame_count", manifest.frames.size()},
                    {"size", {manifest.size.width, manifest.size.height}},
                    {"fps", manifest.fps},
                    {"regions", OrderedJson::array()}};
    for (const MotionManifest::Entry& entry : manifest.regions)
        out["regions"].push_back(region_json(entry, manifest.st));
    return out.dump(1) + "\n";
}

}  // namespace weft
