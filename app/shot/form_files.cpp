#include "app/shot/form_files.h"

#include <algorithm>
#include <filesystem>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/core/unsqueezed_image.h"
#include "engine/form/camera_rotation.h"
#include "engine/form/depth_positions.h"
#include "engine/media/form_passes.h"

namespace weft {
namespace {

// A normal map of 8 or 16 bits has no header to look into.
HeaderCamera header_of(const std::string& path) {
    const auto camera = read_camera(path);
    return camera ? *camera : HeaderCamera();
}

// Of the picture unsqueezed.
Expected<ViewCamera> view_camera(const FormParams& form, const HeaderCamera& header,
                                 const std::string& path, const PassPlate& plate) {
    const std::optional<double> fov_deg = form.fov_deg ? form.fov_deg : header.fov_deg;
    if (!fov_deg) {
        return fail(ErrorCode::kUnreadable,
                    path +
                        " gives a form only with the camera's horizontal field of view, which is "
                        "not in its header.",
                    "Set it in degrees" + by({{setting::kFov}}) + ".");
    }
    return camera_with(*fov_deg, plate.aspect.unsqueezed(plate.size));
}

// How the camera is turned, from the position pass of the same render.
std::optional<std::array<double, 9>> rotation_by_places(const FormParams& form,
                                                        const std::string& path,
                                                        const PassPlate& plate,
                                                        const ViewCamera& camera) {
    const auto normals = locate_normals(path, form.normal_layer);
    if (!normals) return std::nullopt;
    const auto pass = locate_positions(path, {}, {normals->layer.name});
    // A file with nothing but the normals is no position pass.
    if (!pass || pass->layer.name == normals->layer.name) return std::nullopt;
    auto places = read_positions(path, pass->layer.name, plate.size);
    if (!places) return std::nullopt;
    return camera_rotation(unsqueezed(std::move(*places), plate.aspect), camera);
}

// Whether a shape or a plane's strokes are drawn.
bool draws_form(const FormParams& form) {
    return !form.shape.empty() ||
           std::any_of(form.strokes.begin(), form.strokes.end(), [](const FormGuide& stroke) {
               return stroke.kind == FormGuideKind::kParallel;
           });
}

}  // namespace

bool reads_form(RegionPlan::FormFrom from) {
    return from == RegionPlan::FormFrom::kPositions || from == RegionPlan::FormFrom::kNormals;
}

FormFiles form_files(const Region& region) {
    using From = RegionPlan::FormFrom;
    const FormParams& form = region.form;
    const FormFiles drawn{From::kShape, "", "The shape"};
    switch (form.source) {
        case FormSource::kAuto:
        case FormSource::kPass:
            if (!form.position.empty())
                return {From::kPositions, form.position, "The position pass"};
            if (!form.normal.empty()) return {From::kNormals, form.normal, "The normal pass"};
            if (form.source == FormSource::kPass) return {};
            return draws_form(form) ? drawn : FormFiles{From::kMotion, "", "The motion"};
        case FormSource::kDepth:
            return {From::kPositions, region.finish.depth, "The depth pass"};
        case FormSource::kShape:
            return drawn;
        case FormSource::kInflate:
            return {From::kOutline, "", "The outline"};
        case FormSource::kFlat:
            return {};
    }
    return {};
}

void add_form_settings(Hasher& hasher, const Region& region) {
    const FormParams& form = region.form;
    const FormFiles files = form_files(region);
    hasher.value(static_cast<int>(files.from)).text(files.pattern).text(files.what);
    hasher.text(form.position_layer).text(form.normal_layer).text(region.finish.depth_layer);
    hasher.value(static_cast<int>(form.normal_space)).value(static_cast<int>(form.depth_kind));
    hasher.value(form.fov_deg.value_or(0));
    if (files.from == RegionPlan::FormFrom::kOutline) hasher.value(form.roundness);
    for (const auto* guides : {&form.shape, &form.strokes}) {
        hasher.value(static_cast<std::uint64_t>(guides->size()));
        for (const FormGuide& guide : *guides) {
            hasher.value(static_cast<int>(guide.kind));
            for (const double number : guide.numbers)
                hasher.value(number);
        }
    }
}

Expected<ImageF3> read_form_places(const Region& region, const std::string& path,
                                   const PassPlate& plate) {
    const FormParams& form = region.form;
    if (form.source != FormSource::kDepth)
        return read_positions(path, form.position_layer, plate.size);
    WEFT_TRY(depth, read_depth(path, region.finish.depth_layer, plate.size));
    WEFT_TRY(camera, view_camera(form, header_of(path), path, plate));
    return positions_from_depth(depth, form.depth_kind, camera, plate.aspect);
}

NormalAxes axes_of_normals(const FormParams& form, const std::string& path) {
    if (form.normal_space == NormalSpace::kCamera) return NormalAxes::kCamera;
    if (form.normal_space == NormalSpace::kWorld) return NormalAxes::kWorld;
    const auto pass = locate_normals(path, form.normal_layer);
    const std::string layer = pass ? lower_case(pass->layer.name) : std::string();
    if (layer.find("camera") != std::string::npos) return NormalAxes::kCamera;
    if (layer.find("world") != std::string::npos || header_of(path).by_blender)
        return NormalAxes::kWorld;
    return NormalAxes::kPresumedCamera;
}

Expected<NormalPass> read_form_normals(const Region& region, const std::string& path,
                                       const PassPlate& plate) {
    const FormParams& form = region.form;
    WEFT_TRY(normals, read_normals(path, form.normal_layer, plate.size));
    const HeaderCamera header = header_of(path);
    WEFT_TRY(camera, view_camera(form, header, path, plate));
    if (axes_of_normals(form, path) != NormalAxes::kWorld)
        return NormalPass{std::move(normals), camera, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    const auto turned = header.camera_from_world ? header.camera_from_world
                                                 : rotation_by_places(form, path, plate, camera);
    if (turned) return NormalPass{std::move(normals), camera, *turned};
    return fail(ErrorCode::kUnreadable,
                "The normals of " + path +
                    " are in the world's axes, and neither worldToCamera in its header nor a "
                    "position pass in the same file that fits the field of view" +
                    by({{setting::kFov}}) + " tells the camera's.",
                "Give the position pass instead" + by({{setting::kPositionPass}}) +
                    ", or normals in the camera's axes" + by({{setting::kNormalSpace, "camera"}}) +
                    ".");
}

}  // namespace weft
