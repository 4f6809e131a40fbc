#pragma once
// A smooth displacement field on a lattice of nodes, with interpolation between them.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"

namespace weft {

/// Displacements in pixels at the nodes of a square lattice over a frame. Node (i, j) stands at
/// ((i − kMargin) · spacing, (j − kMargin) · spacing) in frame coordinates, where pixel (x, y) has
/// its centre at (x + 0.5, y + 0.5). Between nodes the field is a Catmull–Rom surface (C¹, exact
/// for quadratics), beyond the lattice it goes on linearly. Const access is thread-safe.
class LatticeField {
  public:
    static constexpr int kMargin = 2;  ///< Nodes outside the frame on each side.

    LatticeField() = default;
    /// A field of zeros over a frame of size `full`; `spacing` ≥ 1 px.
    LatticeField(Size full, int spacing);

    [[nodiscard]] Size full_size() const { return full_; }
    [[nodiscard]] int spacing() const { return spacing_; }
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] const ImageF2& nodes() const { return nodes_; }
    [[nodiscard]] ImageF2& nodes() { return nodes_; }
    [[nodiscard]] Vec2 node_position(int i, int j) const {
        return {static_cast<float>((i - kMargin) * spacing_),
                static_cast<float>((j - kMargin) * spacing_)};
    }
    [[nodiscard]] Vec2 node(int i, int j) const {
        const float* n = nodes_.pixel(i, j);
        return {n[0], n[1]};
    }
    void set_node(int i, int j, Vec2 d) {
        float* n = nodes_.pixel(i, j);
        n[0] = d.x;
        n[1] = d.y;
    }

    /// The displacement at any position, in or outside of the frame.
    [[nodiscard]] Vec2 at(Vec2 p) const;
    /// The displacements at positions inside the frame. Neighbours in a row share work.
    [[nodiscard]] std::vector<Vec2> at(const std::vector<Vec2>& positions) const;
    /// The displacement at the centre of every pixel of `area` (inside the frame), in its order.
    [[nodiscard]] ImageF2 dense(const Recti& area) const;
    /// The same field on a lattice of another spacing.
    [[nodiscard]] LatticeField resampled(int spacing) const;

  private:
    Size full_;
    int spacing_ = 0;
    ImageF2 nodes_;
};

/// First `inner`, then `outer`: the displacement of p is inner(p) + outer(p + inner(p)). With
/// fields named target_from_source: a_from_c = compose(b_from_c, a_from_b). Same frame size; the
/// result has `inner`'s spacing.
[[nodiscard]] LatticeField compose(const LatticeField& inner, const LatticeField& outer);

/// The field in the other direction: from a_from_b, b_from_a. Works for any rotation and scale;
/// where the field folds over it gives the nearest place. Same frame size and spacing.
[[nodiscard]] LatticeField inverse(const LatticeField& field);

/// The field over an anamorphic frame, in unsqueezed places and steps, on a lattice of the same
/// spacing; the same field if the frame's pixels are square.
[[nodiscard]] LatticeField unsqueezed(const LatticeField& squeezed, PixelAspect aspect);

/// a + weight · (b − a), node by node; both of the same frame size and spacing.
[[nodiscard]] LatticeField mix(const LatticeField& a, const LatticeField& b, float weight);

}  // namespace weft
