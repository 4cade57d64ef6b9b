#include "planner/door/app/command/session.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <utility>

#include "planner/door/app/command/folded_diagnostics.h"
#include "planner/door/app/command/telling/telling.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/ground/base/number.h"

namespace capstan::app {
namespace {

/// Of the commands that say whether something is safe: which of them this is.
std::optional<service::Verb> verb_of(Command command) {
  switch (command) {
    case Command::kPlan:
      return service::Verb::kPlan;
    case Command::kBind:
      return service::Verb::kBind;
    case Command::kCheck:
      return service::Verb::kCheck;
    default:
      return std::nullopt;
  }
}

/// Whether what the command was asked for is on standard output, so that it needs no last line.
bool prints(Command command) {
  switch (command) {
    case Command::kExplain:
    case Command::kInspect:
    case Command::kDiff:
    case Command::kToolsList:
    case Command::kToolsShow:
    case Command::kMaterialsList:
    case Command::kMaterialsShow:
    case Command::kMachinesList:
    case Command::kMachinesShow:
    case Command::kFixturesList:
    case Command::kFixturesShow:
    case Command::kControlsList:
    case Command::kControlsShow:
    case Command::kShopShow:
    case Command::kCasesNearest:
    case Command::kRulesList:
      return true;
    default:
      return false;
  }
}

std::string summary_line(const Session& s, const std::vector<Diagnostic>& said, int code) {
  std::string out;
  if (const auto verb = verb_of(s.options.command)) {
    out = !s.verdict.empty()
              ? s.verdict
              : service::last_line({.verb = *verb, .done = false, .stopped = s.job.stop_requested()});
  } else if (!s.summary.empty()) {
    out = "capstan: " + s.summary;
  } else {
    out = code == kDone       ? "capstan: done"
          : code == kFindings ? "capstan: done, with findings"
                              : "capstan: nothing done";
  }
  const auto count = [&](Severity severity) {
    return static_cast<std::size_t>(
        std::count_if(said.begin(), said.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
  };
  out += "; " + counted(count(Severity::kError), "error", "errors") + ", " +
         counted(count(Severity::kWarning), "warning", "warnings");
  return out;
}

}  // namespace

Session::Session(Options o)
    : options(std::move(o)), repeats_(verb_of(options.command).value_or(service::Verb::kPlan)) {
  job.threads = options.inputs.threads;
  const bool read = ::isatty(STDERR_FILENO) != 0 && !options.json_diagnostics && !options.quiet;
  if (auto tell = progress_teller(options.progress, read)) job.set_progress(std::move(tell));
}

bool Session::is_new(const service::FileFinding& f) {
  const bool fresh = repeats_.is_new(f);
  return fresh || options.json_diagnostics;
}

int Session::end(const Diagnostic& d, int code) {
  // Readers report each fault before they fail with a summary; that summary may be one of them.
  const auto& told = job.diagnostics();
  if (told.empty() || !(told.back() == d)) {
    Diagnostic fault = d;
    fault.severity = Severity::kError;
    job.report(std::move(fault));
  }
  return static_cast<int>(service::code_of(d, service::Code{code}));
}

void print_diagnostics(Session& s, int code) {
  end_progress();
  const std::vector<Diagnostic> said = without_repeats(s.job.diagnostics());
  const bool json = s.options.json_diagnostics;
  const bool colour = !json && in_colour();
  for (const Diagnostic& d : json || s.options.verbose ? said : folded_diagnostics(said)) {
    if (s.options.quiet && d.severity != Severity::kError) continue;
    std::fprintf(stderr, "%s\n", (json ? diagnostic_json(d) : line_of(d, colour)).c_str());
  }
  const bool shows = !prints(s.options.command);
  if (!shows && code <= kFindings) return;  // the requested text is on standard output
  if (s.options.quiet && code == kDone) return;
  const std::string line = summary_line(s, said, code);
  if (json) {
    std::fprintf(stderr, "%s\n",
                 diagnostic_json({.code = "SUMMARY", .severity = Severity::kNote, .message = line}).c_str());
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

bool print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
    return true;
  return errno == EPIPE;  // who reads has enough: `| head`
}

Diagnostic as_diagnostic(const model::Finding& f, const std::string& file, bool program) {
  Diagnostic d{.code = f.code, .severity = f.severity, .message = f.message, .file = file};
  if (program && f.move > 0) d.line = static_cast<std::uint64_t>(f.move);
  if (!f.step.empty()) d.path = "step '" + f.step + "'";
  if (!program && f.move >= 0)
    d.path = "move " + std::to_string(f.move) + (d.path.empty() ? "" : " of " + d.path);
  return d;
}

}  // namespace capstan::app
