#include "app/render/st_map_files.h"

#include <algorithm>
#include <utility>

#include "app/render/job_frames.h"
#include "engine/core/setting.h"
#include "engine/media/exr_frame.h"

namespace weft {

Status check_st_maps(const std::string& pattern, const ShotPlan& plan) {
    if (!is_exr(pattern)) {
        return fail(ErrorCode::kUsage, "ST-maps are 32 bit EXR files, and " + pattern + " is none.",
                    "Write it like 'st/####.exr'.");
    }
    const bool locked = std::all_of(plan.regions.begin(), plan.regions.end(), [](const auto& r) {
        return r.temporal == TemporalMode::kLocked;
    });
    if (locked) return {};
    return fail(
        ErrorCode::kUsage,
        "ST-maps to the reference frame need the locked temporal mode; in the others no surface is "
        "followed.",
        "Set the mode" + by({{setting::kTemporalMode, "locked"}}) + ", or leave the maps out.");
}

Status write_st_maps(const std::string& path, const StMaps& maps, WriteOptions write) {
    const Size size = maps.warp.visible.size();
    ImageF3 picture(size);
    ExrLayer back{{"stabilize.R", "stabilize.G", "stabilize.B", "stabilize.A"}, true, {}};
    back.samples.reserve(4 * static_cast<std::size_t>(size.width) *
                         static_cast<std::size_t>(size.height));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float *warp = maps.warp.st.pixel(x, y), *st = maps.stabilize.st.pixel(x, y);
            const float shown = maps.stabilize.visible.at(x, y);
            float* to = picture.pixel(x, y);
            std::copy(warp, warp + 2, to);
            to[2] = maps.warp.visible.at(x, y);  // Blender's Map UV multiplies by blue
            back.samples.insert(back.samples.end(), {st[0], st[1], shown, shown});
        }
    }
    ExrFrame frame;
    frame.rgb = picture;
    frame.alpha = maps.warp.visible;
    frame.layers.push_back(std::move(back));
    write.depth = PixelDepth::kFloat;
    write.exr_compression = "zip";
    return write_exr(path, frame, write);
}

}  // namespace weft
