#include "casebase/store/sqlite_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>

namespace capstan::casebase {
namespace {

constexpr int kMaxValueBytes = 1 << 20;  // above what a body may hold: 2 series of 4096 samples, texts

}  // namespace

void CloseDatabase::operator()(sqlite3* db) const { sqlite3_close_v2(db); }
void Finalize::operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }

bool SqliteFile::read_only() const { return sqlite3_db_readonly(db_.get(), "main") != 0; }
int SqliteFile::changes() const { return sqlite3_changes(db_.get()); }

std::string_view bytes_at(sqlite3_stmt* s, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(s, column));
  const int size = sqlite3_column_bytes(s, column);
  return bytes == nullptr ? std::string_view() : std::string_view(bytes, static_cast<std::size_t>(size));
}

/// What SQLite reports, in our codes.
Diagnostic SqliteFile::sqlite_fault(std::string_view doing) const {
  const int code = sqlite3_errcode(db_.get());
  const std::string why = fmt::format("cannot {}: {}", doing, sqlite3_errmsg(db_.get()));
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return fault("CASE-BUSY", why, "another program is writing to it; try again");
    case SQLITE_NOTADB:
      return fault("CASE-SCHEMA", "this is not a case base: " + why);
    case SQLITE_CORRUPT:
      return fault("CASE-DAMAGED", "its file is damaged or cut short: " + why,
                   "restore the case base from a copy");
    case SQLITE_TOOBIG:
    case SQLITE_CONSTRAINT:
    case SQLITE_ERROR:
      return fault("CASE-DAMAGED", why, "restore the file from a copy");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return fault("CASE-READ-ONLY", why);
    case SQLITE_CANTOPEN:
      return fault("CASE-OPEN", why);
    default:
      return fault("CASE-STORE", why);
  }
}

Status SqliteFile::begin(const std::string& how, std::string_view doing) {
  roll_back();  // what could not be ended before
  return run(how, doing);
}

void SqliteFile::roll_back() {
  if (sqlite3_get_autocommit(db_.get()) != 0) return;
  // Prepared beforehand: what is to be undone may have failed for want of memory.
  sqlite3_step(rollback_.get());
  sqlite3_reset(rollback_.get());
}

Status SqliteFile::run(const std::string& sql, std::string_view doing) {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return fail(sqlite_fault(doing));
  return {};
}

Result<Statement> SqliteFile::prepare(const std::string& sql, std::string_view doing) {
  sqlite3_stmt* s = nullptr;
  if (sqlite3_prepare_v2(db_.get(), sql.c_str(), -1, &s, nullptr) != SQLITE_OK)
    return fail(sqlite_fault(doing));
  return Statement(s);
}

Result<std::int64_t> SqliteFile::integer(const std::string& sql) {
  Result<Statement> s = prepare(sql, "read it");
  if (!s) return fail(s.error());
  if (sqlite3_step(s->get()) != SQLITE_ROW) return fail(sqlite_fault("read it"));
  return sqlite3_column_int64(s->get(), 0);
}

Status SqliteFile::harden(int busy_ms) {
  sqlite3_extended_result_codes(db_.get(), 1);
  for (const auto& [option, on] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                   {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                   {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                   {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                   {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0}}) {
    if (sqlite3_db_config(db_.get(), option, on, nullptr) != SQLITE_OK)
      return fail(sqlite_fault("protect it"));
  }
  sqlite3_limit(db_.get(), SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  sqlite3_limit(db_.get(), SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_busy_timeout(db_.get(), busy_ms);
  // EXTRA: the folder is synchronised, too, once the journal is deleted. Else the journal of a commit may
  // come back with the power, and what was acknowledged is rolled back (SQLite, "Pragma statements",
  // synchronous).
  return run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA synchronous = EXTRA", "open it");
}

Status SqliteFile::open(bool create, int busy_ms) {
  std::error_code ignored;
  const std::filesystem::path absolute =
      std::filesystem::absolute(path_, ignored);  // never a URI, ":memory:"
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX | (create ? SQLITE_OPEN_CREATE : 0);
  sqlite3* raw = nullptr;
  const int code =
      sqlite3_open_v2(absolute.c_str(), &raw, flags, nullptr);  // falls back to reading by itself
  db_.reset(raw);
  if (code != SQLITE_OK)
    return fail(fault("CASE-OPEN", fmt::format("cannot open it: {}", sqlite3_errstr(code))));
  if (Status s = harden(busy_ms); !s) return s;
  Result<Statement> rollback = prepare("ROLLBACK", "open it");
  if (!rollback) return fail(rollback.error());
  rollback_ = *std::move(rollback);
  return {};
}

Status SqliteFile::check_schema(std::span<const std::pair<std::string_view, std::string>> tables) {
  Result<Statement> s = prepare("SELECT type, name, sql FROM sqlite_schema ORDER BY name", "read its schema");
  if (!s) return fail(s.error());
  std::size_t found = 0;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(s->get())) == SQLITE_ROW) {
    const std::string name(bytes_at(s->get(), 1));
    const auto ours =
        std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == name; });
    if (bytes_at(s->get(), 0) != "table" || ours == tables.end() || bytes_at(s->get(), 2) != ours->second) {
      return fail(fault("CASE-SCHEMA", fmt::format("the {} '{}' is not one of a case base",
                                                   bytes_at(s->get(), 0).substr(0, 20), name.substr(0, 60))));
    }
    ++found;
  }
  if (code != SQLITE_DONE) return fail(sqlite_fault("read its schema"));
  if (found != tables.size()) return fail(fault("CASE-SCHEMA", "a table of the case base is missing"));
  return {};
}

Status SqliteFile::check_structure() {
  if (checked_) return {};
  Result<Statement> s = prepare("PRAGMA integrity_check(1)", "check it");
  if (!s) return fail(s.error());
  if (sqlite3_step(s->get()) != SQLITE_ROW) return fail(sqlite_fault("check it"));
  if (const std::string says(bytes_at(s->get(), 0)); says != "ok") {
    return fail(fault("CASE-DAMAGED", "nothing is added, for its structure is broken: " + says.substr(0, 200),
                      "restore it from a copy, or export its cases into a new one"));
  }
  checked_ = true;
  return {};
}

}  // namespace capstan::casebase
