#pragma once
#include "engine/core/error.h"
#include "engine/form/form_map.h"
#include "engine/form/metric_field.h"

namespace weft {

/// Lays a surface flat with as little stretch as its shape allows: the displacement (pixels) from a
/// place of the reference frame to its place on the flat surface, so that steps there are as long
/// as the metric says. Minimises the symmetric Dirichlet energy (Smith & Schaefer 2015) by
/// reweighted least squares (Rabinovich et al. 2017, SLIM) with a line search that never flips a
/// triangle, weighted by area; cells without evidence follow. The result is turned and scaled so
/// that, over the evidence inside of the reference frame (all of it if there is none), it is on
/// average as upright and in the median as large as the picture, and its centre stays where it is.
/// `field` must be finished. Bit-identical for any number of threads; thread-safe.
[[nodiscard]] FormMap flat_from_reference(const MetricField& field);

}  // namespace weft
