#pragma once
// Internal: an optional model that puts pictures and words into one space (as CLIP does: Radford et
// al. 2021), named by the user; none is shipped.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// A folder with model.json: name, image (an ONNX file: 1×3×size×size, RGB 0 … 1 less `mean`, by
/// `deviation`, to 1×N), words (a JSON file: {"stone": [N numbers], …}, the text side's vectors),
/// size (16 … 1024), mean and deviation (three numbers each), scale (logits per cosine; 100). The
/// format is described in docs/TEXTURES.md. Not thread-safe: a network holds its layers' results.
class ImageTextModel {
  public:
    /// Errors: Unreadable: a missing or damaged file, a network that OpenCV cannot run, words whose
    /// vectors have another length than the network gives, fewer than two words.
    [[nodiscard]] static Expected<ImageTextModel> open(const std::string& folder);
    ImageTextModel(ImageTextModel&&) noexcept;
    ImageTextModel& operator=(ImageTextModel&&) noexcept;
    ~ImageTextModel();

    [[nodiscard]] const std::string& name() const;
    /// Changes when any of its files does.
    [[nodiscard]] const std::string& identity() const;
    [[nodiscard]] int dimensions() const;
    /// The picture's vector, of length 1. Errors: Unreadable, where the network fails on it.
    [[nodiscard]] Expected<std::vector<float>> see(ViewU8x3 picture);
    /// The mean of the known words' vectors, of length 1; empty where none is known.
    [[nodiscard]] std::vector<float> read(std::string_view text) const;
    /// exp(scale × cosine) over the words given, summing to 1; a word that is not known gets 0.
    [[nodiscard]] std::vector<float> likelihoods(std::span<const float> seen,
                                                 const std::vector<std::string>& words) const;

  private:
    struct Parts;
    explicit ImageTextModel(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace weft
