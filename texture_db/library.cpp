#include "texture_db/library.h"

#include <cstdlib>
#include <filesystem>

#include "texture_db/features.h"
#include "texture_db/library_state.h"
#include "texture_db/material_words.h"
#include "texture_db/sample_codec.h"
#include "texture_db/schema.h"
#include "texture_db/source_picture.h"

namespace weft {

std::string default_library_path() {
    namespace fs = std::filesystem;
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
        return (fs::path(data) / "weft" / "textures.db").string();
    const char* home = std::getenv("HOME");
    return (fs::path(home ? home : ".") / ".local" / "share" / "weft" / "textures.db").string();
}

const char* name_of(TextureOrigin origin) {
    switch (origin) {
        case TextureOrigin::kProcedural:
            return "procedural";
        case TextureOrigin::kPackage:
            return "package";
        case TextureOrigin::kFile:
            break;
    }
    return "file";
}

TextureLibrary::TextureLibrary(std::unique_ptr<State> state) : state_(std::move(state)) {}
TextureLibrary::~TextureLibrary() = default;

Expected<std::shared_ptr<TextureLibrary>> TextureLibrary::open(const std::string& path,
                                                               const LibraryOptions& options) {
    auto state = std::make_unique<State>();
    state->path = path;
    state->read_only = options.read_only;
    WEFT_TRY(database, Database::open(path, options.create, options.read_only));
    WEFT_CHECK_OK(bring_up_to_date(*database, options.read_only));
    state->database = std::move(database);
    return std::shared_ptr<TextureLibrary>(new TextureLibrary(std::move(state)));
}

const std::string& TextureLibrary::path() const {
    return state_->path;
}

Status TextureLibrary::State::refresh() {
    // data_version tells of other connections, changes of this one's own writing.
    WEFT_TRY(version, database->number("PRAGMA data_version"));
    WEFT_TRY(changes, database->number("SELECT count FROM changes"));
    if (index && version == loaded_data_version && changes == loaded_changes) return {};
    if (!index || changes != loaded_changes) {
        WEFT_TRY(loaded, load_index(*database));
        WEFT_TRY(reader, WordReader::load(*database, loaded));
        WEFT_TRY(row, database->query("SELECT data FROM model WHERE name = 'descriptor'"));
        WEFT_TRY(trained, row.step());
        model.reset();
        if (trained) {
            WEFT_TRY(read, DescriptorModel::from_bytes(row.blob(0)));
            model = std::move(read);
        }
        index = std::move(loaded);
        words = std::move(reader);
    }
    loaded_data_version = version;
    loaded_changes = changes;
    return {};
}

Status TextureLibrary::State::count_change() {
    WEFT_TRY(query, database->query("UPDATE changes SET count = count + 1"));
    return query.run();
}

Expected<std::string> TextureLibrary::State::full_id(const std::string& given) {
    const std::string id = given.starts_with("db:") ? given.substr(3) : given;
    const bool hex = id.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!hex || id.size() < 6 || id.size() > 32) {
        return fail(ErrorCode::kUsage,
                    "'" + given +
                        "' is no texture id. An id has 32 hexadecimal digits, of which the first 6 "
                        "or more are enough; see 'weft texture list'.");
    }
    std::string above = id;
    above.back() = static_cast<char>(above.back() + 1);
    WEFT_TRY(query, database->query("SELECT id FROM sample WHERE id >= ? AND id < ? LIMIT 2"));
    query.bind(id).bind(above);
    WEFT_TRY(found, query.step());
    if (!found) {
        return fail(ErrorCode::kUnreadable, "There is no texture " + id + " in the library " +
                                                path +
                                                ". Search for another, or give its library with "
                                                "--db.");
    }
    std::string full = query.text(0);
    WEFT_TRY(another, query.step());
    if (another) {
        return fail(ErrorCode::kUsage,
                    "More than one texture begins with " + id + ". Give more of its digits.");
    }
    return full;
}

Expected<std::int64_t> TextureLibrary::size() {
    const std::scoped_lock lock(state_->mutex);
    return state_->database->number("SELECT count(*) FROM sample");
}

Expected<std::int64_t> TextureLibrary::change_count() {
    const std::scoped_lock lock(state_->mutex);
    return state_->database->number("SELECT count FROM changes");
}

Expected<ImageU8x3> TextureLibrary::thumbnail(const std::string& given) {
    std::vector<std::byte> png;
    {
        const std::scoped_lock lock(state_->mutex);
        WEFT_TRY(id, state_->full_id(given));
        WEFT_TRY(query, state_->database->query("SELECT p.png FROM pixels p JOIN sample s ON "
                                                "s.key = p.sample WHERE s.id = ?"));
        query.bind(id);
        WEFT_TRY(found, query.step());
        if (found) png.assign(query.blob(0).begin(), query.blob(0).end());
    }
    auto image = decode_picture(png);  // outside of the lock: several threads may decode
    if (!image) {
        return fail(ErrorCode::kUnreadable, "The pixels of texture " + given + " in " +
                                                state_->path +
                                                " are damaged. Run 'weft texture verify'.");
    }
    return image;
}

Expected<ImageU8x3> TextureLibrary::original(const std::string& given) {
    std::vector<std::byte> data;
    WEFT_TRY(about, info(given));
    if (about.original_in_file) {
        const std::scoped_lock lock(state_->mutex);
        WEFT_TRY(query, state_->database->query("SELECT p.data FROM picture p JOIN sample s ON "
                                                "s.picture = p.key WHERE s.id = ?"));
        query.bind(about.id);
        WEFT_TRY(found, query.step());
        if (found) data.assign(query.blob(0).begin(), query.blob(0).end());
    }
    if (!data.empty()) return decode_picture(data);
    if (auto picture = read_source_picture(about); picture) return picture;
    return thumbnail(about.id);
}

Expected<TextureInfo> TextureLibrary::info(const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, state_->full_id(given));
    WEFT_TRY(q, state_->database->query(
                    "SELECT s.id, s.name, s.material, s.category, s.tags, s.origin, s.package, "
                    "s.source, s.author, s.licence, s.original_width, s.original_height, "
                    "s.picture, s.measured, s.synthesis, f.id, r.stars FROM sample s LEFT JOIN "
                    "favourite f ON f.id = s.id LEFT JOIN rating r ON r.id = s.id WHERE s.id = ?"));
    q.bind(id);
    WEFT_TRY(found, q.step());
    TextureInfo info;
    if (!found) return fail(ErrorCode::kUnreadable, "There is no texture " + id + ".");
    info.id = q.text(0);
    info.name = q.text(1);
    info.material = q.text(2);
    info.category = q.text(3);
    info.tags = split_words(q.text(4));
    info.origin = static_cast<TextureOrigin>(q.integer(5));
    info.package = q.text(6);
    info.source = q.text(7);
    info.author = q.text(8);
    info.licence = q.text(9);
    info.original_size = {static_cast<int>(q.integer(10)), static_cast<int>(q.integer(11))};
    info.original_in_file = !q.is_null(12);
    if (!read_measured(q.blob(13), info.measured))
        return fail(ErrorCode::kUnreadable, "What is known of texture " + id + " is damaged.");
    info.synthesisability = static_cast<float>(q.real(14));
    info.favourite = !q.is_null(15);
    info.rating = static_cast<int>(q.integer(16));
    return info;
}

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

Expected<std::string> TextureLibrary::note(const std::string& key) {
    const std::scoped_lock lock(state_->mutex);
    return text_note(*state_->database, key);
}

Status TextureLibrary::set_note(const std::string& key, const std::string& value) {
    const std::scoped_lock lock(state_->mutex);
    return set_text_note(*state_->database, key, value);
}

namespace {

Expected<std::vector<FacetCount>> counts_by(Database& database, const std::string& column) {
    std::vector<FacetCount> out;
    WEFT_TRY(query, database.query("SELECT " + column + ", count(*) FROM sample GROUP BY " +
                                   column + " ORDER BY count(*) DESC, " + column));
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        std::string value = query.text(0);
        if (column == "origin") value = name_of(static_cast<TextureOrigin>(query.integer(0)));
        out.push_back({std::move(value), static_cast<int>(query.integer(1))});
    }
}

}  // namespace

Expected<LibraryStats> TextureLibrary::stats() {
    const std::scoped_lock lock(state_->mutex);
    Database& database = *state_->database;
    LibraryStats stats;
    WEFT_TRY(samples, database.number("SELECT count(*) FROM sample"));
    WEFT_TRY(materials, counts_by(database, "material"));
    WEFT_TRY(origins, counts_by(database, "origin"));
    WEFT_TRY(packages, counts_by(database, "package"));
    WEFT_TRY(licences, counts_by(database, "licence"));
    WEFT_TRY(version, database.number("PRAGMA user_version"));
    WEFT_TRY(trained,
             database.number("SELECT trained_on FROM model WHERE name = 'descriptor'", -1));
    stats.samples = samples;
    stats.materials = std::move(materials);
    stats.origins = std::move(origins);
    stats.packages = std::move(packages);
    stats.licences = std::move(licences);
    stats.schema_version = static_cast<int>(version);
    stats.descriptor_trained = trained >= 0;
    stats.descriptor_samples = std::max<std::int64_t>(trained, 0);
    std::error_code ignored;
    const auto bytes = std::filesystem::file_size(state_->path, ignored);
    stats.file_bytes = ignored ? 0 : static_cast<std::int64_t>(bytes);
    return stats;
}

}  // namespace weft
