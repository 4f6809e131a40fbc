#include "texture_db/catalogue/database.h"

#include <sqlite3.h>

#include <filesystem>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

constexpr int kWait_ms = 10'000;

// For a failed write SQLite does not always give the reason: the disk is full, or a quota or the
// limit of a file's size is reached.
bool is_full(int code) {
    switch (code) {
        case SQLITE_IOERR_WRITE:
        case SQLITE_IOERR_FSYNC:
        case SQLITE_IOERR_DIR_FSYNC:
        case SQLITE_IOERR_TRUNCATE:
        case SQLITE_IOERR_SHMSIZE:
        case SQLITE_IOERR_SHMMAP:
        case SQLITE_IOERR_SHMOPEN:
            return true;
        default:
            return (code & 0xff) == SQLITE_FULL;
    }
}

Error in_words(const std::string& path, int code, const std::string& detail) {
    if (is_full(code)) {
        return {ErrorCode::kNoSpace,
                "The texture library " + path +
                    " cannot be written: the disk is full, or a limit is reached.",
                "Free some space and go on; what was stored before is kept.",
                {}};
    }
    switch (code & 0xff) {
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return {ErrorCode::kUnreadable,
                    "The texture library " + path + " is damaged or not a texture library (" +
                        detail + ").",
                    "Restore a copy, or move it away and build it again.",
                    {}};
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return {ErrorCode::kUnreadable,
                    "The texture library " + path + " is being written by another program.",
                    "Wait for it to finish and try again.",
                    {}};
        case SQLITE_CANTOPEN:
        case SQLITE_PERM:
        case SQLITE_READONLY:
            return {
                ErrorCode::kUnreadable,
                "The texture library " + path + " cannot be opened for writing (" + detail + ").",
                "Check the folder and its permissions.",
                {}};
        case SQLITE_NOMEM:
        case SQLITE_TOOBIG:
            return {
                ErrorCode::kNoSpace, "Out of memory in the texture library " + path + ".", {}, {}};
        default:
            return {ErrorCode::kUnreadable,
                    "The texture library " + path + " cannot be used: " + detail + ".",
                    {},
                    {}};
    }
}

}  // namespace

Query::Query(Query&& other) noexcept
    : database_(other.database_), statement_(other.statement_), bound_(other.bound_) {
    other.statement_ = nullptr;
}

Query::~Query() {
    if (!statement_) return;
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
    database_->free_[database_->sql_of_[statement_]].push_back(statement_);
}

Query& Query::bind(std::int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
}
Query& Query::bind(double value) {
    sqlite3_bind_double(statement_, ++bound_, value);
    return *this;
}
Query& Query::bind(std::string_view text) {
    sqlite3_bind_text64(statement_, ++bound_, text.data() ? text.data() : "", text.size(),
                        SQLITE_STATIC, SQLITE_UTF8);
    return *this;
}
Query& Query::bind(std::span<const std::byte> blob) {
    sqlite3_bind_blob64(statement_, ++bound_, blob.data(), blob.size(), SQLITE_STATIC);
    return *this;
}
Query& Query::bind_null() {
    sqlite3_bind_null(statement_, ++bound_);
    return *this;
}

Expected<bool> Query::step() {
    const int code = sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    return tl::unexpected(database_->error(code));
}

Status Query::run() {
    WEFT_TRY(more, step());
    while (more) {
        WEFT_TRY(again, step());
        more = again;
    }
    sqlite3_reset(statement_);
    bound_ = 0;
    return {};
}

std::int64_t Query::integer(int column) const {
    return sqlite3_column_int64(statement_, column);
}
double Query::real(int column) const {
    return sqlite3_column_double(statement_, column);
}
std::string Query::text(int column) const {
    const unsigned char* text = sqlite3_column_text(statement_, column);
    const int bytes = sqlite3_column_bytes(statement_, column);
    return text ? std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(bytes))
                : std::string();
}
std::span<const std::byte> Query::blob(int column) const {
    const void* data = sqlite3_column_blob(statement_, column);
    const int bytes = sqlite3_column_bytes(statement_, column);
    return {static_cast<const std::byte*>(data), data ? static_cast<std::size_t>(bytes) : 0};
}
bool Query::is_null(int column) const {
    return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

Expected<std::unique_ptr<Database>> Database::open(const std::string& path, bool create,
                                                   bool read_only) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const bool there = fs::exists(path, ignored);
    if (!there && (read_only || !create)) {
        return fail(ErrorCode::kUnreadable, "Texture library " + path + " not found.",
                    "Build one, or choose another" +
                        by({{setting::kBuildLibrary}, {setting::kLibrary}}) + ".");
    }
    if (there) {
        WEFT_CHECK_OK(check_input_file(path, "The texture library"));
        // SQLite would take it for a new library, and write to it.
        if (!create && fs::file_size(path, ignored) == 0)
            return fail(ErrorCode::kUnreadable, "The texture library " + path + " is empty.",
                        "Choose another" + by({{setting::kLibrary}}) + ", or remove it.");
    }
    if (!there && fs::path(path).has_parent_path()) {
        std::error_code error;
        fs::create_directories(fs::path(path).parent_path(), error);
        if (error) {
            return fail(ErrorCode::kUnreadable, "The folder of the texture library " + path +
                                                    " cannot be created: " + error.message() + ".");
        }
    }
    sqlite3* handle = nullptr;
    const int flags = (read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE) |
                      (create && !read_only ? SQLITE_OPEN_CREATE : 0) | SQLITE_OPEN_NOMUTEX |
                      SQLITE_OPEN_URI;
    // A name that only looks like a URI is a file name.
    const std::string name = path.starts_with("file:") ? "./" + path : path;
    const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
    std::unique_ptr<Database> database(new Database(path, handle));
    if (code != SQLITE_OK) return tl::unexpected(database->error(code));
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, kWait_ms);
    // Text in a picture must not be able to make the file's own schema run code.
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    return database;
}

Database::~Database() {
    for (const auto& [statement, sql] : sql_of_)
        sqlite3_finalize(statement);
    sqlite3_close(handle_);
}

Expected<Query> Database::query(std::string_view sql) {
    const std::string key(sql);
    auto& spare = free_[key];
    if (!spare.empty()) {
        sqlite3_stmt* statement = spare.back();
        spare.pop_back();
        return Query(this, statement);
    }
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v3(handle_, key.c_str(), static_cast<int>(key.size()),
                                        SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
    if (code != SQLITE_OK) return tl::unexpected(error(code));
    sql_of_[statement] = key;
    return Query(this, statement);
}

Status Database::execute(const char* sql) {
    const int code = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return tl::unexpected(error(code));
    return {};
}

Expected<std::int64_t> Database::number(std::string_view sql, std::int64_t otherwise) {
    WEFT_TRY(statement, query(sql));
    WEFT_TRY(row, statement.step());
    return row ? statement.integer(0) : otherwise;
}

std::int64_t Database::last_row() const {
    return sqlite3_last_insert_rowid(handle_);
}

int Database::changed_rows() const {
    return sqlite3_changes(handle_);
}

Error Database::error(int code) const {
    const std::string detail = handle_ ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
    return in_words(path_, handle_ ? sqlite3_extended_errcode(handle_) : code, detail);
}

Expected<Transaction> Transaction::begin(Database& database) {
    WEFT_CHECK_OK(database.execute("BEGIN IMMEDIATE"));
    return Transaction(&database);
}

Transaction::~Transaction() {
    if (!database_) return;
    // After a full disk SQLite has already rolled back; then this fails without effect.
    (void)database_->execute("ROLLBACK");
}

Status Transaction::commit() {
    WEFT_CHECK_OK(database_->execute("COMMIT"));
    database_ = nullptr;
    return {};
}

}  // namespace weft
