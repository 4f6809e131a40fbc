// Adds the starter textures to a library: copied from the file that was built with the program,
// else rendered now, a batch at a time. Textures that are already in it stay.

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "engine/core/parallel.h"
#include "texture_db/library/library_state.h"
#include "texture_db/starter/starter.h"

namespace weft {
namespace {

constexpr std::size_t kBatch = 64;
constexpr int kOriginalSide_px = 384;
constexpr const char* kDoneNote = "starter.done";
// Raise when the families change; missing textures are then added.
constexpr const char* kEdition = "2:";

std::string done_note(std::size_t done) {
    return kEdition + std::to_string(done);
}

Expected<std::size_t> done_so_far(TextureLibrary& library) {
    WEFT_TRY(note, library.note(kDoneNote));
    if (!note.starts_with(kEdition)) return std::size_t{0};
    const long done = std::strtol(note.c_str() + 2, nullptr, 10);
    return std::min(static_cast<std::size_t>(std::max(done, 0l)), starter_catalogue().size());
}

NewTexture as_new(const StarterItem& item) {
    StarterPicture picture = make_starter(item, kSampleSide_px);
    NewTexture t;
    t.pixels = std::move(picture.pixels);
    t.name = std::move(picture.name);
    t.material = item.material;
    t.category = "starter/" + std::string(item.material);
    t.tags = std::move(picture.tags);
    t.origin = TextureOrigin::kProcedural;
    t.source = starter_source(item);
    t.author = "Weft";
    t.licence = "CC0-1.0";
    t.original_size = {kOriginalSide_px, kOriginalSide_px};
    t.original_crop = {0, 0, kSampleSide_px, kSampleSide_px};
    return t;
}

// Beside the program: bin/weft and share/weft/starter.db.
std::string starter_library_file() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) return {};
    const auto file = program.parent_path().parent_path() / "share" / "weft" / "starter.db";
    return std::filesystem::is_regular_file(file, error) ? file.string() : std::string();
}

}  // namespace

Expected<bool> has_starter_textures(TextureLibrary& library) {
    WEFT_TRY(done, done_so_far(library));
    return done == starter_catalogue().size();
}

Status add_starter_textures(TextureLibrary& library, const CancelToken& cancel,
                            const ProgressFn& progress) {
    // One of each family in turn, so that a partly filled library already has some of each.
    std::vector<StarterItem> items = starter_catalogue();
    std::stable_sort(items.begin(), items.end(), [](const StarterItem& a, const StarterItem& b) {
        return a.number < b.number;
    });
    const std::string ready = starter_library_file();
    WEFT_TRY(samples, library.size());
    // A copy that cannot be read is not an error: the textures are rendered instead.
    if (samples == 0 && !ready.empty())
        (void)library.copy_from(ready, kDoneNote, done_note(items.size()));
    WEFT_TRY(done, done_so_far(library));
    const bool fresh = done < items.size();
    while (done < items.size()) {
        if (cancel.cancelled()) {
            return fail(static_cast<ErrorCode>(cancel.reason()),
                        "Making the starter textures was stopped", "the next run continues.");
        }
        const std::size_t end = std::min(items.size(), done + kBatch);
        std::vector<NewTexture> batch(end - done);
        parallel_for(batch.size(), [&](std::size_t i) { batch[i] = as_new(items[done + i]); });
        WEFT_TRY(added, library.add(batch));
        (void)added;
        done = end;
        WEFT_CHECK_OK(library.set_note(kDoneNote, done_note(done)));
        if (progress) {
            progress(ProgressEvent::titled("starter", static_cast<std::int64_t>(done),
                                           static_cast<std::int64_t>(items.size())));
        }
    }
    WEFT_TRY(stats, library.stats());
    if (fresh || !stats.descriptor_trained) return library.train_descriptor(cancel);
    return {};
}

}  // namespace weft
