#include "planner/door/pipeline/program_check.h"

#include <iterator>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/controls/suitability.h"
#include "planner/proof/verify/verify.h"

namespace capstan::pipeline {

std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job) {
  return findings_of(checked(plan, job), job);
}

std::vector<model::Finding> findings_of(const Checked& checked, Job& job, CheckedProgram* kept,
                                        memo::Memo* proofs, const model::CutBefore* before) {
  const model::Plan& plan = checked.plan;
  std::vector<model::Finding> out = checked.findings;
  if (plan.steps.empty()) return out;
  auto unsuited = controls::suitability(plan);
  std::move(unsuited.begin(), unsuited.end(), std::back_inserter(out));
  const auto program = controls::write_program(plan, job);
  if (!program) {
    model::Finding f;
    f.property = 33;
    f.code = program.error().code;
    f.message = program.error().message;
    out.push_back(std::move(f));
    return out;
  }
  const verify::ProgramText text{"program", *program, controls::tool_table_of(plan)};
  auto more =
      verify::check_program(text, &plan, plan.machine, plan.cutters, job, proofs, before, checked.part.get());
  out.insert(out.end(), more.begin(), more.end());
  if (kept != nullptr) *kept = {text.text, text.tool_table, std::move(more)};
  return out;
}

}  // namespace capstan::pipeline
