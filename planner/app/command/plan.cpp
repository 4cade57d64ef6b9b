#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "casebase/casebase.h"
#include "planner/app/command/session.h"
#include "planner/app/files/inputs.h"
#include "planner/app/files/load.h"
#include "planner/app/files/outputs.h"
#include "planner/app/show/values.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/late/late.h"
#include "planner/motion/time.h"
#include "planner/pipeline/pipeline.h"
#include "planner/verify/verify.h"
#include "rules/engine/check.h"
#include "tooling/holding/holding.h"

namespace capstan::app {
namespace {

/// Findings of the plan, which may be known already, and of each program made from it; told to the job. Gives
/// their number.
std::size_t verified(const model::Plan& plan, const std::optional<std::vector<model::Finding>>& known,
                     const std::vector<Output>& outputs, Job& job) {
  std::size_t n = 0;
  const auto tell = [&](const std::vector<model::Finding>& findings, const std::string& file, bool program) {
    for (const auto& f : findings) {
      job.report(as_diagnostic(f, file, program));
      if (f.severity != Severity::kNote) ++n;
    }
  };
  tell(known ? *known : verify::check_plan(plan, job), plan.file_name, false);
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
int finish(Session& s, const model::Plan& plan, std::vector<Output> outputs,
           const std::optional<std::vector<model::Finding>>& known = std::nullopt) {
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
  const std::size_t findings = open ? 0 : verified(plan, known, outputs, s.job);
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

/// What a shop's own tables lack or say twice: planning goes on, for the rows that do decide are sound.
void judge_rules(const rules::RuleBase& base, Job& job) {
  constexpr std::size_t kMostTold = 10;
  const auto findings = rules::check(base);
  for (std::size_t i = 0; i < std::min(kMostTold, findings.size()); ++i) {
    const auto& f = findings[i];
    job.report({.code = std::string(rules::code_of(f.fault)),
                .severity = Severity::kWarning,
                .message = f.text(),
                .file = f.file,
                .line = f.line});
  }
  if (findings.size() > kMostTold)
    job.warn("RULE-MORE", std::to_string(findings.size() - kMostTold) +
                              " further findings in the rules; capstan rules check --rules shows them all");
}

/// Why edges cannot be broken so wide, with the widths that the tables know; nothing when they can.
std::optional<Diagnostic> edges_wrong(const pipeline::Inputs& in) {
  const double width = in.edge_break_mm;
  const rules::Table* table = in.rules.table("edge_break");
  const auto fact = rules::find_fact("edge_break_mm");
  if (!(width > 0.0) || table == nullptr || !fact) return std::nullopt;
  const auto at = std::find(table->facts.begin(), table->facts.end(), *fact);
  if (at == table->facts.end()) return std::nullopt;
  const auto side = static_cast<std::size_t>(at - table->facts.begin());
  std::string ranges;
  for (const rules::Row& row : table->rows) {
    if (row.chains.empty()) continue;
    const rules::Side& s = row.when[side];
    if (rules::holds(s, width)) return std::nullopt;
    const std::string range = "from " + trimmed(s.from, 3) + " to below " + trimmed(s.below, 3) + " mm";
    if (ranges.find(range) == std::string::npos) ranges += (ranges.empty() ? "" : ", ") + range;
  }
  return Diagnostic{.code = "APP-EDGES",
                    .message = "--edges " + trimmed(width, 4) + ": no rule breaks edges so wide",
                    .expected = "0 for none, or a width " + (ranges.empty() ? "that rules know" : ranges)};
}

/// Reads what holds the piece before anything is planned: a file that cannot be read is no failure of
/// planning.
std::optional<Diagnostic> holding_wrong(const std::string& how, Job& job) {
  if (how == "auto" || how == "none") return std::nullopt;
  auto fixtures = tooling::shipped_fixtures(job);
  if (!fixtures || tooling::find_fixture(*fixtures, how) != nullptr) return std::nullopt;
  auto text = read_file(how);
  if (!text) {
    text.error().hint = "workholding is auto, none, the id of a fixture, or a file";
    return text.error();
  }
  Job silent;  // what there is to say of it is said when it is used
  auto file = tooling::read_holding(*text, how, silent);
  if (file) return std::nullopt;
  for (const Diagnostic& d : silent.diagnostics()) {
    if (!(d == file.error())) job.report(d);
  }
  return file.error();
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
  if (const auto wrong = edges_wrong(task.inputs)) return s.end(*wrong, kUsage);
  if (s.options.inputs.rules) judge_rules(task.inputs.rules, s.job);
  if (s.options.inputs.workholding) {
    if (const auto wrong = holding_wrong(*s.options.inputs.workholding, s.job))
      return s.end(*wrong, kUnreadable);
  }
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
  const auto bound = pipeline::bind_checked(task.part, task.inputs, policy, s.job);
  if (!bound) return s.end(bound.error(), kImpossible);
  return finish(s, bound->plan, std::move(task.outputs), bound->findings);
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
