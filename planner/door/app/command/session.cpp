#include "planner/door/app/command/session.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "planner/door/app/command/folded_diagnostics.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/ground/base/number.h"

namespace capstan::app {
namespace {

/// A bar on a terminal, once work has taken more than a second; nothing in a pipe.
class Bar {
 public:
  void show(std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (now - begun_ < std::chrono::seconds(1) || now - shown_ < std::chrono::milliseconds(100)) return;
    shown_ = now;
    constexpr int kWidth = 30;
    const double f = fraction < 0.0 ? 0.0 : fraction > 1.0 ? 1.0 : fraction;
    const auto full = static_cast<std::size_t>(f * kWidth);
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    std::fprintf(stderr, "\r%-20.*s [%s] %3d %%", static_cast<int>(stage.size()), stage.data(), bar.c_str(),
                 static_cast<int>(100.0 * f));
    std::fflush(stderr);
    visible = true;
  }
  bool visible = false;

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point shown_;
};

Bar& bar() {
  static Bar one;
  return one;
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

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

Session::Session(Options o) : options(std::move(o)) {
  job.threads = options.inputs.threads;
  if (::isatty(STDERR_FILENO) != 0 && !options.json_diagnostics)
    job.set_progress([](std::string_view stage, double fraction) { bar().show(stage, fraction); });
}

namespace {

/// Whether two sentences say the same with the same numbers, but for the digits that a program rounds: of
/// decimals, for names and counts are whole.
bool same_but_for_rounding(std::string_view a, std::string_view b) {
  constexpr double kRounded = 1e-3;  // of a number, and
  constexpr double kMost = 0.1;      // of any: a program has its speeds to 0.1 1/min; default, unsourced
  const auto number = [](std::string_view& text, double& value) {
    const auto read =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (read.ec != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return true;
  };
  while (!a.empty() && !b.empty()) {
    double x = 0.0, y = 0.0;
    std::string_view rest_a = a, rest_b = b;
    if (number(rest_a, x) && number(rest_b, y)) {
      const auto decimal = [](std::string_view all, std::string_view rest) {
        return all.substr(0, all.size() - rest.size()).find('.') != std::string_view::npos;
      };
      const double apart = decimal(a, rest_a) || decimal(b, rest_b)
                               ? std::min(kMost, kRounded * std::max(std::abs(x), std::abs(y)))
                               : 0.0;
      if (!(std::abs(x - y) <= apart)) return false;
      a = rest_a;
      b = rest_b;
      continue;
    }
    if (a.front() != b.front()) return false;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.empty() && b.empty();
}

}  // namespace

bool Session::is_new(const service::FileFinding& f) {
  if (!f.program) {
    // Programs are judged against the first plan.
    if (of_plan_.empty()) plan_file_ = f.file;
    if (f.file == plan_file_) of_plan_.push_back(f.finding);
    return true;
  }
  const bool line = options.command == Command::kCheck && f.finding.move > 0;
  if (line || options.json_diagnostics) return true;
  return std::none_of(of_plan_.begin(), of_plan_.end(), [&](const model::Finding& known) {
    return known.code == f.finding.code && known.severity == f.finding.severity &&
           known.step == f.finding.step && same_but_for_rounding(known.message, f.finding.message);
  });
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
  if (bar().visible) std::fputs("\r\033[K", stderr);
  const std::vector<Diagnostic> said = without_repeats(s.job.diagnostics());
  if (s.options.json_diagnostics) {
    for (const Diagnostic& d : said) std::fprintf(stderr, "%s\n", diagnostic_json(d).c_str());
  } else {
    for (const Diagnostic& d : folded_diagnostics(said))
      std::fprintf(stderr, "%s\n", one_line(to_text(d)).c_str());
  }
  const bool shows =
      s.options.command != Command::kExplain && s.options.command != Command::kInspect &&
      s.options.command != Command::kDiff && s.options.command != Command::kToolsList &&
      s.options.command != Command::kToolsShow && s.options.command != Command::kMaterialsList &&
      s.options.command != Command::kMaterialsShow && s.options.command != Command::kMachinesList &&
      s.options.command != Command::kFixturesList && s.options.command != Command::kCasesNearest &&
      s.options.command != Command::kRulesList;
  if (!shows && code <= kFindings) return;  // the requested text is on standard output
  const std::string line = summary_line(s, said, code);
  if (s.options.json_diagnostics) {
    std::fprintf(stderr, "%s\n",
                 diagnostic_json({.code = "SUMMARY", .severity = Severity::kNote, .message = line}).c_str());
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

bool print(const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
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
