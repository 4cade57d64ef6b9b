#include "planner/door/service/logs/import_logs.h"

#include <fstream>
#include <utility>

#include "casebase/retain/join/import.h"
#include "casebase/retain/join/seen.h"
#include "planner/door/service/reading.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::service {

namespace retain = casebase::retain;

Result<PlannedSteps> read_steps(const std::string& path, Job& job) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  PlannedSteps out;
  const Content content = content_of(*bytes);
  if (content == Content::kPlanJson || content == Content::kPart) {
    auto plan = read_plan(*std::move(bytes), path, job);
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

auto wrong_usage(std::string message, std::string expected) {
  return failed({.code = "USAGE-IMPORT", .message = std::move(message), .expected = std::move(expected)},
                Code::kUsage);
}
auto unreadable(const Diagnostic& what) { return failed(what, Code::kUnreadable); }

// Units of a log that says none: of an inch machine, feeds are in the format's own unit of time.
retain::LogUnits inches(retain::LogFormat format) {
  return format == retain::LogFormat::kTrace
             ? retain::LogUnits{kMmPerInch * retain::kTraceUnits.mm, kMmPerInch * retain::kTraceUnits.mm_min}
             : retain::LogUnits{kMmPerInch, kMmPerInch};
}

// What the words of the caller mean, files left alone.
Outcome<retain::ImportOptions> options_of(const LogImport& asked, retain::LogFormat format) {
  if (!(asked.period_s >= kLeastPeriodS && asked.period_s <= kMostPeriodS))
    return wrong_usage("the period of " + shortest(asked.period_s) + " s is none",
                       shortest(kLeastPeriodS) + " to " + shortest(kMostPeriodS) + " s");
  retain::ImportOptions options{.columns = asked.columns, .period_s = asked.period_s};
  if (asked.unit == "inch") {
    options.units = inches(format);
  } else if (!asked.unit.empty() && asked.unit != "mm") {
    return wrong_usage("'" + asked.unit + "' is no unit of a log", "mm or inch");
  }
  for (const std::string& text : asked.triggers) {
    const auto trigger = retain::trigger_of(text);
    if (!trigger)
      return wrong_usage("'" + text + "' is no trigger", "e.g. lag_mm>0.05 or load_percent>90:0.5");
    options.triggers.push_back(*trigger);
  }
  return options;
}

}  // namespace

Outcome<ImportedLogs> import_logs(const std::string& base, const std::vector<std::string>& logs,
                                  const LogImport& asked, Job& job) {
  const auto format = retain::log_format_of(asked.format);
  if (!format)
    return wrong_usage("'" + asked.format + "' is no format of a log", std::string(retain::kLogFormats));
  if (logs.empty()) return wrong_usage("no log is named", "one log or more");
  if (!asked.parts.empty() && asked.parts.size() != logs.size()) {
    return wrong_usage(
        counted(asked.parts.size(), "part", "parts") + " for " + counted(logs.size(), "log", "logs"),
        "a part for each log, or none");
  }
  auto options = options_of(asked, *format);
  if (!options) return tl::unexpected(options.error());
  const auto planned = read_steps(asked.plan, job);
  if (!planned) return unreadable(planned.error());
  std::optional<retain::ProgramMarks> marks;
  if (!asked.program.empty()) {
    auto read = read_marks(asked.program, *planned);
    if (!read) return unreadable(read.error());
    marks = *std::move(read);
    options->marks = &*marks;
  }
  if (!asked.inspection.empty()) {
    const auto bytes = read_file(asked.inspection);
    if (!bytes) return unreadable(bytes.error());
    auto rows =
        retain::read_inspection(*bytes, asked.inspection, asked.unit == "inch" ? kMmPerInch : 1.0, job);
    if (!rows) return unreadable(rows.error());
    options->inspection = *std::move(rows);
  }
  std::vector<casebase::Case> cases;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::string& path = logs[i];
    std::ifstream in(path, std::ios::binary);
    if (!in) {
      return unreadable(
          {.code = "FILE-READ", .message = "the file cannot be opened for reading", .file = path});
    }
    const retain::LogFrom from{.part = asked.parts.empty() ? "" : asked.parts[i],
                               .machine = asked.machine,
                               .file = path,
                               .inspection = asked.inspection};
    auto more = retain::import_log(in, *format, planned->steps, from, *options, job);
    if (!more) return unreadable(more.error());
    cases.insert(cases.end(), more->begin(), more->end());
  }
  auto kept = casebase::CaseBase::open_or_create(base, job);
  if (!kept) return unreadable(kept.error());
  if (auto seen = retain::seen_before(*kept, cases)) job.report(*std::move(seen));
  const std::size_t before = kept->size();
  if (auto ok = kept->add(cases); !ok) return failed(ok.error(), Code::kImpossible);
  for (Diagnostic& d : kept->take_faults()) job.report(std::move(d));
  return ImportedLogs{cases.size(), kept->size() - before, kept->size()};
}

}  // namespace capstan::service
