#include "app/session/textures/texture_pitch.h"

#include <cmath>

#include "app/base/picture.h"
#include "engine/media/image_files.h"
#include "engine/synthesis/texture_period.h"

namespace weft {

Expected<double> texture_pitch(const std::string& path, Vec2 along) {
    WEFT_TRY(picture, read_image(path));
    const PicturePtr codes = make_picture(picture.rgb, true, nullptr, nullptr);
    const Size axis = find_period(codes->srgb).axis_px();
    const double pitch = std::abs(along.x) >= std::abs(along.y) ? axis.width : axis.height;
    if (pitch >= 2) return pitch;
    return fail(ErrorCode::kUsage, "No regular bricks or tiles are found in this texture.",
                "Set its scale by hand.");
}

}  // namespace weft
