#include "texture_db/catalogue/copy.h"

#include <filesystem>

#include "engine/core/input_file.h"
#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/catalogue/schema.h"

namespace weft {
namespace {

// All tables but the artist's own (favourites, collections, …), which are empty in libraries that
// are made for copying.
constexpr const char* kCopy = R"sql(
INSERT INTO main.picture SELECT * FROM other.picture;
INSERT INTO main.sample SELECT * FROM other.sample;
INSERT INTO main.pixels SELECT * FROM other.pixels;
INSERT INTO main.features SELECT * FROM other.features;
INSERT INTO main.descriptor SELECT * FROM other.descriptor;
INSERT OR REPLACE INTO main.model SELECT * FROM other.model;
INSERT INTO main.sample_text(rowid, name, material, tags, category)
    SELECT rowid, name, material, tags, category FROM other.sample_text;
)sql";

// Attaches the other file for its lifetime, read-only, also if its folder is not writable.
class Attached {
  public:
    static Expected<std::unique_ptr<Attached>> open(Database& database, const std::string& path) {
        WEFT_CHECK_OK(check_input_file(path, "The texture library"));
        WEFT_TRY(attach, database.query("ATTACH ? AS other"));
        std::string uri = "file:";
        constexpr const char* kHex = "0123456789ABCDEF";
        for (const char c : std::filesystem::absolute(path).string()) {
            const auto byte = static_cast<unsigned char>(c);
            if (c == '?' || c == '#' || c == '%' || byte < 0x20) {
                uri += '%';
                uri += kHex[byte >> 4];
                uri += kHex[byte & 15];
            } else {
                uri += c;
            }
        }
        WEFT_CHECK_OK(attach.bind(uri + "?mode=ro&immutable=1").run());
        return std::unique_ptr<Attached>(new Attached(database));
    }
    ~Attached() { (void)database_.execute("DETACH other"); }
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;

  private:
    explicit Attached(Database& database) : database_(database) {}
    Database& database_;
};

}  // namespace

Expected<bool> copy_library(Database& database, const std::string& path, const std::string& key,
                            const std::string& value) {
    WEFT_TRY(attached, Attached::open(database, path));
    WEFT_TRY(version, database.number("PRAGMA other.user_version"));
    if (version != kLibrarySchema) return false;
    {
        WEFT_TRY(note, database.query("SELECT value FROM other.note WHERE key = ?"));
        note.bind(key);
        WEFT_TRY(found, note.step());
        if (!found || note.text(0) != value) return false;
    }
    {
        WEFT_TRY(transaction, Transaction::begin(database));
        WEFT_TRY(samples, database.number("SELECT count(*) FROM main.sample"));
        if (samples > 0) return false;
        WEFT_CHECK_OK(database.execute(kCopy));
        WEFT_TRY(write, database.query("INSERT OR REPLACE INTO main.note VALUES(?, ?)"));
        WEFT_CHECK_OK(write.bind(key).bind(value).run());
        WEFT_CHECK_OK(count_change(database));
        WEFT_CHECK_OK(transaction.commit());
    }
    return true;
}

}  // namespace weft
