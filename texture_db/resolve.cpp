#include "texture_db/library.h"

namespace weft {

Expected<ResolvedTexture> resolve_texture(const std::string& library_path, const std::string& id) {
    const std::string path = library_path.empty() ? default_library_path() : library_path;
    LibraryOptions options;
    options.create = false;
    WEFT_TRY(library, TextureLibrary::open(path, options));
    WEFT_TRY(info, library->info(id));
    ResolvedTexture out;
    WEFT_TRY(pixels, library->thumbnail(info.id));
    out.pixels = std::move(pixels);
    if (!info.original_size.empty()) {
        WEFT_TRY(original, library->original(info.id));
        if (original.size() != out.pixels.size()) out.original = std::move(original);
    }
    out.credit = {{}, info.id, info.name, info.material, info.author, info.licence, info.source};
    if (!info.package.empty()) out.credit.source = info.package + ": " + info.source;
    return out;
}

}  // namespace weft
