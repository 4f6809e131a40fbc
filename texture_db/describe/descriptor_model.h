#pragma once
// Internal: the descriptor that is trained on a library. It maps features to a short vector in
// which samples of one material lie close together.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// y = P · clamp((x − mean) / deviation, −6, 6). Immutable.
struct DescriptorModel {
    int inputs = 0, outputs = 0;
    std::vector<float> mean, deviation;  ///< inputs
    std::vector<float> projection;       ///< outputs × inputs
    std::vector<std::string> materials;  ///< The materials of the training.
    std::vector<float> centres;          ///< materials × outputs

    [[nodiscard]] std::vector<float> describe(std::span<const float> features) const;
    /// From a descriptor to the centre of each material; very far for one with too few samples.
    [[nodiscard]] std::vector<float> distances_to_centres(std::span<const float> descriptor) const;
    [[nodiscard]] std::vector<std::byte> to_bytes() const;
    [[nodiscard]] static Expected<DescriptorModel> from_bytes(std::span<const std::byte> bytes);
};

struct LabelledFeatures {
    std::vector<std::vector<float>> features;
    std::vector<int> labels;     ///< Into `materials`.
    std::vector<float> weights;  ///< Of each sample.
    std::vector<std::string> materials;
};

/// Linear discriminant analysis (Fisher 1936; Rao 1948) with a shrunken within-class covariance
/// (Ledoit & Wolf 2004, fixed intensity), at most 40 outputs. Deterministic. Errors: Usage with
/// fewer than two materials of ten samples.
[[nodiscard]] Expected<DescriptorModel> learn_descriptor(const LabelledFeatures& data);

}  // namespace weft
