// The part of the shelf that asks the texture library.
#include <filesystem>

#include "app/session/background.h"
#include "app/session/larger_original.h"
#include "app/session/texture_shelf.h"
#include "texture_db/import.h"
#include "texture_db/library.h"

namespace weft {
namespace {

std::vector<TextureCount> counts_of(const std::vector<FacetCount>& facets) {
    std::vector<TextureCount> out;
    for (const FacetCount& facet : facets)
        out.push_back({facet.value, facet.count});
    return out;
}

}  // namespace

namespace {

std::string counted(int n, const char* one, const char* more) {
    return std::to_string(n) + " " + (n == 1 ? one : more);
}

std::string outcome_of(const ImportReport& report) {
    std::string out = "Brought in " + counted(report.samples, "sample", "samples") + " of " +
                      counted(report.pictures, "picture", "pictures") + ".";
    if (report.skipped > 0)
        out += " " + counted(report.skipped, "picture was", "pictures were") +
               " in already, or are no colour maps.";
    if (!report.refused.empty())
        out += " " +
               counted(static_cast<int>(report.refused.size()), "picture was", "pictures were") +
               " left out; the first: " + report.refused.front().first + " (" +
               report.refused.front().second + ").";
    return out;
}

}  // namespace

void TextureShelf::open_library(const std::string& path) {
    const std::lock_guard lock(mutex_);
    if (threads_.size() > 1) return;
    threads_.emplace_back([this, path] { fill_library(path); });
}

std::string TextureShelf::activity() const {
    const std::lock_guard lock(mutex_);
    return activity_;
}

void TextureShelf::fill_library(const std::string& path) {
    lower_thread_priority();
    auto opened = TextureLibrary::open(path);
    const auto say = [&](std::string text) {
        const std::lock_guard lock(mutex_);
        activity_ = std::move(text);
        ++arrivals_;
    };
    if (!opened) return say(opened.error().text());
    {
        const std::lock_guard lock(mutex_);
        library_ = *opened;
        library_path_ = path;
        library_due_ = true;
    }
    wake_.notify_all();
    const auto progress = [&](const ProgressEvent& event) {
        const std::lock_guard lock(mutex_);
        activity_ = "Making the starter textures, " + std::to_string(event.done) + " of " +
                    std::to_string(event.total);
        library_due_ |= event.done % 200 == 0;
        ++arrivals_;
        wake_.notify_all();
    };
    const Status filled = add_starter_textures(**opened, cancel_, progress);
    say(filled || cancel_.cancelled() ? std::string() : filled.error().text());
    {
        const std::lock_guard lock(mutex_);
        library_due_ = true;
    }
    wake_.notify_all();
}

void TextureShelf::bring_in(const TextureImport& import) {
    {
        const std::lock_guard lock(mutex_);
        importing_ = {};
        importing_.running = library_ != nullptr;
        importing_.failed = !library_;
        if (library_) {
            imports_due_.push_back(import);
            if (!importer_.joinable())
                importer_ = std::thread([this, library = library_] { serve_imports(*library); });
        } else {
            importing_.outcome =
                "The texture library is not open yet, or cannot be: the drawer says why. Add the "
                "folder again then.";
        }
        ++arrivals_;
    }
    wake_.notify_all();
}

TextureImportState TextureShelf::importing() const {
    const std::lock_guard lock(mutex_);
    return importing_;
}

void TextureShelf::serve_imports(TextureLibrary& library) {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || !imports_due_.empty(); });
        if (stop_) return;
        const TextureImport asked = std::move(imports_due_.front());
        imports_due_.pop_front();
        lock.unlock();
        ImportOptions options;
        options.author = asked.author;
        if (!asked.licence.empty()) options.licence = asked.licence;
        options.keep_originals = asked.keep_originals;
        const auto report = import_pictures(library, {asked.folder}, options, cancel_,
                                            [&](const ProgressEvent& event) {
                                                const std::lock_guard busy(mutex_);
                                                importing_.done = event.done;
                                                importing_.total = event.total;
                                                ++arrivals_;
                                            });
        lock.lock();
        importing_.running = !imports_due_.empty();
        importing_.failed = !report;
        importing_.outcome = report ? outcome_of(*report) : report.error().text();
        library_due_ = true;
        ++arrivals_;
        wake_.notify_all();
    }
}

void TextureShelf::take_library() {
    SearchQuery all;
    all.sort = TextureSort::kMaterial;
    all.limit = 100'000;
    const auto found = library_->search(all);
    if (!found) return;
    library_cards_.clear();
    for (const SearchHit& hit : found->hits) {
        TextureCard card;
        card.path = "db:" + hit.id;
        card.name = shown_name(hit.name);
        card.material = shown_name(hit.material);
        library_cards_.push_back(std::move(card));
    }
    auto counts = std::make_shared<TextureAnswer>();
    counts->origins = counts_of(found->origins);
    counts->licences = counts_of(found->licences);
    {
        const std::lock_guard lock(mutex_);
        everything_ = std::move(counts);
        searched_.reset();
    }
    publish();
}

TextureCard TextureShelf::details(const TextureCard& card) {
    if (!card.path.starts_with("db:")) return card;
    const std::lock_guard lock(mutex_);
    if (const auto found = details_.find(card.path); found != details_.end()) return found->second;
    details_due_ = card.path;
    wake_.notify_all();
    return card;
}

std::string TextureShelf::name_of_texture(const std::string& path) {
    TextureCard card;
    card.path = library_name_of(path);
    if (!card.path.empty()) card = details(card);
    return card.name.empty() ? std::filesystem::path(path).filename().string() : card.name;
}

void TextureShelf::look_up(const std::string& path) {
    const auto info = library_->info(path.substr(3));
    if (!info) return;
    TextureCard card;
    card.path = path;
    card.name = shown_name(info->name);
    card.material = shown_name(info->material);
    card.tags = info->tags;
    card.author = info->author;
    card.licence = info->licence;
    card.source = info->package.empty() ? info->source : info->package;
    card.size = info->original_size;
    std::string library;
    {
        const std::lock_guard lock(mutex_);
        library = library_path_;
    }
    if (const auto scale = original_scale(library, info->id)) card.original_scale = *scale;
    const std::lock_guard lock(mutex_);
    details_[path] = std::move(card);
    ++arrivals_;
}

std::shared_ptr<const TextureAnswer> TextureShelf::search(const TextureQuestion& question) {
    const std::lock_guard lock(mutex_);
    if (!library_ || question.empty()) return nullptr;
    if (searched_ == question) return search_result_;
    search_due_ = question;
    wake_.notify_all();
    return nullptr;
}

std::shared_ptr<const TextureAnswer> TextureShelf::everything() const {
    const std::lock_guard lock(mutex_);
    return everything_;
}

void TextureShelf::search_library(const TextureQuestion& question) {
    SearchQuery query;
    query.text = question.words;
    for (const TextureOrigin origin :
         {TextureOrigin::kProcedural, TextureOrigin::kPackage, TextureOrigin::kFile})
        if (question.origin == name_of(origin)) query.origins.push_back(origin);
    if (!question.licence.empty()) query.licences.push_back(question.licence);
    query.limit = question.words.empty() ? 100'000 : 2000;
    if (question.words.empty()) query.sort = TextureSort::kMaterial;
    const auto found = library_->search(query);
    auto answer = std::make_shared<TextureAnswer>();
    if (found) {
        for (const SearchHit& hit : found->hits)
            answer->paths.push_back("db:" + hit.id);
        answer->origins = counts_of(found->origins);
        answer->licences = counts_of(found->licences);
    }
    const std::lock_guard lock(mutex_);
    searched_ = question;
    search_result_ = std::move(answer);
    ++arrivals_;
}

void TextureShelf::find_similar(const std::string& key, PicturePtr picture, Recti part) {
    {
        const std::lock_guard lock(mutex_);
        if (key == similar_key_) return;
        similar_due_ = key;
        similar_picture_ = std::move(picture);
        similar_part_ = part;
    }
    wake_.notify_all();
}

void TextureShelf::find_similar(const std::string& key, const std::string& picture_path) {
    {
        const std::lock_guard lock(mutex_);
        if (key == similar_key_ || key == similar_due_) return;
        similar_due_ = key;
        similar_picture_.reset();
        similar_file_ = picture_path;
    }
    wake_.notify_all();
}

std::shared_ptr<const std::vector<std::string>> TextureShelf::similar(
    const std::string& key) const {
    const std::lock_guard lock(mutex_);
    return key == similar_key_ ? similar_result_ : nullptr;
}

void TextureShelf::look_for_similar(const std::string& key, const Picture* picture,
                                    const Recti& part) {
    auto paths = std::make_shared<std::vector<std::string>>();
    std::shared_ptr<TextureLibrary> library;
    {
        const std::lock_guard lock(mutex_);
        library = library_;
    }
    if (library && picture) {
        const ImageU8x3 whole = shrink(*picture, 1 << 20);
        constexpr int kCount = 120;
        if (const auto found = library->similar(whole.view().crop(part), kCount))
            for (const SearchHit& hit : *found)
                paths->push_back("db:" + hit.id);
    }
    const std::lock_guard lock(mutex_);
    similar_key_ = key;
    similar_result_ = std::move(paths);
    ++arrivals_;
}

void TextureShelf::recommend(const std::string& key, const ImageU8x3& plate,
                             const SurfaceToSuit& surface) {
    RecommendRequest request;
    request.excluded_licences = licence_list(surface.excluded_licences);
    request.plate = plate;
    request.regions.push_back({surface.region, surface.matte->view(), {}, {}});
    const auto found = library_->recommend(request);
    std::vector<TextureSuggestion> out;
    if (found && !found->regions.empty()) {
        for (const auto& one : found->regions[0].suggestions)
            out.push_back({"db:" + one.id,
                           one.reasons.empty() ? std::string() : shown_name(one.reasons[0]),
                           one.score});
    }
    const std::lock_guard lock(mutex_);
    ranked_key_ = key;
    ranked_ = std::move(out);
    ++arrivals_;
}

void TextureShelf::suggest_together(const std::string& key, PicturePtr plate,
                                    std::vector<TogetherRegion> regions,
                                    const std::string& excluded_licences) {
    {
        const std::lock_guard lock(mutex_);
        if (!library_ || key == together_key_ || (together_due_ && together_due_->key == key))
            return;
        together_due_ = Together{key, std::move(plate), std::move(regions), excluded_licences};
    }
    wake_.notify_all();
}

std::shared_ptr<const std::vector<TogetherSuggestion>> TextureShelf::together(
    const std::string& key) const {
    const std::lock_guard lock(mutex_);
    return key == together_key_ ? together_ : nullptr;
}

void TextureShelf::recommend_together(const Together& asked) {
    auto found = std::make_shared<std::vector<TogetherSuggestion>>();
    const ImageU8x3 plate = shrink(*asked.plate, 1 << 20);
    RecommendRequest request;
    request.plate = plate;
    request.excluded_licences = licence_list(asked.excluded);
    for (const TogetherRegion& region : asked.regions)
        if (region.matte && region.matte->size() == plate.size())
            request.regions.push_back(
                {region.name,
                 region.matte->view(),
                 region.keep.starts_with("db:") ? region.keep.substr(3) : region.keep,
                 {}});
    const bool whole = request.regions.size() == asked.regions.size();
    const auto advice = library_->recommend(request);
    if (whole && advice) {
        for (const SceneSuggestion& scene : advice->together) {
            TogetherSuggestion one;
            one.why = scene.why;
            one.score = scene.score;
            for (const Suggestion& s : scene.per_region) {
                one.paths.push_back(s.id.empty() ? std::string() : "db:" + s.id);
                one.reasons.push_back(s.reasons.empty() ? std::string() : shown_name(s.reasons[0]));
            }
            found->push_back(std::move(one));
        }
    }
    const std::lock_guard lock(mutex_);
    together_key_ = asked.key;
    together_ = std::move(found);
    ++arrivals_;
}

}  // namespace weft
