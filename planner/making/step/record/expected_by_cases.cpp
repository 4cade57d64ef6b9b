#include "planner/making/step/record/expected_by_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "casebase/casebase.h"
#include "casebase/tune/applied/named.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"

namespace capstan::step {
namespace {

namespace tune = casebase::tune;
using casebase::Case;

/// Fewer parts do not show how far parts differ. Default, unsourced: as kRepeats of the case base.
constexpr std::size_t kLeastParts = 3;

std::string signed_mm(double v) { return (v < 0.0 ? "" : "+") + fixed(v, 3) + " mm"; }

/// The plan's steps as cases, those that can be ones.
std::vector<Case> steps_of(const model::Plan& plan) {
  Job silent;
  return casebase::cases_of(plan, silent);
}

/// The measured cases that are heard, without their series, which say nothing of times and bores.
std::vector<Case> measured(const casebase::CaseBase& cases, std::string_view material,
                           std::string_view machine) {
  std::vector<Case> out = cases.measured_in(material, machine, tune::kMostHeard);
  for (Case& c : out) c.observed.wear_series_mm = c.observed.load_series_percent = {};
  return out;
}

double half_90(double std_dev, std::size_t parts) {
  return tune::deviations_90(static_cast<double>(parts - 1)) * std_dev;
}

/// What cases say of one thing, and which cases.
struct Heard {
  std::size_t parts = 0;
  std::string by;      ///< "8 cases of 4 parts (1 doubted)"
  std::string record;  ///< the same, each case with what came of it
};

/// `samples` and `weight`: of these cases, one each, in their order.
template <class Sample, class Outcome>
Heard heard(const std::vector<Case>& cases, const std::vector<Sample>& samples, const tune::Corrected& how,
            const Outcome& outcome) {
  std::set<std::size_t> parts;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    parts.insert(samples[i].group);
    told.push_back(tune::with_outcome(cases[i], outcome(cases[i]), how.fit.weight[i] < tune::kDoubtedWeight));
  }
  Heard out{.parts = parts.size(), .by = {}, .record = {}};
  out.by = counted(cases.size(), "case", "cases") + " of " + counted(out.parts, "part", "parts") +
           (how.doubted == 0 ? std::string() : " (" + std::to_string(how.doubted) + " doubted)");
  out.record = out.by + ": " + tune::named(told);
  return out;
}

/// Those of which `samples_of` makes a sample.
template <class SamplesOf, class Wanted>
std::vector<Case> those_heard(const std::vector<Case>& cases, const SamplesOf& samples_of,
                              const Wanted& wanted) {
  std::vector<Case> out;
  for (const Case& c : cases)
    if (wanted(c) && !samples_of(std::span(&c, 1)).empty()) out.push_back(c);
  return out;
}

/// Times of measured cases over those that were planned for them.
struct Times {
  std::optional<tune::TimeCorrection> correction;  ///< nothing: of too few parts
  Heard heard;
};
template <class Wanted>
Times times_of(const std::vector<Case>& cases, const Wanted& wanted) {
  const std::vector<Case> same = those_heard(cases, tune::times_of, [&](const Case& c) {
    return c.observed.time_s && c.observed.time_s->value > 0.0 && wanted(c);
  });
  const auto samples = tune::times_of(same);
  Times out{.correction = tune::correct_time(samples, false), .heard = {}};
  if (!out.correction) return out;
  out.heard = heard(same, samples, out.correction->how, [](const Case& c) {
    return motion::duration_text(c.observed.time_s->value) + " for " +
           motion::duration_text(c.predicted.time_s);
  });
  if (out.heard.parts < kLeastParts) out.correction.reset();
  return out;
}

std::string with_half(double s, double half_s) {
  return motion::duration_text(s) + " +- " + motion::duration_text(half_s);
}

/// Mean time of a block of the step's path, s; 0: it has none.
double block_of(const Case& step) {
  return step.bound.path_blocks > 0 ? step.predicted.time_s / step.bound.path_blocks : 0.0;
}

/// Each step's time times the factor for blocks as long as its own; parts differ by one factor in all steps.
void tell_time(const model::Plan& plan, const std::vector<Case>& steps, const std::vector<Case>& cases,
               std::vector<model::Provenance>& rows, Job& job) {
  const Times all = times_of(cases, [](const Case&) { return true; });
  if (!all.correction) return;
  double planned_s = 0.0, expected_s = 0.0, spread_s = 0.0;
  for (const Case& s : steps) {
    const double block_s = block_of(s);
    if (!(block_s > 0.0)) continue;
    const double one_s = s.predicted.time_s * all.correction->factor(block_s);
    planned_s += s.predicted.time_s;
    expected_s += one_s;
    spread_s += one_s * all.correction->ln_std_dev(block_s);
  }
  if (!(planned_s > 0.0)) return;
  // What no step's case speaks of (tool changes, ways between steps) is as planned.
  const auto whole = motion::time_of(plan);
  if (!whole) return;
  const double other_s = std::max(0.0, whole->total_s() - planned_s);
  const std::string value = with_half(expected_s + other_s, half_90(spread_s, all.heard.parts));
  const std::string without = motion::duration_text(whole->total_s());
  rows.push_back({std::string(kTimeByCases), value, "without them " + without + "; by " + all.heard.record});
  job.note("CASE-TIME", "by " + all.heard.by + " measured on this machine the plan takes " + value +
                            " (90 of 100) in place of " + without + "; feeds and paths stay as they are");
}

/// The time of each step of which steps like it were measured.
void tell_step_times(const std::vector<Case>& steps, const std::vector<Case>& cases,
                     std::vector<model::Provenance>& rows) {
  using Like = std::pair<std::string, std::string>;
  std::map<Like, Times> known;
  for (const Case& s : steps) {
    const double block_s = block_of(s);
    if (!(block_s > 0.0)) continue;
    const Like like{s.asked.operation, s.asked.tool_class};
    auto at = known.find(like);
    if (at == known.end()) {
      const auto alike = [&](const Case& c) {
        return c.asked.operation == like.first && c.asked.tool_class == like.second;
      };
      at = known.emplace(like, times_of(cases, alike)).first;
    }
    const Times& times = at->second;
    if (!times.correction) continue;
    const double expected_s = s.predicted.time_s * times.correction->factor(block_s);
    const double spread_s = expected_s * times.correction->ln_std_dev(block_s);
    rows.push_back({time_row_of(s.from.workingstep),
                    with_half(expected_s, half_90(spread_s, times.heard.parts)),
                    "without them " + motion::duration_text(s.predicted.time_s) + ", as planned; by " +
                        times.heard.record});
  }
}

/// How far bores come out from the size asked, by the measured parts of one tool class and cutter diameter.
struct Bores {
  std::optional<tune::BoreCorrection> correction;  ///< nothing: of too few parts
  Heard heard;
};
Bores bores_of(const std::vector<Case>& cases, const casebase::Question& q) {
  const std::vector<Case> same = those_heard(cases, tune::bores_of, [&](const Case& c) {
    return c.asked.tool_class == q.tool_class && tune::same_cutter(c.asked, q) && c.bound.fz_mm > 0.0 &&
           c.asked.stick_out_mm > 0.0;
  });
  const auto samples = tune::bores_of(same);
  Bores out{.correction = tune::correct_bores(samples, false), .heard = {}};
  if (!out.correction) return out;
  out.heard = heard(same, samples, out.correction->how, [](const Case& c) {
    return signed_mm(c.observed.size_deviation_mm->value - c.bound.aimed_over_mm->value) +
           " from what it aimed at";
  });
  if (out.heard.parts < kLeastParts) out.correction.reset();
  return out;
}

/// `cases`: of the plan's material. Bores of another material, tool class or cutter diameter say nothing of
/// these: other forces bend other tools.
void tell_bores(const model::Plan& plan, const std::vector<Case>& steps, const std::vector<Case>& cases,
                std::vector<model::Provenance>& rows, Job& job) {
  std::map<std::pair<std::string, double>, Bores> by_tool;
  for (const Case& s : steps) {
    const casebase::Question& q = s.asked;
    // A path that the file gave aims where the file says.
    if (!tune::finishes_bore(s) || !s.bound.aimed_over_mm || !(q.cutter_diameter_mm > 0.0) ||
        !(q.stick_out_mm > 0.0))
      continue;
    const std::pair tool(q.tool_class, q.cutter_diameter_mm);
    if (!by_tool.contains(tool)) by_tool.emplace(tool, bores_of(cases, q));
    const Bores& bores = by_tool.at(tool);
    if (!bores.correction) continue;
    const double feed_mm = s.bound.fz_mm * std::max(1, q.teeth),
                 ratio = q.stick_out_mm / q.cutter_diameter_mm;
    const double half = bores.correction->half_90_mm(feed_mm, ratio);
    const double middle = s.bound.aimed_over_mm->value, half_zone = 0.5 * q.tolerance_mm;
    const double comes = middle + bores.correction->deviation_mm(feed_mm, ratio);
    const std::string value = signed_mm(comes) + " +- " + fixed(half, 3) + " mm";
    rows.push_back(
        {bore_row_of(s.from.workingstep), value,
         "without them " + signed_mm(middle) + ", the middle of its zone; by " + bores.heard.record});
    // The zone as it is drawn: of H7 it lies on one side of the size.
    const double off = comes - middle;
    const bool leaves = half_zone > 0.0 && (off + half > half_zone || off - half < -half_zone);
    Diagnostic d{.code = "CASE-BORE",
                 .severity = leaves ? Severity::kWarning : Severity::kNote,
                 .message = "step '" + s.from.workingstep + "': by " + bores.heard.by +
                            " its bore comes out " + value + " from its nominal size (90 of 100)",
                 .file = plan.file_name};
    if (leaves) {
      d.message +=
          ", beyond its zone of " + signed_mm(middle - half_zone) + " to " + signed_mm(middle + half_zone);
      d.hint = "let the tool stick out less, or feed less; measure the first part";
    }
    job.report(std::move(d));
  }
}

}  // namespace

std::string time_row_of(std::string_view step) { return "time of '" + std::string(step) + "' by cases"; }
std::string bore_row_of(std::string_view step) { return "bore of '" + std::string(step) + "' by cases"; }

const model::Provenance* row_of(const model::Plan& plan, std::string_view what) {
  const auto at = std::find_if(plan.provenance.begin(), plan.provenance.end(),
                               [&](const model::Provenance& p) { return p.what == what; });
  return at == plan.provenance.end() ? nullptr : &*at;
}

std::vector<model::Provenance> tell_expected(const model::Plan& plan, const casebase::CaseBase* cases,
                                             Job& job) {
  std::vector<model::Provenance> rows;
  if (cases == nullptr) return rows;
  const std::vector<Case> steps = steps_of(plan);
  const std::vector<Case> timed = measured(*cases, {}, plan.machine.id);
  tell_time(plan, steps, timed, rows, job);
  tell_step_times(steps, timed, rows);
  const std::string material = casebase::material_group_of(plan.material);
  tell_bores(plan, steps, measured(*cases, material, plan.machine.id), rows, job);
  if (!rows.empty() && !cases->whole()) {
    job.report({.code = "CASE-LOST",
                .severity = Severity::kWarning,
                .message = "times and bores by cases are those of the cases that are left, and may be off by "
                           "more than is told",
                .file = plan.file_name,
                .hint = "restore the case base from a copy"});
  }
  return rows;
}

}  // namespace capstan::step
