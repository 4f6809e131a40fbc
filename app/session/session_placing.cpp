// Texture scale from the known size of bricks or tiles.
#include <cmath>

#include "app/base/background.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "engine/media/image_files.h"
#include "engine/synthesis/texture_period.h"

namespace weft {
namespace {

// Distance between repeats of the sample along a direction, px.
Expected<double> pitch_of(const std::string& path, Vec2 along) {
    WEFT_TRY(picture, read_image(path));
    const PicturePtr codes = make_picture(picture.rgb, true, nullptr, nullptr);
    const Size axis = find_period(codes->srgb).axis_px();
    // Use the axis that is closer to the line's direction.
    const double pitch = std::abs(along.x) >= std::abs(along.y) ? axis.width : axis.height;
    if (pitch >= 2) return pitch;
    return fail(ErrorCode::kUsage,
                "No regular bricks or tiles are found in this texture. Set its scale by hand.");
}

}  // namespace

void Session::scale_by_line(const ScaleByLine& action) {
    const Region* region = region_by_id(document(), selected_);
    if (!region || region->texture.sample.empty() || action.count <= 0) {
        notify(NoticeKind::kWarning, "Choose a texture to synthesize first.");
        return;
    }
    const Vec2 line = action.to - action.from;
    const double length = std::hypot(static_cast<double>(line.x), static_cast<double>(line.y));
    const std::string path = resolve_path(project_dir(path_), region->texture.sample);
    start_for_document([this, path, line, length, count = action.count,
                        id = region->id]() -> Finish {
        const auto pitch = pitch_of(path, line);
        return [this, pitch, length, count, id] {
            if (!pitch) {
                notify(NoticeKind::kWarning, pitch.error().text());
                return;
            }
            edit(SetRegionParameter{{id, {}}, "placement.scale", length / (count * *pitch)}, true);
        };
    });
}

}  // namespace weft
