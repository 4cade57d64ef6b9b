#include <algorithm>
#include <cmath>
#include <utility>

#include "casebase/casebase.h"
#include "planner/app/command/session.h"
#include "planner/app/files/inputs.h"
#include "planner/app/files/load.h"
#include "planner/app/files/outputs.h"
#include "planner/app/show/values.h"
#include "planner/late/late.h"
#include "planner/motion/time.h"
#include "planner/pipeline/pipeline.h"
#include "planner/verify/verify.h"

namespace capstan::app {
namespace {

/// Findings of the plan, and of each program made from it; told to the job. Gives their number.
std::size_t verified(const model::Plan& plan, const std::vector<Output>& outputs, Job& job) {
  std::size_t n = 0;
  const auto tell = [&](const std::vector<model::Finding>& findings, const std::string& file, bool program) {
    for (const auto& f : findings) {
      job.report(as_diagnostic(f, file, program));
      if (f.severity != Severity::kNote) ++n;
    }
  };
  tell(verify::check_plan(plan, job), plan.file_name, false);
  std::string table;
  for (const Output& o : outputs) {
    if (o.kind == OutputKind::kToolTable) table = o.bytes;
  }
  for (const Output& o : outputs) {
    if (o.kind != OutputKind::kLinuxCnc) continue;
    tell(verify::check_program({o.path, o.bytes, table}, &plan, plan.machine, plan.cutters, job), o.path,
         true);
  }
  return n;
}

std::string summary_of(const model::Plan& plan, std::size_t findings) {
  std::string out = "planned " + counted(plan.steps.size(), "step", "steps") + " in " +
                    counted(plan.setups.size(), "set-up", "set-ups") + " with " +
                    counted(plan.cutters.size(), "tool", "tools");
  if (const auto t = motion::time_of(plan)) out += ", " + duration(t->total_s());
  const auto loaded = static_cast<std::size_t>(
      std::count_if(plan.cutters.begin(), plan.cutters.end(), [](const auto& c) { return c.loaded; }));
  // Where none is in the magazine, nothing is known of it.
  if (loaded > 0 && loaded < plan.cutters.size())
    out += ", " + std::to_string(plan.cutters.size() - loaded) + " of them to load";
  if (!plan.unplanned.empty())
    out += "; " + counted(plan.unplanned.size(), "feature", "features") + " not planned";
  return out + "; " + counted(findings, "finding", "findings");
}

std::string written_text(const std::vector<Output>& outputs) {
  std::string out;
  for (const Output& o : outputs) {
    if (o.path != "-") out += (out.empty() ? "; wrote " : ", ") + o.path + losses_text(o);
  }
  return out;
}

/// Makes outputs, checks them, writes them: what plan and bind have in common at their end.
int finish(Session& s, const model::Plan& plan, std::vector<Output> outputs) {
  if (plan.steps.empty() && !plan.unplanned.empty()) {
    s.summary = "nothing can be planned, nothing is written";
    return s.end({.code = "APP-IMPOSSIBLE",
                  .message = "none of " + counted(plan.unplanned.size(), "feature", "features") +
                             " can be planned with these tools on this machine",
                  .file = plan.file_name},
                 kImpossible);
  }
  if (auto ok = make(plan, outputs, s.job); !ok) return s.end(ok.error(), kImpossible);
  // What is left open has no path yet, so there is nothing to prove.
  const bool open = s.options.bind != pipeline::Bind::kAll;
  const std::size_t findings = open ? 0 : verified(plan, outputs, s.job);
  s.summary = summary_of(plan, findings);
  const bool clean = findings == 0 && plan.unplanned.empty();
  if (s.options.strict && !clean) {
    s.summary += "; nothing written (--strict)";
    return kFindings;
  }
  if (auto ok = write_all(outputs); !ok) return s.end(ok.error(), kImpossible);
  s.summary += written_text(outputs);
  return clean ? kDone : kFindings;
}

bool makes_program(const std::vector<Output>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const Output& o) { return o.kind == OutputKind::kLinuxCnc; });
}

/// What both are given: outputs that can be, a part, inputs. Gives an exit code when something is missing.
struct Task {
  std::vector<Output> outputs;
  model::Plan part;
  pipeline::Inputs inputs;
};
int prepared(Session& s, const pipeline::Policy& policy, Task& task) {
  auto outputs = outputs_of(s.options.outputs);
  if (!outputs) return s.end(outputs.error(), kUsage);
  task.outputs = *std::move(outputs);
  if (policy.bind != pipeline::Bind::kAll && makes_program(task.outputs)) {
    return s.end({.code = "OUT-OPEN",
                  .message = "a program needs every decision closed",
                  .hint = "leave --bind out, or write .p21 or .json"},
                 kUsage);
  }
  auto part = load_plan(s.options.files[0], s.job);
  if (!part) return s.end(part.error(), kUnreadable);
  task.part = *std::move(part);
  auto inputs = gather(s.options.inputs, task.part, s.job);
  if (!inputs) return s.end(inputs.error(), kUnreadable);
  task.inputs = *std::move(inputs);
  if (s.options.inputs.cases) {
    auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
    if (!base) return s.end(base.error(), kUnreadable);
    task.inputs.cases = std::make_shared<const casebase::CaseBase>(*std::move(base));
    task.inputs.provenance.push_back({"cases", *s.options.inputs.cases, "named by the caller"});
  }
  return kDone;
}

}  // namespace

int run_plan(Session& s) {
  pipeline::Policy policy;
  policy.reopen = s.options.reopen;
  policy.bind = s.options.bind;
  Task task;
  if (const int code = prepared(s, policy, task); code != kDone) return code;
  const auto plan = pipeline::bind(std::move(task.part), task.inputs, policy, s.job);
  if (!plan) return s.end(plan.error(), kImpossible);
  return finish(s, *plan, std::move(task.outputs));
}

int run_bind(Session& s) {
  Task task;
  if (const int code = prepared(s, {}, task); code != kDone) return code;
  // A catalogue says nothing of what is loaded.
  const bool any = std::any_of(task.inputs.library.begin(), task.inputs.library.end(),
                               [](const model::Cutter& c) { return c.loaded; });
  if (!any) {
    return s.end(
        {.code = "APP-MAGAZINE",
         .message = "no cutter of the library is in the magazine",
         .expected = "--tools with the machine's tool table (.tbl), or a list that gives tool numbers"},
        kUsage);
  }
  late::LatePolicy policy;
  if (s.options.deadline) policy.deadline = *s.options.deadline;
  const auto outcome = late::bind(std::move(task.part), std::move(task.inputs), policy, s.job);
  if (!outcome) return s.end(outcome.error(), kImpossible);
  for (const std::string& what : outcome->reopened) s.job.note("LATE-REOPENED", what, "");
  return finish(s, outcome->plan, std::move(task.outputs));
}

}  // namespace capstan::app
