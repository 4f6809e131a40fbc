#include "texture_db/catalogue/schema.h"

#include "engine/core/setting.h"

#include <array>

namespace weft {
namespace {

// Version 1: the catalogue. Pixels have a table of their own, so that reading the catalogue does
// not load them. A `picture` is what several samples were cut from.
constexpr const char* kCatalogue = R"sql(
CREATE TABLE picture(
    key INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE,
    width INTEGER NOT NULL, height INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE sample(
    key INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL, material TEXT NOT NULL, category TEXT NOT NULL, tags TEXT NOT NULL,
    origin INTEGER NOT NULL, package TEXT NOT NULL, source TEXT NOT NULL,
    author TEXT NOT NULL, licence TEXT NOT NULL,
    original_width INTEGER NOT NULL, original_height INTEGER NOT NULL,
    crop_x0 INTEGER NOT NULL, crop_y0 INTEGER NOT NULL,
    crop_x1 INTEGER NOT NULL, crop_y1 INTEGER NOT NULL,
    picture INTEGER REFERENCES picture(key),
    measured BLOB NOT NULL, synthesis REAL NOT NULL, added INTEGER NOT NULL);
CREATE INDEX sample_by_material ON sample(material);
CREATE TABLE pixels(sample INTEGER PRIMARY KEY REFERENCES sample(key) ON DELETE CASCADE,
    png BLOB NOT NULL);
CREATE TABLE features(sample INTEGER PRIMARY KEY REFERENCES sample(key) ON DELETE CASCADE,
    version INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE descriptor(sample INTEGER PRIMARY KEY REFERENCES sample(key) ON DELETE CASCADE,
    data BLOB NOT NULL);
CREATE TABLE model(name TEXT PRIMARY KEY, trained_on INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE note(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE changes(only INTEGER PRIMARY KEY CHECK(only = 0), count INTEGER NOT NULL);
INSERT INTO changes VALUES(0, 0);
CREATE VIRTUAL TABLE sample_text USING fts5(name, material, tags, category,
    tokenize = 'unicode61 remove_diacritics 2');
CREATE VIRTUAL TABLE sample_word USING fts5vocab(sample_text, 'row');
)sql";

// Version 2: the artist's own data. By id, not by row: a sample that is removed and built again is
// still a favourite.
constexpr const char* kKept = R"sql(
CREATE TABLE favourite(id TEXT PRIMARY KEY, added INTEGER NOT NULL);
CREATE TABLE rating(id TEXT PRIMARY KEY, stars INTEGER NOT NULL CHECK(stars BETWEEN 1 AND 5));
CREATE TABLE recent(id TEXT PRIMARY KEY, used INTEGER NOT NULL);
CREATE TABLE collection(name TEXT NOT NULL, id TEXT NOT NULL, PRIMARY KEY(name, id));
CREATE TABLE saved_search(name TEXT PRIMARY KEY, query TEXT NOT NULL);
)sql";

// Version 3: other features (features.h). Earlier descriptors do not fit them and are trained
// again.
constexpr const char* kForget = "DELETE FROM model; DELETE FROM descriptor;";

// Version 4: an image–text model's vector of each sample (sample_embeddings.h).
constexpr const char* kEmbeddings = R"sql(
CREATE TABLE sight(sample INTEGER PRIMARY KEY REFERENCES sample(key) ON DELETE CASCADE,
    data BLOB NOT NULL);
)sql";

constexpr std::array<const char*, kLibrarySchema> kSteps{kCatalogue, kKept, kForget, kEmbeddings};

Status upgrade(Database& database, int from) {
    for (int version = from; version < kLibrarySchema; ++version) {
        WEFT_TRY(transaction, Transaction::begin(database));
        // Another process may have done this step while this one waited for the lock.
        WEFT_TRY(now, database.number("PRAGMA user_version"));
        if (now > version) continue;
        WEFT_CHECK_OK(database.execute(kSteps[static_cast<std::size_t>(version)]));
        const std::string mark =
            "PRAGMA application_id = " + std::to_string(kLibraryApplicationId) +
            "; PRAGMA user_version = " + std::to_string(version + 1);
        WEFT_CHECK_OK(database.execute(mark.c_str()));
        WEFT_CHECK_OK(transaction.commit());
    }
    return {};
}

}  // namespace

Status bring_up_to_date(Database& database, bool read_only) {
    WEFT_TRY(application, database.number("PRAGMA application_id"));
    WEFT_TRY(version, database.number("PRAGMA user_version"));
    WEFT_TRY(tables, database.number("SELECT count(*) FROM sqlite_master"));
    if (application != kLibraryApplicationId && (tables > 0 || version > 0)) {
        return fail(ErrorCode::kUnreadable,
                    database.path() + " is a database, but not a texture library.",
                    "Choose another file" + by({{setting::kLibrary}}) + ".");
    }
    if (version > kLibrarySchema) {
        return fail(ErrorCode::kUnreadable,
                    "The texture library " + database.path() +
                        " was written by a newer version of weft (schema " +
                        std::to_string(version) + ", this one knows " +
                        std::to_string(kLibrarySchema) + ").",
                    "Install that version, or use another library.");
    }
    if (read_only) {
        if (version == kLibrarySchema) return {};
        return fail(ErrorCode::kUnreadable,
                    "The texture library " + database.path() + " is of an older version.",
                    "Open it once for writing to bring it up to date.");
    }
    // WAL: readers continue while another process writes.
    WEFT_CHECK_OK(database.execute(
        "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON"));
    return upgrade(database, static_cast<int>(version));
}

}  // namespace weft
