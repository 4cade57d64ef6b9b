#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>

#include "casebase/fields.h"
#include "casebase/store.h"
#include "planner/ground/base/file.h"

namespace capstan::casebase {
namespace {

constexpr int kApplicationId = 0x43415053;  // "CAPS"
constexpr int kSchemaVersion = 1;
constexpr int kMaxValueBytes = 65536;         // far above what a field may hold
constexpr std::int64_t kLeastRowBytes = 100;  // id, six words, fourteen numbers: a row takes more than this
constexpr std::size_t kReportedRows = 20;

struct CloseDatabase {
  void operator()(sqlite3* db) const { sqlite3_close_v2(db); }
};
struct Finalize {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

/// The hash of a set of ids: the exclusive or of them.
struct Digest {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Digest&) const = default;
  void toggle(std::string_view id) {
    high ^= word(id.substr(0, 16));
    low ^= word(id.substr(16, 16));
  }
  static std::uint64_t word(std::string_view hex) {
    std::uint64_t v = 0;
    std::from_chars(hex.data(), hex.data() + hex.size(), v, 16);
    return v;
  }
  std::string text() const { return hex64(high) + hex64(low); }
};

struct Totals {
  std::int64_t count = 0;
  Digest ids;
  bool operator==(const Totals&) const = default;
};

/// All columns but the id, as "name TYPE NOT NULL", "name" or "?".
std::string columns(std::string_view text, std::string_view real, std::string_view integer) {
  std::string out;
  const auto put = [&](std::string_view name, std::string_view form) {
    out += ", ";
    out += fmt::format(fmt::runtime(form), name);
  };
  for (const TextField& f : text_fields()) put(f.name, text);
  for (const NumberField& f : number_fields()) put(f.name, real);
  put("teeth", integer);
  put("coolant", integer);
  return out;
}

std::string case_table() {
  return "CREATE TABLE capstan_case(id TEXT PRIMARY KEY NOT NULL" +
         columns("{} TEXT NOT NULL", "{} REAL NOT NULL", "{} INTEGER NOT NULL") + ") STRICT, WITHOUT ROWID";
}
constexpr const char* kTotalTable =
    "CREATE TABLE capstan_total(one INTEGER PRIMARY KEY CHECK(one = 1), count INTEGER NOT NULL, "
    "ids TEXT NOT NULL) STRICT";

std::string text_of(sqlite3_stmt* s, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(s, column));
  const int size = sqlite3_column_bytes(s, column);
  return bytes == nullptr ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
}

const char* name_of_type(int type) {
  switch (type) {
    case SQLITE_INTEGER:
      return "an integer";
    case SQLITE_FLOAT:
      return "a number";
    case SQLITE_TEXT:
      return "text";
    case SQLITE_BLOB:
      return "bytes";
    default:
      return "NULL";
  }
}

/// Reads a row as far as its types are right; the fault of one that cannot be a case, or was altered.
std::optional<std::string> read_row(sqlite3_stmt* s, Case& c) {
  int column = 0;
  std::optional<std::string> wrong;
  const auto typed = [&](std::string_view name, int expected) {
    const int type = sqlite3_column_type(s, column);
    if (type != expected && !wrong) wrong = fmt::format("{} is {}", name, name_of_type(type));
    return type == expected;
  };
  if (typed("id", SQLITE_TEXT)) c.id = text_of(s, column);
  ++column;
  for (const TextField& f : text_fields()) {
    if (typed(f.name, SQLITE_TEXT)) f.in(c) = text_of(s, column);
    ++column;
  }
  for (const NumberField& f : number_fields()) {
    if (typed(f.name, SQLITE_FLOAT)) f.in(c) = sqlite3_column_double(s, column);
    ++column;
  }
  std::array<std::int64_t, 2> integers{};
  for (std::int64_t& v : integers) {
    if (typed(&v == integers.data() ? "teeth" : "coolant", SQLITE_INTEGER))
      v = sqlite3_column_int64(s, column);
    ++column;
  }
  if (wrong) return wrong;
  c.teeth = static_cast<int>(std::clamp<std::int64_t>(integers[0], -1, 1'000'000));
  c.coolant = integers[1] != 0;
  if (integers[1] != 0 && integers[1] != 1) return "coolant is neither 0 nor 1";
  if (auto fault = fault_of(c)) return fault;
  if (id_of(c) != c.id) return "its hash does not fit what it holds: it was altered";
  return std::nullopt;
}

}  // namespace

struct Store::Impl {
  std::string path;
  Database db;
  std::vector<Case> cases;
  bool damaged = false, checked = false;

  Diagnostic fault(std::string code, std::string message, std::string hint = {}) const {
    return {.code = std::move(code), .message = std::move(message), .file = path, .hint = std::move(hint)};
  }

  /// What SQLite reports, in our codes.
  Diagnostic sqlite_fault(std::string_view doing) const {
    const int code = sqlite3_errcode(db.get());
    const std::string why = fmt::format("cannot {}: {}", doing, sqlite3_errmsg(db.get()));
    switch (code & 0xff) {
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        return fault("CASE-BUSY", why, "another program is writing to it; try again");
      case SQLITE_NOTADB:
        return fault("CASE-SCHEMA", "this is not a case base: " + why);
      case SQLITE_CORRUPT:
      case SQLITE_TOOBIG:
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

  Status run(const std::string& sql, std::string_view doing) {
    if (sqlite3_exec(db.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
      return fail(sqlite_fault(doing));
    }
    return {};
  }

  Result<Statement> prepare(const std::string& sql, std::string_view doing) {
    sqlite3_stmt* s = nullptr;
    if (sqlite3_prepare_v2(db.get(), sql.c_str(), -1, &s, nullptr) != SQLITE_OK)
      return fail(sqlite_fault(doing));
    return Statement(s);
  }

  /// The one row and column of a query, as an integer.
  Result<std::int64_t> integer(const std::string& sql) {
    Result<Statement> s = prepare(sql, "read it");
    if (!s) return fail(s.error());
    if (sqlite3_step(s->get()) != SQLITE_ROW) return fail(sqlite_fault("read it"));
    return sqlite3_column_int64(s->get(), 0);
  }

  void roll_back() { sqlite3_exec(db.get(), "ROLLBACK", nullptr, nullptr, nullptr); }

  Status connect(Missing missing, int busy_ms);
  Status harden(int busy_ms);
  Status make_schema();
  Status check_schema();
  Status read_all(Job& job);
  Result<Totals> totals();
  Result<Totals> read_rows(Job& job);
  Status insert(std::span<const Case> added);
};

Status Store::Impl::connect(Missing missing, int busy_ms) {
  std::error_code ignored;
  const std::filesystem::path absolute =
      std::filesystem::absolute(path, ignored);  // never a URI, never ":memory:"
  const bool there = std::filesystem::exists(absolute, ignored);
  if (!there && missing == Missing::kRefuse) {
    return fail(fault("CASE-OPEN", "there is no such case base", "`cases add` makes one"));
  }
  if (there && !std::filesystem::is_regular_file(absolute, ignored)) {
    return fail(fault("CASE-OPEN", "this is not a file"));
  }
  const int flags =
      SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX | (missing == Missing::kCreate ? SQLITE_OPEN_CREATE : 0);
  sqlite3* raw = nullptr;
  const int code =
      sqlite3_open_v2(absolute.c_str(), &raw, flags, nullptr);  // falls back to reading by itself
  db.reset(raw);
  if (code != SQLITE_OK) {
    return fail(fault("CASE-OPEN", fmt::format("cannot open it: {}", sqlite3_errstr(code))));
  }
  return harden(busy_ms);
}

Status Store::Impl::harden(int busy_ms) {
  sqlite3_extended_result_codes(db.get(), 1);
  for (const auto& [option, on] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                   {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                   {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                   {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                   {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0}}) {
    if (sqlite3_db_config(db.get(), option, on, nullptr) != SQLITE_OK)
      return fail(sqlite_fault("protect it"));
  }
  sqlite3_limit(db.get(), SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  sqlite3_limit(db.get(), SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_busy_timeout(db.get(), busy_ms);
  return run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA synchronous = FULL", "set it up");
}

/// In a file without any table, which is what SQLite opens where there was none.
Status Store::Impl::make_schema() {
  if (Status s = run("BEGIN IMMEDIATE", "make the case base"); !s) return s;
  const Result<std::int64_t> tables = integer("SELECT count(*) FROM sqlite_schema");
  const Result<std::int64_t> application = integer("PRAGMA application_id");
  Status made;
  if (!tables || !application) {
    made = fail(!tables ? tables.error() : application.error());
  } else if (*tables == 0 && *application == 0) {
    made =
        run(fmt::format("{}; {}; INSERT INTO capstan_total VALUES(1, 0, '{}'); PRAGMA application_id = {}; "
                        "PRAGMA user_version = {}",
                        case_table(), kTotalTable, Digest{}.text(), kApplicationId, kSchemaVersion),
            "make the case base");
  }
  if (made) made = run("COMMIT", "make the case base");
  if (!made) roll_back();
  return made;
}

Status Store::Impl::check_schema() {
  const Result<std::int64_t> application = integer("PRAGMA application_id");
  if (!application) return fail(application.error());
  if (*application != kApplicationId) return fail(fault("CASE-SCHEMA", "this is not a case base"));
  const Result<std::int64_t> version = integer("PRAGMA user_version");
  if (!version) return fail(version.error());
  if (*version > kSchemaVersion) {
    return fail(
        fault("CASE-SCHEMA",
              fmt::format("the case base is of version {}, this program knows {}", *version, kSchemaVersion),
              "use the newer program that made it"));
  }
  Result<Statement> s = prepare("SELECT type, name, sql FROM sqlite_schema ORDER BY name", "read its schema");
  if (!s) return fail(s.error());
  std::vector<std::string> found;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(s->get())) == SQLITE_ROW) {
    const std::string name = text_of(s->get(), 1);
    const std::string expected = name == "capstan_case"    ? case_table()
                                 : name == "capstan_total" ? kTotalTable
                                                           : "";
    if (text_of(s->get(), 0) != "table" || expected.empty() || text_of(s->get(), 2) != expected) {
      return fail(fault("CASE-SCHEMA", fmt::format("the {} '{}' is not one of a case base",
                                                   text_of(s->get(), 0).substr(0, 20), name.substr(0, 60))));
    }
    found.push_back(name);
  }
  if (code != SQLITE_DONE) return fail(sqlite_fault("read its schema"));
  if (found != std::vector<std::string>{"capstan_case", "capstan_total"}) {
    return fail(fault("CASE-SCHEMA", "a table of the case base is missing"));
  }
  return {};
}

Result<Totals> Store::Impl::totals() {
  Result<Statement> s = prepare("SELECT count, ids FROM capstan_total WHERE one = 1", "read its totals");
  if (!s) return fail(s.error());
  const int code = sqlite3_step(s->get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) return fail(sqlite_fault("read its totals"));
  const std::string ids = code == SQLITE_ROW ? text_of(s->get(), 1) : std::string();
  if (ids.size() != 32)
    return fail(fault("CASE-DAMAGED", "its totals are gone", "restore the file from a copy"));
  Totals t{sqlite3_column_int64(s->get(), 0), {}};
  t.ids.toggle(ids);
  return t;
}

/// Verified rows into `cases`; gives what the totals of all of them should be.
Result<Totals> Store::Impl::read_rows(Job& job) {
  const Result<std::int64_t> pages = integer("PRAGMA page_count"), page = integer("PRAGMA page_size");
  if (!pages || !page) return fail(!pages ? pages.error() : page.error());
  // A tree whose branches were made to cross would give more rows than the file has room for.
  const std::int64_t room = *pages * *page / kLeastRowBytes;
  Result<Statement> s =
      prepare("SELECT id" + columns("{}", "{}", "{}") + " FROM capstan_case", "read its cases");
  if (!s) return fail(s.error());
  Totals read;
  std::size_t refused = 0;
  int code = SQLITE_ROW;
  for (std::int64_t row = 1; (code = sqlite3_step(s->get())) == SQLITE_ROW; ++row) {
    if (row > room) return fail(fault("CASE-DAMAGED", "it gives more cases than it has room for"));
    if (row > static_cast<std::int64_t>(kMaxCases)) {
      return fail(fault("CASE-LIMIT", fmt::format("it holds more than {} cases", kMaxCases)));
    }
    Case c;
    std::optional<std::string> wrong = read_row(s->get(), c);
    if (!wrong && !cases.empty() && cases.back().id >= c.id) wrong = "it is not in order, or there twice";
    if (!wrong) {
      read.ids.toggle(c.id);
      ++read.count;
      cases.push_back(std::move(c));
    } else if (++refused <= kReportedRows) {
      Diagnostic d = fault("CASE-ROW", fmt::format("case {} is left out: {}", row, *wrong));
      d.severity = Severity::kWarning;
      job.report(std::move(d));
    }
  }
  if (code != SQLITE_DONE) return fail(sqlite_fault("read its cases"));
  damaged = damaged || refused != 0;
  return read;
}

Status Store::Impl::read_all(Job& job) {
  if (Status s = check_schema(); !s) return s;
  const Result<Totals> stated = totals();
  if (!stated) return fail(stated.error());
  const Result<Totals> read = read_rows(job);
  if (!read) return fail(read.error());
  if (*stated != *read) {
    damaged = true;
    Diagnostic d = fault(
        "CASE-ROW",
        fmt::format("it should hold {} cases, and {} of them can be trusted", stated->count, read->count),
        "restore the file from a copy; nothing is added to this one");
    if (stated->count == read->count) d.message = "its cases are not those that its totals speak of";
    d.severity = Severity::kWarning;
    job.report(std::move(d));
  }
  return {};
}

Status Store::Impl::insert(std::span<const Case> added) {
  if (Status s = check_schema(); !s) return s;
  Result<Totals> total = totals();
  if (!total) return fail(total.error());
  Result<Statement> s =
      prepare("INSERT INTO capstan_case VALUES(?" + columns("?", "?", "?") + ") ON CONFLICT(id) DO NOTHING",
              "add a case");
  if (!s) return fail(s.error());
  for (const Case& c : added) {
    int at = 1;
    const auto text = [&](const std::string& v) {
      sqlite3_bind_text(s->get(), at++, v.data(), static_cast<int>(v.size()), SQLITE_STATIC);
    };
    text(c.id);
    for (const TextField& f : text_fields()) text(value(f, c));
    for (const NumberField& f : number_fields()) sqlite3_bind_double(s->get(), at++, value(f, c));
    sqlite3_bind_int(s->get(), at++, c.teeth);
    sqlite3_bind_int(s->get(), at++, c.coolant ? 1 : 0);
    if (sqlite3_step(s->get()) != SQLITE_DONE) return fail(sqlite_fault("add a case"));
    if (sqlite3_changes(db.get()) == 1) {
      ++total->count;
      total->ids.toggle(c.id);
    }
    sqlite3_reset(s->get());
  }
  if (total->count > static_cast<std::int64_t>(kMaxCases)) {
    return fail(fault("CASE-LIMIT", fmt::format("it would hold more than {} cases", kMaxCases)));
  }
  return run(fmt::format("UPDATE capstan_total SET count = {}, ids = '{}' WHERE one = 1", total->count,
                         total->ids.text()),
             "add a case");
}

Store::Store(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Result<Store> Store::open(const std::string& path, Missing missing, Job& job, int busy_ms) {
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  if (Status s = impl->connect(missing, busy_ms); !s) return fail(s.error());
  if (missing == Missing::kCreate && sqlite3_db_readonly(impl->db.get(), "main") == 0) {
    const Result<std::int64_t> tables = impl->integer("SELECT count(*) FROM sqlite_schema");
    if (!tables) return fail(tables.error());
    if (*tables == 0) {
      if (Status s = impl->make_schema(); !s) return fail(s.error());
    }
  }
  if (Status s = impl->run("BEGIN", "read it"); !s) return fail(s.error());
  Status read = impl->read_all(job);
  impl->roll_back();  // nothing was written
  if (!read) return fail(read.error());
  return Store(std::move(impl));
}

std::vector<Case> Store::take_cases() { return std::move(impl_->cases); }

Status Store::add(std::span<const Case> cases) {
  if (impl_->damaged) {
    return fail(impl_->fault("CASE-DAMAGED", "cases of it were altered or are gone, so nothing is added",
                             "restore it from a copy, or export its cases into a new one"));
  }
  if (sqlite3_db_readonly(impl_->db.get(), "main") != 0) {
    return fail(impl_->fault("CASE-READ-ONLY", "the case base may only be read"));
  }
  if (Status s = impl_->run("BEGIN IMMEDIATE", "add a case"); !s) return s;
  Status added;
  if (!impl_->checked) {  // writing into a broken tree breaks more of it
    Result<Statement> s = impl_->prepare("PRAGMA integrity_check(1)", "check it");
    if (!s || sqlite3_step(s->get()) != SQLITE_ROW) {
      added = fail(!s ? s.error() : impl_->sqlite_fault("check it"));
    } else if (const std::string says = text_of(s->get(), 0); says != "ok") {
      added = fail(impl_->fault("CASE-DAMAGED",
                                "nothing is added, for its structure is broken: " + says.substr(0, 200),
                                "restore it from a copy, or export its cases into a new one"));
    }
    impl_->checked = added.has_value();
  }
  if (added) added = impl_->insert(cases);
  if (added) added = impl_->run("COMMIT", "store what was added");
  if (!added) impl_->roll_back();
  return added;
}

}  // namespace capstan::casebase
