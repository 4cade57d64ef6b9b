#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

int run_cases_metric(Session& s) {
  auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const auto metric = s.options.learn ? base->learn_metric() : Result<casebase::Metric>(base->metric());
  if (!metric) return s.end(metric.error(), kImpossible);
  report_faults(s, *base);
  std::vector<std::vector<std::string>> rows = {{"number", "weight"}};
  for (std::size_t i = 0; i < casebase::kDimensions; ++i)
    rows.push_back({std::string(casebase::dimension_name(i)), trimmed(metric->weight[i], 3)});
  s.summary = metric->cases == 0
                  ? "the fixed scales; none was learned"
                  : "learned from " + counted(metric->cases, "case", "cases") + " that went well";
  return print(service::table(rows, "")) ? kDone : kImpossible;
}

}  // namespace capstan::app
