#pragma once
// The texture library: one SQLite file of 96×96 samples with everything known about them.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/media/write_rule.h"
#include "texture_db/catalogue/licence.h"
#include "texture_db/catalogue/marks.h"
#include "texture_db/catalogue/query.h"
#include "texture_db/catalogue/store.h"
#include "texture_db/recommend/recommend.h"

namespace weft {

/// $XDG_DATA_HOME/weft/textures.db, else ~/.local/share/weft/textures.db.
[[nodiscard]] std::string default_library_path();

struct LibraryOptions {
    bool create = true;      ///< Make an empty library where there is no file.
    bool read_only = false;  ///< Nothing is written; the schema must be current.
};

struct LibraryStats {
    std::int64_t samples = 0;
    std::vector<FacetCount> materials, origins, packages, licences;  ///< Most frequent first.
    std::int64_t file_bytes = 0;
    int schema_version = 0;
    bool descriptor_trained = false;
    /// Number of samples that the descriptor was trained on.
    std::int64_t descriptor_samples = 0;
};

/// A problem that `verify` found.
struct LibraryFault {
    std::string id;  ///< Empty: of the file as a whole.
    std::string what;
};

/// All members may be called from any thread; one call at a time runs, the others wait. Several
/// processes may have the same file open: readers never wait for a writer, and writers wait up to
/// 10 s for each other. Errors of every member: Unreadable (damaged file, no such id), NoSpace
/// (full disk; what was stored before stays).
class TextureLibrary {
  public:
    /// Opens or creates a library and upgrades an older schema. Takes well under 200 ms for 15,000
    /// samples, because pixels stay in the file. Errors: Unreadable if it is not a library, is
    /// damaged, or was written by a newer version.
    [[nodiscard]] static Expected<std::shared_ptr<TextureLibrary>> open(
        const std::string& path, const LibraryOptions& options = {});
    ~TextureLibrary();
    TextureLibrary(const TextureLibrary&) = delete;
    TextureLibrary& operator=(const TextureLibrary&) = delete;

    [[nodiscard]] const std::string& path() const;

    // ---- reading -----------------------------------------------------------------------------
    /// Number of samples.
    [[nodiscard]] Expected<std::int64_t> size();
    /// Grows whenever samples change, through this or another process: then reload views.
    [[nodiscard]] Expected<std::int64_t> change_count();
    /// The 96×96 pixels. About 0.3 ms.
    [[nodiscard]] Expected<ImageU8x3> thumbnail(const std::string& id);
    /// The larger picture that the sample was cut from (from the file or from its source), at most
    /// 4096 px a side; the sample itself if there is none or its source is missing.
    [[nodiscard]] Expected<ImageU8x3> original(const std::string& id);
    /// `id` may be a prefix (at least 6 digits) that matches one sample only.
    [[nodiscard]] Expected<TextureInfo> info(const std::string& id);
    /// Words over names, tags, materials and measured attributes; see docs/TEXTURES.md.
    [[nodiscard]] Expected<SearchResult> search(const SearchQuery& query);
    /// Nearest by the trained descriptor, best first, without the sample itself.
    [[nodiscard]] Expected<std::vector<SearchHit>> similar(const std::string& id, int count);
    /// The same for any picture of at least 32×32 (its middle 96×96 is used; smaller ones are
    /// extended by mirroring). The first five are the nearest of each of the five likeliest
    /// materials, then all others by distance.
    [[nodiscard]] Expected<std::vector<SearchHit>> similar(ViewU8x3 picture, int count);
    /// Suggestions for regions of a frame. Errors: Usage for an empty matte or sizes that differ.
    [[nodiscard]] Expected<Recommendation> recommend(const RecommendRequest& request);
    [[nodiscard]] Expected<LibraryStats> stats();
    /// Checks every row: ids against pixels, features, text index, SQLite's own check. Progress in
    /// samples. Returns an empty list for a sound library.
    [[nodiscard]] Expected<std::vector<LibraryFault>> verify(const CancelToken& cancel = {},
                                                             const ProgressFn& progress = {});

    // ---- what the artist keeps ------------------------------------------------------------------
    [[nodiscard]] Status set_favourite(const std::string& id, bool favourite);
    [[nodiscard]] Status set_rating(const std::string& id, int rating);  ///< 0 … 5.
    [[nodiscard]] Status set_material(const std::string& id, const std::string& material);
    [[nodiscard]] Status set_tags(const std::string& id, const std::vector<std::string>& tags);
    /// Records that a texture was used; the last 200 are kept.
    [[nodiscard]] Status mark_used(const std::string& id);
    [[nodiscard]] Expected<std::vector<std::string>> recent(int count);  ///< Ids, last first.
    [[nodiscard]] Expected<std::vector<FacetCount>> collections();
    [[nodiscard]] Status add_to_collection(const std::string& name, const std::string& id);
    [[nodiscard]] Status remove_from_collection(const std::string& name, const std::string& id);
    [[nodiscard]] Status delete_collection(const std::string& name);
    [[nodiscard]] Expected<std::vector<SavedSearch>> saved_searches();
    /// Replaces a search of the same name.
    [[nodiscard]] Status save_search(const std::string& name, const SearchQuery& query);
    [[nodiscard]] Status delete_saved_search(const std::string& name);

    // ---- writing
    // ----------------------------------------------------------------------------------
    /// Adds samples in one transaction: all or none. Features are computed on thread_count()
    /// threads. Returns how many were new.
    [[nodiscard]] Expected<int> add(const std::vector<NewTexture>& textures);
    [[nodiscard]] Status remove(const std::string& id);
    /// Trains the descriptor on the samples' materials and stores it. Errors: Usage with
    /// fewer than two materials of ten samples.
    [[nodiscard]] Status train_descriptor(const CancelToken& cancel = {},
                                          const ProgressFn& progress = {});
    /// Removes samples of packages that do not look like their material: too few of the 25 nearest
    /// samples from other images have it (confusable materials count as one). Returns their
    /// number. Trains the descriptor before and after. Packages for which `was_inspected` is true
    /// are not changed.
    [[nodiscard]] Expected<int> remove_outliers(
        const std::function<bool(const std::string& package)>& was_inspected,
        const CancelToken& cancel = {}, const ProgressFn& progress = {});
    /// Sets the image–text model (image_text_model.h) that searches and recommendations use in
    /// addition, and encodes every sample with it, unless that is done. If it is stopped, the next
    /// call continues. Empty: no model. Errors: Unreadable if the model cannot be used; the
    /// previous one stays.
    [[nodiscard]] Status use_image_text_model(const std::string& folder,
                                              const CancelToken& cancel = {},
                                              const ProgressFn& progress = {});
    /// The folder of the current model, or empty.
    [[nodiscard]] Expected<std::string> image_text_model();
    /// Copies the content of another library, with its descriptor, into this one, which must be
    /// empty, in one transaction; only if the other's note `key` is `value`. Returns true if it
    /// did.
    [[nodiscard]] Expected<bool> copy_from(const std::string& path, const std::string& key,
                                           const std::string& value);
    /// Notes for resuming long operations ("import:/home/me/pictures").
    [[nodiscard]] Expected<std::string> note(const std::string& key);
    [[nodiscard]] Status set_note(const std::string& key, const std::string& value);

  private:
    struct State;
    explicit TextureLibrary(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Adds the 4,000 starter textures unless they are in the library. An empty library gets them in
/// under a second from share/weft/starter.db beside the program, if ./run has built that file;
/// otherwise they are rendered (under a minute on two cores). After an interruption the next call
/// continues.
[[nodiscard]] Status add_starter_textures(TextureLibrary& library, const CancelToken& cancel = {},
                                          const ProgressFn& progress = {});
/// Returns true if all of them are in the library.
[[nodiscard]] Expected<bool> has_starter_textures(TextureLibrary& library);

/// A texture as a project uses it.
struct ResolvedTexture {
    ImageU8x3 pixels;    ///< 96×96.
    ImageU8x3 original;  ///< Larger, or empty.
    TextureCredit credit;
};
/// Takes "db:ID" or "ID" (at least 6 digits of it). `library_path` empty: the default one. Errors:
/// Usage if the name is not an id; Unreadable if there is no such texture or library.
[[nodiscard]] Expected<ResolvedTexture> resolve_texture(const std::string& library_path,
                                                        const std::string& id);

/// Writes a texture as FOLDER/db_ID.png with its credit beside it (db_ID.png.credit.json), so that
/// a project contains the pixels and opens without the library. Returns the path. Errors: those of
/// resolve_texture(); NoSpace, Unreadable for the folder.
[[nodiscard]] Expected<std::string> keep_texture(const std::string& library_path,
                                                 const std::string& id, const std::string& folder,
                                                 const WriteRule& rule = WriteRule::own());
[[nodiscard]] Expected<std::string> keep_texture(const ResolvedTexture& texture,
                                                 const std::string& folder,
                                                 const WriteRule& rule = WriteRule::own());
/// The path of a picture's credit file; empty if there is none.
[[nodiscard]] std::string texture_credit_path(const std::string& picture_path);
/// The credit that keep_texture() wrote beside a picture, if there is one.
[[nodiscard]] std::optional<TextureCredit> read_texture_credit(const std::string& picture_path);

}  // namespace weft
