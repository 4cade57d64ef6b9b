#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "planner/ground/base/result.h"

// A file of SQLite, opened defensively, and what it reports in our codes; of this folder alone.

struct sqlite3;
struct sqlite3_stmt;

namespace capstan::casebase {

struct CloseDatabase {
  void operator()(sqlite3* db) const;
};
struct Finalize {
  void operator()(sqlite3_stmt* s) const;
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

/// The bytes of a column of the row that a statement stands at.
[[nodiscard]] std::string_view bytes_at(sqlite3_stmt* s, int column);

class SqliteFile {
 public:
  explicit SqliteFile(std::string path) : path_(std::move(path)) {}

  /// Opens it, which makes it where `create`. Fails CASE-OPEN.
  Status open(bool create, int busy_ms);
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool read_only() const;
  /// How many rows the last statement changed.
  [[nodiscard]] int changes() const;

  [[nodiscard]] Diagnostic fault(std::string code, std::string message, std::string hint = {}) const {
    return {.code = std::move(code), .message = std::move(message), .file = path_, .hint = std::move(hint)};
  }
  [[nodiscard]] Diagnostic sqlite_fault(std::string_view doing) const;
  Status run(const std::string& sql, std::string_view doing);
  Result<Statement> prepare(const std::string& sql, std::string_view doing);
  /// The one row and column of a query, as an integer.
  Result<std::int64_t> integer(const std::string& sql);
  /// Begins a transaction (`BEGIN`, `BEGIN IMMEDIATE`).
  Status begin(const std::string& how, std::string_view doing);
  /// Ends the transaction without a change, where there is one, and lets go of its lock, also without memory.
  void roll_back();

  /// Whether the schema is these tables, by name, to the letter and nothing else. Fails CASE-SCHEMA.
  Status check_schema(std::span<const std::pair<std::string_view, std::string>> tables);
  /// The structure of the whole file; once, since it was opened. Fails CASE-DAMAGED.
  Status check_structure();

 private:
  std::string path_;
  Database db_;
  Statement rollback_;
  bool checked_ = false;

  Status harden(int busy_ms);
};

}  // namespace capstan::casebase
