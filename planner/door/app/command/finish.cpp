#include "planner/door/app/command/finish.h"

#include <algorithm>
#include <string>
#include <utility>

#include "planner/door/service/explain/values.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/physics/motion/time.h"

namespace capstan::app {

using service::duration;

namespace {

using service::is_program;
using service::of_program;
using service::Output;

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
  if (!plan.unplanned.empty()) out += "; " + unplanned_text(plan);
  return out + "; " + counted(findings, "finding", "findings");
}

std::string written_text(const std::vector<Output>& outputs) {
  std::string out;
  for (const Output& o : outputs) {
    if (o.path != "-") out += (out.empty() ? "; wrote " : ", ") + o.path + service::losses_text(o);
  }
  return out;
}

/// "step 5 SLOT: ... (and 2 more)": a step's reason says more than one of the whole plan.
std::string why(const model::Plan& plan, const std::vector<model::Condemnation>& condemned) {
  const auto of_step =
      std::find_if(condemned.begin(), condemned.end(), [](const auto& c) { return !c.step.empty(); });
  std::string out = model::text_of(plan, of_step == condemned.end() ? condemned.front() : *of_step);
  if (condemned.size() > 1) out += " (and " + std::to_string(condemned.size() - 1) + " more)";
  return out;
}

/// A program from before, under the name of one that is not written now, must not pass for it: it is put
/// aside. A tool table stays, for it may be the machine's own.
void put_aside(const Output& o, Job& job) {
  if (o.path == "-") return;
  using service::Aside;
  const Aside aside = is_program(o) ? service::set_aside(o.path) : service::left_there(o.path);
  switch (aside.outcome) {
    case Aside::kNothingThere:
      return;
    case Aside::kRenamed:
      return job.warn("APP-BEFORE", "the program " + o.path +
                                        " from before is not of this plan; renamed to " + aside.renamed_to);
    case Aside::kStays:
      return job.warn("APP-BEFORE", o.path + " is from before, not of this plan");
  }
}

/// Takes the programs and their tables out of the outputs, and says so of each.
void withhold(Session& s, const model::Plan& plan, const std::vector<model::Condemnation>& condemned,
              std::vector<Output>& outputs) {
  for (const Output& o : outputs) {
    if (!of_program(o)) continue;
    s.job.report(
        {.code = "APP-WITHHELD",
         .severity = Severity::kError,
         .message =
             (is_program(o) ? "program not written: " : "tool table not written: ") + why(plan, condemned),
         .file = o.path,
         .hint = model::never_written(condemned)
                     ? "correct the file; nobody can tell what its program would be, so that "
                       "--allow-findings does not write it either"
                     : "plan it with other tools, depths or another machine; --allow-findings writes "
                       "it all the same, with a stop before each condemned step"});
    put_aside(o, s.job);
  }
  std::erase_if(outputs, of_program);
}

}  // namespace

void put_programs_aside(const std::vector<Output>& outputs, Job& job) {
  for (const Output& o : outputs) {
    if (of_program(o)) put_aside(o, job);
  }
}

bool makes_program(const std::vector<Output>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(), is_program);
}

int finish(Session& s, const service::Planned& planned, std::vector<Output> outputs) {
  const model::Plan& plan = planned.plan;
  if (plan.steps.empty() && !plan.unplanned.empty()) {
    s.summary = "nothing can be planned, nothing is written";
    return s.end({.code = "APP-IMPOSSIBLE",
                  .message = "none of " + counted(service::unplanned_features(plan), "feature", "features") +
                             " can be planned with these tools on this machine",
                  .file = plan.file_name},
                 kImpossible);
  }
  if (auto ok = service::make(plan, outputs, s.job); !ok) return s.end(ok.error(), kImpossible);
  // What is left open has no path yet, so there is nothing to prove.
  service::Verdict verdict;
  if (!planned.open) {
    auto judgement = service::judge(s.options.inputs, planned, outputs, s.job);
    if (!judgement) return s.end(judgement.error(), kImpossible);
    verdict = *std::move(judgement);
    for (const auto& c : model::contradictions(plan)) {
      s.job.report({.code = "PIP-CONTRADICTED",
                    .severity = Severity::kError,
                    .message = c.why,
                    .file = plan.file_name});
    }
    for (const Told& t : verdict.told) s.job.report(as_diagnostic(t.finding, t.file, t.program));
  }
  s.summary = summary_of(plan, verdict.findings);
  const bool condemned = !verdict.condemned.empty();
  const bool clean =
      verdict.findings == 0 && plan.unplanned.empty() && !condemned && model::unreadable(plan).empty();
  if (s.options.inputs.strict && !clean) {
    put_programs_aside(outputs, s.job);
    s.summary += "; nothing written (--strict)";
    return kFindings;
  }
  std::string verdict_text;
  if (condemned) {
    const bool asked = std::any_of(outputs.begin(), outputs.end(), of_program);
    verdict_text = !asked            ? "; no program can be made of it: "
                   : verdict.written ? "; the program stops before what is condemned: "
                                     : "; program not written: ";
    verdict_text += why(plan, verdict.condemned);
    if (!verdict.written) withhold(s, plan, verdict.condemned, outputs);
  }
  if (auto ok = service::write_all(outputs); !ok) return s.end(ok.error(), kImpossible);
  s.summary += verdict_text + written_text(outputs);
  return clean ? kDone : kFindings;
}

}  // namespace capstan::app
