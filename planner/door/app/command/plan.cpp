#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "planner/door/app/command/finish.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/check.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/door/service/planning.h"

namespace capstan::app {
namespace {

/// The outputs that can be; gives an exit code when one cannot.
int outputs_for(Session& s, std::vector<service::Output>& outputs) {
  auto named = service::outputs_of(s.options.outputs);
  if (!named) return s.end(named.error(), kUsage);
  outputs = *std::move(named);
  if (s.options.inputs.bind == pipeline::Bind::kAll || !makes_program(outputs)) return kDone;
  return s.end({.code = "OUT-OPEN",
                .message = "a program needs every decision closed",
                .hint = "leave --bind out, or write .p21 or .json"},
               kUsage);
}

/// A file of edits beside the part or an output, by its name, is told where nobody names it: what a plan is
/// made with is what the call names.
void tell_edits_beside(Session& s) {
  const auto& o = s.options;
  if (o.inputs.edits_file) return;
  std::vector<std::string> names = {o.files[0]};
  names.insert(names.end(), o.outputs.begin(), o.outputs.end());
  std::set<std::string> seen(o.outputs.begin(), o.outputs.end());
  for (const std::string& name : names) {
    if (name == "-") continue;
    const std::string beside = std::filesystem::path(name).replace_extension(".edits.yaml").string();
    std::error_code error;
    if (!seen.insert(beside).second || !std::filesystem::is_regular_file(beside, error)) continue;
    s.job.report({.code = "EDIT-BESIDE",
                  .severity = Severity::kNote,
                  .message = "this file of edits lies beside " + name + " and is not used",
                  .file = beside,
                  .hint = "--edits " + beside + " plans with it"});
  }
}

}  // namespace

int run_plan(Session& s) {
  std::vector<service::Output> outputs;
  if (const int code = outputs_for(s, outputs); code != kDone) return code;
  const auto planned = service::plan(s.options.inputs, {s.options.files[0]}, s.job);
  if (!planned) return s.end(planned.error());
  tell_edits_beside(s);
  return finish(s, *planned, std::move(outputs));
}

int run_bind(Session& s) {
  const auto began = s.job.now();
  std::vector<service::Output> outputs;
  if (const int code = outputs_for(s, outputs); code != kDone) return code;
  const auto planned = service::bind(s.options.inputs, {s.options.files[0]}, began, s.job);
  if (!planned) return s.end(planned.error());
  const bool json_there =
      std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return o.path == "-"; });
  const int code = finish(s, *planned, std::move(outputs), began);
  // Standard output is the JSON's where it is asked for.
  if (code <= kFindings && !json_there && !planned->changes.empty()) (void)print(planned->changes);
  return code;
}

int run_check(Session& s) {
  std::vector<service::Source> sources;
  for (const std::string& path : s.options.files) sources.push_back({path});
  const auto tell = [&](const FileFinding& t) {
    if (!s.options.json && s.is_new(t)) s.job.report(as_diagnostic(t.finding, t.file, t.program));
  };
  const auto result = service::check(s.options.inputs, std::move(sources), tell, s.job);
  if (!result) return s.end(result.error());
  if (s.options.json && !print(findings_json(result->findings)))
    return s.end({.code = "FILE-WRITE", .message = "standard output is closed"}, kImpossible);
  service::Ending end{.verb = service::Verb::kCheck};
  service::take_check(*result, end);
  s.verdict = service::last_line(end);
  return result->clean() ? kDone : kFindings;
}

}  // namespace capstan::app
