#include "planner/door/late/measured_names.h"

#include <set>
#include <string>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/model/nouns/all.h"

namespace capstan::late {
namespace {

using model::AnyRef;

constexpr std::size_t kMostTold = 10;  // names in a message; default, unsourced

}  // namespace

Status only_read(const model::Plan& plan, const Measured& measured) {
  if (measured.empty()) return {};
  const model::Model& m = plan.model;
  std::set<std::string> read;
  for (const AnyRef r : m.all_below(model::TypeId::kComparisonExpression)) {
    const auto& c = m.at<model::ComparisonExpression>(r);
    for (const AnyRef side : {AnyRef(c.operand1), AnyRef(c.operand2)}) {
      const auto* v = m.get<model::NcVariable>(side);
      if (v != nullptr && !v->its_name.value_or("").empty()) read.insert(*v->its_name);
    }
  }
  for (const auto& [name, value] : measured) {
    if (read.contains(name)) continue;
    Diagnostic d = unknown_name("measured variable", name, {read.begin(), read.end()}, "");
    d.file = plan.file_name;
    d.hint = "no if or while statement of the plan reads a variable";
    std::size_t told = 0;
    for (const std::string& known : read) {
      if (++told > kMostTold) break;
      d.hint = (told == 1 ? "the statements of the plan read " : d.hint + ", ") + known;
    }
    return fail(std::move(d));
  }
  return {};
}

}  // namespace capstan::late
