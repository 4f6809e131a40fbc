#include "texture_db/catalogue/rows.h"

#include "engine/core/setting.h"
#include "texture_db/catalogue/index.h"

namespace weft {

Expected<std::vector<StoredPixels>> pixels_behind(Database& database, const std::string& from_where,
                                                  std::int64_t after, std::size_t count) {
    std::vector<StoredPixels> out;
    WEFT_TRY(rows, database.query("SELECT p.sample, p.png " + from_where +
                                  " AND p.sample > ? ORDER BY p.sample LIMIT ?"));
    rows.bind(after).bind(static_cast<std::int64_t>(count));
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) return out;
        const auto png = rows.blob(1);
        out.push_back({rows.integer(0), {png.begin(), png.end()}});
    }
}

Expected<std::string> text_note(Database& database, const std::string& key) {
    WEFT_TRY(query, database.query("SELECT value FROM note WHERE key = ?"));
    query.bind(key);
    WEFT_TRY(found, query.step());
    return found ? query.text(0) : std::string();
}

Status set_text_note(Database& database, const std::string& key, const std::string& value) {
    WEFT_TRY(query, database.query("INSERT OR REPLACE INTO note VALUES(?, ?)"));
    return query.bind(key).bind(value).run();
}

Expected<std::string> full_id(Database& database, const std::string& given) {
    const std::string id = given.starts_with("db:") ? given.substr(3) : given;
    const bool hex = id.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!hex || id.size() < 6 || id.size() > 32) {
        return fail(ErrorCode::kUsage,
                    "'" + given +
                        "' is not a texture id. An id has 32 hexadecimal digits; a prefix of 6 or "
                        "more is enough.",
                    "Choose one from the list" + by({{setting::kListTextures}}) + ".");
    }
    std::string above = id;
    above.back() = static_cast<char>(above.back() + 1);
    WEFT_TRY(query, database.query("SELECT id FROM sample WHERE id >= ? AND id < ? LIMIT 2"));
    query.bind(id).bind(above);
    WEFT_TRY(found, query.step());
    if (!found) {
        return fail(ErrorCode::kUnreadable,
                    "Texture " + id + " was not found in the library " + database.path() + ".",
                    "Search for another, or choose its library" + by({{setting::kLibrary}}) + ".");
    }
    std::string full = query.text(0);
    WEFT_TRY(another, query.step());
    if (another) {
        return fail(ErrorCode::kUsage, "More than one texture begins with " + id + ".",
                    "Give more of its digits.");
    }
    return full;
}

Status count_change(Database& database) {
    WEFT_TRY(query, database.query("UPDATE changes SET count = count + 1"));
    return query.run();
}

Expected<std::optional<DescriptorModel>> stored_model(Database& database) {
    WEFT_TRY(row, database.query("SELECT data FROM model WHERE name = 'descriptor'"));
    WEFT_TRY(trained, row.step());
    if (!trained) return std::optional<DescriptorModel>();
    WEFT_TRY(model, DescriptorModel::from_bytes(row.blob(0)));
    return std::optional(std::move(model));
}

Status store_descriptor(Database& database, std::int64_t key, std::span<const float> descriptor) {
    WEFT_TRY(insert, database.query("INSERT OR REPLACE INTO descriptor VALUES(?, ?)"));
    return insert.bind(key).bind(bytes_of(descriptor)).run();
}

}  // namespace weft
