#include "rules/engine/check.h"

#include <algorithm>

namespace capstan::rules {
namespace {

Box domain(const Table& table) {
  Box box;
  for (const std::size_t fact : table.facts) box.push_back(domain_of(fact_types()[fact]));
  return box;
}

void find_gaps(const Table& table, std::vector<RuleFinding>& out) {
  std::vector<Box> left{domain(table)};
  for (const Row& row : table.rows) {
    if (row.conditional) left = subtract(left, row.when);
  }
  for (const Box& box : left)
    out.push_back({RuleFault::kGap, table.name, {}, to_text(box, table.facts), table.file, 0});
}

// What is left of `box` where no row of better priority than `priority` decides.
std::vector<Box> undecided(const Table& table, const Box& box, int priority) {
  std::vector<Box> left{box};
  for (const Row& row : table.rows) {
    if (row.priority >= priority) break;
    left = subtract(left, row.when);
  }
  return left;
}

void find_contradictions(const Table& table, std::vector<RuleFinding>& out) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (std::size_t k = i + 1; k < table.rows.size(); ++k) {
      const Row& a = table.rows[i];
      const Row& b = table.rows[k];
      if (a.priority != b.priority || a.concludes_as(b)) continue;
      const Box both = intersect(a.when, b.when);
      if (empty(both)) continue;
      const auto left = undecided(table, both, a.priority);
      if (left.empty()) continue;
      out.push_back({RuleFault::kContradiction,
                     table.name,
                     {a.id, b.id},
                     to_text(left.front(), table.facts),
                     b.file,
                     b.line});
    }
  }
}

void find_dead_rows(const Table& table, std::vector<RuleFinding>& out) {
  for (const Row& row : table.rows) {
    const Box within = intersect(row.when, domain(table));
    if (!empty(within) && !undecided(table, within, row.priority).empty()) continue;
    out.push_back(
        {RuleFault::kDeadRow, table.name, {row.id}, to_text(row.when, table.facts), row.file, row.line});
  }
}

void find_incapable(const RuleBase& base, const Table& table, std::vector<RuleFinding>& out) {
  const auto grade = find_fact("it_grade");
  const auto at = std::find(table.facts.begin(), table.facts.end(), *grade);
  if (at == table.facts.end()) return;
  const auto side = static_cast<std::size_t>(at - table.facts.begin());
  for (const Row& row : table.rows) {
    for (const auto& chain : row.chains) {
      int best = 99;
      for (const StepSpec& step : chain) {
        if (const Capability* c = base.capability(step.action)) best = std::min(best, c->finest_grade);
      }
      if (row.when[side].from >= best) continue;
      Box box = row.when;
      box[side].below = std::min(box[side].below, static_cast<double>(best));
      out.push_back(
          {RuleFault::kIncapable, table.name, {row.id}, to_text(box, table.facts), row.file, row.line});
      break;
    }
  }
}

}  // namespace

std::string_view to_text(RuleFault f) {
  switch (f) {
    case RuleFault::kGap:
      return "gap";
    case RuleFault::kContradiction:
      return "contradiction";
    case RuleFault::kDeadRow:
      return "dead row";
    case RuleFault::kIncapable:
      return "incapable chain";
  }
  return "?";
}

std::string RuleFinding::text() const {
  std::string ids;
  for (const std::string& id : rows) ids += (ids.empty() ? "" : " and ") + id;
  std::string out = table + ": " + std::string(to_text(fault)) + ": ";
  switch (fault) {
    case RuleFault::kGap:
      return out + "no row for " + box;
    case RuleFault::kContradiction:
      return out + ids + " conclude differently for " + box;
    case RuleFault::kDeadRow:
      return out + ids + " never decides: better rows cover " + box;
    case RuleFault::kIncapable:
      return out + ids + " has a chain that does not hold " + box;
  }
  return out;
}

std::vector<RuleFinding> check(const RuleBase& base) {
  std::vector<RuleFinding> out;
  for (const Table& table : base.tables) {
    find_gaps(table, out);
    find_contradictions(table, out);
    find_dead_rows(table, out);
    find_incapable(base, table, out);
  }
  return out;
}

}  // namespace capstan::rules
