#include "rules/engine/table.h"

#include <algorithm>

namespace capstan::rules {

std::optional<double> find(const Parameters& p, std::string_view name) {
  const auto it = std::find_if(p.begin(), p.end(), [&](const auto& pair) { return pair.first == name; });
  if (it == p.end()) return std::nullopt;
  return it->second;
}

const Table* RuleBase::table(std::string_view name) const {
  const auto it = std::find_if(tables.begin(), tables.end(), [&](const Table& t) { return t.name == name; });
  return it == tables.end() ? nullptr : &*it;
}

const Capability* RuleBase::capability(std::string_view action) const {
  const auto it = std::find_if(capabilities.begin(), capabilities.end(),
                               [&](const Capability& c) { return c.action == action; });
  return it == capabilities.end() ? nullptr : &*it;
}

std::optional<std::size_t> missing_fact(const Table& table, const Facts& facts) {
  for (const std::size_t fact : table.facts) {
    const auto v = facts.value(fact);
    if (!v || !holds(domain_of(fact_types()[fact]), *v)) return fact;
  }
  return std::nullopt;
}

const Row* decide(const Table& table, const Facts& facts) {
  for (const Row& row : table.rows) {  // in order of priority
    bool all = true;
    for (std::size_t i = 0; all && i < table.facts.size(); ++i) {
      const auto v = facts.value(table.facts[i]);
      all = v && holds(row.when[i], *v);
    }
    if (all) return &row;
  }
  return nullptr;
}

}  // namespace capstan::rules
