#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "casebase/casebase.h"
#include "planner/door/app/command/finish.h"
#include "planner/door/app/command/session.h"
#include "planner/door/app/files/inputs.h"
#include "planner/door/app/files/load.h"
#include "planner/door/app/files/outputs.h"
#include "planner/door/late/late.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "rules/engine/check.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/fixtures/fixtures.h"

namespace capstan::app {
namespace {

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
  auto text = read_file(how, tooling::kDataFileCap);
  if (!text && only_a_name(how))
    return unknown_name("fixture", how, tooling::ids_of(*fixtures), tooling::kListFixtures);
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
  auto part = load_plan(s.options.files[0], s.job, s.options.strict);
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

/// Without a list of tools those of the plan are what is loaded, in the plan's own tool numbers.
void take_tools_of_plan(const model::Plan& part, pipeline::Inputs& inputs, Job& job) {
  std::vector<model::Cutter> own;
  for (const model::Cutter& c : part.cutters) {
    if (c.pocket <= 0) continue;
    own.push_back(c);
    own.back().loaded = true;
  }
  if (own.empty()) return;
  job.note("APP-TOOLS", "no --tools: the plan's own " + counted(own.size(), "cutter", "cutters") +
                            " count as loaded, in the plan's tool numbers");
  inputs.provenance.push_back({"tools", "those of the plan", "no --tools is given"});
  inputs.library = std::move(own);
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
  const auto began = s.job.now();
  Task task;
  if (const int code = prepared(s, {}, task); code != kDone) return code;
  if (!s.options.inputs.tools) take_tools_of_plan(task.part, task.inputs, s.job);
  // A catalogue says nothing of what is loaded.
  const bool any = std::any_of(task.inputs.library.begin(), task.inputs.library.end(),
                               [](const model::Cutter& c) { return c.loaded; });
  if (!any) {
    return s.end(
        {.code = "APP-MAGAZINE",
         .message = "no cutter of the library is in the magazine",
         .expected = "--tools with the machine's tool table (.tbl), or a list that gives tool numbers; "
                     "or a plan that holds its cutters"},
        kUsage);
  }
  late::LatePolicy policy;
  policy.deadline = s.options.deadline;
  policy.began = began;
  policy.allow_findings = s.options.allow_findings;
  const auto outcome = late::bind(std::move(task.part), std::move(task.inputs), policy, s.job);
  if (!outcome) return s.end(outcome.error(), kImpossible);
  for (const std::string& what : outcome->reopened) s.job.note("LATE-REOPENED", what, "");
  const int code = finish(s, outcome->plan, std::move(task.outputs), outcome->of_plan);
  // Checking the program and writing it take their time, too.
  const bool late = outcome->late || (policy.deadline && s.job.now() - began > *policy.deadline);
  if (!late || code > kFindings) return code;
  s.summary += "; too late: the deadline was past when the plan was there";
  return kLate;
}

}  // namespace capstan::app
