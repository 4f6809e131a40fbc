#include "app/measure/form_measure.h"

#include <algorithm>
#include <iterator>

#include "app/measure/measure_job.h"
#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/form/view_camera.h"
#include "engine/media/form_passes.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

// The file of every measured frame: the same for all if it is a single one.
class Files {
  public:
    static Expected<Files> open(const std::string& text, const char* what,
                                const std::vector<int>& frames) {
        WEFT_TRY(pattern, SequencePattern::parse(text));
        if (pattern.is_single()) return Files(std::move(pattern), text);
        WEFT_TRY(present, pattern.list_frames());
        std::vector<int> missing;
        std::set_difference(frames.begin(), frames.end(), present.begin(), present.end(),
                            std::back_inserter(missing));
        if (missing.empty()) return Files(std::move(pattern), text);
        return fail(
            ErrorCode::kMissingFrames,
            std::string(what) + " " + text + " has no file for " + frames_text(missing) + ".",
            "Add the files, or measure only the frames that have one" + by({{setting::kFrames}}) +
                ".");
    }

    [[nodiscard]] std::string on(int frame) const {
        return pattern_.is_single() ? text_ : pattern_.path_for(frame);
    }

  private:
    Files(SequencePattern pattern, std::string text)
        : pattern_(std::move(pattern)), text_(std::move(text)) {}

    SequencePattern pattern_;
    std::string text_;
};

Expected<Size> plane_texels(const Region& region) {
    if (region.texture.plane.empty()) {
        return fail(ErrorCode::kUsage,
                    "The coordinates of the layer st count in planes, and the plane's proportions "
                    "are not known.",
                    "Give the render's plane" + by({{setting::kPlane}}) +
                        "; a render exports it on request.");
    }
    WEFT_TRY(picture, read_image(region.texture.plane));
    return picture.rgb.size();
}

// Of the camera, if it is given or in the header of a frame's pass.
Expected<std::optional<double>> focal_px(const Region& region, const std::string& pass,
                                         Size plate) {
    std::optional<double> fov_deg = region.form.fov_deg;
    if (!fov_deg) {
        WEFT_TRY(header, read_camera(pass));
        fov_deg = header.fov_deg;
    }
    if (!fov_deg) return std::optional<double>();
    return std::optional<double>(camera_with(*fov_deg, plate).focal_px);
}

// Nothing was measured: says which of the two is empty.
Status check_seen(const FormTruth::Seen& seen, const std::string& positions,
                  const std::string& st) {
    if (seen.inside == 0) return {};
    if (seen.placed == 0) {
        return fail(
            ErrorCode::kUnreadable,
            "The position pass " + positions + " has no places inside the matte.",
            "Check its layer" + by({{setting::kPositionLayer}}) + " and that it is of this shot.");
    }
    if (seen.laid == 0) {
        return fail(ErrorCode::kUnreadable, "The layer st of " + st + " is empty inside the matte.",
                    "Check that it is of this surface's render.");
    }
    return {};
}

}  // namespace

Expected<FormMeasures> measure_form(const Shot& shot, const Region& region, const std::string& st,
                                    const std::vector<int>& frames, const CancelToken& cancel) {
    if (region.form.position.empty()) {
        return fail(ErrorCode::kUsage, "How the texture lies is measured against the true surface.",
                    "Give a position pass" + by({{setting::kPositionPass}}) + ".");
    }
    WEFT_TRY(texels, plane_texels(region));
    WEFT_TRY(passes, Files::open(region.form.position, "The position pass", frames));
    WEFT_TRY(layers, Files::open(st, "The layer st", frames));
    const Size size = shot.plate->size();
    const std::string& normal = region.form.normal;
    WEFT_TRY(turns, Files::open(normal.empty() ? region.form.position : normal, "The normal pass",
                                frames));
    WEFT_CHECK_OK(check_picture_exists(passes.on(frames.front())));
    WEFT_TRY(focal, focal_px(region, passes.on(frames.front()), size));
    FormTruth truth(texels, focal);
    FormTruth::Seen all;
    for (const int frame : frames) {
        if (cancel.cancelled()) return cancelled(cancel);
        WEFT_TRY(positions, read_positions(passes.on(frame), region.form.position_layer, size));
        WEFT_TRY(coordinates, read_st_layer(layers.on(frame), size));
        WEFT_TRY(matte, visible_matte(shot, frame));
        ImageF3 normals;
        if (!normal.empty()) {
            WEFT_TRY(read, read_normals(turns.on(frame), region.form.normal_layer, size));
            normals = std::move(read);
        }
        const FormTruth::Seen seen = truth.add(frame, positions, coordinates, matte, normals);
        all.inside += seen.inside, all.placed += seen.placed, all.laid += seen.laid;
    }
    WEFT_CHECK_OK(check_seen(all, region.form.position, st));
    return truth.summary(shot.plan.regions.front().reference_frames.front());
}

}  // namespace weft
