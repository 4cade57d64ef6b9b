#include "planner/door/service/ending/reporting.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "casebase/planned.h"
#include "casebase/record/sha256.h"
#include "planner/door/report/report.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/door/service/explain/explain.h"
#include "planner/ground/base/file.h"

namespace capstan::service {
namespace {

/// What the plan says of itself.
report::About explained(const model::Plan& plan) {
  report::About out;
  out.explained = explain(plan);
  for (std::size_t n = 1; n <= plan.steps.size(); ++n)
    out.explained_steps.push_back(explain(plan, std::to_string(n)).value_or(std::string()));
  out.marks.emplace_back("plan", casebase::plan_hash_of(plan));
  return out;
}

/// Of the files among the inputs, under the names of their rows of provenance.
void add_files(const Request& request, report::About& about) {
  using Row = std::pair<std::string_view, const std::optional<std::string>*>;
  for (const auto& [what, named] :
       {Row{"machine", &request.machine}, Row{"tools", &request.tools}, Row{"material", &request.material},
        Row{"rules", &request.rules}, Row{"workholding", &request.workholding}}) {
    std::error_code ignored;
    if (!*named || !std::filesystem::path(**named).has_extension() ||
        !std::filesystem::is_regular_file(**named, ignored))
      continue;  // a name of what is built in, or several
    if (const auto bytes = read_file(**named))
      about.hashes.emplace_back(std::string(what), casebase::sha256(*bytes));
  }
}

}  // namespace

std::string report_of(const Request& request, const Planned& planned, const Verdict& verdict,
                      const std::vector<Output>& outputs, const Job& job) {
  const model::Plan& plan = planned.part ? *planned.part : planned.plan;
  report::About about = explained(plan);
  Ending end{.verb = Verb::kPlan,
             .late = planned.late,
             .open = planned.open,
             .unread = reading_errors(job.diagnostics())};
  take_plan(plan, end);
  take_verdict(plan, verdict, end);
  about.verdict = last_line(end);
  about.judged = !verdict.condemned.empty() ? report::Judged::kNotSafe
                 : calls_safe(end)          ? report::Judged::kSafe
                                            : report::Judged::kNotChecked;
  for (const model::Condemnation& c : verdict.condemned) about.condemned.push_back(model::text_of(plan, c));
  for (const FileFinding& f : verdict.findings) about.findings.push_back({f.file, f.program, f.finding});
  for (const Diagnostic& d : job.diagnostics())
    if (d.severity != Severity::kNote) about.told.push_back(d);
  const auto program = std::find_if(outputs.begin(), outputs.end(), is_program);
  if (program != outputs.end() && verdict.written) {
    about.program_name = program->path;
    about.program = program->bytes;
    about.marks.emplace_back("program", casebase::sha256(program->bytes));
  }
  if (!planned.brought_sha256.empty()) about.hashes.emplace_back(report::kPart, planned.brought_sha256);
  add_files(request, about);
  return report::html(plan, about);
}

std::string report_of(const model::Plan& plan) {
  report::About about = explained(plan);
  about.verdict = "Not checked: this report was made from a plan, without the check";
  return report::html(plan, about);
}

}  // namespace capstan::service
