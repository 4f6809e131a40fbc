#pragma once
// The textures that the drawer shows: their cards at once, their thumbnails as they are asked for,
// the visible ones first.

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
    std::string path;  ///< What is applied to a region.
    std::string name, material;
    std::vector<std::string> tags;
    std::string author, licence, source;
    Size size;  ///< 0 while unknown.
    /// Pixels of the picture that a library's sample was cut from, for one of the sample: above 1
    /// the larger picture shows more. 1 where there is none.
    float original_scale = 1;
};

/// "db:ID" of a texture that came from a library and was kept as a file (db_ID.png), else empty.
[[nodiscard]] std::string library_name_of(const std::string& path);

/// A file's or a library's name as it is shown: "Wall bricks 005".
[[nodiscard]] std::string shown_name(std::string name);

/// A texture that suits a region, and why.
struct TextureSuggestion {
    std::string path;
    std::string reason;  ///< "Same colour, finer grain"
    float score = 0;     ///< 0–1, higher suits better.
};

/// A region that wants a texture that goes with those of the others.
struct TogetherRegion {
    std::uint32_t region = 0;
    std::string name;
    std::shared_ptr<const Matte> matte;
    std::string keep;  ///< "db:ID" to be kept; empty: to be changed.
};

/// One texture for each region, chosen to go with each other.
struct TogetherSuggestion {
    std::vector<std::string> paths;    ///< In the order asked; empty for a region that has none.
    std::vector<std::string> reasons;  ///< Likewise.
    std::string why;
    float score = 0;
};

/// What the drawer asks of the library; all conditions hold together.
struct TextureQuery {
    std::string words;    ///< "rough grey stone"
    std::string origin;   ///< "package" (photographs), "procedural", "file", or any.
    std::string licence;  ///< As the source writes it, or any.
    [[nodiscard]] bool empty() const { return words.empty() && origin.empty() && licence.empty(); }
    bool operator==(const TextureQuery&) const = default;
};

struct TextureCount {
    std::string value;
    int count = 0;
};

struct TextureAnswer {
    std::vector<std::string> paths;               ///< The best first.
    std::vector<TextureCount> origins, licences;  ///< Over all of them, most frequent first.
};

/// A region that wants a texture.
struct SurfaceQuery {
    std::string region;  ///< Its name, which may say what it is.
    PicturePtr plate;
    std::shared_ptr<const Matte> matte;  ///< Of the plate's size.
    std::string excluded_licences;
};

/// An artist's own pictures on their way into the library.
struct TextureImport {
    std::string folder, author;
    std::string licence;          ///< Empty: not known.
    bool keep_originals = false;  ///< As ImportOptions has it.
};

/// How the last one goes, or went.
struct TextureImportState {
    bool running = false, failed = false;
    int done = 0, total = 0;  ///< Pictures.
    std::string outcome;      ///< "Brought in 40 samples of 3 pictures.", or what went wrong.
};

/// Thread-safe; nothing blocks. What is asked for in every frame (a ranking, a search, what is
/// similar, what goes together) has a worker each that answers the newest question; thumbnails and
/// details wait in a queue, since many of them are wanted at once.
class TextureShelf {
  public:
    explicit TextureShelf(std::size_t budget_bytes = std::size_t{192} << 20);
    ~TextureShelf();

    /// Looks through these folders in the background; a sub-folder's name is the material.
    void scan(std::vector<std::string> folders);
    /// Opens a texture library in the background, too, and fills an empty one with the starter
    /// textures. Its textures are named "db:ID". Once.
    void open_library(const std::string& path);
    /// Cuts samples out of a folder's pictures and adds them to the library, in the background; one
    /// import after the other. Interrupted by the end of the program, it goes on when asked again.
    void import_folder(const TextureImport& import);
    [[nodiscard]] TextureImportState importing() const;
    /// What is being done to the library ("Making the starter textures, 300 of 1700"), or nothing.
    [[nodiscard]] std::string activity() const;
    /// Everything known about a card; author, licence and tags of a library's texture come later.
    [[nodiscard]] TextureCard details(const TextureCard& card);
    /// How a texture is called: a library's, also where it was kept as a file, by its name there.
    [[nodiscard]] std::string name_of_texture(const std::string& path);
    /// The answer to a question; null while it is worked out, or without a library.
    [[nodiscard]] std::shared_ptr<const TextureAnswer> search(const TextureQuery& question);
    /// The whole library's counts; null without one.
    [[nodiscard]] std::shared_ptr<const TextureAnswer> everything() const;
    /// Looks for textures like this part of a picture, in the background. `key` stands for it.
    void find_similar(const std::string& key, PicturePtr picture, Recti part);
    /// The same for a picture file.
    void find_similar(const std::string& key, const std::string& picture_path);
    /// What was found, the nearest first; null while it is worked out.
    [[nodiscard]] std::shared_ptr<const std::vector<std::string>> similar(
        const std::string& key) const;
    [[nodiscard]] std::shared_ptr<const std::vector<TextureCard>> cards() const;
    /// Null while it is being made: asked for again every frame by what is visible. What is seen
    /// now comes first, in the order of the questions.
    [[nodiscard]] PicturePtr thumbnail(const std::string& path, int longest_px);
    /// Ranks the library's textures for a surface; `key` stands for all that it depends on.
    void suggest_for(const std::string& key, SurfaceQuery surface);
    /// The same for all regions together; `key` stands for all that it depends on.
    void suggest_together(const std::string& key, PicturePtr plate,
                          std::vector<TogetherRegion> regions,
                          const std::string& excluded_licences);
    /// What was found, the best first; null while it is worked out.
    [[nodiscard]] std::shared_ptr<const std::vector<TogetherSuggestion>> together(
        const std::string& key) const;
    [[nodiscard]] std::vector<TextureSuggestion> suggestions(const std::string& key) const;
    /// Whether they were worked out, or there is no library to choose from.
    [[nodiscard]] bool suggested(const std::string& key) const;
    /// Grows whenever something arrives.
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

    // Set once, before `open_`.
    std::shared_ptr<TextureLibrary> library_;
    std::string library_path_;
    std::atomic<bool> open_ = false;
    std::atomic<std::uint64_t> library_version_ = 0;  // grows when its textures change

    // What there is, for the window.
    Published<std::vector<TextureCard>> cards_{std::vector<TextureCard>{}};
    Published<TextureAnswer> everything_;
    Published<std::string> activity_{std::string()};
    Published<TextureImportState> importing_{TextureImportState{}};
    // Both lists of cards, from which workers make the one above.
    std::mutex listing_;
    std::vector<TextureCard> folder_cards_, library_cards_;

    mutable std::mutex mutex_;  // of all below, up to the threads
    std::condition_variable wake_;
    bool stop_ = false;
    /// In the order in which they were asked for last: those of a frame of the window stand
    /// together.
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
    std::set<std::string> unknown_;  // not in the library as it is now
    std::deque<std::string> pending_details_;
    std::string looking_up_;  // in flight
    std::deque<TextureImport> pending_imports_;

    std::thread queue_, filler_;
    std::thread importer_;  // begun by the first import

    // They use all above, and end first.
    LatestWorker<std::vector<std::string>, std::size_t> scanner_;
    LatestWorker<std::pair<TextureQuery, std::uint64_t>, TextureAnswer> searcher_;
    LatestWorker<std::string, std::vector<std::string>> similar_;
    LatestWorker<std::string, std::vector<TextureSuggestion>> ranking_;
    LatestWorker<std::string, std::vector<TogetherSuggestion>> together_;
};

}  // namespace weft
