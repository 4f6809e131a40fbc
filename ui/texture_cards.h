#pragma once
// Internal to the texture drawer: its parts.

#include "ui/ctx.h"

namespace weft::ui {

/// A texture's middle in a square.
void texture_thumbnail(Ctx& c, const std::string& path, ImVec2 min, ImVec2 max);
/// Makes the last item a texture that can be dragged.
void texture_drag_source(Ctx& c, const TextureCard& card);
/// What suits the selected region, on the artist's frame.
void suggested(Ctx& c, const std::vector<TextureCard>& cards);
/// One texture for each region, chosen to go with each other.
void suggested_together(Ctx& c, const std::vector<TextureCard>& cards);
/// Where the textures come from, under which licence, and what they look like.
void texture_facets(Ctx& c);

}  // namespace weft::ui
