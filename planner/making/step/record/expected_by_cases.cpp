#include "planner/making/step/record/expected_by_cases.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "casebase/casebase.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"

namespace capstan::step {
namespace {

namespace tune = casebase::tune;
using casebase::Case;

/// Fewer parts do not show how far parts differ. Default, unsourced: as kRepeats of the case base.
constexpr std::size_t kLeastParts = 3;
/// Cases that are heard: reading one takes some 10 us. Default, unsourced.
constexpr std::size_t kMostHeard = 1000;

std::string signed_mm(double v) { return (v < 0.0 ? "" : "+") + fixed(v, 3) + " mm"; }

/// The plan's steps as cases, those that can be ones.
std::vector<Case> steps_of(const model::Plan& plan) {
  Job silent;
  return casebase::cases_of(plan, silent);
}

double half_90(double std_dev, std::size_t parts) {
  return tune::deviations_90(static_cast<double>(parts - 1)) * std_dev;
}

template <class Sample>
std::size_t groups_of(const std::vector<Sample>& samples) {
  std::set<std::size_t> groups;
  for (const Sample& s : samples) groups.insert(s.group);
  return groups.size();
}

/// `doubted`: cases that lie so far from the others that they hardly count.
std::string heard(std::size_t cases, std::size_t parts, std::size_t doubted) {
  return counted(cases, "case", "cases") + " of " + counted(parts, "part", "parts") +
         (doubted == 0 ? std::string() : " (" + std::to_string(doubted) + " doubted)");
}

/// Each step's time times the factor for blocks as long as its own; parts differ by one factor in all steps.
void tell_time(const model::Plan& plan, const std::vector<Case>& steps, const std::vector<Case>& cases,
               std::vector<model::Provenance>& rows, Job& job) {
  const auto samples = tune::times_of(cases);
  const std::size_t parts = groups_of(samples);
  if (parts < kLeastParts) return;
  const auto correction = tune::correct_time(samples, false);
  if (!correction) return;
  double planned_s = 0.0, expected_s = 0.0, spread_s = 0.0;
  for (const Case& s : steps) {
    if (!(s.predicted.time_s > 0.0) || s.bound.path_blocks <= 0) continue;
    const double block_s = s.predicted.time_s / s.bound.path_blocks;
    const double one_s = s.predicted.time_s * correction->factor(block_s);
    planned_s += s.predicted.time_s;
    expected_s += one_s;
    spread_s += one_s * correction->ln_std_dev(block_s);
  }
  if (!(planned_s > 0.0)) return;
  // What no step's case speaks of (tool changes, ways between steps) is as planned.
  const auto whole = motion::time_of(plan);
  if (!whole) return;
  const double other_s = std::max(0.0, whole->total_s() - planned_s);
  const std::string by = heard(samples.size(), parts, correction->how.doubted);
  const std::string value =
      motion::duration_text(expected_s + other_s) + " +- " + motion::duration_text(half_90(spread_s, parts));
  rows.push_back({std::string(kTimeByCases), value, by});
  job.note("CASE-TIME", "by " + by + " measured on this machine the plan takes " + value +
                            " (90 of 100) in place of " + motion::duration_text(whole->total_s()) +
                            "; feeds and paths stay as they are");
}

/// How far bores come out from the size asked, by the measured parts of one tool class and cutter diameter.
struct Bores {
  std::optional<tune::BoreCorrection> correction;
  std::size_t cases = 0, parts = 0;
};
Bores bores_of(const std::vector<Case>& cases, const casebase::Question& q) {
  std::vector<Case> same;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(same), [&](const Case& c) {
    return c.asked.tool_class == q.tool_class && tune::same_cutter(c.asked, q);
  });
  const auto samples = tune::bores_of(same);
  Bores out{.correction = {}, .cases = samples.size(), .parts = groups_of(samples)};
  if (out.parts >= kLeastParts) out.correction = tune::correct_bores(samples, false);
  return out;
}

/// `cases`: of the plan's material. Bores of another material, tool class or cutter diameter say nothing of
/// these: other forces bend other tools.
void tell_bores(const model::Plan& plan, const std::vector<Case>& steps, const std::vector<Case>& cases,
                std::vector<model::Provenance>& rows, Job& job) {
  std::map<std::pair<std::string, double>, Bores> by_tool;
  for (const Case& s : steps) {
    const casebase::Question& q = s.asked;
    const bool finishes =
        q.operation.find("FINISH") != std::string::npos || !(s.bound.allowance_side_mm > 0.0);
    // A path that the file gave aims where the file says.
    if (!finishes || !s.bound.aimed_over_mm || !tune::mills_bore(q) || !(q.cutter_diameter_mm > 0.0) ||
        !(q.stick_out_mm > 0.0))
      continue;
    const std::pair tool(q.tool_class, q.cutter_diameter_mm);
    if (!by_tool.contains(tool)) by_tool.emplace(tool, bores_of(cases, q));
    const Bores& bores = by_tool.at(tool);
    if (!bores.correction) continue;
    const double feed_mm = s.bound.fz_mm * std::max(1, q.teeth),
                 ratio = q.stick_out_mm / q.cutter_diameter_mm;
    const double off = bores.correction->deviation_mm(feed_mm, ratio);
    const double half = bores.correction->half_90_mm(feed_mm, ratio);
    const double aimed = s.bound.aimed_over_mm->value, half_zone = 0.5 * q.tolerance_mm;
    const std::string value = signed_mm(aimed + off) + " +- " + fixed(half, 3) + " mm";
    const std::string by = heard(bores.cases, bores.parts, bores.correction->how.doubted);
    rows.push_back({"bore of '" + s.from.workingstep + "' by cases", value, by});
    // The zone as it is drawn, which the path aims at the middle of: of H7 it lies on one side of the size.
    const bool leaves = half_zone > 0.0 && (off + half > half_zone || off - half < -half_zone);
    Diagnostic d{.code = "CASE-BORE",
                 .severity = leaves ? Severity::kWarning : Severity::kNote,
                 .message = "step '" + s.from.workingstep + "': by " + by + " its bore comes out " + value +
                            " from its nominal size (90 of 100)",
                 .file = plan.file_name};
    if (leaves) {
      d.message +=
          ", beyond its zone of " + signed_mm(aimed - half_zone) + " to " + signed_mm(aimed + half_zone);
      d.hint = "let the tool stick out less, or feed less; measure the first part";
    }
    job.report(std::move(d));
  }
}

}  // namespace

std::vector<model::Provenance> tell_expected(const model::Plan& plan, const casebase::CaseBase* cases,
                                             Job& job) {
  std::vector<model::Provenance> rows;
  if (cases == nullptr) return rows;
  const std::vector<Case> steps = steps_of(plan);
  tell_time(plan, steps, cases->measured_in({}, plan.machine.id, kMostHeard), rows, job);
  const std::string material = casebase::material_group_of(plan.material);
  tell_bores(plan, steps, cases->measured_in(material, plan.machine.id, kMostHeard), rows, job);
  return rows;
}

}  // namespace capstan::step
