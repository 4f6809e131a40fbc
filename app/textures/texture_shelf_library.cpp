// The part of TextureShelf that accesses the texture library.

#include <fmt/format.h>

#include "app/base/background.h"
#include "app/textures/larger_original.h"
#include "app/textures/texture_shelf.h"
#include "engine/media/image_files.h"
#include "texture_db/library/library.h"
#include "texture_db/sources/import.h"

namespace weft {
namespace {

using Paths = std::vector<std::string>;

std::vector<TextureCount> counts_of(const std::vector<FacetCount>& facets) {
    std::vector<TextureCount> out;
    for (const FacetCount& facet : facets)
        out.push_back({facet.value, facet.count});
    return out;
}

std::string counted(int n, const char* one, const char* more) {
    return std::to_string(n) + " " + (n == 1 ? one : more);
}

std::string outcome_of(const ImportReport& report) {
    std::string out = "Imported " + counted(report.samples, "sample", "samples") + " from " +
                      counted(report.pictures, "image", "images") + ".";
    if (report.skipped > 0)
        out += " " + counted(report.skipped, "image was", "images were") +
               " skipped: already imported, or not a colour map.";
    if (!report.refused.empty())
        out += " " + counted(static_cast<int>(report.refused.size()), "image was", "images were") +
               " left out; the first: " + report.refused.front().first + " (" +
               report.refused.front().second + ").";
    return out;
}

// "No texture matches every word: the nearest lack 'cable'."
std::string note_on(const SearchResult& found) {
    if (!found.ignored.empty())
        return fmt::format("Nothing in the library is called '{}'.",
                           fmt::join(found.ignored, "', '"));
    if (found.missing.empty()) return {};
    return fmt::format("No texture matches every word: the nearest lack '{}'.",
                       fmt::join(found.missing, "', '"));
}

TextureAnswer answer_to(TextureLibrary& library, const TextureQuery& question) {
    SearchQuery query;
    query.text = question.words;
    for (const TextureOrigin origin :
         {TextureOrigin::kProcedural, TextureOrigin::kPackage, TextureOrigin::kFile})
        if (question.origin == name_of(origin)) query.origins.push_back(origin);
    if (!question.licence.empty()) query.licences.push_back(question.licence);
    query.limit = question.words.empty() ? 100'000 : 2000;
    if (question.words.empty()) query.sort = TextureSort::kMaterial;
    TextureAnswer answer;
    if (const auto found = library.search(query)) {
        for (const SearchHit& hit : found->hits)
            answer.paths.push_back("db:" + hit.id);
        answer.origins = counts_of(found->origins);
        answer.licences = counts_of(found->licences);
        answer.note = note_on(*found);
    }
    return answer;
}

Paths similar_to(TextureLibrary& library, const Picture& picture, const Recti& part) {
    Paths paths;
    const ImageU8x3 whole = shrink(picture, 1 << 20);
    constexpr int kCount = 120;
    if (const auto found = library.similar(whole.view().crop(part), kCount))
        for (const SearchHit& hit : *found)
            paths.push_back("db:" + hit.id);
    return paths;
}

std::string reason_of(const Suggestion& suggestion) {
    return suggestion.reasons.empty() ? std::string() : shown_name(suggestion.reasons[0]);
}

std::vector<TextureSuggestion> ranked_for(TextureLibrary& library, const SurfaceQuery& surface) {
    const ImageU8x3 plate = shrink(*surface.plate, 1 << 20);
    RecommendRequest request;
    request.excluded_licences = licence_list(surface.excluded_licences);
    request.plate = plate;
    request.regions.push_back({surface.region, surface.matte->view(), {}, {}});
    const auto found = library.recommend(request);
    std::vector<TextureSuggestion> out;
    if (!found || found->regions.empty()) return out;
    // What scores far below the best, or has nothing to say for it, is a guess and is not shown.
    // What suits a less likely role scores lower: of the first five for the regions of
    // bench/regions.json a limit of 0.6 hides 67 of 375, this one 5.
    constexpr float kGuess = 0.35f;
    float best = 0;
    for (const Suggestion& one : found->regions[0].suggestions)
        best = std::max(best, one.score);
    for (const Suggestion& one : found->regions[0].suggestions)
        if (one.score >= kGuess * best && !one.reasons.empty())
            out.push_back({"db:" + one.id, reason_of(one), one.score});
    return out;
}

std::vector<TogetherSuggestion> together_for(TextureLibrary& library, const Picture& picture,
                                             const std::vector<TogetherRegion>& regions,
                                             const std::string& excluded) {
    const ImageU8x3 plate = shrink(picture, 1 << 20);
    RecommendRequest request;
    request.plate = plate;
    request.excluded_licences = licence_list(excluded);
    for (const TogetherRegion& region : regions) {
        if (!region.matte || region.matte->size() != plate.size()) return {};
        request.regions.push_back(
            {region.name,
             region.matte->view(),
             region.keep.starts_with("db:") ? region.keep.substr(3) : region.keep,
             {}});
    }
    std::vector<TogetherSuggestion> out;
    const auto advice = library.recommend(request);
    if (!advice) return out;
    for (const SceneSuggestion& scene : advice->together) {
        TogetherSuggestion one;
        one.why = scene.why;
        one.score = scene.score;
        for (const Suggestion& s : scene.per_region) {
            one.paths.push_back(s.id.empty() ? std::string() : "db:" + s.id);
            one.reasons.push_back(reason_of(s));
        }
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace

// ---- filling it ------------------------------------------------------------------------------

void TextureShelf::open_library(const std::string& path) {
    if (!filler_.joinable()) filler_ = std::thread([this, path] { fill_library(path); });
}

std::string TextureShelf::activity() const {
    return *activity_.get();
}

void TextureShelf::fill_library(const std::string& path) {
    lower_thread_priority();
    const auto say = [&](std::string text) {
        activity_.put(std::move(text));
        ++changes_;
    };
    auto opened = TextureLibrary::open(path);
    if (!opened) return say(opened.error().text());
    library_ = *opened;
    library_path_ = path;
    open_ = true;
    list_library();
    constexpr std::int64_t kListedEvery = 200;
    std::int64_t listed = 0;
    const auto progress = [&](const ProgressEvent& event) {
        if (event.done >= listed + kListedEvery) {
            list_library();
            listed = event.done;
        }
        say("Making the starter textures, " + std::to_string(event.done) + " of " +
            std::to_string(event.total));
    };
    const Status filled = add_starter_textures(*library_, cancel_, progress);
    list_library();
    say(filled || cancel_.cancelled() ? std::string() : filled.error().text());
}

void TextureShelf::list_library() {
    SearchQuery all;
    all.sort = TextureSort::kMaterial;
    all.limit = 100'000;
    const auto found = library_->search(all);
    if (!found) return;
    std::vector<TextureCard> cards;
    for (const SearchHit& hit : found->hits) {
        TextureCard card;
        card.path = "db:" + hit.id;
        card.name = shown_name(hit.name);
        card.material = shown_name(hit.material);
        cards.push_back(std::move(card));
    }
    TextureAnswer counts;
    counts.origins = counts_of(found->origins);
    counts.licences = counts_of(found->licences);
    everything_.put(std::move(counts));
    {
        const std::lock_guard lock(mutex_);
        unknown_.clear();
    }
    const std::lock_guard lock(listing_);
    library_cards_ = std::move(cards);
    publish_cards();
    ++library_version_;
    ++changes_;
}

void TextureShelf::import_folder(const TextureImport& import) {
    TextureImportState state;
    state.running = library() != nullptr;
    state.failed = !state.running;
    if (state.running) {
        const std::lock_guard lock(mutex_);
        pending_imports_.push_back(import);
        if (!importer_.joinable()) importer_ = std::thread([this] { serve_imports(); });
    } else {
        state.outcome =
            "The texture library is not open yet, or cannot be: the drawer says why. Add the "
            "folder again then.";
    }
    importing_.put(std::move(state));
    ++changes_;
    wake_.notify_all();
}

TextureImportState TextureShelf::importing() const {
    return *importing_.get();
}

void TextureShelf::serve_imports() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || !pending_imports_.empty(); });
        if (stop_) return;
        const TextureImport asked = std::move(pending_imports_.front());
        pending_imports_.pop_front();
        lock.unlock();
        ImportOptions options;
        options.author = asked.author;
        if (!asked.licence.empty()) options.licence = asked.licence;
        options.keep_originals = asked.keep_originals;
        TextureImportState state;
        state.running = true;
        const auto report = import_pictures(*library_, {asked.folder}, options, cancel_,
                                            [&](const ProgressEvent& event) {
                                                state.done = static_cast<int>(event.done);
                                                state.total = static_cast<int>(event.total);
                                                importing_.put(state);
                                                ++changes_;
                                            });
        list_library();
        lock.lock();
        state.running = !pending_imports_.empty();
        state.failed = !report;
        state.outcome = report ? outcome_of(*report) : report.error().text();
        importing_.put(std::move(state));
        ++changes_;
    }
}

// Runs in the queue's thread.
std::optional<TextureCard> TextureShelf::card_of(const std::string& path) const {
    TextureCard card;
    card.path = path;
    if (!path.starts_with("db:")) {
        const auto credit = read_texture_credit(path);
        if (!credit || credit->name.empty()) return std::nullopt;
        card.name = shown_name(credit->name);
        card.material = shown_name(credit->material);
        card.author = credit->author;
        card.licence = credit->licence;
        card.source = credit->source;
        return card;
    }
    const auto info = library_->info(path.substr(3));
    if (!info) return std::nullopt;
    card.name = shown_name(info->name);
    card.material = shown_name(info->material);
    card.tags = info->tags;
    card.author = info->author;
    card.licence = info->licence;
    card.source = info->package.empty() ? info->source : info->package;
    card.size = info->original_size;
    if (const auto scale = original_scale(library_path_, info->id)) card.original_scale = *scale;
    return card;
}

void TextureShelf::look_up(const std::string& path) {
    auto card = card_of(path);
    const std::lock_guard lock(mutex_);
    if (!card) {
        unknown_.insert(path);
        return;
    }
    details_[path] = std::move(*card);
    ++changes_;
}

// ---- asking it -------------------------------------------------------------------------------

std::shared_ptr<const TextureAnswer> TextureShelf::everything() const {
    return everything_.get();
}

std::shared_ptr<const TextureAnswer> TextureShelf::search(const TextureQuery& question) {
    if (!library() || question.empty()) return nullptr;
    return searcher_.ask({question, library_version_.load()}, [this, question](const CancelToken&) {
        return std::optional(answer_to(*library_, question));
    });
}

void TextureShelf::find_similar(const std::string& key, PicturePtr picture, Recti part) {
    (void)similar_.ask(key, [this, picture = std::move(picture), part](const CancelToken&) {
        return std::optional(picture && library() ? similar_to(*library_, *picture, part)
                                                  : Paths());
    });
}

void TextureShelf::find_similar(const std::string& key, const std::string& picture_path) {
    (void)similar_.ask(key, [this, picture_path](const CancelToken&) {
        const auto read = read_image(picture_path);
        if (!read || !library()) return std::optional(Paths());
        const PicturePtr picture = make_picture(read->rgb, true, nullptr, nullptr);
        return std::optional(similar_to(*library_, *picture, rect_of(picture->size)));
    });
}

std::shared_ptr<const Paths> TextureShelf::similar(const std::string& key) const {
    return similar_.try_read(key);
}

void TextureShelf::suggest_for(const std::string& key, SurfaceQuery surface) {
    if (!library() || !surface.plate || !surface.matte) return;
    (void)ranking_.ask(key, [this, surface = std::move(surface)](const CancelToken&) {
        return std::optional(ranked_for(*library_, surface));
    });
}

std::vector<TextureSuggestion> TextureShelf::suggestions(const std::string& key) const {
    const auto found = ranking_.try_read(key);
    return found ? *found : std::vector<TextureSuggestion>{};
}

bool TextureShelf::suggested(const std::string& key) const {
    return !library() || ranking_.try_read(key);
}

void TextureShelf::suggest_together(const std::string& key, PicturePtr plate,
                                    std::vector<TogetherRegion> regions,
                                    const std::string& excluded_licences) {
    if (!library() || !plate) return;
    (void)together_.ask(key, [this, plate = std::move(plate), regions = std::move(regions),
                              excluded_licences](const CancelToken&) {
        return std::optional(together_for(*library_, *plate, regions, excluded_licences));
    });
}

std::shared_ptr<const std::vector<TogetherSuggestion>> TextureShelf::together(
    const std::string& key) const {
    return together_.try_read(key);
}

}  // namespace weft
