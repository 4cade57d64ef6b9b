#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "tests/sweep/features.h"

namespace capstan::testing::sweep {

/// One part, of one material, on one machine.
struct Case {
  std::size_t feature = 0, material = 0, machine = 0;  ///< into features(), kMaterials, kMachines
  [[nodiscard]] std::string name() const;
};

/// A material as a drawing names it, and its group of ISO 513 (plastics stand apart).
struct MaterialName {
  const char* name;
  const char* group;
};
inline constexpr MaterialName kMaterials[] = {
    {"C45", "P"},        {"42CrMo4+QT", "P"},   {"X5CrNi18-10", "M"}, {"1.4462", "M"},
    {"EN-GJL-250", "K"}, {"EN-GJS-600-3", "K"}, {"EN AW-6061", "N"},  {"CW614N", "N"},
    {"Ti6Al4V", "S"},    {"Inconel 718", "S"},  {"50 HRC", "H"},      {"POM", "plastic"},
};
inline constexpr const char* kMachines[] = {"small_router", "tormach_1100mx", "generic_vmc"};

/// Every combination.
[[nodiscard]] std::vector<Case> all_cases();
/// Each feature and each material once, the machines in turn.
[[nodiscard]] std::vector<Case> diagonal();

/// On each machine each feature once and each material once.
[[nodiscard]] std::vector<Case> each_once_per_machine();

/// What became of a case.
struct Outcome {
  std::string failed;  ///< why there is no plan at all; empty: there is one
  pipeline::Checked made;
  std::vector<model::Finding> findings;  ///< of the plan and of its program
  double plan_s = 0.0;       ///< cutting and rapids; changes of tool and the spindle's starts are not in it
  double catalogue_s = 0.0;  ///< of the same; 0: the catalogue has no such tool
  [[nodiscard]] bool whole() const { return failed.empty() && made.plan.unplanned.empty(); }
  [[nodiscard]] double ratio() const { return whole() && catalogue_s > 0.0 ? plan_s / catalogue_s : 0.0; }
};

/// Plans cases; each machine's shop is opened once. Where CAPSTAN_SWEEP_KEEP names a folder, each part, its
/// plan and its program are left there.
class Sweep {
 public:
  Sweep();
  [[nodiscard]] Outcome plan(const Case& c);

 private:
  std::vector<Result<pipeline::Inputs>> shops_;
};

/// What a plan promises and does not keep, a line each; empty: nothing.
///
///     no finding is an error, no limit is exceeded;
///     no move sideways in material has a feed below the least chip of its cutter, beyond 1 mm of way in all;
///     no wall is predicted to be off by more than half of its zone;
///     a feature that is not planned says why and what would help.
[[nodiscard]] std::string broken(const Case& c, const Outcome& o);

/// Whether the reason of a refusal helps: it gives a figure with its unit, which says what would do, or an
/// option.
[[nodiscard]] bool helps(const std::string& reason);

/// Which moves of a step that has a path and sections meet material.
[[nodiscard]] std::vector<bool> cutting_moves(const model::StepResult& s);

}  // namespace capstan::testing::sweep
