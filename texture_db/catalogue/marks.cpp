#include "texture_db/catalogue/marks.h"

#include <algorithm>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/query_json.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

constexpr int kRecentKept = 200;

Status check_name(const std::string& name, const std::string& what) {
    if (!name.empty()) return {};
    return fail(ErrorCode::kUsage, "The " + what + " needs a name.");
}

}  // namespace

Status set_favourite(Database& database, const std::string& id, bool favourite) {
    WEFT_TRY(query,
             database.query(favourite ? "INSERT OR IGNORE INTO favourite VALUES(?, strftime('%s'))"
                                      : "DELETE FROM favourite WHERE id = ?"));
    return query.bind(id).run();
}

Status set_rating(Database& database, const std::string& id, int rating) {
    if (rating < 0 || rating > 5)
        return fail(ErrorCode::kUsage, "A rating lies between 0 (none) and 5.");
    WEFT_TRY(query, database.query(rating > 0 ? "INSERT OR REPLACE INTO rating VALUES(?, ?)"
                                              : "DELETE FROM rating WHERE id = ?"));
    query.bind(id);
    if (rating > 0) query.bind(rating);
    return query.run();
}

Status set_material(Database& database, const std::string& id, const std::string& material) {
    WEFT_CHECK_OK(check_name(material, "material"));
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(sample, database.query("UPDATE sample SET material = ? WHERE id = ?"));
        WEFT_CHECK_OK(sample.bind(material).bind(id).run());
        WEFT_TRY(text, database.query("UPDATE sample_text SET material = ? WHERE rowid = (SELECT "
                                      "key FROM sample WHERE id = ?)"));
        WEFT_CHECK_OK(text.bind(material).bind(id).run());
    }
    WEFT_CHECK_OK(count_change(database));
    return transaction.commit();
}

Status set_tags(Database& database, const std::string& id, const std::vector<std::string>& tags) {
    const std::string joined = joined_words(tags);
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(sample, database.query("UPDATE sample SET tags = ? WHERE id = ?"));
        WEFT_CHECK_OK(sample.bind(joined).bind(id).run());
        WEFT_TRY(text, database.query("UPDATE sample_text SET tags = ? WHERE rowid = (SELECT key "
                                      "FROM sample WHERE id = ?)"));
        WEFT_CHECK_OK(text.bind(joined).bind(id).run());
    }
    WEFT_CHECK_OK(count_change(database));
    return transaction.commit();
}

Status mark_used(Database& database, const std::string& id) {
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        // A counter instead of the clock, so that two uses in one second keep their order.
        WEFT_TRY(insert, database.query("INSERT OR REPLACE INTO recent VALUES(?, (SELECT "
                                        "ifnull(max(used), 0) + 1 FROM recent))"));
        WEFT_CHECK_OK(insert.bind(id).run());
        WEFT_TRY(trim, database.query("DELETE FROM recent WHERE id NOT IN (SELECT id FROM recent "
                                      "ORDER BY used DESC LIMIT ?)"));
        WEFT_CHECK_OK(trim.bind(kRecentKept).run());
    }
    return transaction.commit();
}

Expected<std::vector<std::string>> recent(Database& database, int count) {
    WEFT_TRY(query, database.query("SELECT r.id FROM recent r JOIN sample s ON s.id = r.id "
                                   "ORDER BY r.used DESC LIMIT ?"));
    query.bind(std::max(0, count));
    std::vector<std::string> ids;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return ids;
        ids.push_back(query.text(0));
    }
}

Expected<std::vector<FacetCount>> collections(Database& database) {
    WEFT_TRY(query, database.query("SELECT name, count(*) FROM collection GROUP BY name "
                                   "ORDER BY name"));
    std::vector<FacetCount> out;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        out.push_back({query.text(0), static_cast<int>(query.integer(1))});
    }
}

Status add_to_collection(Database& database, const std::string& name, const std::string& id) {
    WEFT_CHECK_OK(check_name(name, "collection"));
    WEFT_TRY(query, database.query("INSERT OR IGNORE INTO collection VALUES(?, ?)"));
    return query.bind(name).bind(id).run();
}

Status remove_from_collection(Database& database, const std::string& name, const std::string& id) {
    WEFT_TRY(query, database.query("DELETE FROM collection WHERE name = ? AND id = ?"));
    return query.bind(name).bind(id).run();
}

Status delete_collection(Database& database, const std::string& name) {
    WEFT_TRY(query, database.query("DELETE FROM collection WHERE name = ?"));
    return query.bind(name).run();
}

Expected<std::vector<SavedSearch>> saved_searches(Database& database) {
    WEFT_TRY(query, database.query("SELECT name, query FROM saved_search ORDER BY name"));
    std::vector<SavedSearch> out;
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        auto read = query_from_json(query.text(1));
        if (!read) return fail_in(std::move(read).error(), "saved search '" + query.text(0) + "'");
        out.push_back({query.text(0), read->text, *read});
    }
}

Status save_search(Database& database, const std::string& name, const SearchQuery& search) {
    WEFT_CHECK_OK(check_name(name, "saved search"));
    const std::string json = query_to_json(search);
    WEFT_TRY(query, database.query("INSERT OR REPLACE INTO saved_search VALUES(?, ?)"));
    return query.bind(name).bind(json).run();
}

Status delete_saved_search(Database& database, const std::string& name) {
    WEFT_TRY(query, database.query("DELETE FROM saved_search WHERE name = ?"));
    return query.bind(name).run();
}

}  // namespace weft
