#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "casebase/store/local.h"

// The heads of the outbox are sealed again for the numbers that they have behind the copy's rows. What was
// added when a commit's outcome was unknown may stand in the copy, too; it is given once.
//
// The files are opened for each call and not kept open: another program may reach the server meanwhile, and
// then the outbox is gone and the copy longer. Who appends after that gets CASE-BUSY (open the base
// again), and no acknowledgement. A lock between programs keeps appending and draining apart.

namespace capstan::casebase {
namespace {

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

class LocalStore final : public Store {
 public:
  LocalStore(LocalFiles files, std::string name) : files_(std::move(files)), name_(std::move(name)) {}

  Status connect(LocalBase& counted);

  std::string name() const override { return name_; }
  Result<std::string> read(std::int64_t after, const TakeHead& take) override;
  Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) override;
  Status append(std::int64_t after, const TakeHead& take, const Decide& decide) override;

 private:
  /// A row of the base.
  struct Place {
    bool waits = false;       // in the outbox; else in the copy
    std::int64_t number = 0;  // there
  };
  struct View {
    std::vector<Place> places;  // of row 1, 2, ...
    std::vector<NewRow> rows;   // the same rows, as they are numbered here
    Totals copy, outbox;
    std::string stated;
  };

  LocalFiles files_;
  std::string name_;
  std::optional<View> view_;

  Result<View> view() const;
};

/// The base as it is now. Needs the lock: a file whose maker was killed before it had a table gets its
/// tables.
Result<LocalStore::View> LocalStore::view() const {
  View v;
  Job quiet;
  std::set<Id> ids;
  v.stated = bytes_of(Totals{});
  if (exists(files_.copy)) {
    const Result<std::unique_ptr<Store>> copy = open_sqlite(files_.copy, Missing::kCreate, quiet);
    Result<FileRows> rows = copy ? rows_of(**copy) : Result<FileRows>(fail(copy.error()));
    if (!rows) return fail(rows.error());
    v.copy = rows->totals;
    v.rows = std::move(rows->rows);
    v.stated = rows->stated;
    for (const NewRow& row : v.rows) v.places.push_back({false, row.number});
    if (!rows->whole) return v;  // whoever reads it finds so by its totals
  }
  if (!exists(files_.outbox)) return v;
  for (const NewRow& row : v.rows) {
    const auto head = head_of(row.head, row.number);
    if (head && head->kind == RowKind::kCase) ids.insert(head->id);
  }
  const Result<std::unique_ptr<Store>> outbox = open_sqlite(files_.outbox, Missing::kCreate, quiet);
  Result<FileRows> rows = outbox ? rows_of(**outbox) : Result<FileRows>(fail(outbox.error()));
  if (!rows) return fail(rows.error());
  v.outbox = rows->totals;
  Totals all = v.copy;
  for (NewRow& row : rows->rows) {
    const auto head = head_of(row.head, row.number);
    if (head && head->kind == RowKind::kCase && !ids.insert(head->id).second) continue;
    v.places.push_back({true, row.number});
    const auto number = static_cast<std::int64_t>(v.places.size());
    v.rows.push_back({number, head ? bytes_of(*head, number) : std::string(), {}});
    all.count(v.rows.back().head);
  }
  v.stated = rows->whole ? bytes_of(all) : std::string();
  return v;
}

Status LocalStore::connect(LocalBase& counted) {
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) return fail(lock.error());
  Result<View> v = view();
  if (!v) return fail(v.error());
  counted.copied = v->copy.rows;
  counted.waiting = static_cast<std::int64_t>(v->places.size()) - v->copy.rows;
  view_ = *std::move(v);
  return {};
}

Result<std::string> LocalStore::read(std::int64_t after, const TakeHead& take) {
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) return fail(lock.error());
  Result<View> v = view();
  if (!v) return fail(v.error());
  view_ = *std::move(v);
  for (const NewRow& row : view_->rows) {
    if (row.number <= after) continue;
    if (Status s = take(row.number, row.head); !s) return fail(s.error());
  }
  return view_->stated;
}

Status LocalStore::bodies(std::span<const std::int64_t> numbers, const TakeBody& take) {
  for (const bool waits : {false, true}) {
    std::vector<std::int64_t> there;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto place = static_cast<std::size_t>(numbers[i] - 1);
      if (!view_ || numbers[i] < 1 || place >= view_->places.size()) continue;
      if (view_->places[place].waits != waits) continue;
      there.push_back(view_->places[place].number);
      at.push_back(i);
    }
    if (there.empty()) continue;
    Job quiet;
    const Result<std::unique_ptr<Store>> file =
        open_sqlite(waits ? files_.outbox : files_.copy, Missing::kRefuse, quiet);
    if (!file) return fail(file.error());
    const Status read =
        (*file)->bodies(there, [&](std::size_t i, std::string_view body) { take(at[i], body); });
    if (!read) return read;
  }
  return {};
}

Status LocalStore::append(std::int64_t after, const TakeHead& take, const Decide& decide) {
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) return fail(lock.error());
  Result<View> now = view();
  if (!now) return fail(now.error());
  const bool same = view_ && now->copy == view_->copy && now->rows.size() >= view_->rows.size() &&
                    std::equal(view_->rows.begin(), view_->rows.end(), now->rows.begin(),
                               [](const NewRow& a, const NewRow& b) { return a.head == b.head; });
  if (!same) {
    return fail(Diagnostic{.code = "CASE-BUSY",
                           .message = "another program reached the server meanwhile",
                           .file = name_,
                           .hint = "open it again"});
  }
  view_ = *std::move(now);
  for (const NewRow& row : view_->rows) {
    if (row.number <= after) continue;
    if (Status s = take(row.number, row.head); !s) return s;
  }
  Result<Appended> appended = decide(view_->stated);
  if (!appended) return fail(appended.error());
  if (appended->rows.empty()) return {};
  Appended out;
  Totals waiting = view_->outbox, all = totals_of(view_->stated).value_or(Totals{});
  for (NewRow& row : appended->rows) {
    const auto head = head_of(row.head, row.number);
    if (!head) throw std::logic_error("a row that was made now has no head");
    const std::int64_t number = waiting.rows + 1;
    out.rows.push_back({number, bytes_of(*head, number), row.body});
    waiting.count(out.rows.back().head);
    all.count(row.head);
  }
  out.totals = bytes_of(waiting);
  Job quiet;
  const Result<std::unique_ptr<Store>> outbox = open_sqlite(files_.outbox, Missing::kCreate, quiet);
  if (!outbox) return fail(outbox.error());
  const Status added = (*outbox)->append(
      view_->outbox.rows, [](std::int64_t, std::string_view) -> Status { return {}; },
      [&](const std::string&) -> Result<Appended> { return out; });
  if (!added) return added;
  for (std::size_t i = 0; i < out.rows.size(); ++i) {
    view_->places.push_back({true, out.rows[i].number});
    view_->rows.push_back({appended->rows[i].number, appended->rows[i].head, {}});
  }
  view_->outbox = waiting;
  view_->stated = bytes_of(all);
  return {};
}

}  // namespace

Result<LocalBase> open_local(const LocalFiles& files, const std::string& name) {
  LocalBase out;
  auto store = std::make_unique<LocalStore>(files, name);
  if (Status s = store->connect(out); !s) return fail(s.error());
  out.store = std::move(store);
  return out;
}

}  // namespace capstan::casebase
