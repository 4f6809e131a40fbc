#include "app/session/texture_shelf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/session/background.h"
#include "engine/media/image_files.h"
#include "engine/media/plates.h"
#include "texture_db/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// The statistics that suggestions go by, over the pixels where `inside` says so.
template <class Inside>
void statistics(ViewU8x3 picture, Inside&& inside, float mean[3], float& contrast, float& grain) {
    double sum[3] = {0, 0, 0}, luma_sum = 0, luma_square = 0, steps = 0;
    std::int64_t count = 0, step_count = 0;
    const auto luma = [&](int x, int y) {
        const std::uint8_t* p = picture.pixel(x, y);
        return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    };
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x + 1 < picture.width(); ++x) {
            if (!inside(x, y)) continue;
            for (int c = 0; c < 3; ++c)
                sum[c] += picture.pixel(x, y)[c];
            const double l = luma(x, y);
            luma_sum += l;
            luma_square += l * l;
            ++count;
            if (!inside(x + 1, y)) continue;
            steps += std::abs(l - luma(x + 1, y));
            ++step_count;
        }
    }
    if (count == 0) return;
    const auto n = static_cast<double>(count);
    for (int c = 0; c < 3; ++c)
        mean[c] = static_cast<float>(sum[c] / n);
    contrast =
        static_cast<float>(std::sqrt(std::max(0.0, luma_square / n - luma_sum * luma_sum / n / n)));
    grain = step_count ? static_cast<float>(steps / static_cast<double>(step_count)) : 0;
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
    : budget_bytes_(budget_bytes), cards_(std::make_shared<const std::vector<TextureCard>>()) {
    threads_.emplace_back([this] { work(); });
}

TextureShelf::~TextureShelf() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        cancel_.cancel();
    }
    wake_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
    if (importer_.joinable()) importer_.join();
}

void TextureShelf::look_in(std::vector<std::string> folders) {
    {
        const std::lock_guard lock(mutex_);
        if (folders == folders_) return;
        folders_ = folders;
        to_scan_ = std::move(folders);
        scan_due_ = true;
    }
    wake_.notify_all();
}

std::shared_ptr<const std::vector<TextureCard>> TextureShelf::cards() const {
    const std::lock_guard lock(mutex_);
    return cards_;
}

PicturePtr TextureShelf::thumbnail(const std::string& path, int longest_px) {
    const std::lock_guard lock(mutex_);
    const std::string name = path + "@" + std::to_string(longest_px);
    if (const auto found = kept_.find(name); found != kept_.end()) {
        found->second.used = ++clock_;
        return found->second.picture;
    }
    const auto same = [&](const Wish& w) { return w.path == path && w.longest_px == longest_px; };
    if (const auto at = std::find_if(wishes_.begin(), wishes_.end(), same); at != wishes_.end())
        wishes_.erase(at);
    wishes_.push_back({path, longest_px, std::chrono::steady_clock::now()});
    constexpr std::size_t kMostWaiting = 200;
    if (wishes_.size() > kMostWaiting) wishes_.pop_front();
    wake_.notify_all();
    return nullptr;
}

void TextureShelf::suggest_for(const std::string& key, SurfaceToSuit surface) {
    {
        const std::lock_guard lock(mutex_);
        if (key == ranked_key_ || key == rank_due_) return;
        rank_due_ = key;
        rank_surface_ = std::move(surface);
    }
    wake_.notify_all();
}

std::vector<TextureSuggestion> TextureShelf::suggestions(const std::string& key) const {
    const std::lock_guard lock(mutex_);
    return key == ranked_key_ ? ranked_ : std::vector<TextureSuggestion>{};
}

bool TextureShelf::suggested(const std::string& key) const {
    const std::lock_guard lock(mutex_);
    return key == ranked_key_;
}

std::uint64_t TextureShelf::arrivals() const {
    return arrivals_.load();
}

void TextureShelf::scan(const std::vector<std::string>& folders) {
    auto cards = std::make_shared<std::vector<TextureCard>>();
    for (const std::string& folder : folders) {
        std::error_code error;
        fs::recursive_directory_iterator it(folder, error), end;
        for (; !error && it != end; it.increment(error)) {
            const std::string path = it->path().string();
            if (!it->is_regular_file(error) || !has_picture_extension(path)) continue;
            TextureCard card;
            card.path = path;
            card.name = shown_name(it->path().stem().string());
            const fs::path parent = it->path().parent_path();
            card.material =
                parent == fs::path(folder) ? "Unsorted" : shown_name(parent.filename().string());
            card.source = folder;
            cards->push_back(std::move(card));
        }
    }
    std::sort(cards->begin(), cards->end(), [](const TextureCard& a, const TextureCard& b) {
        return std::tie(a.material, a.name, a.path) < std::tie(b.material, b.name, b.path);
    });
    folder_cards_ = std::move(*cards);
    publish();
}

void TextureShelf::publish() {
    auto cards = std::make_shared<std::vector<TextureCard>>(folder_cards_);
    cards->insert(cards->end(), library_cards_.begin(), library_cards_.end());
    std::shared_ptr<const std::vector<TextureCard>> old;  // freed after the lock is
    const std::lock_guard lock(mutex_);
    old = std::exchange(cards_, std::move(cards));
    ++arrivals_;
}

// What is on the screen now, from the first to the last: everything seen is asked for in each
// frame.
TextureShelf::Wish TextureShelf::next_wish() {
    constexpr std::chrono::milliseconds kOneFrame(50);
    const auto seen = wishes_.back().asked - kOneFrame;
    const auto at = std::find_if(wishes_.begin(), wishes_.end(),
                                 [&](const Wish& wish) { return wish.asked >= seen; });
    Wish wish = std::move(*at);
    wishes_.erase(at);
    return wish;
}

void TextureShelf::make_thumbnail(const Wish& wish) {
    PicturePtr picture;
    constexpr int kSample = 96;
    if (wish.path.starts_with("db:")) {
        std::shared_ptr<TextureLibrary> library;
        {
            const std::lock_guard lock(mutex_);
            library = library_;
        }
        if (library) {
            const std::string id = wish.path.substr(3);
            auto pixels = library->thumbnail(id);
            // Not for a card on a dense screen: the original of a drawn texture is drawn again.
            if (pixels && wish.longest_px > 4 * kSample) {
                if (auto larger = library->original(id)) pixels = std::move(larger);
            }
            if (pixels) picture = make_picture(shrink(pixels->view(), wish.longest_px));
        }
    } else if (const auto image = read_image(wish.path)) {
        const PicturePtr whole = make_picture(
            image->rgb, image->depth == PixelDepth::kU8 || image->depth == PixelDepth::kU16,
            nullptr, nullptr);
        picture = make_picture(shrink(*whole, wish.longest_px));
    }
    std::vector<PicturePtr> gone;  // freed after the lock is
    const std::lock_guard lock(mutex_);
    if (picture) bytes_ += picture->size_bytes();
    kept_[wish.path + "@" + std::to_string(wish.longest_px)] = {picture, wish.longest_px, ++clock_};
    ++arrivals_;
    gone = trim();
}

// Those that were not looked at for longest go, and more than need be: looking for them takes a
// while when there are thousands.
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

const TextureShelf::Look* TextureShelf::look_of(const std::string& path) {
    if (const auto found = looks_.find(path); found != looks_.end()) return &found->second;
    const auto image = read_image(path);
    if (!image) return nullptr;
    const PicturePtr whole = make_picture(image->rgb, true, nullptr, nullptr);
    const ImageU8x3 small = shrink(*whole, 256);
    Look look;
    statistics(
        small.view(), [](int, int) { return true; }, look.mean, look.contrast, look.grain);
    return &(looks_[path] = look);
}

void TextureShelf::rank(const std::string& key, const SurfaceToSuit& asked) {
    const ImageU8x3 whole = shrink(*asked.plate, 1 << 20);
    const Matte& matte = *asked.matte;
    if (!library_cards_.empty() && whole.size() == matte.size())
        return recommend(key, whole, asked);
    Look surface;
    if (whole.size() == matte.size()) {
        statistics(
            whole.view(), [&](int x, int y) { return matte.at(x, y) > 127; }, surface.mean,
            surface.contrast, surface.grain);
    }
    const auto all = cards();
    std::vector<TextureSuggestion> found;
    constexpr std::size_t kMostLooked = 400;
    for (std::size_t k = 0; k < std::min(all->size(), kMostLooked); ++k) {
        const Look* look = look_of((*all)[k].path);
        if (!look) continue;
        float colour = 0;
        for (int c = 0; c < 3; ++c)
            colour += std::abs(look->mean[c] - surface.mean[c]) / 3.0f;
        const float contrast = std::abs(look->contrast - surface.contrast);
        const float grain = std::abs(look->grain - surface.grain);
        TextureSuggestion one;
        one.path = (*all)[k].path;
        one.score = 1.0f / (1.0f + colour / 40.0f + contrast / 30.0f + grain / 12.0f);
        one.reason = colour < 28                       ? "Close in colour"
                     : contrast < 8                    ? "Similar contrast"
                     : look->grain > surface.grain + 4 ? "Livelier grain"
                     : look->grain < surface.grain - 4 ? "Calmer grain"
                                                       : "A fresh contrast";
        if (colour < 28 && contrast < 10) one.reason = "Close in colour and contrast";
        found.push_back(std::move(one));
    }
    std::stable_sort(
        found.begin(), found.end(),
        [](const TextureSuggestion& a, const TextureSuggestion& b) { return a.score > b.score; });
    constexpr std::size_t kShown = 8;
    if (found.size() > kShown) found.resize(kShown);
    const std::lock_guard lock(mutex_);
    ranked_key_ = key;
    ranked_ = std::move(found);
    ++arrivals_;
}

void TextureShelf::work() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] {
            return stop_ || scan_due_ || library_due_ || !wishes_.empty() || !rank_due_.empty() ||
                   search_due_ || !details_due_.empty() || !similar_due_.empty() || together_due_;
        });
        if (stop_) return;
        if (scan_due_) {
            scan_due_ = false;
            const auto folders = to_scan_;
            lock.unlock();
            scan(folders);
            lock.lock();
        } else if (library_due_) {
            library_due_ = false;
            lock.unlock();
            take_library();
            lock.lock();
        } else if (search_due_) {
            const TextureQuestion question = *std::exchange(search_due_, {});
            lock.unlock();
            search_library(question);
            lock.lock();
        } else if (!similar_due_.empty()) {
            const std::string key = std::exchange(similar_due_, {});
            PicturePtr picture = std::exchange(similar_picture_, nullptr);
            const std::string file = std::exchange(similar_file_, {});
            Recti part = similar_part_;
            lock.unlock();
            if (!picture && !file.empty()) {
                if (const auto read = read_image(file))
                    picture = make_picture(read->rgb, true, nullptr, nullptr);
                if (picture) part = rect_of(picture->size);
            }
            look_for_similar(key, picture.get(), part);
            lock.lock();
        } else if (together_due_) {
            const Together asked = *std::exchange(together_due_, {});
            lock.unlock();
            recommend_together(asked);
            lock.lock();
        } else if (!details_due_.empty()) {
            const std::string path = std::exchange(details_due_, {});
            lock.unlock();
            look_up(path);
            lock.lock();
        } else if (!wishes_.empty()) {
            const Wish wish = next_wish();
            lock.unlock();
            make_thumbnail(wish);
            lock.lock();
        } else {
            const std::string key = std::exchange(rank_due_, {});
            const SurfaceToSuit surface = std::exchange(rank_surface_, {});
            lock.unlock();
            if (surface.plate && surface.matte) rank(key, surface);
            lock.lock();
        }
    }
}

}  // namespace weft
