#include "planner/door/service/explain/origins.h"

#include <algorithm>
#include <set>
#include <vector>

#include "planner/door/service/explain/values.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::service {
namespace {

std::set<std::string> step_time_rows(const model::Plan& plan) {
  std::set<std::string> out;
  for (const std::string& id : model::step_ids(plan)) out.insert(step::time_row_of(id));
  return out;
}

}  // namespace

std::string origins_text(const model::Plan& plan) {
  const std::set<std::string> apart = step_time_rows(plan);
  std::vector<std::vector<std::string>> rows;
  for (const model::Provenance& p : plan.provenance)
    if (!apart.contains(p.what)) rows.push_back({p.what, p.value, p.source});
  return rows.empty() ? std::string() : "\nWhere inputs come from\n" + table(rows);
}

bool has_step_times(const model::Plan& plan) {
  const std::set<std::string> rows = step_time_rows(plan);
  return std::any_of(plan.provenance.begin(), plan.provenance.end(),
                     [&](const model::Provenance& p) { return rows.contains(p.what); });
}

std::string told_of_step(const model::Plan& plan, std::string_view row, std::string_view none) {
  const model::Provenance* told = step::row_of(plan, row);
  return told == nullptr ? std::string(none) : told->value;
}

}  // namespace capstan::service
