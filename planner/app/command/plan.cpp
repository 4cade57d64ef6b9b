#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "planner/app/command/session.h"
#include "planner/app/files/inputs.h"
#include "planner/app/files/load.h"
#include "planner/app/files/outputs.h"
#include "planner/app/show/values.h"
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
  if (!plan.unplanned.empty())
    out += "; " + counted(plan.unplanned.size(), "feature", "features") + " not planned";
  return out + "; " + counted(findings, "finding", "findings");
}

std::string written_text(const std::vector<Output>& outputs) {
  std::string out;
  for (const Output& o : outputs) {
    if (o.path != "-") out += (out.empty() ? "; wrote " : ", ") + o.path;
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
  const std::size_t findings = verified(plan, outputs, s.job);
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

/// Reads, plans, finishes.
int planned(Session& s, const pipeline::Policy& policy) {
  auto outputs = outputs_of(s.options.outputs);
  if (!outputs) return s.end(outputs.error(), kUsage);
  if (policy.bind != pipeline::Bind::kAll && makes_program(*outputs)) {
    return s.end({.code = "OUT-OPEN",
                  .message = "a program needs every decision closed",
                  .hint = "leave --bind out, or write .p21 or .json"},
                 kUsage);
  }
  if (s.options.inputs.cases) {
    return s.end({.code = "APP-CASES", .message = "planning from a case base (--cases) is not supported yet"},
                 kUsage);
  }
  auto part = load_plan(s.options.files[0], s.job);
  if (!part) return s.end(part.error(), kUnreadable);
  const auto inputs = gather(s.options.inputs, *part, s.job);
  if (!inputs) return s.end(inputs.error(), kUnreadable);
  if (s.options.deadline) s.job.set_deadline(std::chrono::steady_clock::now() + *s.options.deadline);
  const auto plan = pipeline::bind(*std::move(part), *inputs, policy, s.job);
  if (!plan) return s.end(plan.error(), kImpossible);
  return finish(s, *plan, *std::move(outputs));
}

}  // namespace

int run_plan(Session& s) {
  pipeline::Policy policy;
  policy.reopen = s.options.reopen;
  policy.bind = s.options.bind;
  return planned(s, policy);
}

int run_bind(Session& s) {
  pipeline::Policy policy;
  // A library of a machine's own tool table says what is loaded; a catalogue does not.
  policy.only_loaded_cutters = s.options.inputs.tools.has_value();
  return planned(s, policy);
}

}  // namespace capstan::app
