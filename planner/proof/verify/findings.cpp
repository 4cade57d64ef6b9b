#include "planner/proof/verify/findings.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

void Findings::add(Severity severity, int property, std::string code, Where where, std::string message,
                   double badness, bool unproved) {
  if (tape_ != nullptr) tape_->push_back({severity, property, code, where.move, message, badness, unproved});
  // Recent items are those of the same step: looking back is short.
  for (std::size_t i = items_.size(); i-- > 0;) {
    Item& old = items_[i];
    if (old.order != where.order && i + 64 < items_.size()) break;
    if (old.order != where.order || old.finding.step != where.step || old.finding.property != property ||
        old.finding.code != code) {
      continue;
    }
    ++old.count;
    if (badness > old.badness) {
      old.badness = badness;
      old.finding.move = where.move;
      old.finding.message = std::move(message);
      old.finding.severity = severity;
    }
    return;
  }
  items_.push_back({where.order,
                    badness,
                    1,
                    {.property = property,
                     .code = std::move(code),
                     .severity = severity,
                     .step = std::move(where.step),
                     .move = where.move,
                     .message = std::move(message),
                     .unproved = unproved}});
}

void Findings::error(int property, std::string code, Where where, std::string message, double badness) {
  add(Severity::kError, property, std::move(code), std::move(where), std::move(message), badness);
}
void Findings::warn(int property, std::string code, Where where, std::string message, double badness) {
  add(Severity::kWarning, property, std::move(code), std::move(where), std::move(message), badness);
}
void Findings::note(int property, std::string code, Where where, std::string message) {
  add(Severity::kNote, property, std::move(code), std::move(where), std::move(message), 0.0);
}
void Findings::unproved(Severity severity, int property, std::string code, Where where, std::string message) {
  add(severity, property, std::move(code), std::move(where), std::move(message), 0.0, true);
}

void Findings::repeat(const std::vector<Reported>& said, std::size_t order, const std::string& step) {
  for (const Reported& s : said)
    add(s.severity, s.property, s.code, {order, step, s.move}, s.message, s.badness, s.unproved);
}

std::vector<model::Finding> Findings::take() {
  std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
    return std::tie(a.order, a.finding.property, a.finding.move, a.finding.code) <
           std::tie(b.order, b.finding.property, b.finding.move, b.finding.code);
  });
  std::vector<model::Finding> out;
  for (Item& i : items_) {
    if (i.count > 1)
      i.finding.message += "; the worst of " + std::to_string(i.count) + " like it in this step";
    out.push_back(std::move(i.finding));
  }
  items_.clear();
  return out;
}

model::Finding not_begun() {
  Findings out;
  out.error(11, std::string(kStopped), {Findings::kWhole, "", -1},
            "the check was stopped before it began: nothing is proven");
  return std::move(out.take().front());
}

}  // namespace capstan::verify
