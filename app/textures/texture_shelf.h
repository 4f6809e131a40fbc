#pragma once
// The textures of the drawer: cards at once, thumbnails on request, visible ones first.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/base/picture.h"
#include "engine/core/cancel.h"

namespace weft {

class TextureLibrary;

struct TextureCard {
    std::string path;  ///< Path that is applied to a region.
    std::string name, material;
    std::vector<std::string> tags;
    std::string author, licence, source;
    Size size;  ///< Size; 0: not known yet.
    /// Pixels of the original image per pixel of the library sample: above 1 the original has more
    /// detail. 1: no original.
    float original_scale = 1;
};

/// Returns "db:ID" for a library texture that was copied to a file (db_ID.png), otherwise an empty
/// string.
[[nodiscard]] std::string library_name_of(const std::string& path);

/// Display name of a file or library texture: "Wall bricks 005".
[[nodiscard]] std::string shown_name(std::string name);

/// A texture suggested for a region, with the reason.
struct TextureSuggestion {
    std::string path;
    std::string reason;  ///< "Same colour, finer grain"
    float score = 0;     ///< Score, 0–1; higher is better.
};

/// A region of a set: its texture must match those of the other regions.
struct TogetherRegion {
    std::uint32_t region = 0;
    std::string name;
    std::shared_ptr<const Matte> matte;
    std::string keep;  ///< "db:ID" of a texture to keep; empty: suggest one.
};

/// A set: one texture for each region, chosen to match.
struct TogetherSuggestion {
    std::vector<std::string> paths;    ///< In the order of the request; empty if there is none.
    std::vector<std::string> reasons;  ///< Reasons, in the same order.
    std::string why;
    float score = 0;
};

/// A search in the library; all conditions must hold.
struct TextureQuery {
    std::string words;    ///< "rough grey stone"
    std::string origin;   ///< "package" (photographs), "procedural", "file", or any.
    std::string licence;  ///< Licence as written by the source; empty: any.
    [[nodiscard]] bool empty() const { return words.empty() && origin.empty() && licence.empty(); }
    bool operator==(const TextureQuery&) const = default;
};

struct TextureCount {
    std::string value;
    int count = 0;
};

struct TextureAnswer {
    std::vector<std::string> paths;               ///< Results, best first.
    std::vector<TextureCount> origins, licences;  ///< Counts over all results, most frequent first.
    std::string note;  ///< Which words found nothing, a sentence; empty: all found something.
};

/// A region for which textures are suggested.
struct SurfaceQuery {
    std::string region;  ///< Name of the region, a hint at its material.
    PicturePtr plate;
    std::shared_ptr<const Matte> matte;  ///< Matte at the plate's size.
    std::string excluded_licences;
};

/// An import of the user's own images into the library.
struct TextureImport {
    std::string folder, author;
    std::string licence;          ///< Licence; empty: not known.
    bool keep_originals = false;  ///< As in ImportOptions.
};

/// State of the current or last import.
struct TextureImportState {
    bool running = false, failed = false;
    int done = 0, total = 0;  ///< Numbers of images.
    std::string outcome;      ///< "Imported 40 samples from 3 images.", or the error.
};

/// Thread-safe; does not block. Each kind of repeated request (suggestions, search, similar
/// textures, sets) has a worker that answers the newest one. Thumbnails and details are queued,
/// because many are needed at once.
class TextureShelf {
  public:
    explicit TextureShelf(std::size_t budget_bytes = std::size_t{192} << 20);
    ~TextureShelf();

    /// Lists these folders in the background; a subfolder's name is the material.
    void scan(std::vector<std::string> folders);
    /// Opens a texture library in the background and fills an empty one with the starter textures.
    /// Its textures are named "db:ID". Call it once.
    void open_library(const std::string& path);
    /// Imports samples from a folder's images into the library in the background, one import after
    /// another. An import interrupted by closing the program continues when it is requested again.
    void import_folder(const TextureImport& import);
    [[nodiscard]] TextureImportState importing() const;
    /// Current work on the library ("Making the starter textures, 300 of 1700"); empty: none.
    [[nodiscard]] std::string activity() const;
    /// Everything known about a card; author, licence and tags of a library texture arrive later.
    [[nodiscard]] TextureCard details(const TextureCard& card);
    /// Display name of a texture; for a library texture, also one copied to a file, its name in the
    /// library or, without that, in the credit beside the file. The file's name until it is known.
    [[nodiscard]] std::string name_of_texture(const std::string& path);
    /// Result of a search; null while in progress, or without a library.
    [[nodiscard]] std::shared_ptr<const TextureAnswer> search(const TextureQuery& question);
    /// Counts over the whole library; null without one.
    [[nodiscard]] std::shared_ptr<const TextureAnswer> everything() const;
    /// Finds textures similar to this part of a picture in the background. `key` identifies it.
    void find_similar(const std::string& key, PicturePtr picture, Recti part);
    /// The same for an image file.
    void find_similar(const std::string& key, const std::string& picture_path);
    /// Similar textures, nearest first; null while in progress.
    [[nodiscard]] std::shared_ptr<const std::vector<std::string>> similar(
        const std::string& key) const;
    [[nodiscard]] std::shared_ptr<const std::vector<TextureCard>> cards() const;
    /// Returns a thumbnail; null until it is ready. Visible items request theirs in every frame;
    /// the current ones are served first, in request order.
    [[nodiscard]] PicturePtr thumbnail(const std::string& path, int longest_px);
    /// The file has been written anew: its thumbnails are made again when they are asked for.
    void forget_thumbnails(const std::string& path);
    /// Ranks the library's textures for a region; `key` identifies everything that the result
    /// depends on.
    void suggest_for(const std::string& key, SurfaceQuery surface);
    /// Finds sets for all regions; `key` identifies everything that the result depends on.
    void suggest_together(const std::string& key, PicturePtr plate,
                          std::vector<TogetherRegion> regions,
                          const std::string& excluded_licences);
    /// Suggested sets, best first; null while in progress.
    [[nodiscard]] std::shared_ptr<const std::vector<TogetherSuggestion>> together(
        const std::string& key) const;
    [[nodiscard]] std::vector<TextureSuggestion> suggestions(const std::string& key) const;
    /// Returns true if the suggestions are ready, or there is no library.
    [[nodiscard]] bool suggested(const std::string& key) const;
    /// Increases whenever a result arrives.
    [[nodiscard]] std::uint64_t changes() const;

  private:
    struct ThumbnailRequest {
        std::string path;
        int longest_px = 0;
        std::chrono::steady_clock::time_point asked;
        [[nodiscard]] bool same(const ThumbnailRequest& o) const {
            return path == o.path && longest_px == o.longest_px;
        }
    };
    // ---- the queue of thumbnails and details ----
    void serve_queue();
    [[nodiscard]] ThumbnailRequest next_thumbnail();
    void make_thumbnail(const ThumbnailRequest& request);
    [[nodiscard]] TextureCard looked_up(const TextureCard& card);
    [[nodiscard]] std::optional<TextureCard> card_of(const std::string& path) const;
    void look_up(const std::string& path);
    [[nodiscard]] std::vector<PicturePtr> trim();

    // ---- the library ----
    /// Null until it is open.
    [[nodiscard]] TextureLibrary* library() const { return open_ ? library_.get() : nullptr; }
    void fill_library(const std::string& path);
    void serve_imports();
    void list_library();
    void publish_cards();

    const std::size_t budget_bytes_;
    std::atomic<std::uint64_t> changes_ = 0;
    CancelToken cancel_;

    // Set once, before `open_` becomes true.
    std::shared_ptr<TextureLibrary> library_;
    std::string library_path_;
    std::atomic<bool> open_ = false;
    std::atomic<std::uint64_t> library_version_ = 0;  // increases when its textures change

    // Published cards, for the window.
    Published<std::vector<TextureCard>> cards_{std::vector<TextureCard>{}};
    Published<TextureAnswer> everything_;
    Published<std::string> activity_{std::string()};
    Published<TextureImportState> importing_{TextureImportState{}};
    // The two lists of cards that workers merge into `cards_`.
    std::mutex listing_;
    std::vector<TextureCard> folder_cards_, library_cards_;

    mutable std::mutex mutex_;  // protects all members below, up to the threads
    std::condition_variable wake_;
    bool stop_ = false;
    /// In order of the last request; requests of one window frame are adjacent.
    std::deque<ThumbnailRequest> pending_thumbnails_;
    std::optional<ThumbnailRequest> making_;  // in flight
    struct Kept {
        PicturePtr picture;  ///< Null: it cannot be read.
        int longest_px = 0;
        std::uint64_t used = 0;
    };
    std::map<std::string, Kept> kept_;
    std::size_t bytes_ = 0;
    std::uint64_t clock_ = 0;
    std::map<std::string, TextureCard> details_;
    std::set<std::string> unknown_;  // not in the current library
    std::deque<std::string> pending_details_;
    std::string looking_up_;  // in flight
    std::deque<TextureImport> pending_imports_;

    std::thread queue_, filler_;
    std::thread importer_;  // started by the first import

    // They use the members above and are destroyed first.
    LatestWorker<std::vector<std::string>, std::size_t> scanner_;
    LatestWorker<std::pair<TextureQuery, std::uint64_t>, TextureAnswer> searcher_;
    LatestWorker<std::string, std::vector<std::string>> similar_;
    LatestWorker<std::string, std::vector<TextureSuggestion>> ranking_;
    LatestWorker<std::string, std::vector<TogetherSuggestion>> together_;
};

}  // namespace weft
