// Rules for a shot's output and textures.
#include "app/shot/shot.h"
#include "engine/core/setting.h"
#include "engine/media/frame_writer.h"
#include "texture_db/library/library.h"

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

Project with_references(const Shot& shot) {
    Project project = shot.project;
    for (std::size_t k = 0; k < shot.references.size(); ++k) {
        const ShotReference& reference = shot.references[k];
        if (!reference.by_default) continue;
        Leaf<Region>& region = project.regions[shot.region_index[k]];
        region = region.with([&](Region& r) { r.reference_frames = {reference.frame}; });
    }
    return project;
}

std::string empty_reference_text(const std::string& region, const ShotReference& reference) {
    const std::string frame = std::to_string(reference.frame);
    const std::string text =
        "Region '" + region + "': its matte is empty on the reference frame " + frame + ". ";
    if (!reference.better)
        return text + "Place the texture on a frame that shows the surface" +
               by({{setting::kReferenceFrame}}) + ".";
    const std::string better = std::to_string(*reference.better);
    return text + "Frame " + better + " shows the surface; place the texture there" +
           by({{setting::kReferenceFrame, better}}) + ".";
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
