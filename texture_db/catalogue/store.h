#pragma once
// Adds samples to a library's file and removes them.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "texture_db/catalogue/query.h"

namespace weft {

class Database;

inline constexpr int kSampleSide_px = 96;

/// The input for one sample. `pixels` must be 96×96.
struct NewTexture {
    ImageU8x3 pixels;
    std::string name, material, category;
    std::vector<std::string> tags;
    TextureOrigin origin = TextureOrigin::kFile;
    std::string package, source, author, licence;
    /// Larger picture to keep in the file (as a JPEG of high quality), shared by the samples that
    /// were cut from it; or null.
    std::shared_ptr<const ImageU8x3> original;
    Size original_size;   ///< Of the picture at `source`, if that is kept by reference.
    Recti original_crop;  ///< The sample's place in that picture.
};

/// What is stored of a sample besides its name; computed outside the library's lock.
struct PreparedTexture {
    std::string id;
    std::vector<std::byte> png;
    MeasuredTexture measured;
    std::vector<float> features;
    float synthesis = 0;
};
/// A larger picture, encoded once for all samples from it.
struct PreparedPicture {
    Size size;
    std::string hash;
    std::vector<std::byte> bytes;
};
struct PreparedTextures {
    std::vector<PreparedTexture> samples;                  ///< In the order of the textures.
    std::map<const ImageU8x3*, PreparedPicture> pictures;  ///< By NewTexture::original.
};

/// Measures and encodes on thread_count() threads. Errors: Usage for a sample of another size.
[[nodiscard]] Expected<PreparedTextures> prepare_textures(const std::vector<NewTexture>& textures);
/// All or none, in one transaction; how many were new. The caller holds the library's lock.
[[nodiscard]] Expected<int> store_textures(Database& database,
                                           const std::vector<NewTexture>& textures,
                                           const PreparedTextures& prepared);
/// `id`: in full. The caller holds the library's lock.
[[nodiscard]] Status remove_texture(Database& database, const std::string& id);

}  // namespace weft
