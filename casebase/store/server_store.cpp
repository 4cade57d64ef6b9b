#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "casebase/casebase.h"
#include "casebase/store/local.h"
#include "casebase/store/log.h"
#include "casebase/store/server.h"
#include "planner/ground/base/number.h"

// A server with a copy beside it and, while it cannot be reached, an outbox.
//
// Draining gives all rows of the outbox to the server in one transaction, without those that it has (a case
// by its id, a judgement by who said it, when and why), and only then removes the outbox. So draining may be
// interrupted anywhere and done again.

namespace capstan::casebase {
namespace {

constexpr std::size_t kCopiedAtATime = 4096;  // rows

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

Diagnostic warning(std::string code, std::string message, std::string file, std::string hint = {}) {
  return {.code = std::move(code),
          .severity = Severity::kWarning,
          .message = std::move(message),
          .file = std::move(file),
          .hint = std::move(hint)};
}

/// The heads of a copy that is whole, by number from 1.
struct Copied {
  std::string bytes;  // one behind the other: a string each would take as long as reading them
  std::vector<std::size_t> ends;
  Totals totals;
  std::string_view head(std::size_t row) const {
    const std::size_t from = row == 0 ? 0 : ends[row - 1];
    return std::string_view(bytes).substr(from, ends[row] - from);
  }
};

class ServerStore final : public Store {
 public:
  ServerStore(std::string uri, LocalFiles files, ConnectServer to_server)
      : uri_(std::move(uri)), name_(name_of(uri_)), files_(std::move(files)), connect_(to_server) {}

  Status connect(Missing missing, Job& job);

  std::string name() const override { return name_; }
  Result<std::string> read(std::int64_t after, const TakeHead& take) override;
  Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) override;
  Status append(std::int64_t after, const TakeHead& take, const Decide& decide) override;
  Result<bool> append_found(std::span<const std::string> ids, const TakeHead& take,
                            const Decide& decide) override;
  std::vector<Diagnostic> take_told() override { return std::exchange(told_, {}); }

 private:
  std::string uri_, name_;
  LocalFiles files_;
  ConnectServer connect_;
  std::unique_ptr<Store> server_;  // none while it cannot be reached
  std::unique_ptr<Store> local_;   // then
  std::vector<Diagnostic> told_;

  Status drain(Job& job);
  void set_aside(Job& job);
  std::optional<Copied> copied() const;
  Status copy(std::vector<NewRow> rows, const std::optional<Totals>& before);
  Status follow(std::int64_t after, std::vector<NewRow> rows);
  void tell(const Status& copying);
  Status copy_into(Store& to, std::vector<NewRow>& rows, const Totals& before);
};

Status ServerStore::connect(Missing missing, Job& job) {
  Result<std::unique_ptr<Store>> server = connect_(uri_, missing, job);
  if (server) {
    server_ = *std::move(server);
    if (!files_.outbox.empty() && exists(files_.outbox)) return drain(job);
    return {};
  }
  Diagnostic why = server.error();
  // The library's fault is this machine's, not the server's: the copy of a server that was reached before
  // serves until it is mended; nothing is begun for one that never was.
  const bool no_library = why.code == "CASE-LIBRARY";
  if (why.code != "CASE-OFFLINE" && !no_library) return fail(std::move(why));
  const bool reached = !files_.copy.empty() && (exists(files_.copy) || exists(files_.outbox));
  if (files_.copy.empty() || (!reached && (no_library || missing == Missing::kRefuse))) {
    if (!no_library) {
      why.code = "CASE-OPEN";
      why.hint = "there is no local copy of it yet";
    }
    return fail(std::move(why));
  }
  Result<LocalBase> local = open_local(files_, name_);
  if (!local) return fail(local.error());
  local_ = std::move(local->store);
  job.report(warning(why.code,
                     fmt::format("{}: the local copy of the server's base, {}, is used, what is added waits "
                                 "for the server ({} so far)",
                                 why.message, counted(static_cast<std::size_t>(local->copied), "row", "rows"),
                                 counted(static_cast<std::size_t>(local->waiting), "row", "rows")),
                     name_,
                     (no_library ? why.hint + "; " : "") +
                         "the next call that reaches the server adds what waits in " + files_.outbox));
  return {};
}

/// Puts a damaged outbox where nothing is added to it and nobody takes it for sent.
void ServerStore::set_aside(Job& job) {
  std::string aside;
  for (int i = 1; aside.empty() || exists(aside); ++i)
    aside = files_.outbox + ".damaged-" + std::to_string(i);
  std::error_code wrong;
  std::filesystem::rename(files_.outbox, aside, wrong);
  job.report(
      warning("CASE-DAMAGED",
              "rows that waited for the server were altered or are gone; those that were not are added",
              wrong ? files_.outbox : aside, "read what is left of it with `cases list`"));
}

/// Adds what waits to the server. What hinders it is a warning: it goes on waiting.
Status ServerStore::drain(Job& job) {
  const auto waits_on = [&](const Diagnostic& why) -> Status {
    job.report(
        warning("CASE-OUTBOX", "what waits for the server was not added: " + why.message, files_.outbox));
    return {};
  };
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) return waits_on(lock.error());
  if (!exists(files_.outbox)) return {};
  std::vector<NewRow> waiting;
  bool whole = true;
  {
    const Result<std::unique_ptr<Store>> outbox = open_sqlite(files_.outbox, Missing::kCreate, job);
    Result<FileRows> rows = outbox ? rows_of(**outbox) : Result<FileRows>(fail(outbox.error()));
    if (!rows && rows.error().code != "CASE-DAMAGED" && rows.error().code != "CASE-SCHEMA")
      return waits_on(rows.error());
    whole = rows && rows->whole;
    std::vector<std::int64_t> numbers;
    if (rows) {
      for (const NewRow& row : rows->rows) numbers.push_back(row.number);
      const Status read = (*outbox)->bodies(
          numbers, [&](std::size_t i, std::string_view body) { rows->rows[i].body = body; });
      if (!read) return waits_on(read.error());
      for (NewRow& row : rows->rows) {
        const auto head = head_of(row.head, row.number);
        if (head && head->body == sum_of(row.body)) {
          waiting.push_back(std::move(row));
        } else {
          whole = false;
        }
      }
    }
  }
  Job quiet;  // the log that is opened for this says nothing that the one to come does not
  Result<std::unique_ptr<Store>> store = connect_(uri_, Missing::kRefuse, quiet);
  if (!store) return waits_on(store.error());
  Result<Log> log = Log::open(*std::move(store), quiet);
  if (!log) return waits_on(log.error());
  const Result<std::size_t> added = log->adopt(waiting);
  if (!added) return waits_on(added.error());
  if (!whole) {
    set_aside(job);
  } else {
    std::error_code wrong;
    std::filesystem::remove(files_.outbox, wrong);  // where it stays, all of it is known the next time
  }
  job.report(Diagnostic{.code = "CASE-OUTBOX",
                        .severity = Severity::kNote,
                        .message = fmt::format("{} waited for the server, {} of them new to it: added",
                                               counted(waiting.size(), "row", "rows"), *added),
                        .file = name_});
  return {};
}

/// Appends rows behind the copy's, whose totals are `before`. Their bodies are read where they are not known.
Status ServerStore::copy_into(Store& to, std::vector<NewRow>& rows, const Totals& before) {
  Totals now = before;
  for (std::size_t from = 0; from < rows.size(); from += kCopiedAtATime) {
    const std::size_t until = std::min(rows.size(), from + kCopiedAtATime);
    std::vector<std::int64_t> numbers;
    std::vector<std::size_t> at;
    for (std::size_t i = from; i < until; ++i) {
      if (!rows[i].body.empty()) continue;
      numbers.push_back(rows[i].number);
      at.push_back(i);
    }
    const Status read =
        server_->bodies(numbers, [&](std::size_t i, std::string_view body) { rows[at[i]].body = body; });
    if (!read) return read;
    Appended out;
    const Totals last = now;
    for (std::size_t i = from; i < until; ++i) {
      const auto head = head_of(rows[i].head, rows[i].number);
      // What is altered on the server is not copied, nor what stands behind it.
      if (!head || head->body != sum_of(rows[i].body)) {
        rows.resize(i);
        break;
      }
      now.count(rows[i].head);
      out.rows.push_back(std::move(rows[i]));
    }
    out.totals = bytes_of(now);
    const Status added = to.append(
        last.rows, [](std::int64_t, std::string_view) -> Status { return {}; },
        [&](const std::string& stated) -> Result<Appended> {
          // Another program may have brought it up to date meanwhile.
          return totals_of(stated) == std::optional(last) ? out : Appended{};
        });
    if (!added) return added;
  }
  return {};
}

/// The copy's heads; nothing: there is none that is whole. Needs the lock.
std::optional<Copied> ServerStore::copied() const {
  if (!exists(files_.copy)) return std::nullopt;
  Job quiet;
  const Result<std::unique_ptr<Store>> file = open_sqlite(files_.copy, Missing::kRefuse, quiet);
  if (!file) return std::nullopt;
  Copied out;
  const Result<std::string> stated = (*file)->read(0, [&](std::int64_t, std::string_view head) -> Status {
    out.totals.count(head);
    out.bytes += head;
    out.ends.push_back(out.bytes.size());
    return {};
  });
  const bool whole = stated && totals_of(*stated) == std::optional(out.totals);
  return whole ? std::optional(std::move(out)) : std::nullopt;
}

/// Brings the copy up to date, as far as it can be: the server has the rows. `before`: the copy's totals when
/// it was looked at; nothing: it is made again. Needs the lock.
Status ServerStore::copy(std::vector<NewRow> rows, const std::optional<Totals>& before) {
  if (!before) {
    std::error_code ignored;
    for (const char* ending : {"", "-journal"}) std::filesystem::remove(files_.copy + ending, ignored);
  }
  Job quiet;
  const Result<std::unique_ptr<Store>> to = open_sqlite(files_.copy, Missing::kCreate, quiet);
  if (!to) return fail(to.error());
  return copy_into(**to, rows, before.value_or(Totals{}));
}

void ServerStore::tell(const Status& copying) {
  if (copying) return;
  told_.push_back(
      warning("CASE-COPY", "the local copy is not up to date: " + copying.error().message, files_.copy));
}

Result<std::string> ServerStore::read(std::int64_t after, const TakeHead& take) {
  if (!server_) return local_->read(after, take);
  if (after != 0 || files_.copy.empty()) return server_->read(after, take);
  std::optional<Copied> before;
  if (const Result<FileLock> lock = FileLock::take(files_.lock); lock) before = copied();
  // As long as the server's rows are the copy's, to the byte, only those behind them are kept while they
  // pass; where the copy is of other rows, all are.
  const std::size_t held = before ? before->ends.size() : 0;
  std::size_t same = 0;
  Totals now;
  std::vector<NewRow> behind;
  bool whole = true;
  const auto keep = [&](std::int64_t number, std::string_view head) {
    now.count(head);
    whole = whole && number == now.rows && head_of(head, number).has_value();
    behind.push_back({number, std::string(head), {}});
  };
  const auto keep_same = [&] {  // where the copy is of other rows after all
    if (same == held) return;
    for (std::size_t i = 0; i < same; ++i) keep(static_cast<std::int64_t>(i + 1), before->head(i));
    same = 0;
  };
  const Result<std::string> stated =
      server_->read(0, [&](std::int64_t number, std::string_view head) -> Status {
        const bool next = number == static_cast<std::int64_t>(same + 1);
        if (behind.empty() && same < held && next && before->head(same) == head) {
          if (++same == held) now = before->totals;
          return take(number, head);
        }
        keep_same();
        keep(number, head);
        return take(number, head);
      });
  if (!stated) return stated;
  const bool ours = before && same == held;
  if (!ours) keep_same();
  if (!whole || totals_of(*stated) != std::optional(now)) return stated;  // the copy is the better one
  if (ours && behind.empty()) return stated;
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) {
    tell(fail(lock.error()));
    return stated;
  }
  const std::optional<Copied> meanwhile = copied();
  const auto totals = [](const std::optional<Copied>& rows) {
    return rows ? std::optional(rows->totals) : std::nullopt;
  };
  if (totals(meanwhile) == totals(before))  // else another program is bringing it up to date
    tell(copy(std::move(behind), ours ? totals(before) : std::nullopt));
  return stated;
}

Status ServerStore::bodies(std::span<const std::int64_t> numbers, const TakeBody& take) {
  if (server_) {
    std::vector<bool> given(numbers.size());
    Status done = server_->bodies(numbers, [&](std::size_t i, std::string_view body) {
      given[i] = true;
      take(i, body);
    });
    if (done || done.error().code != "CASE-OFFLINE" || files_.copy.empty()) return done;
    // The copy has the same rows: what is held against their heads is read from there.
    std::vector<std::int64_t> left;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (given[i]) continue;
      left.push_back(numbers[i]);
      at.push_back(i);
    }
    Job quiet;
    const Result<std::unique_ptr<Store>> copy = open_sqlite(files_.copy, Missing::kRefuse, quiet);
    if (!copy) return done;
    return (*copy)->bodies(left, [&](std::size_t i, std::string_view body) { take(at[i], body); });
  }
  return local_->bodies(numbers, take);
}

/// Adds rows to the copy where it ends with row `after`. One that is behind, or ahead, is brought up to date
/// at the next opening.
Status ServerStore::follow(std::int64_t after, std::vector<NewRow> rows) {
  const Result<FileLock> lock = FileLock::take(files_.lock);
  if (!lock) return fail(lock.error());
  if (!exists(files_.copy)) return {};
  Job quiet;
  const Result<std::unique_ptr<Store>> to = open_sqlite(files_.copy, Missing::kRefuse, quiet);
  if (!to) return fail(to.error());
  const Result<std::string> stated =
      (*to)->read(after, [](std::int64_t, std::string_view) -> Status { return {}; });
  if (!stated) return fail(stated.error());
  const std::optional<Totals> there = totals_of(*stated);
  return there && there->rows == after ? copy_into(**to, rows, *there) : Status();
}

Status ServerStore::append(std::int64_t after, const TakeHead& take, const Decide& decide) {
  if (!server_) return local_->append(after, take, decide);
  std::vector<NewRow> fresh;
  Status done = server_->append(
      after,
      [&](std::int64_t number, std::string_view head) {
        fresh.push_back({number, std::string(head), {}});
        return take(number, head);
      },
      [&](const std::string& stated) {
        Result<Appended> out = decide(stated);
        if (out) fresh.insert(fresh.end(), out->rows.begin(), out->rows.end());
        return out;
      });
  if (done) {
    if (!files_.copy.empty() && !fresh.empty()) tell(follow(after, std::move(fresh)));
    return done;
  }
  if (done.error().code != "CASE-OFFLINE" || files_.copy.empty()) return done;
  // The commit's outcome is unknown. What is added waits in the outbox, where the server knows it again.
  Result<LocalBase> local = open_local(files_, name_);
  if (!local || local->copied != after || exists(files_.outbox)) return done;
  server_.reset();
  local_ = std::move(local->store);
  told_.push_back(warning("CASE-OFFLINE", done.error().message + ": what is added waits for the server",
                          name_,
                          "the next call that reaches the server adds what waits in " + files_.outbox));
  return local_->append(after, take, decide);
}

Result<bool> ServerStore::append_found(std::span<const std::string> ids, const TakeHead& take,
                                       const Decide& decide) {
  if (!server_) return false;
  std::vector<NewRow> fresh;
  const Result<bool> done = server_->append_found(ids, take, [&](const std::string& stated) {
    Result<Appended> out = decide(stated);
    if (out) fresh = out->rows;
    return out;
  });
  if (done) {
    if (files_.copy.empty() || fresh.empty()) return done;
    const std::int64_t after = fresh.front().number - 1;
    tell(follow(after, std::move(fresh)));
    return done;
  }
  if (done.error().code != "CASE-OFFLINE" || files_.copy.empty()) return done;
  // Whether it is stored is unknown. The copy stands for the server from here on, as if it had been away
  // already, and what waits in the outbox is known again there.
  Result<LocalBase> local = open_local(files_, name_);
  if (!local) return done;
  server_.reset();
  local_ = std::move(local->store);
  told_.push_back(warning("CASE-OFFLINE", done.error().message + ": what is added waits for the server",
                          name_,
                          "the next call that reaches the server adds what waits in " + files_.outbox));
  return false;
}

}  // namespace

Result<std::unique_ptr<Store>> open_server(const std::string& uri, Missing missing, Job& job,
                                           ConnectServer connect) {
  const Result<LocalFiles> files = local_files(name_of(uri));
  if (!files) job.report(warning("CASE-COPY", files.error().message, files.error().file, files.error().hint));
  auto store = std::make_unique<ServerStore>(uri, files ? *files : LocalFiles{}, connect);
  if (Status s = store->connect(missing, job); !s) return fail(s.error());
  return store;
}

}  // namespace capstan::casebase
