#include "casebase/casebase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>

#include "casebase/intake.h"
#include "casebase/search.h"
#include "casebase/store/log.h"
#include "planner/ground/base/stopping.h"

namespace capstan::casebase {
namespace {

Diagnostic unknown(std::string_view id, std::string why) {
  return {.code = "CASE-UNKNOWN", .message = "'" + std::string(id.substr(0, 40)) + "' " + std::move(why)};
}

}  // namespace

struct CaseBase::Impl {
  explicit Impl(Log l) : log(std::move(l)), search(log) {}

  /// The base of a log. Fails as the log does, and where its metric cannot be read.
  static Result<CaseBase> base_of(Result<Log> log, Job& job) {
    if (!log) return fail(log.error());
    auto impl = std::make_unique<Impl>(*std::move(log));
    const Result<Metric> metric = impl->log.metric();
    if (!metric) return fail(metric.error());
    impl->search.weigh(*metric);
    for (Diagnostic& d : impl->log.take_faults()) job.report(std::move(d));
    return CaseBase(std::move(impl));
  }

  Log log;
  Search search;

  Result<std::uint32_t> entry(std::string_view id) const {
    const auto digits = id_of_digits(id);
    const auto found = digits ? log.find(*digits) : std::nullopt;
    if (!found) return fail(unknown(id, "is no case of this base"));
    return *found;
  }

  Status note(RowKind kind, std::span<const std::string> ids, Verdict verdict, const Remark& remark) {
    if (const auto wrong = fault_of(remark)) return fail("CASE-INVALID", *wrong);
    std::vector<std::uint32_t> entries;
    for (const std::string& id : ids) {
      const Result<std::uint32_t> e = entry(id);
      if (!e) return fail(e.error());
      entries.push_back(*e);
    }
    if (Status s = log.note(kind, entries, verdict, remark); !s) return s;
    forget();
    search.update();
    return {};
  }

  /// The cases that are not removed and of which this holds, by id.
  std::vector<Case> live_where(const std::function<bool(const Entry&)>& holds,
                               std::size_t most = std::numeric_limits<std::size_t>::max()) const {
    const std::vector<Entry>& entries = log.entries();
    std::vector<std::uint32_t> live;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      tick();
      if (!entries[i].removed && holds(entries[i])) live.push_back(static_cast<std::uint32_t>(i));
    }
    const auto by_id = [&](std::uint32_t a, std::uint32_t b) { return entries[a].id < entries[b].id; };
    if (live.size() > most) {
      std::nth_element(live.begin(), live.begin() + static_cast<std::ptrdiff_t>(most), live.end(), by_id);
      live.resize(most);
    }
    // In order before they are read: a case is a hundred times as large as its place.
    std::sort(live.begin(), live.end(), by_id);
    std::vector<Case> out;
    out.reserve(live.size());
    constexpr std::size_t kAtATime = 64;  // some 1 ms; default, unsourced
    for (std::span<const std::uint32_t> left = live; !left.empty();) {
      poll();
      const auto some = left.first(std::min(left.size(), kAtATime));
      left = left.subspan(some.size());
      for (std::optional<Case>& c : log.load(some)) {
        if (c) out.push_back(*std::move(c));
      }
    }
    return out;
  }

  /// What others wrote meanwhile may have come with what was written: verdicts may be others.
  void forget() { read.clear(); }

  /// Places become cases; those that are not what was stored are left out. Each case is read and verified
  /// once: the questions of a plan, one for each candidate of a step, find the same ones again and again.
  Look loaded(const std::vector<Found>& found) const {
    const std::scoped_lock lock(reading);
    std::vector<std::uint32_t> missing;
    for (const Found& f : found) {
      if (!read.contains(f.entry)) missing.push_back(f.entry);
    }
    if (read.size() + missing.size() > kMostKept) {
      read.clear();
      missing.clear();
      for (const Found& f : found) missing.push_back(f.entry);
    }
    std::vector<std::optional<Case>> cases;
    if (!missing.empty()) cases = log.load(missing);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i]) read.emplace(missing[i], *std::move(cases[i]));
    }
    Look out;
    out.found.reserve(found.size());
    for (const Found& f : found) {
      const double distance = std::sqrt(f.distance2);
      if (const auto c = read.find(f.entry); c != read.end()) {
        out.found.push_back({c->second, distance});
      } else {
        const Entry& e = log.entries()[f.entry];
        out.lost.push_back({digits_of(e.id), distance, e.origin, e.verdict});
      }
    }
    return out;
  }

 private:
  static constexpr std::size_t kMostKept = std::size_t{1} << 15U;  // some 30 MB; default, unsourced
  mutable std::mutex reading;
  mutable std::map<std::uint32_t, Case> read;  // by entry, with the verdicts that it has
};

CaseBase::CaseBase(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseBase::CaseBase(CaseBase&&) noexcept = default;
CaseBase& CaseBase::operator=(CaseBase&&) noexcept = default;
CaseBase::~CaseBase() = default;

namespace {

Result<Log> open_log(const std::string& uri, Missing missing, Job& job) {
  Result<std::unique_ptr<Store>> store = open_store(uri, missing, job);
  if (!store) return fail(store.error());
  return Log::open(*std::move(store), job);
}

}  // namespace

Result<CaseBase> CaseBase::open(const std::string& uri, Job& job) {
  return Impl::base_of(open_log(uri, Missing::kRefuse, job), job);
}

Result<CaseBase> CaseBase::open_or_create(const std::string& uri, Job& job) {
  return Impl::base_of(open_log(uri, Missing::kCreate, job), job);
}

Result<CaseBase> Intake::read(Job& job) {
  return CaseBase::Impl::base_of(Log::open(std::move(store_), job), job);
}

Status CaseBase::add(const Case& c) { return add(std::span(&c, 1)); }

Status CaseBase::add(std::span<const Case> added) {
  const Result<std::vector<Case>> checked = with_ids(added);
  if (!checked) return fail(checked.error());
  if (checked->empty()) return {};
  if (Status s = impl_->log.add(*checked); !s) return s;
  impl_->forget();
  impl_->search.update();
  return {};
}

Status CaseBase::judge(std::span<const std::string> ids, Verdict verdict, const Remark& remark) {
  return impl_->note(RowKind::kJudgement, ids, verdict, remark);
}

Status CaseBase::remove(std::span<const std::string> ids, const Remark& remark) {
  return impl_->note(RowKind::kRemoval, ids, Verdict::kUnknown, remark);
}

const Metric& CaseBase::metric() const { return impl_->search.metric(); }

Result<Metric> CaseBase::learn_metric() {
  const Metric learned = learned_metric(cases());
  if (learned.cases == 0) return fail("CASE-UNKNOWN", "no case went well, so that nothing can be learned");
  if (Status s = impl_->log.add_metric(learned); !s) return fail(s.error());
  impl_->search.update();
  impl_->search.weigh(learned);
  return learned;
}

Result<std::string> CaseBase::find(std::string_view digits) const {
  std::string found;
  for (const Entry& e : impl_->log.entries()) {
    std::string id = digits_of(e.id);
    if (!id.starts_with(digits)) continue;
    if (!found.empty()) return fail(unknown(digits, "begins more than one id"));
    found = std::move(id);
  }
  if (found.empty()) return fail(unknown(digits, "begins no id of this base"));
  return found;
}

Result<Case> CaseBase::get(std::string_view id) const {
  const Result<std::uint32_t> entry = impl_->entry(id);
  if (!entry) return fail(entry.error());
  std::vector<std::optional<Case>> c = impl_->log.load(std::span(&*entry, 1));
  if (!c.front()) {
    std::vector<Diagnostic> faults = impl_->log.take_faults();
    return fail(faults.empty() ? unknown(id, "cannot be read") : faults.back());
  }
  return *std::move(c.front());
}

std::vector<CaseBase::LaterVerdict> CaseBase::later_verdicts(std::string_view id) const {
  std::vector<LaterVerdict> out;
  const Result<std::uint32_t> entry = impl_->entry(id);
  if (!entry) return out;
  for (const Note& note : impl_->log.notes()) {
    if (note.entry != *entry) continue;
    const Result<std::optional<Remark>> read = impl_->log.remark(note);
    const Remark remark = read ? read->value_or(Remark{"", "", "(altered: not shown)"})
                               : Remark{"", "", "(not read: " + read.error().message + ")"};
    LaterVerdict said{std::nullopt, remark.by, remark.time_utc, remark.reason};
    if (note.kind == RowKind::kJudgement) said.verdict = note.verdict;
    out.push_back(std::move(said));
  }
  return out;
}

Result<std::vector<Neighbour>> CaseBase::nearest(const Question& q, std::size_t k) const {
  if (const auto wrong = fault_of(q)) return fail("CASE-INVALID", "the question cannot be: " + *wrong);
  return impl_->loaded(impl_->search.nearest(q, k)).found;
}

Result<CaseBase::Look> CaseBase::look(const Question& q, std::size_t k) const {
  if (const auto wrong = fault_of(q)) return fail("CASE-INVALID", "the question cannot be: " + *wrong);
  return impl_->loaded(impl_->search.nearest(q, k));
}

Result<std::vector<Neighbour>> CaseBase::within(const Question& q, double distance) const {
  if (const auto wrong = fault_of(q)) return fail("CASE-INVALID", "the question cannot be: " + *wrong);
  return impl_->loaded(impl_->search.within(q, distance * distance)).found;
}

std::size_t CaseBase::size() const { return impl_->log.live(); }

bool CaseBase::whole() const { return impl_->log.whole(); }

std::vector<CaseBase::Categories> CaseBase::categories() const {
  std::vector<Categories> out;  // by `Entry::categories`, which are numbered as they come
  for (const Entry& e : impl_->log.entries()) {
    tick();
    if (e.categories >= out.size()) out.resize(e.categories + 1);
    Categories& c = out[e.categories];
    if (c.material_group.empty()) {
      const std::string& all = impl_->log.categories(e);
      c.operation = operation_in(all);
      c.material_group = material_group_in(all);
      c.tool_class = tool_class_in(all);
      c.machine_class = machine_class_in(all);
    }
    if (!e.removed) ++c.cases;
  }
  return out;
}

std::vector<Case> CaseBase::cases() const {
  return impl_->live_where([](const Entry&) { return true; });
}

std::vector<Case> CaseBase::cut_with(std::string_view tool_class) const {
  return impl_->live_where([&](const Entry& e) {
    return e.origin != Origin::kSimulated && tool_class_in(impl_->log.categories(e)) == tool_class;
  });
}

namespace {

/// Whether an entry is a measured case of these; an empty name: of any.
bool is_measured_in(const Log& log, const Entry& e, std::string_view material_group,
                    std::string_view machine_class) {
  const std::string& categories = log.categories(e);
  const auto is = [](std::string_view asked, std::string_view there) {
    return asked.empty() || asked == there;
  };
  return e.origin == Origin::kMeasured && is(material_group, material_group_in(categories)) &&
         is(machine_class, machine_class_in(categories));
}

}  // namespace

std::vector<Case> CaseBase::measured_in(std::string_view material_group, std::string_view machine_class,
                                        std::size_t most) const {
  return impl_->live_where(
      [&](const Entry& e) { return is_measured_in(impl_->log, e, material_group, machine_class); }, most);
}

CaseBase::MeasuredState CaseBase::state_of_measured(std::string_view material_group,
                                                    std::string_view machine_class,
                                                    std::string_view with) const {
  Sum all = sum_of(with);
  std::size_t cases = 0;
  for (const Entry& e : impl_->log.entries()) {
    tick();
    if (e.removed || !is_measured_in(impl_->log, e, material_group, machine_class)) continue;
    const std::array<std::uint64_t, 5> said = {e.id.high, e.id.low, e.body.high, e.body.low,
                                               static_cast<std::uint64_t>(e.verdict)};
    const Sum one = sum_of({reinterpret_cast<const char*>(said.data()), sizeof said});
    all.high += one.high;  // in whatever order the rows stand
    all.low += one.low;
    ++cases;
  }
  return {cases, digits_of(all)};
}

std::vector<Diagnostic> CaseBase::take_faults() const { return impl_->log.take_faults(); }

}  // namespace capstan::casebase
