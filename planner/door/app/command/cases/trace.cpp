#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

// `capstan cases trace`: which part, workingstep, tool edge, program line and measured value belong together.

namespace capstan::app {
namespace {

namespace retain = casebase::retain;
using casebase::Case;

struct Lines {
  long first = 0, last = 0;  // of the program; 0: not known
};

// What belongs together, of one executed workingstep.
struct Traced {
  const Case* c = nullptr;
  Lines lines;
};

// Whether a case was cut by this plan: it has its hash, or the sheet has its step.
bool is_of(const Case& c, const PlannedSteps& planned, const std::string& hash) {
  if (planned.plan) return c.from.plan_hash == hash;
  return c.from.plan_hash.empty() &&
         std::any_of(planned.steps.begin(), planned.steps.end(), [&](const retain::Step& s) {
           return s.id == c.from.workingstep && s.is_for(c.from.part) &&
                  s.planned.asked.operation == c.asked.operation &&
                  s.planned.asked.machine_class == c.asked.machine_class;
         });
}

bool names_step(const PlannedSteps& planned, const std::string& name) {
  return std::any_of(planned.steps.begin(), planned.steps.end(),
                     [&](const retain::Step& s) { return s.id == name; });
}

std::string lines_text(const Lines& lines) {
  return lines.first == 0 ? std::string("-") : std::to_string(lines.first) + "-" + std::to_string(lines.last);
}

std::string edge_text(const casebase::From& f) {
  if (f.tool_instance.empty() && f.tool_edge.empty()) return "-";
  return f.tool_instance + (f.tool_edge.empty() ? "" : " edge " + f.tool_edge);
}

std::string or_dash(const std::string& text) { return text.empty() ? std::string("-") : text; }

std::string text_of(const std::vector<Traced>& rows) {
  std::vector<std::vector<std::string>> cells = {{"part", "workingstep", "tool", "edge", "lines", "ended",
                                                  "time s", "lag mm", "load %", "size off mm", "verdict",
                                                  "case"}};
  for (const Traced& t : rows) {
    const Case& c = *t.c;
    const casebase::Observed& o = c.observed;
    cells.push_back({or_dash(c.from.part), or_dash(c.from.workingstep),
                     c.asked.tool_class + " D" + trimmed(c.asked.cutter_diameter_mm, 3), edge_text(c.from),
                     lines_text(t.lines), or_dash(c.from.time_utc), figure_text(o.time_s),
                     figure_text(o.lag_mm), figure_text(o.spindle_load_percent),
                     figure_text(o.size_deviation_mm), std::string(to_text(o.verdict)), c.id.substr(0, 12)});
  }
  return rows.empty() ? std::string("no case of this plan\n") : service::table(cells, "");
}

// A case a line, with the lines of the program where they are known.
std::string json_lines(const std::vector<Traced>& rows) {
  std::string out;
  for (const Traced& t : rows) {
    std::string one = case_json(*t.c);
    if (t.lines.first > 0) {
      one.insert(1, "\"program_lines\": [" + std::to_string(t.lines.first) + ", " +
                        std::to_string(t.lines.last) + "], ");
    }
    out += one + '\n';
  }
  return out;
}

// Where the rows go.
struct Destinations {
  std::vector<std::string> files;
  std::string base;  // a case base; empty: none
};

// By the endings alone, before any work. One case base: adding to a second may fail when the first has taken
// the rows.
Result<Destinations> destinations_of(const std::vector<std::string>& outputs) {
  Destinations out;
  for (const std::string& path : outputs) {
    if (path.ends_with(".jsonl") || path.ends_with(".csv")) {
      out.files.push_back(path);
      continue;
    }
    // A URI may hold a password, so that it is not repeated.
    if (!path.ends_with(".db") && path.find("://") == std::string::npos) {
      return fail(Diagnostic{.code = "USAGE-OUTPUT",
                             .message = "the ending of '" + path + "' is not known; nothing is written",
                             .expected = ".jsonl (JSON lines), .csv, .db or postgresql://... (a case base)"});
    }
    if (!out.base.empty()) {
      return fail(Diagnostic{.code = "USAGE-OUTPUT",
                             .message = "two case bases are named: " + casebase::name_of(out.base) + " and " +
                                        casebase::name_of(path) + "; nothing is written",
                             .expected = "one, so that all outputs are written or none",
                             .hint = "call it twice: a case that is there already is not added again"});
    }
    out.base = path;
  }
  return out;
}

// A file that was made for the rows goes if it does not take them.
Status add_to_base(const std::string& uri, const std::vector<Case>& cases, Job& job) {
  std::error_code ignored;
  const bool is_new = uri.ends_with(".db") && !std::filesystem::exists(uri, ignored);
  Status added;
  {
    auto base = casebase::CaseBase::open_or_create(uri, job);
    if (!base) return tl::unexpected(base.error());
    added = base->add(cases);
  }
  if (!added && is_new) std::filesystem::remove(uri, ignored);
  return added;
}

// All outputs, or none: the files are on disk before the base takes the rows, and get their names after it.
Status write_to(const Destinations& to, const std::vector<Traced>& rows, Job& job) {
  std::vector<Case> cases;
  for (const Traced& t : rows) cases.push_back(*t.c);
  std::vector<StagedFile> files;
  for (const std::string& path : to.files) {
    auto staged = StagedFile::make(path, path.ends_with(".csv") ? casebase::to_csv(cases) : json_lines(rows));
    if (!staged) return tl::unexpected(staged.error());
    files.push_back(*std::move(staged));
  }
  if (!to.base.empty()) {
    if (auto ok = add_to_base(to.base, cases, job); !ok) return ok;
  }
  for (StagedFile& f : files) {
    if (auto ok = f.put(); !ok) {
      Diagnostic d = ok.error();
      if (!to.base.empty()) d.message += "; " + casebase::name_of(to.base) + " has taken the cases already";
      return fail(std::move(d));
    }
  }
  return {};
}

}  // namespace

int run_cases_trace(Session& s) {
  const auto to = destinations_of(s.options.outputs);
  if (!to) return s.end(to.error(), kUsage);
  const auto planned = read_steps(s.options.files.front(), s.job);
  if (!planned) return s.end(planned.error(), kUnreadable);
  std::map<std::string, Lines> lines;
  if (!s.options.log.program.empty()) {
    const auto marks = read_marks(s.options.log.program, *planned);
    if (!marks) return s.end(marks.error(), kUnreadable);
    for (std::size_t i = 0; i < marks->marks.size(); ++i)
      lines.emplace(marks->marks[i].id, Lines{marks->marks[i].line, marks->last_line(i)});
  }
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::vector<Case> cases = base->cases();
  report_faults(s, *base);
  const std::string hash = planned->plan ? casebase::plan_hash_of(*planned->plan) : std::string();
  const std::vector<std::string>& parts = s.options.log.parts;
  std::size_t of_another = 0;  // cases of steps of these names that another plan was cut by
  std::vector<Traced> rows;
  for (const Case& c : cases) {
    if (c.origin == casebase::Origin::kSimulated || !wanted(c, s.options.words)) continue;
    if (!parts.empty() && std::find(parts.begin(), parts.end(), c.from.part) == parts.end()) continue;
    if (!is_of(c, *planned, hash)) {
      of_another +=
          planned->plan && !c.from.plan_hash.empty() && names_step(*planned, c.from.workingstep) ? 1 : 0;
      continue;
    }
    const auto at = lines.find(c.from.workingstep);
    rows.push_back({&c, at == lines.end() ? Lines{} : at->second});
  }
  if (of_another > 0)
    s.job.note("CASE-PLAN", counted(of_another, "case", "cases") +
                                " of steps of these names were cut by another plan than this one (" +
                                hash.substr(0, 12) + "), and are not shown");
  // By part and time, then as the plan has the steps.
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < planned->steps.size(); ++i) place.emplace(planned->steps[i].id, i);
  std::stable_sort(rows.begin(), rows.end(), [&](const Traced& a, const Traced& b) {
    const auto key = [&](const Traced& t) {
      const casebase::From& f = t.c->from;
      const auto at = place.find(f.workingstep);
      return std::tuple(f.part.size(), f.part, at == place.end() ? place.size() : at->second, f.time_utc);
    };
    return key(a) < key(b);
  });
  if (auto written = write_to(*to, rows, s.job); !written) return s.end(written.error(), kImpossible);
  s.summary = counted(rows.size(), "executed workingstep", "executed workingsteps") + " of " +
              counted(planned->steps.size(), "planned step", "planned steps");
  return print(s.options.json ? json_lines(rows) : text_of(rows)) ? kDone : kImpossible;
}

}  // namespace capstan::app
