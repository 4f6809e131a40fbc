#pragma once
// Costs of a seam between two pictures.

#include <cstdint>

#include "engine/core/image.h"
#include "engine/seam/seam.h"

namespace weft {

/// A seam cost of 1 (see fill_seam_costs()) as an integer of SeamProblem.
inline constexpr std::int32_t kSeamCostScale = 1 << 14;
/// ε of the seam cost, 8-bit units: keeps costs finite where both pictures are flat.
inline constexpr float kGradientFloor = 8.0f;

/// How the cost of a seam between two neighbours is measured.
enum class SeamCost {
    kGradient,  ///< Mismatch over gradient (Kwatra et al. 2003, section 3.2).
    kPaper      ///< The paper's eq. 2 and 3.
};

/// Fills `problem.right` and `problem.down` from the old picture A and the new picture B (each as
/// large as `problem.cells`, 8-bit RGB) with Kwatra et al. 2003, eq. 1 and section 3.2:
///   V_pq = (‖A(p)−B(p)‖ + ‖A(q)−B(q)‖) / (‖A(p)−A(q)‖ + ‖B(p)−B(q)‖ + ε) · kSeamCostScale,
/// rounded to the nearest integer. A seam prefers places where both pictures have an edge; a
/// smaller ε (`gradient_floor`) makes that preference stronger. Pixels outside the overlap may have
/// any value. Pure; thread-safe.
void fill_seam_costs(ViewU8x3 a, ViewU8x3 b, SeamProblem& problem,
                     float gradient_floor = kGradientFloor);

/// The paper's variant, eq. 3: V_pq = ‖I(p)−I(q)‖² / 255² · kSeamCostScale. I is the picture that
/// the result should resemble where `known` is set, else (A+B)/2 (`target` and `known` may be
/// empty). Eq. 2, D_p = ‖L(p)−I(p)‖², is fill_data_costs() where there is a target; elsewhere it is
/// the same for both pictures and left out. Measures contrast, not mismatch; kept for comparison.
void fill_paper_costs(ViewU8x3 a, ViewU8x3 b, ViewU8x3 target, ViewU8x1 known,
                      SeamProblem& problem);

/// Fills `problem.old_cost` and `problem.new_cost` from a picture that the result should resemble:
///   D_p = weight · ‖L(p)−target(p)‖² / 255² · kSeamCostScale, L the old or the new picture,
/// and 0 where `known` is 0 (the paper, eq. 5). Weights are in [0, 1000].
void fill_data_costs(ViewU8x3 a, ViewU8x3 b, ViewU8x3 target, ViewU8x1 known, float weight,
                     SeamProblem& problem);

}  // namespace weft
