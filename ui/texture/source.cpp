// The source of the texture, for licences and for rendering again.
#include <filesystem>

#include "ui/base/icons.h"
#include "ui/texture/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

void provenance_section(Ctx& c, const Region& region) {
    if (!section(c, "Source", false)) return;
    const PanelName panel(c, "Provenance");
    const bool plane = !region.texture.plane.empty();
    const std::string& path = plane ? region.texture.plane : region.texture.sample;
    if (path.empty()) {
        wrapped(c, "No texture is chosen yet.", c.theme.quiet);
        section_gap(c);
        return;
    }
    info_row(c, plane ? "Picture" : "Sample", std::filesystem::path(path).filename().string(),
             path.c_str());
    // Library textures are named by their id.
    TextureCard card;
    card.path = library_name_of(path);
    if (!card.path.empty()) {
        const TextureCard known = c.textures.details(card);
        info_row(c, "Material", known.material.empty() ? "…" : known.material);
        info_row(c, "Author", known.author.empty() ? "not stated" : known.author);
        info_row(c, "Licence", known.licence.empty() ? "not stated" : known.licence);
        info_row(c, "Source", known.source.empty() ? "not stated" : known.source);
    } else {
        info_row(c, "Licence", "Your file", "No credits are stored with this file");
    }
    if (!plane) {
        info_row(c, "Seed", std::to_string(c.view.project.settings.seed));
        info_row(c, "Overlap", std::to_string(region.synthesis.overlap_px) + " px");
    }
    info_row(c, "Backend", c.view.backend);
    if (button(c, "Copy as text", {.icon = icons::kCopy, .width = -1}))
        c.pictures.set_clipboard(region.name + ": " + path + ", seed " +
                                 std::to_string(c.view.project.settings.seed) + ", frame " +
                                 std::to_string(c.view.frame) + " of " + c.view.plate.path);
    section_gap(c);
}

}  // namespace weft::ui
