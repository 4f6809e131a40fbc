#pragma once
// The parts that a frame was composited from, so that a compositor can repeat the composite.

#include "engine/compute/plane_pyramid.h"
#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/form/form_on_frame.h"
#include "engine/lighting/shading.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// All of the plate's size, in the working space, before the roll-off of display-referred output:
/// output = plate · (1 − alpha) + patch + edge. Where the plate is not finite it counts as 0.
struct FrameLayers {
    ImageF3 patch;  ///< All regions, premultiplied, unclipped.
    ImageF1 alpha;
    /// What soft edges remove of the old surface, and the remainder of the equation.
    ImageF3 edge;
    ImageF3 texture;           ///< The topmost region's, before light; 0 where there is none.
    ImageF3 light;             ///< What the texture was multiplied by; 1 where there is no region.
    ImageF1 light_confidence;  ///< Shading::sure, 0–1; 0 where there is no region.
    ImageF3 gloss;             ///< What was added to it then; 0 where there is none.
    /// What is added last, so that patch = alpha · (texture · light + gloss + finish) where all but
    /// it are rounded as half floats: grain, ink, blending, regions below. Of note_finish().
    ImageF3 finish;
    ImageF2 st;    ///< Place in the texture, 0–1, origin bottom left; 0 where there is none.
    ImageF1 seam;  ///< 1 where a seam of the texture plane shows.
    ImageF1 id;    ///< The region's id, of the topmost; 0 where there is none.
    /// Of the topmost region's form (form_on_frame()), 0 where it is flat; or empty.
    ShownForm form;

    /// `with_form`: has the layers of the form.
    explicit FrameLayers(Size size, bool with_form = false);
};

/// One region's share over `box`. `matte` and the pictures are of the box's size. `unlit` and
/// `lit`: the texture before and after light; `gloss`, which may be empty, is a part of the latter;
/// `coords` may be empty (no ST, no seams). `plane_seams`: 255 at the seams of the plane; may be
/// empty.
struct LayerShare {
    Recti box;
    ViewU8x1 matte;
    ViewF3 unlit, lit, gloss;
    const TextureCoords* coords = nullptr;
    const Shading* light = nullptr;  ///< May be null: nothing had to be told apart.
    Size plane = {};
    WrapMode wrap = WrapMode::kRepeat;
    ViewU8x1 plane_seams = {};
    float id = 0;
};
void add_share(FrameLayers& layers, const LayerShare& share);
/// Lays the finished texture (with grain and ink) over the layers below.
void add_patch(FrameLayers& layers, const Recti& box, ViewU8x1 matte, ViewF3 texture);
/// Lays a region's form, of the box's size, over those below.
void add_form(FrameLayers& layers, const Recti& box, ViewU8x1 matte, const ShownForm& form);
/// `plate` and `composite` in the working space.
void finish_layers(FrameLayers& layers, ViewF3 plate, ViewF3 composite);
/// Fills FrameLayers::finish from the others; the last step, after the plate's alpha was put back.
void note_finish(FrameLayers& layers);

/// 255 at texels whose right or lower neighbour is not their neighbour in the sample.
[[nodiscard]] Matte seam_texels(const TexturePlane& plane);

}  // namespace weft
