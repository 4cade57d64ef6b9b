#include "casebase/store/log.h"

#include <fmt/format.h>

#include <array>

#include "casebase/record/encoding.h"

namespace capstan::casebase {

Result<std::vector<Case>> with_ids(std::span<const Case> cases) {
  std::vector<Case> out(cases.begin(), cases.end());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (const auto wrong = fault_of(out[i])) {
      return fail(
          Diagnostic{.code = "CASE-INVALID",
                     .message = fmt::format("case {} of {} cannot be: {}", i + 1, out.size(), *wrong)});
    }
    out[i].id = id_of(out[i]);
  }
  return out;
}

NewRow row_of_case(const Case& c, std::int64_t number) {
  std::string body = encoded(c);
  const std::string categories = categories_of(c.asked);
  Head head;
  head.kind = RowKind::kCase;
  head.id = *id_of_digits(c.id);
  head.body = sum_of(body);
  head.verdict = c.observed.verdict;
  head.origin = c.origin;
  head.categories = categories;
  head.key = key_of(c.asked);
  return {number, bytes_of(head, number), std::move(body)};
}

Result<Log> Log::open(std::unique_ptr<Store> store, Job& job) {
  Log log(std::move(store));
  const auto take = [&](std::int64_t number, std::string_view head) { return log.take(number, head, &job); };
  const Result<std::string> stated = log.store_->read(0, take);
  if (!stated) return fail(stated.error());
  const auto totals = totals_of(*stated);
  Diagnostic d{.code = "CASE-ROW",
               .severity = Severity::kWarning,
               .message = {},
               .file = log.name(),
               .hint = "restore it from a copy; nothing is added to this one"};
  if (!totals) {
    d.message = "its totals are gone, or do not fit its rows: nobody can tell whether rows are missing";
  } else if (totals->rows != log.totals_.rows) {
    d.message = fmt::format("it should hold {} rows, and {} of them are there", totals->rows, log.taken_);
  } else if (totals->chain != log.totals_.chain) {
    d.message = "its rows are not those that its totals speak of";
  }
  log.heads_damaged_ = log.heads_damaged_ || !d.message.empty();
  log.shared_->damaged = log.heads_damaged_;
  if (!d.message.empty()) job.report(std::move(d));
  return log;
}

/// Takes a row; one that is not what was stored is reported to `job`, or is a fault where there is no job.
Status Log::take(std::int64_t number, std::string_view bytes, Job* job) {
  std::optional<std::string> wrong;
  const auto head = head_of(bytes, number);
  const bool in_order = number == totals_.rows + 1;
  if (!head) {
    wrong = "its hash does not fit what it holds: it was altered";
  } else if (!in_order && (job == nullptr || number <= totals_.rows)) {
    wrong = "it is not in order, or rows before it are gone";
  } else if (!in_order) {
    // Rows before it are gone, as the totals say. This one was sealed with its number, and holds.
    heads_damaged_ = true;
    totals_.rows = number - 1;
  }
  totals_.count(bytes);
  if (!wrong) wrong = take_in(number, *head);
  if (!wrong) {
    ++taken_;
    return {};
  }
  ++refused_;
  heads_damaged_ = true;
  Diagnostic d{
      .code = "CASE-ROW", .message = fmt::format("row {} is left out: {}", number, *wrong), .file = name()};
  if (job == nullptr) {
    shared_->damaged = true;
    d.code = "CASE-DAMAGED";
    return fail(std::move(d));
  }
  d.severity = Severity::kWarning;
  if (refused_ <= kReportedRows) job->report(std::move(d));
  return {};
}

std::optional<std::string> Log::take_in(std::int64_t number, const Head& head) {
  if (head.kind == RowKind::kMetric) {
    metric_ = {number, head.body};
    return std::nullopt;
  }
  if (head.kind != RowKind::kCase) {
    const auto entry = find(head.id);
    if (!entry) return "it speaks of a case that is not there";
    notes_.push_back({head.kind, *entry, head.verdict, number, head.body});
    Entry& e = entries_[*entry];
    if (head.kind == RowKind::kJudgement) {
      e.verdict = head.verdict;
    } else if (!e.removed) {
      e.removed = true;
      ++removed_;
    }
    return std::nullopt;
  }
  if (find(head.id)) return std::nullopt;
  if (entries_.size() >= kMaxCases) return fmt::format("a case base holds at most {} cases", kMaxCases);
  auto known = category(head.categories);
  if (!known) {
    known = static_cast<std::uint32_t>(categories_.size());
    category_numbers_.emplace(head.categories, *known);
    categories_.emplace_back(head.categories);
  }
  entries_.push_back({.id = head.id,
                      .number = number,
                      .body = head.body,
                      .categories = *known,
                      .origin = head.origin,
                      .verdict = head.verdict,
                      .removed = false,
                      .key = head.key});
  by_id_.add(entries_.size() - 1, head.id);
  return std::nullopt;
}

std::optional<std::uint32_t> Log::category(std::string_view categories) const {
  const auto found = category_numbers_.find(categories);
  if (found == category_numbers_.end()) return std::nullopt;
  return found->second;
}

bool Log::whole() const {
  const std::lock_guard lock(shared_->mutex);
  return !heads_damaged_ && !shared_->lost_metric;
}

std::optional<std::uint32_t> Log::find(const Id& id) const {
  return by_id_.find(id, [&](std::size_t i) { return entries_[i].id; });
}

/// How many cases there are once this is appended.
std::int64_t Log::live_with(const Store::Appended& more) const {
  auto held = static_cast<std::int64_t>(live());
  IdSet gone;
  for (const NewRow& row : more.rows) {
    if (case_id_in(row.head)) {
      ++held;
      continue;
    }
    const auto head = head_of(row.head, row.number);
    if (!head || head->kind != RowKind::kRemoval) continue;
    const auto entry = find(head->id);
    if (!(entry && entries_[*entry].removed) && gone.insert(head->id).second) --held;
  }
  return held;
}

void Log::put(Store::Appended& to, Head head, std::string body) const {
  head.body = sum_of(body);
  const std::int64_t number = totals_.rows + static_cast<std::int64_t>(to.rows.size()) + 1;
  to.rows.push_back({number, bytes_of(head, number), std::move(body)});
}

/// Appends what `make` gives once the rows of others are taken in, and takes it in.
Status Log::append(const std::function<Status(Store::Appended&)>& make) {
  const std::lock_guard lock(shared_->mutex);
  const auto refuse = [&] {
    return fail(Diagnostic{.code = "CASE-DAMAGED",
                           .message = "cases of it were altered or are gone, so nothing is added",
                           .file = name(),
                           .hint = "restore it from a copy, or export its cases into a new one"});
  };
  if (shared_->damaged) return refuse();
  std::vector<NewRow> mine;
  const auto take_row = [&](std::int64_t number, std::string_view head) {
    return take(number, head, nullptr);
  };
  const Status done =
      store_->append(totals_.rows, take_row, [&](const std::string& stated) -> Result<Store::Appended> {
        if (totals_of(stated) != std::optional(totals_)) {
          shared_->damaged = true;
          return refuse();
        }
        Store::Appended out;
        if (Status made = make(out); !made) return fail(made.error());
        Totals after = totals_;
        for (const NewRow& row : out.rows) after.count(row.head);
        out.totals = bytes_of(after, live_with(out));
        mine = out.rows;
        return out;
      });
  if (!done) return done;
  for (const NewRow& row : mine) {
    if (Status taken = take(row.number, row.head, nullptr); !taken) return taken;
  }
  return {};
}

Status Log::room_for(const Store::Appended& more) const {
  if (entries_.size() + more.rows.size() <= kMaxCases) return {};
  return fail(Diagnostic{.code = "CASE-LIMIT",
                         .message = fmt::format("it would hold more than {} cases", kMaxCases),
                         .file = name()});
}

Status Log::add(std::span<const Case> cases) {
  return append([&](Store::Appended& out) -> Status {
    IdSet mine;
    for (const Case& c : cases) {
      const Id id = *id_of_digits(c.id);
      if (find(id) || !mine.insert(id).second) continue;
      out.rows.push_back(row_of_case(c, totals_.rows + static_cast<std::int64_t>(out.rows.size()) + 1));
    }
    return room_for(out);
  });
}

Status Log::note(RowKind kind, std::span<const std::uint32_t> entries, Verdict verdict,
                 const Remark& remark) {
  return append([&](Store::Appended& out) -> Status {
    for (const std::uint32_t entry : entries) {
      const Entry& e = entries_.at(entry);
      // What holds already is said once: a call whose outcome is unknown may be repeated.
      if (kind == RowKind::kRemoval ? e.removed : e.verdict == verdict) continue;
      Head head;
      head.kind = kind;
      head.id = e.id;
      head.verdict = verdict;
      put(out, head, bytes_of(remark));
    }
    return {};
  });
}

Status Log::add_metric(const Metric& metric) {
  return append([&](Store::Appended& out) -> Status {
    std::string body = bytes_of(metric);
    if (metric_ && metric_->second == sum_of(body)) return {};
    Head head;
    head.kind = RowKind::kMetric;
    put(out, head, std::move(body));
    return {};
  });
}

Result<std::size_t> Log::adopt(std::span<const NewRow> rows) {
  std::size_t added = 0;
  const Status done = append([&](Store::Appended& out) -> Status {
    IdSet mine;
    for (const NewRow& row : rows) {
      const auto head = head_of(row.head, row.number);
      if (!head) throw std::logic_error("a row to be adopted was altered");
      const auto known = find(head->id);
      const auto same = [&](const Note& n) {
        return known && n.entry == *known && n.kind == head->kind && n.verdict == head->verdict &&
               n.body == head->body;
      };
      if (head->kind == RowKind::kCase) {
        if (known || !mine.insert(head->id).second) continue;
      } else if (head->kind == RowKind::kMetric) {
        if (metric_ && metric_->second == head->body) continue;
      } else if (!known && !mine.contains(head->id)) {
        return fail(Diagnostic{.code = "CASE-UNKNOWN",
                               .message = fmt::format("what waits speaks of case {}, which is not there",
                                                      digits_of(head->id).substr(0, 12)),
                               .file = name()});
      } else if (std::any_of(notes_.begin(), notes_.end(), same)) {
        continue;
      }
      put(out, *head, row.body);
    }
    added = out.rows.size();
    return room_for(out);
  });
  if (!done) return fail(done.error());
  return added;
}

Result<Metric> Log::metric() const {
  if (!metric_) return Metric{};
  std::optional<Metric> found;
  const std::array<std::int64_t, 1> number = {metric_->first};
  const std::lock_guard lock(shared_->mutex);
  const Status read = store_->bodies(number, [&](std::size_t, std::string_view body) {
    if (sum_of(body) == metric_->second) found = metric_of(body);
  });
  if (!read) return fail(read.error());
  if (found) return *found;
  shared_->damaged = shared_->lost_metric = true;
  shared_->faults.push_back(
      {.code = "CASE-ROW",
       .severity = Severity::kWarning,
       .message = fmt::format(
           "the metric of row {} was altered or is gone: distances are by the fixed scales", metric_->first),
       .file = name()});
  return Metric{};
}

/// The case of a body if it is what was stored; `why` says why not.
std::optional<Case> Log::verified(const Entry& entry, std::string_view body, std::string& why) const {
  why = "its hash does not fit what it holds: it was altered";
  if (sum_of(body) != entry.body) return std::nullopt;
  std::optional<Case> c = decoded(body);
  if (!c) {
    why = "nobody can read it";
    return std::nullopt;
  }
  if (const auto fault = fault_of(*c)) {
    why = *fault;
    return std::nullopt;
  }
  c->id = id_of(*c);
  const bool fits = id_of_digits(c->id) == std::optional(entry.id) && c->origin == entry.origin &&
                    key_of(c->asked) == entry.key && categories_of(c->asked) == categories_[entry.categories];
  if (!fits) {
    why = "its head is not that of its body";
    return std::nullopt;
  }
  c->observed.verdict = entry.verdict;
  return c;
}

std::vector<std::optional<Case>> Log::load(std::span<const std::uint32_t> wanted) const {
  std::vector<std::optional<Case>> out(wanted.size());
  std::vector<std::int64_t> numbers;
  numbers.reserve(wanted.size());
  for (const std::uint32_t entry : wanted) numbers.push_back(entries_.at(entry).number);
  std::vector<std::string> why(wanted.size(), "its row is gone");
  const std::lock_guard lock(shared_->mutex);
  const Status read = store_->bodies(numbers, [&](std::size_t i, std::string_view body) {
    out[i] = verified(entries_[wanted[i]], body, why[i]);
  });
  if (!read) {  // a file in use, a lost connection: the rows are none the worse for it
    const auto same = [&](const Diagnostic& d) {
      return d.code == read.error().code && d.message == read.error().message;
    };
    if (std::none_of(shared_->faults.begin(), shared_->faults.end(), same))
      shared_->faults.push_back(read.error());
    return out;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i]) continue;
    shared_->damaged = true;
    if (!shared_->told.insert(wanted[i]).second) continue;
    shared_->faults.push_back(
        {.code = "CASE-ROW",
         .severity = Severity::kWarning,
         .message =
             fmt::format("case {} is left out: {}", digits_of(entries_[wanted[i]].id).substr(0, 12), why[i]),
         .file = name(),
         .hint = "restore the base from a copy; where it is near, what went well raises nothing"});
  }
  return out;
}

Result<std::optional<Remark>> Log::remark(const Note& note) const {
  std::optional<Remark> out;
  const std::array<std::int64_t, 1> number = {note.number};
  const std::lock_guard lock(shared_->mutex);
  const Status read = store_->bodies(number, [&](std::size_t, std::string_view body) {
    if (sum_of(body) == note.body) out = remark_of(body);
  });
  if (!read) return fail(read.error());
  return out;
}

std::vector<Diagnostic> Log::take_faults() const {
  const std::lock_guard lock(shared_->mutex);
  std::vector<Diagnostic> out = std::exchange(shared_->faults, {});
  shared_->told.clear();
  for (Diagnostic& d : store_->take_told()) out.push_back(std::move(d));
  return out;
}

}  // namespace capstan::casebase
