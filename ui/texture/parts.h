#pragma once
// Internal: parts of the texture drawer and the inspector.

#include "ui/base/ctx.h"

namespace weft::ui {

/// The centre of a texture as a square thumbnail.
void texture_thumbnail(Ctx& c, const std::string& path, ImVec2 min, ImVec2 max);
/// Makes the last item a drag source for the texture.
void texture_drag_source(Ctx& c, const TextureCard& card);
/// Suggestions for the selected region on the current frame.
void suggested(Ctx& c, const std::vector<TextureCard>& cards);
/// Suggested sets: one texture for each region, chosen to match.
void suggested_together(Ctx& c, const std::vector<TextureCard>& cards);
/// Filters by origin, licence and look.
void texture_facets(Ctx& c);
/// Painting on the surface in another program.
void flat_controls(Ctx& c, const Region& region);
/// Where the texture comes from.
void provenance_section(Ctx& c, const Region& region);

}  // namespace weft::ui
