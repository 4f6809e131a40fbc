#pragma once
// Internal: an optional model that maps pictures and words into one space (as CLIP does: Radford et
// al. 2021). The user supplies it; none is included.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// A folder with model.json: name, image (an ONNX file: 1×3×size×size, RGB 0 … 1 less `mean`,
/// divided by `deviation`, to 1×N), words (a JSON file: {"stone": [N numbers], …}, the text side's
/// vectors), size (16 … 1024), mean and deviation (three numbers each), scale (logits per cosine;
/// 100). docs/TEXTURES.md describes the format. Not thread-safe, because a network holds the
/// results of its layers.
class ImageTextModel {
  public:
    /// Errors: Unreadable for a missing or damaged file, a network that OpenCV cannot run, words
    /// whose vectors differ in length from the network's output, or fewer than two words.
    [[nodiscard]] static Expected<ImageTextModel> open(const std::string& folder);
    ImageTextModel(ImageTextModel&&) noexcept;
    ImageTextModel& operator=(ImageTextModel&&) noexcept;
    ~ImageTextModel();

    [[nodiscard]] const std::string& name() const;
    /// Changes when any of its files changes.
    [[nodiscard]] const std::string& identity() const;
    [[nodiscard]] int dimensions() const;
    /// The picture's vector, of length 1. Errors: Unreadable if the network fails on it.
    [[nodiscard]] Expected<std::vector<float>> encode_image(ViewU8x3 picture);
    /// The mean of the known words' vectors, of length 1; empty if no word is known.
    [[nodiscard]] std::vector<float> encode_text(std::string_view text) const;
    /// exp(scale × cosine) over the given words, summing to 1; 0 for an unknown word.
    [[nodiscard]] std::vector<float> likelihoods(std::span<const float> seen,
                                                 const std::vector<std::string>& words) const;

  private:
    struct Parts;
    explicit ImageTextModel(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace weft
