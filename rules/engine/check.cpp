#include "rules/engine/check.h"

#include <algorithm>

#include "planner/ground/vocabulary/shape_kind.h"

namespace capstan::rules {
namespace {

// Share of a chain's error of position that is left when the program stops before the last step, it is
// measured, and the operator corrects the work offset. Nothing in a program corrects by itself. Default,
// unsourced.
constexpr double kProbed = 0.5;
constexpr double kCoarsest = 19.0;  // beyond IT18: a demand that asks for no grade

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

// The part of `box` in which no row of better priority than `priority` decides.
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

/// What a chain holds: the best that any of its steps claims; unset: no step claims anything.
struct Holds {
  std::optional<double> grade, ra_um, position_mm, form_mm;
};

template <class T>
void better(std::optional<double>& best, const std::optional<T>& claimed) {
  if (claimed) best = std::min(best.value_or(1e9), static_cast<double>(*claimed));
}

Holds held_by(const RuleBase& base, const std::vector<StepSpec>& chain) {
  Holds out;
  for (const StepSpec& step : chain) {
    const Capability* c = base.capability(step.action);
    if (c == nullptr) continue;
    better(out.grade, c->finest_grade);
    better(out.ra_um, c->finest_ra_um);
    better(out.position_mm, c->position_mm);
    better(out.form_mm, c->form_mm);
  }
  return out;
}

std::optional<std::size_t> side_of(const Table& table, std::string_view fact) {
  const auto index = find_fact(fact);
  const auto at = std::find(table.facts.begin(), table.facts.end(), *index);
  if (at == table.facts.end()) return std::nullopt;
  return static_cast<std::size_t>(at - table.facts.begin());
}

bool allows(const Table& table, const Row& row, std::string_view fact, std::string_view symbol) {
  const auto side = side_of(table, fact);
  if (!side) return true;
  const auto& symbols = fact_types()[table.facts[*side]].symbols;
  const auto at = std::find(symbols.begin(), symbols.end(), symbol) - symbols.begin();
  return holds(row.when[*side], static_cast<double>(at));
}

void incapable(const Table& table, const Row& row, std::string box, std::vector<RuleFinding>& out) {
  out.push_back({RuleFault::kIncapable, table.name, {row.id}, std::move(box), row.file, row.line});
}

// The grade that a row accepts.
bool holds_grade(const Table& table, const Row& row, const Holds& chain, std::vector<RuleFinding>& out) {
  const auto side = side_of(table, "it_grade");
  if (!side || !chain.grade || row.when[*side].from >= *chain.grade) return true;
  Box box = row.when;
  box[*side].below = std::min(box[*side].below, *chain.grade);
  incapable(table, row, to_text(box, table.facts), out);
  return false;
}

/// One kind of demand: its table, the fact in it, and what a chain holds of it.
struct DemandKind {
  std::string_view table, fact;
  std::optional<double> Holds::*held;
};
constexpr DemandKind kDemands[] = {{"texture", "ra_um", &Holds::ra_um},
                                   {"position", "position_mm", &Holds::position_mm},
                                   {"form", "form_mm", &Holds::form_mm}};

// Whether a demand's row lets features of this shape come to this row: then with a grade of as_grade or
// finer, and without a reamer where the wall must be machined.
bool leads_to(const Table& table, const Row& row, const Table& demands, const Row& demand,
              std::string_view shape) {
  if (!demand.cannot.empty() || !allows(demands, demand, "shape", shape)) return false;
  const auto grade = side_of(table, "it_grade");
  if (grade && find(demand.values, "as_grade").value_or(kCoarsest) < row.when[*grade].from) return false;
  const bool machined = find(demand.values, "machined").value_or(0.0) > 0.0;
  if (machined && !allows(table, row, "reamer", "none")) return false;
  const bool sunk =
      allows(table, row, "taper", "countersink") || allows(table, row, "taper", "countersink_below");
  const bool straight = allows(table, row, "taper", "none") || allows(table, row, "taper", "other");
  return table.name != "hole" || (shape == "countersink" ? sunk : straight);
}

// Narrows the demand's box, in the facts that both tables use, to the values that the row accepts.
void narrow_to(const Table& table, const Row& row, const Table& demands, Box& box) {
  for (std::size_t i = 0; i < demands.facts.size(); ++i) {
    const auto at = std::find(table.facts.begin(), table.facts.end(), demands.facts[i]);
    if (at != table.facts.end())
      box[i] = intersect(box[i], row.when[static_cast<std::size_t>(at - table.facts.begin())]);
  }
}

// True if the chain holds what the demand's row accepts, where no row of better priority decides.
bool holds_demand(const RuleBase& base, const Table& table, const Row& row, const DemandKind& kind,
                  std::string_view shape, const Holds& chain, std::vector<RuleFinding>& out) {
  const Table* demands = base.table(kind.table);
  if (demands == nullptr || !(chain.*kind.held)) return true;
  const auto side = side_of(*demands, kind.fact);
  if (!side) return true;
  const Capability* probe = base.capability("probe_feature");
  for (const Row& demand : demands->rows) {
    if (!leads_to(table, row, *demands, demand, shape)) continue;
    double least = *(chain.*kind.held);
    if (kind.held == &Holds::position_mm && find(demand.values, "probe").value_or(0.0) > 0.0 &&
        probe != nullptr && probe->position_mm)
      least = std::min(least, std::max(*probe->position_mm, kProbed * least));
    for (Box box : undecided(*demands, demand.when, demand.priority)) {
      narrow_to(table, row, *demands, box);
      if (empty(box) || !(box[*side].from < least)) continue;
      box[*side].below = std::min(box[*side].below, least);
      incapable(table, row, to_text(box, demands->facts) + " (accepted by " + demand.id + ")", out);
      return false;
    }
  }
  return true;
}

void find_incapable(const RuleBase& base, const Table& table, std::vector<RuleFinding>& out) {
  for (const Row& row : table.rows) {
    for (const auto& steps : row.chains) {
      const Holds chain = held_by(base, steps);
      bool good = holds_grade(table, row, chain, out);
      for (const ShapeTable& pair : shape_tables()) {
        if (pair.table != table.name) continue;
        for (const DemandKind& kind : kDemands)
          good = good && holds_demand(base, table, row, kind, pair.shape, chain, out);
      }
      if (!good) break;
    }
  }
}

void find_missing_tables(const RuleBase& base, std::vector<RuleFinding>& out) {
  for (const ShapeTable& pair : shape_tables()) {
    if (base.table(pair.table) != nullptr) continue;
    out.push_back({RuleFault::kNoTable,
                   std::string(pair.table),
                   {},
                   "shape in {" + std::string(pair.shape) + "}",
                   "",
                   0});
  }
  for (const std::string_view name :
       {"texture", "position", "form", "coolant", "drill_depth", "ream_stock", "edge_break"}) {
    if (base.table(name) == nullptr)
      out.push_back({RuleFault::kNoTable, std::string(name), {}, "every feature", "", 0});
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
    case RuleFault::kNoTable:
      return "no table";
  }
  return "?";
}

std::string_view code_of(RuleFault f) {
  switch (f) {
    case RuleFault::kGap:
      return "RULE-GAP";
    case RuleFault::kContradiction:
      return "RULE-CONTRADICTION";
    case RuleFault::kDeadRow:
      return "RULE-DEAD-ROW";
    case RuleFault::kIncapable:
      return "RULE-INCAPABLE";
    case RuleFault::kNoTable:
      return "RULE-NO-TABLE";
  }
  return "RULE";
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
    case RuleFault::kNoTable:
      return out + "nothing speaks of " + box;
  }
  return out;
}

const std::vector<ShapeTable>& shape_tables() {
  static const std::vector<ShapeTable> kTables = [] {
    std::vector<ShapeTable> out;
    for (const model::ShapeKindRow& r : model::shape_kinds()) {
      out.push_back({r.name, r.name});
      if (r.value == model::ShapeKind::kHole) out.push_back({"countersink", r.name});
    }
    return out;
  }();
  return kTables;
}

std::vector<RuleFinding> check_tables(const RuleBase& base) {
  std::vector<RuleFinding> out;
  for (const Table& table : base.tables) {
    find_gaps(table, out);
    find_contradictions(table, out);
    find_dead_rows(table, out);
    find_incapable(base, table, out);
  }
  return out;
}

std::vector<RuleFinding> check(const RuleBase& base) {
  std::vector<RuleFinding> out;
  find_missing_tables(base, out);
  const auto found = check_tables(base);
  out.insert(out.end(), found.begin(), found.end());
  return out;
}

}  // namespace capstan::rules
