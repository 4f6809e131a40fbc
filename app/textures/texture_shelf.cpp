#include "app/textures/texture_shelf.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "app/base/background.h"
#include "engine/media/image_files.h"
#include "engine/media/plates.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::vector<TextureCard> cards_in(const std::vector<std::string>& folders,
                                  const CancelToken& cancel) {
    std::vector<TextureCard> cards;
    for (const std::string& folder : folders) {
        std::error_code error;
        fs::recursive_directory_iterator it(folder, error), end;
        for (; !error && it != end && !cancel.cancelled(); it.increment(error)) {
            const std::string path = it->path().string();
            if (!it->is_regular_file(error) || !has_picture_extension(path)) continue;
            TextureCard card;
            card.path = path;
            card.name = shown_name(it->path().stem().string());
            const fs::path parent = it->path().parent_path();
            card.material =
                parent == fs::path(folder) ? "Unsorted" : shown_name(parent.filename().string());
            card.source = folder;
            cards.push_back(std::move(card));
        }
    }
    std::sort(cards.begin(), cards.end(), [](const TextureCard& a, const TextureCard& b) {
        return std::tie(a.material, a.name, a.path) < std::tie(b.material, b.name, b.path);
    });
    return cards;
}

std::string name_of(const std::string& path, int longest_px) {
    return path + "@" + std::to_string(longest_px);
}

}  // namespace

std::string library_name_of(const std::string& path) {
    if (path.starts_with("db:")) return path;
    const std::string stem = fs::path(path).stem().string();
    // "db_ID", or "db_ID_larger" of its original.
    constexpr std::size_t kIdDigits = 32;
    const bool named = stem.starts_with("db_") && stem.size() >= kIdDigits + 3 &&
                       (stem.size() == kIdDigits + 3 || stem[kIdDigits + 3] == '_');
    return named ? "db:" + stem.substr(3, kIdDigits) : std::string();
}

std::string shown_name(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    std::replace(name.begin(), name.end(), '-', ' ');
    if (!name.empty())
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

TextureShelf::TextureShelf(std::size_t budget_bytes)
    : budget_bytes_(budget_bytes),
      queue_([this] { serve_queue(); }),
      scanner_([this] { ++changes_; }),
      searcher_([this] { ++changes_; }),
      similar_([this] { ++changes_; }),
      ranking_([this] { ++changes_; }),
      together_([this] { ++changes_; }) {}

TextureShelf::~TextureShelf() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        cancel_.cancel();
    }
    wake_.notify_all();
    queue_.join();
    if (filler_.joinable()) filler_.join();
    if (importer_.joinable()) importer_.join();
}

void TextureShelf::scan(std::vector<std::string> folders) {
    (void)scanner_.ask(folders,
                       [this, folders](const CancelToken& cancel) -> std::optional<std::size_t> {
                           std::vector<TextureCard> cards = cards_in(folders, cancel);
                           if (cancel.cancelled()) return std::nullopt;
                           const std::lock_guard lock(listing_);
                           folder_cards_ = std::move(cards);
                           publish_cards();
                           return folder_cards_.size();
                       });
}

// Requires the lock `listing_`.
void TextureShelf::publish_cards() {
    std::vector<TextureCard> cards = folder_cards_;
    cards.insert(cards.end(), library_cards_.begin(), library_cards_.end());
    cards_.put(std::move(cards));
}

std::shared_ptr<const std::vector<TextureCard>> TextureShelf::cards() const {
    return cards_.get();
}

std::uint64_t TextureShelf::changes() const {
    return changes_.load();
}

PicturePtr TextureShelf::thumbnail(const std::string& path, int longest_px) {
    if (path.starts_with("db:") && !library()) return nullptr;
    ThumbnailRequest request{path, longest_px, std::chrono::steady_clock::now()};
    const std::lock_guard lock(mutex_);
    if (const auto found = kept_.find(name_of(path, longest_px)); found != kept_.end()) {
        found->second.used = ++clock_;
        return found->second.picture;
    }
    if (making_ && making_->same(request)) return nullptr;
    const auto at =
        std::find_if(pending_thumbnails_.begin(), pending_thumbnails_.end(),
                     [&](const ThumbnailRequest& other) { return other.same(request); });
    if (at != pending_thumbnails_.end()) pending_thumbnails_.erase(at);
    pending_thumbnails_.push_back(std::move(request));
    constexpr std::size_t kMostWaiting = 200;
    if (pending_thumbnails_.size() > kMostWaiting) pending_thumbnails_.pop_front();
    wake_.notify_all();
    return nullptr;
}

void TextureShelf::forget_thumbnails(const std::string& path) {
    const std::lock_guard lock(mutex_);
    std::erase_if(kept_, [&](const auto& entry) {
        const Kept& kept = entry.second;
        if (entry.first != name_of(path, kept.longest_px)) return false;
        if (kept.picture) bytes_ -= kept.picture->size_bytes();
        return true;
    });
}

TextureCard TextureShelf::details(const TextureCard& card) {
    return card.path.starts_with("db:") && library() ? looked_up(card) : card;
}

// What is known of it by now; the rest is asked for.
TextureCard TextureShelf::looked_up(const TextureCard& card) {
    const std::lock_guard lock(mutex_);
    if (const auto found = details_.find(card.path); found != details_.end()) return found->second;
    const bool asked = looking_up_ == card.path || unknown_.contains(card.path) ||
                       std::find(pending_details_.begin(), pending_details_.end(), card.path) !=
                           pending_details_.end();
    if (asked) return card;
    pending_details_.push_back(card.path);
    constexpr std::size_t kMostWaiting = 64;
    if (pending_details_.size() > kMostWaiting) pending_details_.pop_front();
    wake_.notify_all();
    return card;
}

std::string TextureShelf::name_of_texture(const std::string& path) {
    TextureCard card;
    card.path = library_name_of(path);
    const bool is_kept = !card.path.empty() && card.path != path;
    if (!card.path.empty()) card = details(card);
    // The library may be still opening, or be another one than the project's textures came from.
    if (card.name.empty() && is_kept) {
        card.path = path;
        card = looked_up(card);
    }
    return card.name.empty() ? fs::path(path).filename().string() : card.name;
}

void TextureShelf::serve_queue() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] {
            return stop_ || !pending_details_.empty() || !pending_thumbnails_.empty();
        });
        if (stop_) return;
        if (!pending_details_.empty()) {
            looking_up_ = pending_details_.back();  // newest request first
            pending_details_.pop_back();
            lock.unlock();
            look_up(looking_up_);
            lock.lock();
            looking_up_.clear();
        } else {
            making_ = next_thumbnail();
            lock.unlock();
            make_thumbnail(*making_);
            lock.lock();
            making_.reset();
        }
    }
}

// Requests of the current frame in order: everything visible is requested in each frame.
TextureShelf::ThumbnailRequest TextureShelf::next_thumbnail() {
    constexpr std::chrono::milliseconds kOneFrame(50);
    const auto seen = pending_thumbnails_.back().asked - kOneFrame;
    const auto at =
        std::find_if(pending_thumbnails_.begin(), pending_thumbnails_.end(),
                     [&](const ThumbnailRequest& request) { return request.asked >= seen; });
    ThumbnailRequest request = std::move(*at);
    pending_thumbnails_.erase(at);
    return request;
}

void TextureShelf::make_thumbnail(const ThumbnailRequest& request) {
    PicturePtr picture;
    constexpr int kSample = 96;
    if (request.path.starts_with("db:")) {
        if (TextureLibrary* const from = library()) {
            const std::string id = request.path.substr(3);
            auto pixels = from->thumbnail(id);
            // Only for large previews: the original of a procedural texture must be drawn again.
            if (pixels && request.longest_px > 4 * kSample) {
                if (auto larger = from->original(id)) pixels = std::move(larger);
            }
            if (pixels) picture = make_picture(shrink(pixels->view(), request.longest_px));
        }
    } else if (const auto image = read_image(request.path)) {
        const PicturePtr whole = make_picture(
            image->rgb, image->depth == PixelDepth::kU8 || image->depth == PixelDepth::kU16,
            nullptr, nullptr);
        picture = make_picture(shrink(*whole, request.longest_px));
    }
    std::vector<PicturePtr> gone;  // destroyed after the lock is released
    const std::lock_guard lock(mutex_);
    if (picture) bytes_ += picture->size_bytes();
    kept_[name_of(request.path, request.longest_px)] = {picture, request.longest_px, ++clock_};
    ++changes_;
    gone = trim();
}

// Frees the least recently used pictures, more than necessary, because sorting thousands takes
// time.
std::vector<PicturePtr> TextureShelf::trim() {
    std::vector<PicturePtr> gone;
    if (bytes_ <= budget_bytes_) return gone;
    std::vector<std::pair<std::uint64_t, std::map<std::string, Kept>::iterator>> order;
    order.reserve(kept_.size());
    for (auto it = kept_.begin(); it != kept_.end(); ++it)
        order.emplace_back(it->second.used, it);
    std::sort(order.begin(), order.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [used, it] : order) {
        if (bytes_ <= budget_bytes_ / 8 * 7 || kept_.size() == 1) break;
        if (it->second.picture) bytes_ -= it->second.picture->size_bytes();
        gone.push_back(std::move(it->second.picture));
        kept_.erase(it);
    }
    return gone;
}

}  // namespace weft
