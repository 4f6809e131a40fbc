// What the artist keeps: favourites, ratings, recents, collections, saved searches.

#include <chrono>

#include "texture_db/library_state.h"
#include "texture_db/material_words.h"
#include "texture_db/query_json.h"

namespace weft {
namespace {

constexpr int kRecentKept = 200;

Status check_name(const std::string& name, const std::string& what) {
    if (!name.empty()) return {};
    return fail(ErrorCode::kUsage, "The " + what + " needs a name.");
}

}  // namespace

Status TextureLibrary::set_favourite(const std::string& given, bool favourite) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(query, state_->database->query(
                        favourite ? "INSERT OR IGNORE INTO favourite VALUES(?, strftime('%s'))"
                                  : "DELETE FROM favourite WHERE id = ?"));
    WEFT_CHECK_OK(query.bind(id).run());
    if (!state_->index) return {};
    if (const auto at = state_->index->by_id.find(id); at != state_->index->by_id.end())
        state_->index->samples[at->second].favourite = favourite;
    return {};
}

Status TextureLibrary::set_rating(const std::string& given, int rating) {
    if (rating < 0 || rating > 5)
        return fail(ErrorCode::kUsage, "A rating lies between 0 (none) and 5.");
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(query,
             state_->database->query(rating > 0 ? "INSERT OR REPLACE INTO rating VALUES(?, ?)"
                                                : "DELETE FROM rating WHERE id = ?"));
    query.bind(id);
    if (rating > 0) query.bind(rating);
    WEFT_CHECK_OK(query.run());
    if (!state_->index) return {};
    if (const auto at = state_->index->by_id.find(id); at != state_->index->by_id.end())
        state_->index->samples[at->second].rating = static_cast<std::uint8_t>(rating);
    return {};
}

Status TextureLibrary::set_material(const std::string& given, const std::string& material) {
    WEFT_CHECK_OK(check_name(material, "material"));
    const std::scoped_lock lock(state_->mutex);
    Database& database = *state_->database;
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(sample, database.query("UPDATE sample SET material = ? WHERE id = ?"));
        WEFT_CHECK_OK(sample.bind(material).bind(id).run());
        WEFT_TRY(text, database.query("UPDATE sample_text SET material = ? WHERE rowid = (SELECT "
                                      "key FROM sample WHERE id = ?)"));
        WEFT_CHECK_OK(text.bind(material).bind(id).run());
    }
    WEFT_CHECK_OK(state_->count_change());
    return transaction.commit();
}

Status TextureLibrary::set_tags(const std::string& given, const std::vector<std::string>& tags) {
    const std::string joined = joined_words(tags);
    const std::scoped_lock lock(state_->mutex);
    Database& database = *state_->database;
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(sample, database.query("UPDATE sample SET tags = ? WHERE id = ?"));
        WEFT_CHECK_OK(sample.bind(joined).bind(id).run());
        WEFT_TRY(text, database.query("UPDATE sample_text SET tags = ? WHERE rowid = (SELECT key "
                                      "FROM sample WHERE id = ?)"));
        WEFT_CHECK_OK(text.bind(joined).bind(id).run());
    }
    WEFT_CHECK_OK(state_->count_change());
    return transaction.commit();
}

Status TextureLibrary::mark_used(const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    Database& database = *state_->database;
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        // A counter, not the clock: two uses in one second keep their order.
        WEFT_TRY(insert, database.query("INSERT OR REPLACE INTO recent VALUES(?, (SELECT "
                                        "ifnull(max(used), 0) + 1 FROM recent))"));
        WEFT_CHECK_OK(insert.bind(id).run());
        WEFT_TRY(trim, database.query("DELETE FROM recent WHERE id NOT IN (SELECT id FROM recent "
                                      "ORDER BY used DESC LIMIT ?)"));
        WEFT_CHECK_OK(trim.bind(kRecentKept).run());
    }
    return transaction.commit();
}

Expected<std::vector<std::string>> TextureLibrary::recent(int count) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query,
             state_->database->query("SELECT r.id FROM recent r JOIN sample s ON s.id = r.id "
                                     "ORDER BY r.used DESC LIMIT ?"));
    query.bind(std::max(0, count));
    std::vector<std::string> ids;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return ids;
        ids.push_back(query.text(0));
    }
}

Expected<std::vector<FacetCount>> TextureLibrary::collections() {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query, state_->database->query("SELECT name, count(*) FROM collection GROUP BY name "
                                            "ORDER BY name"));
    std::vector<FacetCount> out;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        out.push_back({query.text(0), static_cast<int>(query.integer(1))});
    }
}

Status TextureLibrary::add_to_collection(const std::string& name, const std::string& given) {
    WEFT_CHECK_OK(check_name(name, "collection"));
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(query, state_->database->query("INSERT OR IGNORE INTO collection VALUES(?, ?)"));
    return query.bind(name).bind(id).run();
}

Status TextureLibrary::remove_from_collection(const std::string& name, const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(query, state_->database->query("DELETE FROM collection WHERE name = ? AND id = ?"));
    return query.bind(name).bind(id).run();
}

Status TextureLibrary::delete_collection(const std::string& name) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query, state_->database->query("DELETE FROM collection WHERE name = ?"));
    return query.bind(name).run();
}

Expected<std::vector<SavedSearch>> TextureLibrary::saved_searches() {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query, state_->database->query("SELECT name, query FROM saved_search ORDER BY name"));
    std::vector<SavedSearch> out;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        auto read = query_from_json(query.text(1));
        if (!read) return fail_in(std::move(read).error(), "saved search '" + query.text(0) + "'");
        out.push_back({query.text(0), read->text, *read});
    }
}

Status TextureLibrary::save_search(const std::string& name, const SearchQuery& search) {
    WEFT_CHECK_OK(check_name(name, "saved search"));
    const std::string json = query_to_json(search);
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query, state_->database->query("INSERT OR REPLACE INTO saved_search VALUES(?, ?)"));
    return query.bind(name).bind(json).run();
}

Status TextureLibrary::delete_saved_search(const std::string& name) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(query, state_->database->query("DELETE FROM saved_search WHERE name = ?"));
    return query.bind(name).run();
}

}  // namespace weft
