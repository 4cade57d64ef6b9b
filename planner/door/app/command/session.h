#pragma once

#include <string>
#include <vector>

#include "planner/door/app/command/options.h"
#include "planner/door/app/command/run.h"
#include "planner/door/service/ending/repeats.h"
#include "planner/door/service/planning.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

/// State of a command: its options, the job, and the summary for its end.
struct Session {
  explicit Session(Options o);
  Options options;
  Job job;
  std::string summary;  ///< what was done, for the one line at the end
  std::string verdict;  ///< plan, bind, check: that line (service::last_line)

  /// Reports a fault that ends the command, and returns the exit code: that of wrong usage for an unknown
  /// name, wherever it was given.
  int end(const Diagnostic& d, int code);
  /// Whether a finding says what none before it said (service::Repeats). Diagnostics as JSON keep all.
  [[nodiscard]] bool is_new(const service::FileFinding& f);
  int end(const service::Failure& failure) { return end(failure.what, static_cast<int>(failure.code)); }

 private:
  service::Repeats repeats_;
};

/// Prints the job's diagnostics and the summary line on standard error, as `--diagnostics` says.
void print_diagnostics(Session& session, int code);
/// Text for people or programs on standard output. False when it cannot be written; a reader that closes its
/// end early (`| head`) has what it wants.
bool print(const std::string& text);

/// A finding as a diagnostic of the plan or program it is about.
[[nodiscard]] Diagnostic as_diagnostic(const model::Finding& f, const std::string& file, bool program);
using service::FileFinding;
/// Findings as a JSON document; its places are `line` in a program, `move` in a plan.
[[nodiscard]] std::string findings_json(const std::vector<FileFinding>& findings);
/// One diagnostic as a JSON object in a line.
[[nodiscard]] std::string diagnostic_json(const Diagnostic& d);

// The commands. Each gives the exit code.
int run_plan(Session& s);
int run_bind(Session& s);
int run_check(Session& s);
int run_explain(Session& s);
int run_inspect(Session& s);
int run_diff(Session& s);
int run_convert(Session& s);
int run_tools(Session& s);
int run_tools_convert(Session& s);
int run_known(Session& s);
int run_shown(Session& s);
int run_shop_init(Session& s);
int run_shop_show(Session& s);
int run_materials(Session& s);
int run_material(Session& s);
int run_rules(Session& s);
int run_cases_add(Session& s);
int run_cases_list(Session& s);
int run_cases_show(Session& s);
int run_cases_judge(Session& s);
int run_cases_remove(Session& s);
int run_cases_export(Session& s);
int run_cases_metric(Session& s);
int run_cases_nearest(Session& s);
int run_cases_tune(Session& s);
int run_cases_import(Session& s);
int run_cases_trace(Session& s);
int run_cases_report(Session& s);
int run_serve(Session& s);

}  // namespace capstan::app
