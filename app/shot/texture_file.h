#pragma once
// The picture of a texture, from a file or from a library.

#include <string>

#include "engine/core/error.h"
#include "engine/media/image_files.h"
#include "texture_db/library/library.h"

namespace weft {

struct ReadTexture {
    PlateFrame picture;    ///< As stored, in the file's own colour space.
    TextureCredit credit;  ///< Empty where none is known.
};

/// Reads an image file, or a sample "db:ID" of the texture library at `library`. Thread-safe.
/// Errors: those of read_image() and resolve_texture().
[[nodiscard]] Expected<ReadTexture> read_texture(const std::string& path,
                                                 const std::string& library);

/// What to say of a texture whose `alpha` (H×W, 0–1, may be empty) is not opaque everywhere, since
/// alpha is not used; empty: nothing.
[[nodiscard]] std::string transparency_warning(const std::string& path, const ImageF1& alpha);

}  // namespace weft
