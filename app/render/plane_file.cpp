#include "app/render/plane_file.h"

#include <algorithm>

#include "app/render/job_frames.h"
#include "engine/core/setting.h"
#include "engine/pipeline/region_scene.h"

namespace weft {
namespace {

// Its texels in the working space.
ImageF3 plane_picture(const PlanePyramid& plane) {
    const Size size = plane.size();
    const PlanePyramid::Level& texels =
        plane.levels()[static_cast<std::size_t>(plane.plane_level())];
    ImageF3 picture(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float* from = texels.pixel(x, y);
            std::copy(from, from + 3, picture.pixel(x, y));
        }
    }
    return picture;
}

Status write_plane(const std::string& path, const ImageF3& picture, WriteOptions write) {
    write.depth = is_exr(path) ? PixelDepth::kFloat : PixelDepth::kU16;
    write.exr_compression = "zip";
    write.pixel_aspect = 1;
    write.metadata.emplace_back(
        "weft:plane", std::to_string(picture.width()) + "x" + std::to_string(picture.height()));
    return write_image(path, picture, {}, write);
}

bool is_png(const std::string& path) {
    return path.ends_with(".png") || path.ends_with(".PNG");
}

}  // namespace

Status check_plane_file(const std::string& path, const ShotPlan& plan) {
    if (!is_png(path) && !is_exr(path)) {
        return fail(
            ErrorCode::kUsage,
            "The texture plane is written as .png (16 bit) or .exr, and " + path + " is neither.",
            "Choose one of them.");
    }
    if (plan.regions.size() != 1) {
        return fail(ErrorCode::kUsage,
                    "The project has " + std::to_string(plan.regions.size()) +
                        " regions, and one file holds the texture plane of one.",
                    "Disable the others" + by({{"enabled"}}) + ".");
    }
    if (has_plane(plan.regions.front())) return {};
    return fail(ErrorCode::kUsage,
                "There is no texture plane: the texture is synthesized for every frame.",
                "Set the locked temporal mode" + by({{setting::kTemporalMode, "locked"}}) + ".");
}

Status write_plane_file(const std::string& path, const PlanePyramid& plane,
                        const ShotSpaces& spaces, WriteOptions write) {
    ImageF3 picture = plane_picture(plane);
    WEFT_TRY(texture_from_working, make_color_transform(spaces.working, spaces.textures.front()));
    texture_from_working->apply(picture);
    return write_plane(path, picture, std::move(write));
}

Status write_graded_plane(const std::string& path, const PlanePyramid& plane, const Grade& grade,
                          WriteOptions write) {
    ImageF3 picture = plane_picture(plane);
    Matte all(picture.size());
    std::fill_n(all.data(), all.size_bytes(), std::uint8_t{255});
    apply_grade(picture, all, grade);
    return write_plane(path, picture, std::move(write));
}

}  // namespace weft
