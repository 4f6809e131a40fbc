// Members of TextureLibrary for favourites, ratings, tags and collections.

#include "texture_db/library/library_state.h"

namespace weft {

Status TextureLibrary::set_favourite(const std::string& given, bool favourite) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    WEFT_CHECK_OK(weft::set_favourite(*state_->database, id, favourite));
    if (!state_->index) return {};
    const auto at = state_->index->by_id.find(id);
    if (at == state_->index->by_id.end()) return {};
    state_->index->samples[at->second].favourite = favourite;
    return {};
}

Status TextureLibrary::set_rating(const std::string& given, int rating) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    WEFT_CHECK_OK(weft::set_rating(*state_->database, id, rating));
    if (!state_->index) return {};
    const auto at = state_->index->by_id.find(id);
    if (at == state_->index->by_id.end()) return {};
    state_->index->samples[at->second].rating = static_cast<std::uint8_t>(rating);
    return {};
}

Status TextureLibrary::set_material(const std::string& given, const std::string& material) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return weft::set_material(*state_->database, id, material);
}

Status TextureLibrary::set_tags(const std::string& given, const std::vector<std::string>& tags) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return weft::set_tags(*state_->database, id, tags);
}

Status TextureLibrary::mark_used(const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return weft::mark_used(*state_->database, id);
}

Expected<std::vector<std::string>> TextureLibrary::recent(int count) {
    const std::scoped_lock lock(state_->mutex);
    return weft::recent(*state_->database, count);
}

Expected<std::vector<FacetCount>> TextureLibrary::collections() {
    const std::scoped_lock lock(state_->mutex);
    return weft::collections(*state_->database);
}

Status TextureLibrary::add_to_collection(const std::string& name, const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return weft::add_to_collection(*state_->database, name, id);
}

Status TextureLibrary::remove_from_collection(const std::string& name, const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return weft::remove_from_collection(*state_->database, name, id);
}

Status TextureLibrary::delete_collection(const std::string& name) {
    const std::scoped_lock lock(state_->mutex);
    return weft::delete_collection(*state_->database, name);
}

Expected<std::vector<SavedSearch>> TextureLibrary::saved_searches() {
    const std::scoped_lock lock(state_->mutex);
    return weft::saved_searches(*state_->database);
}

Status TextureLibrary::save_search(const std::string& name, const SearchQuery& search) {
    const std::scoped_lock lock(state_->mutex);
    return weft::save_search(*state_->database, name, search);
}

Status TextureLibrary::delete_saved_search(const std::string& name) {
    const std::scoped_lock lock(state_->mutex);
    return weft::delete_saved_search(*state_->database, name);
}

}  // namespace weft
