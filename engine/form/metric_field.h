#pragma once
// How long a step on a surface is for a step on the reference frame.

#include <functional>
#include <optional>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// The first fundamental form G = (∂P/∂x)ᵀ(∂P/∂x) of the surface's place P over the picture: a step
/// dx of pixels is √(dxᵀ G dx) long on the surface. Positive definite where it is known.
struct Metric {
    double xx = 0, xy = 0, yy = 0;

    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
};

/// The square root of the smaller eigenvalue over the larger: the cosine at which a surface is seen
/// without perspective, 1 where it faces the camera.
[[nodiscard]] double facing(const Metric& metric);
/// ½ ln det G: of the area of a pixel on the surface.
[[nodiscard]] double log_area(const Metric& metric);

/// Metrics in the cells of a lattice over a rectangle of the reference frame's plane: cell (i, j)
/// lies between the nodes (i, j) and (i + 1, j + 1) of a LatticeField of the rectangle's size and
/// of the same spacing.
class MetricField {
  public:
    /// `frame`: size of the reference frame; `domain`: the rectangle, in its pixels; `spacing` ≥
    /// 1 px.
    MetricField(Size frame, const Recti& domain, int spacing);
    /// Over the reference frame itself.
    MetricField(Size frame, int spacing);

    [[nodiscard]] const Recti& domain() const { return domain_; }
    [[nodiscard]] int spacing() const { return spacing_; }
    [[nodiscard]] Size cells() const { return cells_; }
    [[nodiscard]] const Metric& at(int i, int j) const { return metrics_[index(i, j)]; }
    /// How much evidence the cell has; 0 where its metric was only continued.
    [[nodiscard]] double evidence(int i, int j) const { return evidence_[index(i, j)]; }
    /// The place of the cell's centre on the reference frame.
    [[nodiscard]] Vec2 centre_of(int i, int j) const;
    /// Whether the cell's centre lies inside of the reference frame.
    [[nodiscard]] bool in_frame(int i, int j) const;

    /// Adds a measurement at a place of the reference frame (pixels), which may lie outside of it;
    /// beyond the lattice it does not count. `weight` > 0.
    void add(Vec2 place, const Metric& metric, double weight);
    /// Whether something was added.
    [[nodiscard]] bool has_evidence() const;
    /// log_area() of the mean of what was added at a place; empty if nothing was. Before finish().
    [[nodiscard]] std::optional<double> log_area(Vec2 place) const;
    /// Turns sums into means, and continues them smoothly to the cells without evidence (harmonic
    /// in ln G). All are scaled so that the cells with evidence have an area of 1 px² a px² in the
    /// geometric mean. Returns false if nothing was added. Call it once, after the last add().
    [[nodiscard]] bool finish() { return finish({}); }
    /// The same; where `beyond` has a metric for a place, in the unit of what was added, a cell
    /// without evidence takes that.
    using Beyond = std::function<std::optional<Metric>(Vec2 place)>;
    [[nodiscard]] bool finish(const Beyond& beyond);
    /// By how much finish() scaled what was added.
    [[nodiscard]] double scaled_by() const { return scaled_by_; }

  private:
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_.width) +
               static_cast<std::size_t>(i);
    }
    // The cell of a place, if it lies in the domain.
    [[nodiscard]] std::optional<std::size_t> cell_of(Vec2 place) const;
    // The factor to the unit of area.
    double scale_to_unit_area();
    void continue_outwards(const std::vector<bool>& known);

    Size frame_, cells_;
    Recti domain_;
    int spacing_;
    double scaled_by_ = 1;
    std::vector<Metric> metrics_;
    std::vector<double> evidence_;
};

}  // namespace weft
