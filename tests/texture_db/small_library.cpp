#include "tests/texture_db/small_library.h"

#include <unistd.h>

#include <filesystem>

#include "engine/core/parallel.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/starter/starter.h"

namespace weft {

namespace {

namespace fs = std::filesystem;

std::shared_ptr<TextureLibrary> make(const std::string& path) {
    constexpr int kEach = 10;  // the fewest that the descriptor is learned from
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
    auto library = open_or_die(path);
    const bool good = library && library->add(textures) && library->train_descriptor();
    return good ? library : nullptr;
}

// Every test may run in a process of its own: the library is made once for each build of the
// program, beside it, under a name that tells the build.
std::string path_beside_program() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return {};
    const auto stamp = fs::last_write_time(program, error).time_since_epoch().count();
    return error ? std::string() : program.string() + "." + std::to_string(stamp) + ".library.db";
}

}  // namespace

std::shared_ptr<TextureLibrary> small_library() {
    static const Scratch scratch;
    static const std::shared_ptr<TextureLibrary> made = [] {
        const std::string kept = path_beside_program();
        if (kept.empty()) return make(scratch.at("small.db"));
        if (fs::exists(kept)) return open_or_die(kept);
        const std::string fresh = kept + "." + std::to_string(::getpid());
        if (!make(fresh)) return std::shared_ptr<TextureLibrary>();
        // Closed by now, so that nothing is left in a journal beside it.
        std::error_code error;
        fs::rename(fresh, kept, error);
        return error ? nullptr : open_or_die(kept);
    }();
    return made;
}

}  // namespace weft
