#include "rules/facts/demand.h"

#include <algorithm>

namespace capstan::rules {
namespace {

// "Ra 0.8: reamed or bored [texture.hole.fine; source]"
std::string said_by(const Table& table, const Row& row, const Facts& facts) {
  std::string out;
  for (const std::size_t fact : table.facts) {
    if (fact_types()[fact].name != "shape" && fact_types()[fact].name != "probe")
      out = facts.text(fact) + ": ";
  }
  return out + (row.text.empty() ? "heeded" : row.text) + " [" + row.id + "; " + row.source + "]";
}

void narrow(FeatureFacts& known, const Row& row, bool& asks) {
  const double as_grade = find(row.values, "as_grade").value_or(kNoGrade);
  const auto grade = known.facts.number("it_grade");
  asks = as_grade < kNoGrade || find(row.values, "machined").value_or(0.0) > 0.0;
  if (grade && as_grade < *grade) known.facts.set("it_grade", as_grade);
  if (find(row.values, "machined").value_or(0.0) > 0.0 && !known.facts.symbol("reamer").empty())
    known.facts.set("reamer", "none");
}

}  // namespace

Demand apply_demands(const RuleBase& base, FeatureFacts& known) {
  Demand out;
  for (const std::string_view name : kDemandTables) {
    const Table* table = base.table(name);
    if (table == nullptr) continue;
    if (const auto fact = missing_fact(*table, known.facts)) {
      out.cannot = "table " + std::string(name) + " does not speak of " + known.facts.text(*fact);
      return out;
    }
    const Row* row = decide(*table, known.facts);
    if (row == nullptr) {
      out.cannot = "no row of table " + std::string(name) + " holds";
      return out;
    }
    if (!row->cannot.empty()) {
      out.cannot = row->cannot + " [" + row->id + "]";
      return out;
    }
    bool asks = false;
    narrow(known, *row, asks);
    if (find(row->values, "probe").value_or(0.0) > 0.0) {
      out.probe = row;
      asks = true;
    }
    if (asks) out.text += (out.text.empty() ? "" : "; ") + said_by(*table, *row, known.facts);
  }
  return out;
}

}  // namespace capstan::rules
