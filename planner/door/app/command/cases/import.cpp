#include "casebase/retain/join/import.h"

#include <fstream>
#include <utility>

#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/reading.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"

// `capstan cases import`: logs of machines as cases. All cases of all logs are kept, or none.

namespace capstan::app {

namespace retain = casebase::retain;

Result<PlannedSteps> read_steps(const std::string& path, Job& job) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  PlannedSteps out;
  const service::Content content = service::content_of(*bytes);
  if (content == service::Content::kPlanJson || content == service::Content::kPart) {
    auto plan = service::read_plan(*std::move(bytes), path, job);
    if (!plan) return tl::unexpected(plan.error());
    out.steps = retain::steps_of(*plan, job);
    out.plan = *std::move(plan);
    return out;
  }
  auto steps = retain::read_sheet(*bytes, path);
  if (!steps) return tl::unexpected(steps.error());
  out.steps = *std::move(steps);
  return out;
}

Result<retain::ProgramMarks> read_marks(const std::string& path, const PlannedSteps& planned) {
  const auto program = read_file(path);
  if (!program) return tl::unexpected(program.error());
  retain::ProgramMarks marks = retain::program_marks(*program);
  if (!planned.plan) {
    return fail(Diagnostic{.code = "LOG-PROGRAM",
                           .message = "a sheet's program has no markers of a plan",
                           .file = path,
                           .expected = "--program with a plan alone"});
  }
  if (auto ok = retain::match(marks, *planned.plan, path); !ok) return tl::unexpected(ok.error());
  return marks;
}

namespace {

Diagnostic wrong_usage(std::string message, std::string expected) {
  return {.code = "USAGE-IMPORT", .message = std::move(message), .expected = std::move(expected)};
}

// Units of a log that says none: of an inch machine, feeds are in the format's own unit of time.
retain::LogUnits inches(retain::LogFormat format) {
  return format == retain::LogFormat::kTrace
             ? retain::LogUnits{kMmPerInch * retain::kTraceUnits.mm, kMmPerInch * retain::kTraceUnits.mm_min}
             : retain::LogUnits{kMmPerInch, kMmPerInch};
}

}  // namespace

int run_cases_import(Session& s) {
  const LogImport& asked = s.options.log;
  const auto format = retain::log_format_of(asked.format);
  if (!format) {
    return s.end(
        wrong_usage("'" + asked.format + "' is no format of a log", std::string(retain::kLogFormats)),
        kUsage);
  }
  if (!asked.parts.empty() && asked.parts.size() != s.options.files.size()) {
    return s.end(wrong_usage(counted(asked.parts.size(), "part", "parts") + " for " +
                                 counted(s.options.files.size(), "log", "logs"),
                             "--part once per log, or not at all"),
                 kUsage);
  }
  retain::ImportOptions options{.columns = asked.columns, .period_s = asked.period_s};
  if (asked.unit == "inch") options.units = inches(*format);
  for (const std::string& text : asked.triggers) {
    const auto trigger = retain::trigger_of(text);
    if (!trigger) {
      return s.end(wrong_usage("--trigger " + text + " is none", "e.g. lag_mm>0.05 or load_percent>90:0.5"),
                   kUsage);
    }
    options.triggers.push_back(*trigger);
  }
  const auto planned = read_steps(asked.plan, s.job);
  if (!planned) return s.end(planned.error(), kUnreadable);
  std::optional<retain::ProgramMarks> marks;
  if (!asked.program.empty()) {
    auto read = read_marks(asked.program, *planned);
    if (!read) return s.end(read.error(), kUnreadable);
    marks = *std::move(read);
    options.marks = &*marks;
  }
  if (!asked.inspection.empty()) {
    const auto bytes = read_file(asked.inspection);
    if (!bytes) return s.end(bytes.error(), kUnreadable);
    auto rows =
        retain::read_inspection(*bytes, asked.inspection, asked.unit == "inch" ? kMmPerInch : 1.0, s.job);
    if (!rows) return s.end(rows.error(), kUnreadable);
    options.inspection = *std::move(rows);
  }
  std::vector<casebase::Case> cases;
  for (std::size_t i = 0; i < s.options.files.size(); ++i) {
    const std::string& path = s.options.files[i];
    std::ifstream in(path, std::ios::binary);
    if (!in) {
      return s.end(
          Diagnostic{.code = "FILE-READ", .message = "the file cannot be opened for reading", .file = path},
          kUnreadable);
    }
    const retain::LogFrom from{.part = asked.parts.empty() ? "" : asked.parts[i],
                               .machine = asked.machine,
                               .file = path,
                               .inspection = asked.inspection};
    auto more = retain::import_log(in, *format, planned->steps, from, options, s.job);
    if (!more) return s.end(more.error(), kUnreadable);
    cases.insert(cases.end(), more->begin(), more->end());
  }
  auto base = casebase::CaseBase::open_or_create(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::size_t before = base->size();
  if (auto ok = base->add(cases); !ok) return s.end(ok.error(), kImpossible);
  report_faults(s, *base);
  s.summary = counted(s.options.files.size(), "log", "logs") + ": " + counted(cases.size(), "case", "cases") +
              ", " + std::to_string(base->size() - before) + " of them new; the base holds " +
              counted(base->size(), "case", "cases");
  return kDone;
}

}  // namespace capstan::app
