#include <memory>

#include "planner/ground/base/stopping.h"
#include "planner/model/plan/range/positions.h"
#include "planner/proof/verify/compared/feature_readings.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/plan/setups.h"
#include "planner/proof/verify/stopped.h"
#include "planner/proof/verify/sweep/sweep.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

namespace {

/// False if a stop ended it and the finding says where.
bool judge(const model::Plan& plan, Findings& findings, Job& job, memo::Memo* known, const CutBefore* before,
           std::shared_ptr<const ReadPart>* kept) {
  const std::vector<StepMoves> steps = moves_of(plan, findings);
  poll();
  check_ranges(plan, findings);
  check_twice(plan, findings);
  if (const std::string beyond = model::beyond_range(plan); !beyond.empty()) {
    findings.error(1, "CHK-RANGE", {Findings::kWhole, "", -1},
                   beyond +
                       ": nothing can be computed with it, and nothing else is checked: correct it in "
                       "the plan's file");
    return true;
  }
  poll();
  check_tools(plan, steps, findings);
  check_tool_materials(plan, findings);
  check_limits(plan, steps, findings);
  poll();
  check_coolant(plan, steps, findings);
  check_life(steps, findings);
  check_sisters(plan, findings);
  check_machine(plan, findings);
  check_holding(plan, findings);
  poll();
  const auto read = std::make_shared<const ReadPart>(read_part(plan, known != nullptr));
  const PartShapes& part = read->shapes;
  if (kept != nullptr) *kept = read;
  poll();
  check_order(plan, part, findings, before);
  check_coverage(plan, findings, before);
  poll();
  check_meaning(plan, findings, before != nullptr, known);
  poll();
  check_setups(plan, part, findings);
  poll();
  check_within(plan, part, findings);
  check_threads(plan, part, steps, findings);
  poll();
  std::vector<double> speed_shares;
  const bool swept = check_removal(plan, *read, steps, findings, job, &speed_shares, known, before);
  check_predicted(plan, part, steps, speed_shares, findings);
  if (!swept) return false;
  job.progress("check", 1.0);
  return true;
}

}  // namespace

std::vector<model::Finding> check_plan(const model::Plan& plan, Job& job, memo::Memo* known,
                                       const CutBefore* before, std::shared_ptr<const ReadPart>* part) {
  Findings findings;
  check_to_its_end(job, findings, [&] { return judge(plan, findings, job, known, before, part); });
  return findings.take();
}

}  // namespace capstan::verify
