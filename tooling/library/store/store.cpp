#include "tooling/library/store/store.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/requirement.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/store/codec.h"
#include "tooling/library/store/rows.h"

namespace capstan::tooling {
namespace {

using model::Cutter;

constexpr int kApplicationId = 0x43415054;  // "CAPT"
/// A row holds the fields of a cutter as the table has them: 2 is version 5 of these.
constexpr int kSchemaVersion = model::kCutterFieldsVersion - 3;
constexpr int kMostRowBytes = 4 << 20;
constexpr double kSlackMm = 1e-6;

constexpr const char* kRecordTable =
    "CREATE TABLE capstan_record(kind TEXT NOT NULL, place INTEGER NOT NULL, body BLOB NOT NULL, "
    "hash INTEGER NOT NULL, PRIMARY KEY(kind, place)) STRICT, WITHOUT ROWID";
constexpr const char* kCutterTable =
    "CREATE TABLE capstan_cutter(place INTEGER PRIMARY KEY, body BLOB NOT NULL, hash INTEGER NOT NULL) "
    "STRICT";
constexpr const char* kIndexTable =
    "CREATE TABLE capstan_index(place INTEGER PRIMARY KEY, class INTEGER NOT NULL, diameter REAL NOT NULL, "
    "diameter_to REAL NOT NULL, reach REAL NOT NULL, flutes REAL NOT NULL, corner REAL NOT NULL, "
    "pitch REAL NOT NULL, hash INTEGER NOT NULL) STRICT";

struct CloseDatabase {
  void operator()(sqlite3* db) const { sqlite3_close_v2(db); }
};
struct Finalize {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

struct Header {
  std::string name, source;
  std::vector<std::pair<std::string, std::string>> kept;
  std::array<std::int64_t, 7> counts{};  ///< item, instance, holder, assembly, entry, text, cutter
};
constexpr std::array<const char*, 6> kKinds = {"item", "instance", "holder", "assembly", "entry", "text"};

std::string encoded(const Header& h) {
  Encoder e;
  e(h.name), e(h.source), e(h.kept);
  for (const std::int64_t n : h.counts) e(n);
  return std::move(e.bytes);
}

std::string_view blob_of(sqlite3_stmt* s, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(s, column));
  const int size = sqlite3_column_bytes(s, column);
  return bytes == nullptr ? std::string_view() : std::string_view(bytes, static_cast<std::size_t>(size));
}

Status protect(sqlite3* db) {
  for (const auto& [option, on] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                   {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                   {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                   {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                   {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0}}) {
    if (sqlite3_db_config(db, option, on, nullptr) != SQLITE_OK)
      return fail("TOOLSTORE-OPEN", "cannot protect it");
  }
  sqlite3_limit(db, SQLITE_LIMIT_LENGTH, kMostRowBytes);
  sqlite3_limit(db, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_exec(db, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0", nullptr, nullptr, nullptr);
  return {};
}

/// Writes rows into a database in memory.
class Writer {
 public:
  explicit Writer(sqlite3* db) : db_(db) {}
  bool run(const std::string& sql) {
    return sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  }
  bool prepare() {
    return made("INSERT INTO capstan_record VALUES(?, ?, ?, ?)", record_) &&
           made("INSERT INTO capstan_cutter VALUES(?, ?, ?)", cutter_) &&
           made("INSERT INTO capstan_index VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)", index_);
  }
  bool record(const char* kind, std::int64_t place, const std::string& body) {
    sqlite3_stmt* s = record_.get();
    sqlite3_bind_text(s, 1, kind, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, place);
    sqlite3_bind_blob(s, 3, body.data(), static_cast<int>(body.size()), SQLITE_STATIC);
    sqlite3_bind_int64(s, 4, hash_of(kind, place, body));
    return step(s);
  }
  bool cutter(std::int64_t place, const Cutter& c) {
    Encoder e(&texts_);
    e(c);
    sqlite3_stmt* s = cutter_.get();
    sqlite3_bind_int64(s, 1, place);
    sqlite3_bind_blob(s, 2, e.bytes.data(), static_cast<int>(e.bytes.size()), SQLITE_STATIC);
    sqlite3_bind_int64(s, 3, hash_of("cutter", place, e.bytes));
    if (!step(s)) return false;
    const IndexKey k = key_of(c, place);
    s = index_.get();
    sqlite3_bind_int64(s, 1, place);
    sqlite3_bind_int(s, 2, k.cutter_class);
    for (int i = 0; i < 6; ++i) sqlite3_bind_double(s, 3 + i, k.value.at(static_cast<std::size_t>(i)));
    sqlite3_bind_int64(s, 9, hash_of(k));
    return step(s);
  }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_.texts(); }
  template <class T>
  bool records(const char* kind, const std::vector<T>& rows) {
    std::int64_t place = 0;
    for (const T& row : rows) {
      Encoder e;
      e(row);
      if (!record(kind, place++, e.bytes)) return false;
    }
    return true;
  }

 private:
  bool made(const char* sql, Statement& out) {
    sqlite3_stmt* s = nullptr;
    const bool ok = sqlite3_prepare_v2(db_, sql, -1, &s, nullptr) == SQLITE_OK;
    out.reset(s);
    return ok;
  }
  static bool step(sqlite3_stmt* s) {
    const bool ok = sqlite3_step(s) == SQLITE_DONE;
    sqlite3_reset(s);
    return ok;
  }
  sqlite3* db_;
  Statement record_, cutter_, index_;
  SharedTexts texts_;
};

bool write_all(Writer& w, const ToolLibrary& l, const std::vector<Cutter>& cutters) {
  std::int64_t place = 0;
  for (const Cutter& c : cutters) {
    if (!w.cutter(place++, c)) return false;
  }
  if (!w.records("text", w.texts())) return false;
  Header h{l.name, l.source, l.kept, {}};
  const std::array<std::size_t, 7> counts = {l.items.size(),      l.instances.size(), l.holders.size(),
                                             l.assemblies.size(), l.entries.size(),   w.texts().size(),
                                             cutters.size()};
  for (std::size_t i = 0; i < counts.size(); ++i) h.counts.at(i) = static_cast<std::int64_t>(counts.at(i));
  return w.record("library", 0, encoded(h)) && w.records("item", l.items) &&
         w.records("instance", l.instances) && w.records("holder", l.holders) &&
         w.records("assembly", l.assemblies) && w.records("entry", l.entries);
}

}  // namespace

struct ToolStore::Impl {
  std::string file, bytes;  ///< `bytes` when it is read from memory; must outlive `db`
  Database db;
  Statement by_place;
  Header header;
  std::vector<SharedText> texts;                                ///< of SharedTexts, by place
  std::vector<IndexKey> keys;                                   ///< by class, then diameter, then place
  std::map<int, std::pair<std::size_t, std::size_t>> of_class;  ///< where a class begins and ends in `keys`
  std::map<int, double> widest_range;  ///< of tools that can be set, per class: diameter_to - diameter

  [[nodiscard]] tl::unexpected<Diagnostic> refuse(std::string code, std::string message,
                                                  std::string hint = {}) const {
    return fail(Diagnostic{
        .code = std::move(code), .message = std::move(message), .file = file, .hint = std::move(hint)});
  }
  [[nodiscard]] tl::unexpected<Diagnostic> damaged(std::string message) const {
    return refuse("TOOLSTORE-DAMAGED", std::move(message), "import the library again, or restore the file");
  }
  [[nodiscard]] Result<Statement> prepare(const char* sql) const {
    sqlite3_stmt* s = nullptr;
    if (sqlite3_prepare_v2(db.get(), sql, -1, &s, nullptr) != SQLITE_OK) {
      const bool foreign = (sqlite3_errcode(db.get()) & 0xff) == SQLITE_NOTADB;
      return refuse(foreign ? "TOOLSTORE-SCHEMA" : "TOOLSTORE-DAMAGED",
                    std::string("this is no tool store that can be read: ") + sqlite3_errmsg(db.get()));
    }
    return Statement(s);
  }
  [[nodiscard]] Result<std::int64_t> integer(const char* sql) const {
    auto s = prepare(sql);
    if (!s) return fail(s.error());
    if (sqlite3_step(s->get()) != SQLITE_ROW) {
      if ((sqlite3_errcode(db.get()) & 0xff) == SQLITE_NOTADB)
        return refuse("TOOLSTORE-SCHEMA", "this is not a tool store");
      return damaged(sqlite3_errmsg(db.get()));
    }
    return sqlite3_column_int64(s->get(), 0);
  }
  Status check_schema() const;
  Status read_header();
  Status read_index();
  Status open();
  template <class T>
  Status read_records(const char* kind, std::int64_t count, std::vector<T>& out) const;
  [[nodiscard]] Result<Cutter> cutter_from(sqlite3_stmt* s, std::int64_t place) const;
};

Status ToolStore::Impl::check_schema() const {
  const auto application = integer("PRAGMA application_id");
  if (!application) return fail(application.error());
  if (*application != kApplicationId) return refuse("TOOLSTORE-SCHEMA", "this is not a tool store");
  const auto version = integer("PRAGMA user_version");
  if (!version) return fail(version.error());
  if (*version != kSchemaVersion)
    return refuse("TOOLSTORE-SCHEMA",
                  "the tool store is of version " + std::to_string(*version) + ", this program knows " +
                      std::to_string(kSchemaVersion),
                  *version > kSchemaVersion ? "use the newer program that made it"
                                            : "import the library again: capstan tools import ...");
  auto s = prepare("SELECT type, name, sql FROM sqlite_schema ORDER BY name");
  if (!s) return fail(s.error());
  std::size_t found = 0;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(s->get())) == SQLITE_ROW) {
    const std::string type(blob_of(s->get(), 0)), name(blob_of(s->get(), 1));
    const char* expected = name == "capstan_record"   ? kRecordTable
                           : name == "capstan_cutter" ? kCutterTable
                           : name == "capstan_index"  ? kIndexTable
                                                      : nullptr;
    if (type != "table" || expected == nullptr || blob_of(s->get(), 2) != expected)
      return refuse("TOOLSTORE-SCHEMA",
                    "the " + type.substr(0, 20) + " '" + name.substr(0, 60) + "' is not one of a tool store");
    ++found;
  }
  if (code != SQLITE_DONE) return damaged(sqlite3_errmsg(db.get()));
  if (found != 3) return refuse("TOOLSTORE-SCHEMA", "a table of the tool store is missing");
  return {};
}

template <class T>
Status ToolStore::Impl::read_records(const char* kind, std::int64_t count, std::vector<T>& out) const {
  auto s = prepare("SELECT place, body, hash FROM capstan_record WHERE kind = ? ORDER BY place");
  if (!s) return fail(s.error());
  sqlite3_bind_text(s->get(), 1, kind, -1, SQLITE_STATIC);
  int code = SQLITE_ROW;
  for (std::int64_t place = 0; (code = sqlite3_step(s->get())) == SQLITE_ROW; ++place) {
    const std::string row = std::string(kind) + " " + std::to_string(place);
    if (place >= count || sqlite3_column_int64(s->get(), 0) != place)
      return damaged(row + " is not where it should be");
    const std::string_view body = blob_of(s->get(), 1);
    if (hash_of(kind, place, body) != sqlite3_column_int64(s->get(), 2)) return damaged(row + " was altered");
    Decoder d(body);
    d(out.emplace_back());
    if (!d.done()) return damaged(row + " cannot be read");
  }
  if (code != SQLITE_DONE) return damaged(sqlite3_errmsg(db.get()));
  if (static_cast<std::int64_t>(out.size()) != count)
    return damaged("it holds " + std::to_string(out.size()) + " of " + std::to_string(count) +
                   " rows of kind " + kind);
  return {};
}

Status ToolStore::Impl::read_header() {
  auto s = prepare("SELECT body, hash FROM capstan_record WHERE kind = 'library' AND place = 0");
  if (!s) return fail(s.error());
  if (sqlite3_step(s->get()) != SQLITE_ROW) return damaged("its header is gone");
  const std::string_view body = blob_of(s->get(), 0);
  if (hash_of("library", 0, body) != sqlite3_column_int64(s->get(), 1))
    return damaged("its header was altered");
  Decoder d(body);
  d(header.name), d(header.source), d(header.kept);
  for (std::int64_t& n : header.counts) d(n);
  if (!d.done()) return damaged("its header cannot be read");
  for (const std::int64_t n : header.counts) {
    if (n < 0 || n > static_cast<std::int64_t>(kMostStoredTools))
      return damaged("its header speaks of " + std::to_string(n) + " rows");
  }
  return {};
}

Status ToolStore::Impl::read_index() {
  auto s = prepare(
      "SELECT place, class, diameter, diameter_to, reach, flutes, corner, pitch, hash FROM capstan_index "
      "ORDER BY place");
  if (!s) return fail(s.error());
  const std::int64_t count = header.counts.back();
  keys.reserve(static_cast<std::size_t>(count));
  int code = SQLITE_ROW;
  for (std::int64_t place = 0; (code = sqlite3_step(s->get())) == SQLITE_ROW; ++place) {
    IndexKey k;
    k.place = sqlite3_column_int64(s->get(), 0);
    k.cutter_class = sqlite3_column_int(s->get(), 1);
    for (int i = 0; i < 6; ++i)
      k.value.at(static_cast<std::size_t>(i)) = sqlite3_column_double(s->get(), 2 + i);
    if (k.place != place || place >= count || hash_of(k) != sqlite3_column_int64(s->get(), 8))
      return damaged("row " + std::to_string(place) + " of its index was altered");
    keys.push_back(k);
  }
  if (code != SQLITE_DONE) return damaged(sqlite3_errmsg(db.get()));
  if (static_cast<std::int64_t>(keys.size()) != count)
    return damaged("its index has " + std::to_string(keys.size()) + " rows of " + std::to_string(count));
  std::sort(keys.begin(), keys.end(), [](const IndexKey& a, const IndexKey& b) {
    if (a.cutter_class != b.cutter_class) return a.cutter_class < b.cutter_class;
    if (a.value[0] != b.value[0]) return a.value[0] < b.value[0];
    return a.place < b.place;
  });
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const IndexKey& k = keys[i];
    const auto at = of_class.emplace(k.cutter_class, std::pair{i, i}).first;
    at->second.second = i + 1;
    double& range = widest_range[k.cutter_class];
    range = std::max(range, k.value[1] - k.value[0]);
  }
  return {};
}

Status ToolStore::Impl::open() {
  if (auto ok = protect(db.get()); !ok) return refuse(ok.error().code, ok.error().message);
  if (auto ok = check_schema(); !ok) return ok;
  if (auto ok = read_header(); !ok) return ok;
  if (auto ok = read_records(kKinds[5], header.counts[5], texts); !ok) return ok;
  if (auto ok = read_index(); !ok) return ok;
  auto s = prepare("SELECT body, hash FROM capstan_cutter WHERE place = ?");
  if (!s) return fail(s.error());
  by_place = std::move(*s);
  return {};
}

Result<Cutter> ToolStore::Impl::cutter_from(sqlite3_stmt* s, std::int64_t place) const {
  const auto row_of = [&] { return "cutter " + std::to_string(place); };
  const std::string_view body = blob_of(s, 0);
  if (hash_of("cutter", place, body) != sqlite3_column_int64(s, 1)) return damaged(row_of() + " was altered");
  Cutter c;
  Decoder d(body, &texts);
  d(c);
  if (!d.done()) return damaged(row_of() + " cannot be read");
  if (const auto faults = faults_of(c); !faults.empty())
    return damaged(row_of() + " ('" + c.id + "') is no cutter: " + faults.front());
  return c;
}

Result<std::string> store_of(const ToolLibrary& library, const std::vector<Cutter>& cutters) {
  if (cutters.size() > kMostStoredTools || library.items.size() > kMostStoredTools)
    return fail("TOOLSTORE-LIMIT", "a store holds " + std::to_string(kMostStoredTools) + " tools at most");
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(":memory:", &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  Database db(raw);
  const auto failed = [&] {
    return fail("TOOLSTORE-WRITE", std::string("cannot make the store: ") + sqlite3_errmsg(db.get()));
  };
  if (code != SQLITE_OK) return failed();
  Writer w(db.get());
  const std::string schema = std::string("PRAGMA application_id = ") + std::to_string(kApplicationId) +
                             "; PRAGMA user_version = " + std::to_string(kSchemaVersion) + "; " +
                             kRecordTable + "; " + kCutterTable + "; " + kIndexTable + "; BEGIN";
  if (!w.run(schema) || !w.prepare() || !write_all(w, library, cutters) || !w.run("COMMIT")) return failed();
  sqlite3_int64 size = 0;
  unsigned char* bytes = sqlite3_serialize(db.get(), "main", &size, 0);
  if (bytes == nullptr) return failed();
  std::string out(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  sqlite3_free(bytes);
  return out;
}

bool looks_like_store(std::string_view bytes) {
  return bytes.starts_with(std::string_view("SQLite format 3\0", 16));
}

ToolStore::ToolStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ToolStore::ToolStore(ToolStore&&) noexcept = default;
ToolStore& ToolStore::operator=(ToolStore&&) noexcept = default;
ToolStore::~ToolStore() = default;

Result<ToolStore> ToolStore::open(const std::string& path) {
  auto impl = std::make_unique<Impl>();
  impl->file = path;
  std::error_code ignored;
  const auto absolute = std::filesystem::absolute(path, ignored);  // never a URI, never ":memory:"
  if (!std::filesystem::is_regular_file(absolute, ignored))
    return impl->refuse("TOOLSTORE-OPEN", "there is no such file");
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(absolute.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr);
  impl->db.reset(raw);
  if (code != SQLITE_OK)
    return impl->refuse("TOOLSTORE-OPEN", std::string("cannot open it: ") + sqlite3_errstr(code));
  if (auto ok = impl->open(); !ok) return fail(ok.error());
  return ToolStore(std::move(impl));
}

Result<ToolStore> ToolStore::from_bytes(std::string bytes, const std::string& file) {
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->bytes = std::move(bytes);
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(":memory:", &raw, SQLITE_OPEN_READWRITE, nullptr);
  impl->db.reset(raw);
  const auto size = static_cast<sqlite3_int64>(impl->bytes.size());
  if (code != SQLITE_OK ||
      sqlite3_deserialize(raw, "main", reinterpret_cast<unsigned char*>(impl->bytes.data()), size, size,
                          SQLITE_DESERIALIZE_READONLY) != SQLITE_OK)
    return impl->refuse("TOOLSTORE-OPEN", "cannot open it");
  if (auto ok = impl->open(); !ok) return fail(ok.error());
  return ToolStore(std::move(impl));
}

std::size_t ToolStore::size() const { return impl_->keys.size(); }

std::vector<std::int64_t> ToolStore::find(const model::ToolRequirement& r) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool exact = r.diameter_exact_mm > 0.0;
  const double low = (exact ? r.diameter_exact_mm - r.diameter_tolerance_mm : r.diameter_min_mm) - kSlackMm;
  const double most = exact ? r.diameter_exact_mm + r.diameter_tolerance_mm : r.diameter_max_mm;
  const double high = most > 0.0 ? most + kSlackMm : kInfinity;
  std::vector<std::int64_t> out;
  for (const model::CutterClass cls : r.classes) {
    const auto it = impl_->of_class.find(static_cast<int>(cls));
    if (it == impl_->of_class.end()) continue;
    // A tool that can be set begins further down.
    const double from = low - impl_->widest_range.at(it->first);
    const auto begin = impl_->keys.begin() + static_cast<std::ptrdiff_t>(it->second.first);
    const auto end = impl_->keys.begin() + static_cast<std::ptrdiff_t>(it->second.second);
    auto k = std::lower_bound(begin, end, from, [](const IndexKey& a, double d) { return a.value[0] < d; });
    for (; k != end && k->value[0] <= high; ++k) {
      const auto& [d, to, reach, flutes, corner, pitch] = k->value;
      if (to < low || reach < r.reach_mm - kSlackMm) continue;
      if (flutes < r.depth_of_cut_mm - kSlackMm) continue;
      if (r.corner_radius_limited && corner > r.corner_radius_max_mm + kSlackMm) continue;
      if (r.thread_pitch_mm > 0.0 && std::abs(pitch - r.thread_pitch_mm) > model::kPitchSlackMm) continue;
      out.push_back(k->place);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Result<std::vector<Cutter>> ToolStore::cutters(const std::vector<std::int64_t>& ids) const {
  std::vector<Cutter> out;
  out.reserve(ids.size());
  sqlite3_stmt* s = impl_->by_place.get();
  for (const std::int64_t place : ids) {
    sqlite3_reset(s);
    sqlite3_bind_int64(s, 1, place);
    if (sqlite3_step(s) != SQLITE_ROW)
      return impl_->damaged("cutter " + std::to_string(place) + " is not there");
    auto c = impl_->cutter_from(s, place);
    sqlite3_reset(s);
    if (!c) return fail(c.error());
    out.push_back(*std::move(c));
  }
  return out;
}

Result<std::vector<Cutter>> ToolStore::all_cutters() const {
  std::vector<IndexKey> by_place = impl_->keys;
  std::sort(by_place.begin(), by_place.end(),
            [](const IndexKey& a, const IndexKey& b) { return a.place < b.place; });
  std::vector<std::int64_t> ids;
  for (const IndexKey& k : by_place) ids.push_back(k.place);
  auto out = cutters(ids);
  if (!out) return out;
  for (std::size_t i = 0; i < out->size(); ++i) {
    if (key_of((*out)[i], by_place[i].place) != by_place[i])
      return impl_->damaged("the index speaks of another cutter than '" + (*out)[i].id + "'");
  }
  return out;
}

Result<ToolLibrary> ToolStore::library() const {
  ToolLibrary l;
  l.name = impl_->header.name;
  l.source = impl_->header.source;
  l.kept = impl_->header.kept;
  const auto& n = impl_->header.counts;
  for (const Status& ok :
       {impl_->read_records(kKinds[0], n[0], l.items), impl_->read_records(kKinds[1], n[1], l.instances),
        impl_->read_records(kKinds[2], n[2], l.holders), impl_->read_records(kKinds[3], n[3], l.assemblies),
        impl_->read_records(kKinds[4], n[4], l.entries)}) {
    if (!ok) return fail(ok.error());
  }
  return l;
}

}  // namespace capstan::tooling
