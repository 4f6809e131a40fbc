#pragma once
// Internal: a value interface to SQLite: one connection, statements that close themselves, errors
// with messages.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/core/error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace weft {

class Database;

/// A prepared statement from the connection's cache; returned to it on destruction.
class Query {
  public:
    Query(Query&& other) noexcept;
    Query& operator=(Query&&) = delete;
    ~Query();

    Query& bind(std::int64_t value);
    Query& bind(int value) { return bind(static_cast<std::int64_t>(value)); }
    Query& bind(double value);
    /// The text must stay alive until the statement has run.
    Query& bind(std::string_view text);
    Query& bind(std::span<const std::byte> blob);
    Query& bind_null();

    /// True while there is a row.
    [[nodiscard]] Expected<bool> step();
    /// Runs a statement that returns nothing.
    [[nodiscard]] Status run();

    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double real(int column) const;
    [[nodiscard]] std::string text(int column) const;
    /// Valid until the next step.
    [[nodiscard]] std::span<const std::byte> blob(int column) const;
    [[nodiscard]] bool is_null(int column) const;

  private:
    friend class Database;
    Query(Database* database, sqlite3_stmt* statement)
        : database_(database), statement_(statement) {}
    Database* database_;
    sqlite3_stmt* statement_;
    int bound_ = 0;
};

/// Not thread-safe: the owner must lock.
class Database {
  public:
    /// Errors: Unreadable (no database, damaged, not writable), NoSpace.
    [[nodiscard]] static Expected<std::unique_ptr<Database>> open(const std::string& path,
                                                                  bool create, bool read_only);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] Expected<Query> query(std::string_view sql);
    /// One or more statements without results.
    [[nodiscard]] Status execute(const char* sql);
    /// First column of the first row, or `otherwise` without a row.
    [[nodiscard]] Expected<std::int64_t> number(std::string_view sql, std::int64_t otherwise = 0);
    [[nodiscard]] std::int64_t last_row() const;
    [[nodiscard]] int changed_rows() const;
    /// What SQLite's last error means, in words.
    [[nodiscard]] Error error(int code) const;

  private:
    friend class Query;
    Database(std::string path, sqlite3* handle) : path_(std::move(path)), handle_(handle) {}
    std::string path_;
    sqlite3* handle_;
    std::unordered_map<std::string, std::vector<sqlite3_stmt*>> free_;
    std::unordered_map<sqlite3_stmt*, std::string> sql_of_;
};

/// BEGIN IMMEDIATE … COMMIT; rolls back on destruction without commit().
class Transaction {
  public:
    [[nodiscard]] static Expected<Transaction> begin(Database& database);
    Transaction(Transaction&& other) noexcept : database_(other.database_) {
        other.database_ = nullptr;
    }
    Transaction& operator=(Transaction&&) = delete;
    ~Transaction();
    [[nodiscard]] Status commit();

  private:
    explicit Transaction(Database* database) : database_(database) {}
    Database* database_;
};

}  // namespace weft
