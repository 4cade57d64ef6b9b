#include "planner/door/app/command/finish.h"

#include <algorithm>
#include <string>
#include <utility>

#include "planner/door/service/ending/last_line.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/unreadable.h"

namespace capstan::app {

namespace {

using service::is_program;
using service::of_program;
using service::Output;

/// The files that were written, each with what it cannot hold.
std::vector<std::string> written(const std::vector<Output>& outputs) {
  std::vector<std::string> out;
  for (const Output& o : outputs) {
    if (o.path != "-") out.push_back(o.path + service::losses_text(o));
  }
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
      return job.warn("APP-BEFORE", "the " + std::string(o.format->words) + " " + o.path +
                                        " from before is not of this plan, and stays");
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
         .message = (is_program(o) ? "program not written: " : "tool table not written: ") +
                    model::text_of(plan, condemned),
         .file = o.path,
         .hint = model::never_written(condemned)
                     ? "correct the file; --allow-findings cannot override this"
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

int finish(Session& s, const service::Planned& planned, std::vector<Output> outputs,
           std::optional<std::chrono::steady_clock::time_point> began) {
  const model::Plan& plan = planned.plan;
  service::Ending end{.verb = began ? service::Verb::kBind : service::Verb::kPlan,
                      .open = planned.open,
                      .unread = service::reading_errors(s.job.diagnostics())};
  if (plan.steps.empty() && !plan.unplanned.empty()) {
    return s.end({.code = "APP-IMPOSSIBLE",
                  .message = "none of " + counted(service::unplanned_features(plan), "feature", "features") +
                             " can be planned with these tools on this machine",
                  .file = plan.file_name},
                 kImpossible);
  }
  using service::Reports;
  if (auto ok = service::make(plan, outputs, s.job, planned.part ? &*planned.part : nullptr,
                              planned.open ? Reports::kUnjudged : Reports::kLeftToJudge,
                              service::writing_of(s.options.inputs));
      !ok)
    return s.end(ok.error(), kImpossible);
  // Open decisions have no path yet, so there is nothing to check.
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
    for (const FileFinding& f : verdict.findings) {
      if (s.is_new(f)) s.job.report(as_diagnostic(f.finding, f.file, f.program));
    }
  }
  service::take_plan(planned.part ? *planned.part : plan, end);
  service::take_verdict(plan, verdict, end);
  const bool condemned = !verdict.condemned.empty();
  const bool clean =
      verdict.count == 0 && plan.unplanned.empty() && !condemned && model::unreadable(plan).empty();
  end.strict = s.options.inputs.strict && !clean;
  if (end.strict) {
    put_programs_aside(outputs, s.job);
  } else {
    if (std::any_of(outputs.begin(), outputs.end(), of_program)) {
      end.program = !condemned        ? service::ProgramEnd::kWritten
                    : verdict.written ? service::ProgramEnd::kWithStops
                                      : service::ProgramEnd::kWithheld;
    }
    if (!verdict.written) withhold(s, plan, verdict.condemned, outputs);
    if (auto ok = service::write_all(outputs, s.job); !ok) return s.end(ok.error(), kImpossible);
    end.wrote = written(outputs);
  }
  const auto& deadline = s.options.inputs.deadline;
  end.late = planned.late || (began && deadline && s.job.now() - *began > *deadline);
  s.verdict = service::last_line(end);
  return end.late ? kLate : clean ? kDone : kFindings;
}

}  // namespace capstan::app
