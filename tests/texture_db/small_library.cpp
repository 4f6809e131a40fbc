#include "tests/texture_db/small_library.h"

#include "engine/core/parallel.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/starter/starter.h"

namespace weft {

std::shared_ptr<TextureLibrary> small_library() {
    static const Scratch scratch;
    static const std::shared_ptr<TextureLibrary> made = [] {
        constexpr int kEach = 10;
        std::vector<StarterItem> items;
        for (const StarterItem& item : starter_catalogue()) {
            if (item.number < kEach) items.push_back(item);
        }
        std::vector<NewTexture> textures(items.size());
        parallel_for(items.size(), [&](std::size_t i) {
            StarterPicture picture = make_starter(items[i], kSampleSide_px);
            NewTexture& t = textures[i];
            t.pixels = std::move(picture.pixels);
            t.name = picture.name;
            t.tags = picture.tags;
            t.material = items[i].material;
            t.origin = TextureOrigin::kProcedural;
            t.source = starter_source(items[i]);
            t.licence = items[i].number % 2 ? "CC0-1.0" : "GPL-2+";
        });
        auto library = open_or_die(scratch.at("small.db"));
        const bool good = library && library->add(textures) && library->train_descriptor();
        return good ? library : nullptr;
    }();
    return made;
}

}  // namespace weft
