// What a shot's output and its textures must keep to.
#include "app/session/shot.h"
#include "engine/media/frame_writer.h"
#include "texture_db/library.h"

namespace weft {

PixelDepth output_depth(const Output& output, PixelDepth plate) {
    switch (output.depth) {
        case OutputDepth::k8:
            return PixelDepth::kU8;
        case OutputDepth::k16:
            return PixelDepth::kU16;
        case OutputDepth::kHalf:
            return PixelDepth::kHalf;
        case OutputDepth::kFloat:
            return PixelDepth::kFloat;
        case OutputDepth::kAuto:
            break;
    }
    return output.path.empty() ? plate : default_depth(output.path, plate);
}

Status check_texture_licences(const Shot& shot) {
    std::vector<TextureCredit> credits;
    const auto add = [&](const std::string& region, const ShotTexture& t) {
        TextureCredit credit;
        credit.region = region;
        credit.name = t.path;
        credit.author = t.author;
        credit.licence = t.licence;
        credits.push_back(std::move(credit));
    };
    for (const ShotTexture& t : shot.textures) {
        add(t.region, t);
        for (const ShotTexture& further : t.also)
            add(t.region, further);
    }
    return check_licences(credits, licence_list(shot.project.settings.excluded_licences));
}

}  // namespace weft
