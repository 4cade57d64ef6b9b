// Machining time against what a good shop would need.
//
// Each part is planned with the generic machining centre and the generic library, checked, and timed by
// motion::time_of. The shop's minutes are an experienced programmer's estimates by hand, for the same part
// and machine with catalogue values; they are estimates, not measurements. The second table shows where the
// time of each part goes: its longest steps, each with the limit that held it most, and where its feed comes
// from.

#include <algorithm>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

/// The aims, as ratios to the shop's time.
constexpr double kAimOfAluminium = 1.3, kAimOfOthers = 1.6;
/// How many steps of a part the second table shows, and the least share of the time that is worth a row.
constexpr std::size_t kStepsShown = 3;
constexpr double kLeastShare = 0.1;

struct Part {
  const char* file;  ///< of the project, or of the corpus where it begins with '/'
  const char* material;
  pipeline::Reopen reopen;
  double shop_min;
  double aim;  ///< of the ratio
};

using pipeline::Reopen;
constexpr Part kParts[] = {
    {"examples/reference_pocket.p21", "EN AW-6061", Reopen::kNothing, 0.0, kAimOfAluminium},
    {"examples/reference_pocket.p21", "C45", Reopen::kNothing, 100.0 / 60.0, kAimOfOthers},
    {"examples/reference_pocket.p21", "X5CrNi18-10", Reopen::kNothing, 185.0 / 60.0, kAimOfOthers},
    {"examples/reference_pocket.p21", "EN-GJL-250", Reopen::kNothing, 1.5, kAimOfOthers},
    {"examples/bracket.p21", "EN AW-6061", Reopen::kNothing, 2.5, kAimOfAluminium},
    {"examples/bracket.p21", "C45", Reopen::kNothing, 5.5, kAimOfOthers},
    {"examples/bracket.p21", "X5CrNi18-10", Reopen::kNothing, 9.0, kAimOfOthers},
    {"examples/bracket.p21", "EN-GJL-250", Reopen::kNothing, 0.0, kAimOfOthers},
    {"examples/surface.stl", "EN AW-6061", Reopen::kNothing, 1.5, kAimOfAluminium},
    {"examples/surface.stl", "C45", Reopen::kNothing, 7.0, kAimOfOthers},
    {"/iso14649/ufsc_Cavidade.p21", "", Reopen::kAll, 1.5, kAimOfOthers},
    {"/iso14649/nist_ex1.stp", "", Reopen::kAll, 5.0, kAimOfOthers},
    {"/iso14649/nist_ex1.stp", "tool steel", Reopen::kAll, 5.0, kAimOfOthers},
    {"/iso14649/nist_ex1.stp", "", Reopen::kTechnology, 13.0, kAimOfOthers},
};

const char* reopened(Reopen r) {
  if (r == Reopen::kAll) return ", re-opened";
  return r == Reopen::kTechnology ? ", technology re-opened" : "";
}

/// "2:35", minutes and seconds.
std::string clock_text(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  const std::string s = std::to_string(whole % 60);
  return std::to_string(whole / 60) + (s.size() < 2 ? ":0" : ":") + s;
}

/// What held the step: the limit of the schedule with the largest share, else the first active one.
std::string held_by(const model::StepResult& step) {
  std::string name, tail;
  if (!step.held_by.empty()) {
    name = step.held_by.front().name;
    tail = ", " + fixed(100.0 * step.held_by.front().share, 0) + " % of its time";
  } else if (!step.active.empty()) {
    name = step.active.front().name;
  } else {
    return "as given";
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + tail;
}

/// Why the step's feed is what it is, with the source; as the ledger has it.
std::string feed_from(const model::Plan& plan, const model::StepResult& step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
  if (op == nullptr) return "-";
  for (const char* name : {"feedrate", "feedrate_per_tooth"}) {
    const model::Decision* d = plan.ledger.find(op->its_technology, name);
    if (d == nullptr) continue;
    const model::Reason& why = plan.ledger.reason(d->reason);
    return why.text + (why.source.empty() ? "" : " (" + why.source + ")");
  }
  return "as given";
}

void add_longest(const std::string& part, const model::Plan& plan, double total_s, Table& out) {
  std::vector<const model::StepResult*> steps;
  for (const auto& s : plan.steps) steps.push_back(&s);
  const auto time = [](const auto* s) { return s->cutting_s + s->rapid_s; };
  std::stable_sort(steps.begin(), steps.end(),
                   [&](const auto* a, const auto* b) { return time(a) > time(b); });
  for (std::size_t i = 0; i < std::min(steps.size(), kStepsShown); ++i) {
    const model::StepResult& s = *steps[i];
    if (time(&s) < kLeastShare * total_s) break;
    out.rows.push_back({part, model::step_id(plan, s), s.cutter_id, clock_text(time(&s)),
                        fixed(s.spindle_rpm, 0), fixed(s.feed_mm_min, 0), fixed(s.axial_depth_mm, 1),
                        held_by(s), feed_from(plan, s)});
  }
}

}  // namespace

Comparison productivity(const std::string& corpus) {
  Comparison out{.name = "productivity"};
  if (corpus.empty()) {
    out.skipped = "the corpus is absent";
    return out;
  }
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  if (!shop) {
    out.skipped = shop.error().message;
    return out;
  }
  Table times{
      {"part", "material", "time", "a shop", "ratio", "aim", "steps", "not planned", "errors", "warnings"},
      {}};
  Table steps{{"part", "step", "tool", "time", "1/min", "mm/min", "depth, mm", "held by", "feed from"}, {}};
  int timed = 0, reached = 0;
  double worst = 0.0;
  for (const Part& part : kParts) {
    const std::string file =
        part.file[0] == '/' ? corpus + part.file : capstan::testing::source_dir() + "/" + part.file;
    Job quiet;
    pipeline::Inputs in = *shop;
    if (*part.material != '\0') in.material_name = part.material;
    const auto read = pipeline::read_plan(testing::slurp(file), file, quiet);
    if (!read) {
      out.skipped = to_text(read.error());
      return out;
    }
    pipeline::Policy policy;
    policy.reopen = part.reopen;
    const auto made = pipeline::bind_checked(*read, in, policy, quiet);
    if (!made) {
      out.skipped = to_text(made.error());
      return out;
    }
    const auto time = motion::time_of(made->plan);
    if (!time) {
      out.skipped = to_text(time.error());
      return out;
    }
    const model::Plan& plan = made->plan;
    const double total_s = time->total_s(), ratio = total_s / 60.0 / part.shop_min;
    const bool stated = part.shop_min > 0.0;
    const auto count = [&](Severity severity) {
      return std::count_if(made->findings.begin(), made->findings.end(),
                           [&](const auto& f) { return f.severity == severity; });
    };
    const auto errors = count(Severity::kError);
    const std::string file_name = file.substr(file.rfind('/') + 1) + reopened(part.reopen);
    times.rows.push_back({file_name, plan.material.id, clock_text(total_s),
                          stated ? clock_text(60.0 * part.shop_min) : "-", stated ? fixed(ratio, 2) : "-",
                          stated ? fixed(part.aim, 1) : "-", std::to_string(plan.steps.size()),
                          std::to_string(plan.unplanned.size()), std::to_string(errors),
                          std::to_string(count(Severity::kWarning))});
    add_longest(file_name + ", " + plan.material.id, plan, total_s, steps);
    if (!stated) continue;
    ++timed;
    worst = std::max(worst, ratio);
    if (ratio <= part.aim && errors == 0 && plan.unplanned.empty()) ++reached;
  }
  out.text = markdown(times) + "\n<details><summary>longest steps of every part</summary>\n\n" +
             markdown(steps) + "\n</details>\n";
  out.headline = std::to_string(reached) + " of " + std::to_string(timed) +
                 " parts within their aim against a shop's estimate, worst ratio " + fixed(worst, 1);
  return out;
}

}  // namespace capstan::validation
