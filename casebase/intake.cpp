#include "casebase/intake.h"

#include <unordered_map>

#include "casebase/store/log.h"

namespace capstan::casebase {
namespace {

/// Why the base has to be read.
Diagnostic to_be_read() { return {.code = "CASE-DAMAGED", .message = "it has to be read"}; }

/// What one transaction finds of the cases that are to be added.
struct Look {
  std::unordered_map<Id, const Case*, HashId> wanted;
  IdSet there;
  std::int64_t last = 0;                // row that was read
  std::vector<std::int64_t> of_others;  // rows that were read and are none of these cases

  Status take(std::int64_t number, std::string_view bytes) {
    const auto head = head_of(bytes, number);
    if (!head) return fail(to_be_read());
    last = std::max(last, number);
    const auto found = head->kind == RowKind::kCase ? wanted.find(head->id) : wanted.end();
    if (found == wanted.end()) {
      of_others.push_back(number);
      return {};
    }
    if (found->second->observed.verdict != Verdict::kUnknown) return fail(to_be_read());
    there.insert(head->id);
    return {};
  }
  /// Whether the index named no row of another case, and the last row is that of the totals.
  [[nodiscard]] bool fits(std::int64_t rows) const {
    return last == rows && (of_others.empty() || of_others == std::vector{rows});
  }
};

}  // namespace

Intake::Intake(std::unique_ptr<Store> store) : store_(std::move(store)) {}
Intake::Intake(Intake&&) noexcept = default;
Intake& Intake::operator=(Intake&&) noexcept = default;
Intake::~Intake() = default;

Result<Intake> Intake::open_or_create(const std::string& uri, Job& job) {
  Result<std::unique_ptr<Store>> store = open_store(uri, Missing::kCreate, job);
  if (!store) return fail(store.error());
  return Intake(*std::move(store));
}

Result<std::optional<Intake::Added>> Intake::add(std::span<const Case> cases) {
  Result<std::vector<Case>> checked = with_ids(cases);
  if (!checked) return fail(checked.error());
  if (checked->empty()) return std::nullopt;
  Look look;
  std::vector<std::string> ids;
  std::vector<const Case*> once;
  for (const Case& c : *checked) {
    const Id id = *id_of_digits(c.id);
    if (!look.wanted.emplace(id, &c).second) continue;
    ids.push_back(id_bytes_of(id));
    once.push_back(&c);
  }
  Added out;
  const auto take = [&](std::int64_t number, std::string_view head) { return look.take(number, head); };
  const auto decide = [&](const std::string& bytes) -> Result<Store::Appended> {
    const auto stated = stated_of(bytes);
    if (!stated || !stated->held || *stated->held < 0 || !look.fits(stated->totals.rows))
      return fail(to_be_read());
    Store::Appended more;
    Totals after = stated->totals;
    for (const Case* c : once) {
      if (look.there.contains(*id_of_digits(c->id))) continue;
      more.rows.push_back(row_of_case(*c, after.rows + 1));
      after.count(more.rows.back().head);
    }
    if (after.rows > static_cast<std::int64_t>(kMaxCases)) return fail(to_be_read());
    const auto added = static_cast<std::int64_t>(more.rows.size());
    more.totals = bytes_of(after, *stated->held + added);
    out = {more.rows.size(), static_cast<std::size_t>(*stated->held + added)};
    return more;
  };
  const Result<bool> done = store_->append_found(ids, take, decide);
  if (!done && (done.error().code == "CASE-DAMAGED" || done.error().code == "CASE-SCHEMA"))
    return std::nullopt;
  if (!done) return fail(done.error());
  return *done ? std::optional(out) : std::nullopt;
}

std::vector<Diagnostic> Intake::take_faults() { return store_->take_told(); }

}  // namespace capstan::casebase
