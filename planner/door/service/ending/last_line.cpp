#include "planner/door/service/ending/last_line.h"

#include <algorithm>
#include <string_view>

#include "planner/door/service/ending/repeats.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/physics/motion/time.h"
#include "planner/proof/verify/verify.h"

namespace capstan::service {
namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
  std::string out;
  for (const std::string& p : parts) {
    if (!out.empty()) out += between;
    out += p;
  }
  return out;
}

/// Of a call that ended before there was anything to judge.
std::string nothing_done(const Ending& end) {
  const char* what = end.verb == Verb::kCheck ? "nothing is checked" : "no plan, no program";
  if (end.stopped) return std::string("Stopped: ") + what;
  return std::string("Failed: ") + what;
}

/// "21 steps, 2 set-ups, 10 tools (3 to load), 4 min 29 s"; empty where there is no plan.
std::string amounts(const Ending& end) {
  std::vector<std::string> out;
  if (end.files > 0) out.push_back(counted(end.files, "file", "files") + " checked");
  if (end.verb != Verb::kCheck || end.steps > 0) {
    // Where decisions are open there may be no step yet.
    if (!end.open || end.steps > 0) out.push_back(counted(end.steps, "step", "steps"));
    if (end.setups > 1) out.push_back(std::to_string(end.setups) + " set-ups");
    out.push_back(counted(end.tools, "tool", "tools") +
                  (end.to_load > 0 ? " (" + std::to_string(end.to_load) + " to load)" : ""));
  }
  if (end.time_s) {
    out.push_back(motion::duration_text(*end.time_s));
    if (!end.time_by_cases.empty()) out.back() += " (by cases " + end.time_by_cases + ")";
  }
  return joined(out, ", ");
}

/// "1 of 12 features is not planned".
std::string unplanned_text(const Ending& end) {
  const std::size_t all = std::max(end.features, end.unplanned);
  return std::to_string(end.unplanned) + " of " + counted(all, "feature", "features") +
         (end.unplanned == 1 ? " is" : " are") + " not planned";
}

/// Why a plan that is not condemned cannot be called safe.
std::vector<std::string> doubts(const Ending& end) {
  std::vector<std::string> out;
  if (end.unread > 0)
    out.push_back(counted(end.unread, "error", "errors") + " in reading: what " +
                  (end.unread == 1 ? "it is" : "they are") + " about is not in the plan");
  if (end.planned_anew > 0)
    out.push_back(counted(end.planned_anew, "plan was", "plans were") +
                  " planned anew to be checked: not all paths are in the file, or values were edited");
  if (end.unproved > 0)
    out.push_back(counted(end.unproved, "thing is", "things are") + " not judged (see above)");
  if (end.compared > 0)
    out.push_back(counted(end.compared, "file is", "files are") + " compared with the schema only");
  return out;
}

/// The fate of condemned programs, in words.
std::string_view program_text(const Ending& end) {
  if (end.strict || end.verb == Verb::kCheck) return "";
  switch (end.program) {
    case ProgramEnd::kNotAsked:
      return ", no program can be made of it";
    case ProgramEnd::kWithStops:
    case ProgramEnd::kWritten:
      return ", the program stops before what is condemned";
    case ProgramEnd::kWithheld:
      return ", no program written";
  }
  return "";
}

}  // namespace

bool calls_safe(const Ending& end) {
  return end.done && end.condemned == 0 && !end.stopped && !end.open && doubts(end).empty() &&
         (end.steps > 0 || end.verb == Verb::kCheck);
}

std::string last_line(const Ending& end) {
  if (!end.done) return nothing_done(end);
  std::string head;
  std::vector<std::string> parts;
  const std::vector<std::string> doubted = end.condemned > 0 ? std::vector<std::string>{} : doubts(end);
  const bool whole = end.unplanned == 0 && !end.faces_left;
  std::string warnings = counted(end.warned, "warning", "warnings") + " of the check";
  if (end.condemned > 0) {
    head = end.stopped ? "Stopped, NOT SAFE" : "NOT SAFE";
    parts.push_back(counted(end.condemned, "finding", "findings") + std::string(program_text(end)));
    if (!end.why.empty()) parts.push_back(end.why);
  } else if (end.stopped) {
    head = "Stopped, not proven safe";
    parts.emplace_back("the check did not come to its end");
  } else if (end.open) {
    head = "Not checked";
    parts.emplace_back("decisions are left open");
  } else if (!doubted.empty()) {
    head = "Not proven safe";
  } else if (end.steps == 0 && end.verb != Verb::kCheck) {
    head = "Nothing to machine";
  } else {
    head = whole ? "Safe" : "Safe, but not whole";
    if (end.warned > 0) {
      head += ", with " + warnings;
      warnings.clear();
    }
  }
  if (end.late) head += ", too late";
  parts.insert(parts.end(), doubted.begin(), doubted.end());
  if (end.unplanned > 0) parts.push_back(unplanned_text(end));
  if (end.faces_left) parts.emplace_back("faces of the CAD shape are not reached (see above)");
  if (end.late) parts.emplace_back("the deadline was past when the plan was there");
  if (end.warned > 0 && !warnings.empty()) parts.push_back(warnings);
  if (end.schema > 0) parts.push_back(counted(end.schema, "deviation", "deviations") + " from the schema");
  if (const std::string of_plan = amounts(end); !of_plan.empty()) parts.push_back(of_plan);
  if (end.strict) parts.emplace_back("nothing written (--strict)");
  if (!end.wrote.empty()) parts.push_back("wrote " + joined(end.wrote, ", "));
  return head + ": " + joined(parts, "; ");
}

std::size_t reading_errors(const std::vector<Diagnostic>& said, std::size_t from) {
  return static_cast<std::size_t>(std::count_if(
      said.begin() + static_cast<std::ptrdiff_t>(from), said.end(),
      [](const Diagnostic& d) { return d.severity == Severity::kError && !d.code.starts_with("PIP-"); }));
}

void take_plan(const model::Plan& plan, Ending& into) {
  into.steps = plan.steps.size();
  into.setups = plan.setups.size();
  into.tools = plan.cutters.size();
  const auto loaded = static_cast<std::size_t>(
      std::count_if(plan.cutters.begin(), plan.cutters.end(), [](const auto& c) { return c.loaded; }));
  // If no tool is in the magazine, its content is unknown.
  into.to_load = loaded == 0 ? 0 : plan.cutters.size() - loaded;
  // Steps without a path have no time.
  if (const auto t = motion::time_of(plan); t && t->total_s() > 0.0) into.time_s = t->total_s();
  for (const model::Provenance& p : plan.provenance) {
    if (p.what == step::kTimeByCases) into.time_by_cases = p.value;
  }
  into.unplanned = unplanned_features(plan);
  into.features = features_of(plan);
}

namespace {

/// Findings that condemn nothing, by what they say; what a program repeats of its plan counts once.
void count_findings(const std::vector<FileFinding>& findings, Ending& into) {
  Repeats repeats(into.verb);
  for (const FileFinding& f : findings) {
    if (!repeats.is_new(f)) continue;
    if (f.finding.code == verify::kStopped) into.stopped = true;
    if (f.finding.code == verify::kFacesLeft) into.faces_left = true;
    if (f.schema || f.finding.severity == Severity::kError) continue;
    if (f.finding.unproved) {
      ++into.unproved;
    } else if (f.finding.severity == Severity::kWarning) {
      ++into.warned;
    }
  }
}

}  // namespace

void take_verdict(const model::Plan& plan, const Verdict& verdict, Ending& into) {
  count_findings(verdict.findings, into);
  into.condemned = verdict.condemned.size();
  if (!verdict.condemned.empty()) into.why = model::text_of(plan, verdict.condemned);
}

void take_check(const CheckResult& result, Ending& into) {
  count_findings(result.findings, into);
  into.condemned = static_cast<std::size_t>(std::count_if(
      result.findings.begin(), result.findings.end(),
      [](const FileFinding& f) { return !f.schema && f.finding.severity == Severity::kError; }));
  into.files = result.checked;
  into.unplanned = result.left_out;
  into.features = result.features;
  into.planned_anew = result.planned_anew;
  into.compared = result.compared;
  into.schema = result.schema;
  into.unread = result.errors;
}

}  // namespace capstan::service
