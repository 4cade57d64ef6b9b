#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "casebase/store/row.h"
#include "casebase/store/sqlite_file.h"
#include "casebase/store/sqlite_tables.h"
#include "casebase/store/store.h"
#include "casebase/store/version_1.h"
#include "planner/ground/base/file.h"

// One file of SQLite: a table of heads, a table of bodies, a row of totals, and the number of each case's row
// by its id. It is opened defensively: the schema has to be ours to the letter, with no other table, index,
// trigger or view.
//
// Rows are only appended, so that writing touches the right edge of two trees, the row of totals and the tree
// of ids. Before writing, that edge is read and held against what it should be, and the file must have the
// size and no free page, as a file has that only grew: then no row that is stored can be overwritten, however
// damaged the rest of the file is. Where it is not so, the whole structure is checked first (PRAGMA
// integrity_check). The tree of ids is the only one that is written in its middle. It is the only tree of its
// kind as well (WITHOUT ROWID), and SQLite refuses a page of another kind in it (SQLITE_CORRUPT): a broken
// branch of it can spoil ids, and no head or body. Nobody believes it: what it finds is held against the head
// that it names, and a case that stands twice because it was not found is read once.
//
// Source: SQLite 3.40, "Database File Format", 1.6 (B-tree pages); moveToChild and balance_nonroot of
// btree.c.

namespace capstan::casebase {
namespace {

constexpr std::int64_t kLeastRowBytes = 64;  // a head takes more than this

class SqliteStore final : public Store, private SqliteFile {
 public:
  explicit SqliteStore(std::string path) : SqliteFile(std::move(path)) {}

  Status connect(Missing missing, int busy_ms, Job& job);

  std::string name() const override { return path(); }
  Result<std::string> read(std::int64_t after, const TakeHead& take) override;
  Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) override;
  Status append(std::int64_t after, const TakeHead& take, const Decide& decide) override;
  Result<bool> append_found(std::span<const std::string> ids, const TakeHead& take,
                            const Decide& decide) override;

 private:
  /// The rows of a file of version 1, until something is added to it.
  std::optional<OldRows> old_;

  [[nodiscard]] Diagnostic totals_gone() const {
    return fault("CASE-DAMAGED", "its totals are gone", "restore the file from a copy");
  }
  Status make_tables();
  Status make_where_empty();
  Result<std::int64_t> version();
  Result<std::int64_t> check_version();
  Result<OldTotals> old_totals();
  Result<OldRows> read_version_1(Job& job);
  Status check_edge(const Totals& totals);
  Result<std::string> totals();
  Status heads(std::int64_t after, const TakeHead& take);
  Status found(std::span<const std::string> ids, const TakeHead& take);
  Status insert(const Appended& appended);
  Status insert_ids(const std::vector<NewRow>& rows);
  Status migrate();
  Status index_ids();
  Status append_within(const std::function<Status()>& heads, const Decide& decide, bool& changed);
  Status within_transaction(const std::function<Status(bool& changed)>& act);
};

Status SqliteStore::make_tables() {
  if (Status made = run(fmt::format("{}; {}; {}; {}", kHeadTable, kBodyTable, kIdTable, kTotalTable),
                        "make the case base");
      !made)
    return made;
  Result<Statement> s = prepare("INSERT INTO capstan_total VALUES(1, ?)", "make the case base");
  if (!s) return fail(s.error());
  const std::string none = bytes_of(Totals{}, 0);
  sqlite3_bind_blob(s->get(), 1, none.data(), static_cast<int>(none.size()), SQLITE_STATIC);
  if (sqlite3_step(s->get()) != SQLITE_DONE) return fail(sqlite_fault("make the case base"));
  return run(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kApplicationId, kSchemaVersion),
      "make the case base");
}

/// In a file without any table, which is what SQLite opens where there was none.
Status SqliteStore::make_where_empty() {
  if (Status s = begin("BEGIN IMMEDIATE", "make the case base"); !s) return s;
  const Result<std::int64_t> tables = integer("SELECT count(*) FROM sqlite_schema");
  const Result<std::int64_t> application = integer("PRAGMA application_id");
  Status made;
  if (!tables || !application) {
    made = fail(!tables ? tables.error() : application.error());
  } else if (*tables == 0 && *application == 0) {
    made = make_tables();
  }
  if (made) made = run("COMMIT", "make the case base");
  if (!made) roll_back();
  return made;
}

Status SqliteStore::connect(Missing missing, int busy_ms, Job& job) {
  std::error_code ignored;
  const std::filesystem::path absolute =
      std::filesystem::absolute(path(), ignored);  // never a URI, ":memory:"
  const bool there = std::filesystem::exists(absolute, ignored);
  if (!there && missing == Missing::kRefuse)
    return fail(fault("CASE-OPEN", "there is no such case base", "`cases add` makes one"));
  if (there && !std::filesystem::is_regular_file(absolute, ignored))
    return fail(fault("CASE-OPEN", "this is not a file"));
  if (Status s = open(missing == Missing::kCreate, busy_ms); !s) return s;
  if (missing == Missing::kCreate && !read_only()) {
    const Result<std::int64_t> tables = integer("SELECT count(*) FROM sqlite_schema");
    if (!tables) return fail(tables.error());
    if (*tables == 0) {
      if (Status s = make_where_empty(); !s) return s;
    }
  }
  const Result<std::int64_t> of = version();
  if (!of) return fail(of.error());
  if (*of != 1) return {};
  if (Status s = begin("BEGIN", "read it"); !s) return s;
  Result<OldRows> old = read_version_1(job);
  roll_back();  // nothing was written
  if (!old) return fail(old.error());
  old_ = *std::move(old);
  return {};
}

Result<std::int64_t> SqliteStore::version() {
  const Result<std::int64_t> application = integer("PRAGMA application_id");
  if (!application) return fail(application.error());
  if (*application != kApplicationId) return fail(fault("CASE-SCHEMA", "this is not a case base"));
  const Result<std::int64_t> of = integer("PRAGMA user_version");
  if (!of) return fail(of.error());
  if (*of > kSchemaVersion || *of < 1) {
    return fail(
        fault("CASE-SCHEMA",
              fmt::format("the case base is of version {}, this program knows {}", *of, kSchemaVersion),
              "use the newer program that made it"));
  }
  return of;
}

/// The version, of a file whose tables are those of version 2 or 3.
Result<std::int64_t> SqliteStore::check_version() {
  const Result<std::int64_t> of = version();
  if (!of) return of;
  if (*of == 1) return fail(fault("CASE-SCHEMA", "it changed its version meanwhile", "open it again"));
  const auto tables = sqlite_tables();
  const std::size_t there = *of == kSchemaVersion ? tables.size() : tables.size() - 1;
  const Status ours = check_schema(std::span(tables).first(there));
  if (!ours) return fail(ours.error());
  return of;
}

Result<OldTotals> SqliteStore::old_totals() {
  Result<Statement> s = prepare("SELECT count, ids FROM capstan_total WHERE one = 1", "read its totals");
  if (!s) return fail(s.error());
  const int code = sqlite3_step(s->get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) return fail(sqlite_fault("read its totals"));
  OldTotals t;
  if (code == SQLITE_ROW) t = {sqlite3_column_int64(s->get(), 0), std::string(bytes_at(s->get(), 1))};
  if (t.ids.size() != 32) return fail(totals_gone());
  return t;
}

Result<OldRows> SqliteStore::read_version_1(Job& job) {
  const std::array<std::pair<std::string_view, std::string>, 2> ours = {
      {{"capstan_case", old_case_table()}, {"capstan_total", old_total_table()}}};
  if (Status s = check_schema(ours); !s) return fail(s.error());
  Result<OldTotals> stated = old_totals();
  const Result<std::int64_t> pages = integer("PRAGMA page_count"), page = integer("PRAGMA page_size");
  if (!stated || !pages || !page)
    return fail(!stated ? stated.error() : !pages ? pages.error() : page.error());
  const auto room = static_cast<std::size_t>(*pages * *page / kLeastRowBytes);
  OldReader reader(path(), *std::move(stated));
  Result<Statement> s = prepare(old_select(), "read its cases");
  if (!s) return fail(s.error());
  std::vector<OldCell> cells(static_cast<std::size_t>(sqlite3_column_count(s->get())));
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(s->get())) == SQLITE_ROW) {
    if (reader.count() >= room)
      return fail(fault("CASE-DAMAGED", "it gives more cases than it has room for"));
    for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
      const int type = sqlite3_column_type(s->get(), i);
      OldCell& cell = cells[static_cast<std::size_t>(i)];
      cell.type = type == SQLITE_TEXT      ? OldCell::Type::kText
                  : type == SQLITE_FLOAT   ? OldCell::Type::kReal
                  : type == SQLITE_INTEGER ? OldCell::Type::kInteger
                                           : OldCell::Type::kOther;
      if (type == SQLITE_TEXT) cell.text = bytes_at(s->get(), i);
      cell.real = sqlite3_column_double(s->get(), i);
      cell.integer = sqlite3_column_int64(s->get(), i);
    }
    reader.row(cells, job);
  }
  if (code != SQLITE_DONE) return fail(sqlite_fault("read its cases"));
  return reader.end(job);
}

Result<std::string> SqliteStore::totals() {
  Result<Statement> s = prepare("SELECT totals FROM capstan_total WHERE one = 1", "read its totals");
  if (!s) return fail(s.error());
  const int code = sqlite3_step(s->get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) return fail(sqlite_fault("read its totals"));
  return code == SQLITE_ROW ? std::string(bytes_at(s->get(), 0)) : std::string();
}

Status SqliteStore::heads(std::int64_t after, const TakeHead& take) {
  const Result<std::int64_t> pages = integer("PRAGMA page_count"), page = integer("PRAGMA page_size");
  if (!pages || !page) return fail(!pages ? pages.error() : page.error());
  // A tree whose branches were made to cross would give more rows than the file has room for.
  const std::int64_t room = *pages * *page / kLeastRowBytes;
  Result<Statement> s =
      prepare("SELECT number, head FROM capstan_head WHERE number > ? ORDER BY number", "read its cases");
  if (!s) return fail(s.error());
  sqlite3_bind_int64(s->get(), 1, after);
  int code = SQLITE_ROW;
  for (std::int64_t row = 1; (code = sqlite3_step(s->get())) == SQLITE_ROW; ++row) {
    if (row > room) return fail(fault("CASE-DAMAGED", "it gives more cases than it has room for"));
    if (Status taken = take(sqlite3_column_int64(s->get(), 0), bytes_at(s->get(), 1)); !taken) return taken;
  }
  if (code != SQLITE_DONE) return fail(sqlite_fault("read its cases"));
  return {};
}

Result<std::string> SqliteStore::read(std::int64_t after, const TakeHead& take) {
  if (old_) {
    for (const NewRow& row : old_->rows) {
      if (row.number <= after) continue;
      if (Status taken = take(row.number, row.head); !taken) return fail(taken.error());
    }
    return old_->damaged ? std::string() : bytes_of(old_->totals);
  }
  if (Status s = begin("BEGIN", "read it"); !s) return fail(s.error());
  const Result<std::int64_t> of = check_version();
  Status done = of ? Status() : fail(of.error());
  Result<std::string> stated = done ? totals() : Result<std::string>(fail(done.error()));
  if (stated) done = heads(after, take);
  roll_back();  // nothing was written
  if (!done) return fail(done.error());
  return stated;
}

Status SqliteStore::bodies(std::span<const std::int64_t> numbers, const TakeBody& take) {
  if (old_) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto at = static_cast<std::size_t>(numbers[i] - 1);
      if (numbers[i] >= 1 && at < old_->rows.size()) take(i, old_->rows[at].body);
    }
    return {};
  }
  Result<Statement> s = prepare("SELECT body FROM capstan_body WHERE number = ?", "read a case");
  if (!s) return fail(s.error());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    sqlite3_bind_int64(s->get(), 1, numbers[i]);
    const int code = sqlite3_step(s->get());
    // A row in a broken page is as good as gone. Whatever else hinders reading says nothing of the row, and
    // may be tried again: another program, the disk, no memory.
    constexpr std::array kGone = {SQLITE_DONE, SQLITE_CORRUPT, SQLITE_NOTADB, SQLITE_TOOBIG};
    if (code == SQLITE_ROW) {
      take(i, bytes_at(s->get(), 0));
    } else if (std::find(kGone.begin(), kGone.end(), code & 0xff) == kGone.end()) {
      return fail(sqlite_fault("read a case"));
    }
    sqlite3_reset(s->get());
  }
  return {};
}

/// Whether the edge at which rows are appended is what it should be; else the whole structure is checked.
Status SqliteStore::check_edge(const Totals& totals) {
  const Result<std::int64_t> free = integer("PRAGMA freelist_count"), pages = integer("PRAGMA page_count"),
                             size = integer("PRAGMA page_size");
  for (const Result<std::int64_t>* of : {&free, &pages, &size}) {
    if (!*of) return fail(of->error());
  }
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(std::filesystem::absolute(path()), unknown);
  if (*free != 0 || unknown || bytes != static_cast<std::uintmax_t>(*pages * *size)) {
    if (Status s = check_structure(); !s) return s;
  }
  Result<Statement> s = prepare(
      "SELECT (SELECT max(number) FROM capstan_body), number, head, body FROM capstan_head JOIN capstan_body "
      "USING(number) WHERE number = (SELECT max(number) FROM capstan_head)",
      "check it");
  if (!s) return fail(s.error());
  const int code = sqlite3_step(s->get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) return fail(sqlite_fault("check it"));
  if (code == SQLITE_DONE && totals.rows == 0) return {};
  const auto head = code == SQLITE_ROW ? head_of(bytes_at(s->get(), 2), totals.rows) : std::nullopt;
  const bool right = head && sqlite3_column_int64(s->get(), 0) == totals.rows &&
                     sqlite3_column_int64(s->get(), 1) == totals.rows &&
                     sum_of(bytes_at(s->get(), 3)) == head->body;
  if (right) return {};
  return fail(fault("CASE-DAMAGED", "nothing is added, for its last row is not what its totals speak of",
                    "restore it from a copy, or export its cases into a new one"));
}

Status SqliteStore::insert(const Appended& appended) {
  Result<Statement> head = prepare("INSERT INTO capstan_head VALUES(?, ?)", "add a case");
  Result<Statement> body = prepare("INSERT INTO capstan_body VALUES(?, ?)", "add a case");
  Result<Statement> total = prepare("UPDATE capstan_total SET totals = ? WHERE one = 1", "add a case");
  for (const Result<Statement>* s : {&head, &body, &total}) {
    if (!*s) return fail(s->error());
  }
  const auto put = [&](const Statement& s, int at, const std::string& bytes) {
    sqlite3_bind_blob(s.get(), at, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC);
    const bool done = sqlite3_step(s.get()) == SQLITE_DONE;
    sqlite3_reset(s.get());
    return done;
  };
  for (const NewRow& row : appended.rows) {
    for (const auto& [s, bytes] : {std::pair{&*head, &row.head}, {&*body, &row.body}}) {
      sqlite3_bind_int64(s->get(), 1, row.number);
      if (!put(*s, 2, *bytes)) return fail(sqlite_fault("add a case"));
    }
  }
  if (!put(*total, 1, appended.totals)) return fail(sqlite_fault("add a case"));
  if (changes() != 1) return fail(totals_gone());
  return insert_ids(appended.rows);
}

/// By id: many that come together are written page by page.
Status SqliteStore::insert_ids(const std::vector<NewRow>& rows) {
  std::vector<std::pair<std::string_view, std::int64_t>> ids;
  for (const NewRow& row : rows) {
    if (const auto id = case_id_in(row.head)) ids.emplace_back(*id, row.number);
  }
  if (ids.empty()) return {};
  std::sort(ids.begin(), ids.end());
  Result<Statement> s = prepare("INSERT OR IGNORE INTO capstan_id VALUES(?, ?)", "add a case");
  if (!s) return fail(s.error());
  for (const auto& [id, number] : ids) {
    sqlite3_bind_blob(s->get(), 1, id.data(), static_cast<int>(id.size()), SQLITE_STATIC);
    sqlite3_bind_int64(s->get(), 2, number);
    if (sqlite3_step(s->get()) != SQLITE_DONE) return fail(sqlite_fault("add a case"));
    sqlite3_reset(s->get());
  }
  return {};
}

/// Turns a file of version 2, whose heads were read and verified, into one of version 3.
Status SqliteStore::index_ids() {
  if (Status s = check_structure(); !s) return s;
  return run(
      fmt::format("{}; INSERT OR IGNORE INTO capstan_id SELECT substr(head, {}, {}), number FROM "
                  "capstan_head WHERE substr(head, {}, 1) = x'{:02x}' ORDER BY 1, 2; "
                  "PRAGMA user_version = {}",
                  kIdTable, kIdAt + 1, kIdBytes, kIdAt, static_cast<int>(RowKind::kCase), kSchemaVersion),
      "turn it into version 3");
}

/// The heads of the rows that have these ids, and of the last row.
Status SqliteStore::found(std::span<const std::string> ids, const TakeHead& take) {
  Result<Statement> by_id = prepare(
      "SELECT capstan_id.number, head FROM capstan_id LEFT JOIN capstan_head USING(number) WHERE id = ?",
      "read its cases");
  Result<Statement> last =
      prepare("SELECT number, head FROM capstan_head ORDER BY number DESC LIMIT 1", "read its cases");
  if (!by_id || !last) return fail(!by_id ? by_id.error() : last.error());
  const auto given = [&](sqlite3_stmt* s) -> Status {
    const int code = sqlite3_step(s);
    if (code != SQLITE_ROW && code != SQLITE_DONE) return fail(sqlite_fault("read its cases"));
    Status taken = code == SQLITE_ROW ? take(sqlite3_column_int64(s, 0), bytes_at(s, 1)) : Status();
    sqlite3_reset(s);
    return taken;
  };
  for (const std::string& id : ids) {
    sqlite3_bind_blob(by_id->get(), 1, id.data(), static_cast<int>(id.size()), SQLITE_STATIC);
    if (Status s = given(by_id->get()); !s) return s;
  }
  return given(last->get());
}

/// Turns a file of version 1 into one of version 3: its rows as they were read, in the same order. Another
/// program may have done the same meanwhile, with the same rows.
Status SqliteStore::migrate() {
  const Result<std::int64_t> of = version();
  if (!of) return fail(of.error());
  if (*of != 1) return {};
  if (old_->damaged) {
    return fail(fault("CASE-DAMAGED", "cases of it were altered or are gone, so nothing is added",
                      "restore it from a copy, or export its cases into a new one"));
  }
  if (Status s = check_structure(); !s) return s;
  const Result<OldTotals> stated = old_totals();
  if (!stated) return fail(stated.error());
  if (*stated != old_->stated)
    return fail(
        fault("CASE-BUSY", "another program of an older version added to it meanwhile", "open it again"));
  if (Status s = run("DROP TABLE capstan_case; DROP TABLE capstan_total", "turn it into version 3"); !s)
    return s;
  if (Status s = make_tables(); !s) return s;
  return insert({old_->rows, bytes_of(old_->totals)});
}

Status SqliteStore::append_within(const std::function<Status()>& heads, const Decide& decide, bool& changed) {
  if (old_) {
    if (Status s = migrate(); !s) return s;
    changed = true;
  }
  const Result<std::int64_t> of = check_version();
  if (!of) return fail(of.error());
  const Result<std::string> stated = totals();
  if (!stated) return fail(stated.error());
  if (Status s = heads(); !s) return s;
  const Result<Appended> appended = decide(*stated);
  if (!appended) return fail(appended.error());
  if (appended->rows.empty()) return {};
  changed = true;
  if (Status s = check_edge(totals_of(*stated).value_or(Totals{-1, {}})); !s) return s;
  if (*of != kSchemaVersion) {
    if (Status s = index_ids(); !s) return s;
  }
  return insert(*appended);
}

/// Writes what `act` changed, or nothing where it fails.
Status SqliteStore::within_transaction(const std::function<Status(bool& changed)>& act) {
  if (read_only()) return fail(fault("CASE-READ-ONLY", "the case base may only be read"));
  if (Status s = begin("BEGIN IMMEDIATE", "add a case"); !s) return s;
  bool changed = false;
  Status added = act(changed);
  if (added && changed) added = run("COMMIT", "store what was added");
  if (!added || !changed) roll_back();
  return added;
}

Status SqliteStore::append(std::int64_t after, const TakeHead& take, const Decide& decide) {
  Status added = within_transaction(
      [&](bool& changed) { return append_within([&] { return heads(after, take); }, decide, changed); });
  if (added && old_) {
    old_.reset();
    // The room of the old tables; where this fails the file is merely larger.
    (void)run("VACUUM", "make it smaller");
  }
  return added;
}

Result<bool> SqliteStore::append_found(std::span<const std::string> ids, const TakeHead& take,
                                       const Decide& decide) {
  if (old_) return false;
  bool indexed = false;
  const Status added = within_transaction([&](bool& changed) -> Status {
    const Result<std::int64_t> of = version();
    if (!of) return fail(of.error());
    indexed = *of == kSchemaVersion;
    return indexed ? append_within([&] { return found(ids, take); }, decide, changed) : Status();
  });
  if (!added) return fail(added.error());
  return indexed;
}

}  // namespace

Result<std::unique_ptr<Store>> open_sqlite(const std::string& path, Missing missing, Job& job, int busy_ms) {
  auto store = std::make_unique<SqliteStore>(path);
  if (Status s = store->connect(missing, busy_ms, job); !s) return fail(s.error());
  return store;
}

}  // namespace capstan::casebase
