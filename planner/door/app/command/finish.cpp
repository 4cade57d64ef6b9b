#include "planner/door/app/command/finish.h"

#include <algorithm>
#include <string>
#include <utility>

#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/door/app/show/values.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/physics/motion/time.h"
#include "planner/proof/verify/verify.h"

namespace capstan::app {
namespace {

bool is_program(const Output& o) { return o.kind == OutputKind::kLinuxCnc; }
/// What is withheld with a condemned program: the table is of its tools.
bool of_program(const Output& o) { return is_program(o) || o.kind == OutputKind::kToolTable; }

/// Findings of each program among the outputs.
std::vector<Told> of_programs(const model::Plan& plan, const std::vector<Output>& outputs, Job& job) {
  std::string table;
  for (const Output& o : outputs) {
    if (o.kind == OutputKind::kToolTable) table = o.bytes;
  }
  std::vector<Told> out;
  for (const Output& o : outputs) {
    if (!is_program(o)) continue;
    for (auto& f : verify::check_program({o.path, o.bytes, table}, &plan, plan.machine, plan.cutters, job))
      out.push_back({o.path, std::move(f), true});
  }
  return out;
}

std::vector<model::Finding> plain(const std::vector<Told>& told) {
  std::vector<model::Finding> out;
  for (const Told& t : told) out.push_back(t.finding);
  return out;
}

/// What checking came to.
struct Verdict {
  std::size_t findings = 0;  ///< without notes
  std::vector<model::Condemnation> condemned;
  /// Whether it is written all the same, with its stops: asked for, and known what it is.
  bool written = false;
};

/// Checks the plan and its programs and tells the job. A condemned program that is asked for all the same is
/// written again with its stops, and checked as it then is.
Result<Verdict> judged(Session& s, const model::Plan& plan, const KnownFindings& known,
                       std::vector<Output>& outputs) {
  Verdict v;
  std::vector<Told> told;
  const auto of_plan = known ? *known : verify::check_plan(plan, s.job);
  for (const auto& f : of_plan) told.push_back({plan.file_name, f, false});
  auto of_text = of_programs(plan, outputs, s.job);
  auto all = plain(told);
  for (const Told& t : of_text) all.push_back(t.finding);
  v.condemned = model::condemned(plan, all);
  v.written = v.condemned.empty() || (s.options.allow_findings && !model::never_written(v.condemned));
  if (!v.condemned.empty() && v.written && makes_program(outputs)) {
    Job silent;  // what the writer warns of was said when it wrote the first time
    for (Output& o : outputs) {
      if (!is_program(o)) continue;
      auto text = controls::write_linuxcnc(plan, silent, v.condemned);
      if (!text) return tl::unexpected(text.error());
      o.bytes = *std::move(text);
    }
    of_text = of_programs(plan, outputs, s.job);
  }
  std::move(of_text.begin(), of_text.end(), std::back_inserter(told));
  for (const auto& c : model::contradictions(plan)) {
    s.job.report(
        {.code = "PIP-CONTRADICTED", .severity = Severity::kError, .message = c.why, .file = plan.file_name});
  }
  for (const Told& t : told) {
    s.job.report(as_diagnostic(t.finding, t.file, t.program));
    if (t.finding.severity != Severity::kNote) ++v.findings;
  }
  return v;
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
  if (!plan.unplanned.empty()) out += "; " + unplanned_text(plan);
  return out + "; " + counted(findings, "finding", "findings");
}

std::string written_text(const std::vector<Output>& outputs) {
  std::string out;
  for (const Output& o : outputs) {
    if (o.path != "-") out += (out.empty() ? "; wrote " : ", ") + o.path + losses_text(o);
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
  const Aside aside = is_program(o) ? set_aside(o.path) : left_there(o.path);
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

int finish(Session& s, const model::Plan& plan, std::vector<Output> outputs, const KnownFindings& known) {
  if (plan.steps.empty() && !plan.unplanned.empty()) {
    s.summary = "nothing can be planned, nothing is written";
    return s.end({.code = "APP-IMPOSSIBLE",
                  .message = "none of " + counted(unplanned_features(plan), "feature", "features") +
                             " can be planned with these tools on this machine",
                  .file = plan.file_name},
                 kImpossible);
  }
  if (auto ok = make(plan, outputs, s.job); !ok) return s.end(ok.error(), kImpossible);
  // What is left open has no path yet, so there is nothing to prove.
  const bool open = s.options.bind != pipeline::Bind::kAll;
  Verdict verdict;
  if (!open) {
    auto judgement = judged(s, plan, known, outputs);
    if (!judgement) return s.end(judgement.error(), kImpossible);
    verdict = *std::move(judgement);
  }
  s.summary = summary_of(plan, verdict.findings);
  const bool condemned = !verdict.condemned.empty();
  const bool clean =
      verdict.findings == 0 && plan.unplanned.empty() && !condemned && model::unreadable(plan).empty();
  if (s.options.strict && !clean) {
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
  if (auto ok = write_all(outputs); !ok) return s.end(ok.error(), kImpossible);
  s.summary += verdict_text + written_text(outputs);
  return clean ? kDone : kFindings;
}

}  // namespace capstan::app
