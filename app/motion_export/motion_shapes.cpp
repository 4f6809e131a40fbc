#include "app/motion_export/motion_shapes.h"

#include <cctype>
#include <filesystem>

#include "engine/mask/shape_text.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

// Letters, digits and _ of ASCII only, as programs name nodes.
std::string node_name(const std::string& folder) {
    std::string out = "roto_";
    for (const char c : folder) {
        const auto code = static_cast<unsigned char>(c);
        out += code < 128 && std::isalnum(code) ? c : '_';
    }
    return out;
}

}  // namespace

Expected<RegionShapes> write_motion_shapes(const MotionFramesInputs& in) {
    const auto shaped = [&](int frame) {
        return ShapedFrame{frame, in.shot.plate->shown_frame(frame), shows_black(in.shot, frame)};
    };
    std::vector<ShapedFrame> frames;
    for (const int frame : in.motion.frames)
        frames.push_back(shaped(frame));
    WEFT_TRY(found, region_shapes(in.surface, shaped(in.region.reference), frames));
    const std::string name = node_name(in.paths.folder);
    const ShapeTextContext context{in.shot.plate->size(), name};
    const int first = in.shot.plate->frames().front();
    for (const auto& [path, text] :
         {std::pair(in.paths.nuke_shapes, nuke_shapes(found.shapes, context)),
          {in.paths.blender_shapes, blender_shapes(found.shapes, context)},
          {in.paths.mlt_shapes, mlt_shapes(found.shapes, context, first)}})
        WEFT_CHECK_OK(write_file_atomically((std::filesystem::path(in.spec.folder) / path).string(),
                                            text, in.rule));
    return found;
}

}  // namespace weft
