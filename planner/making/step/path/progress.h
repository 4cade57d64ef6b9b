#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/making/step/path/stocks.h"
#include "planner/making/step/plan_so_far.h"

// Material that earlier steps leave for later ones.

namespace capstan::step {

class Progress {
 public:
  explicit Progress(const PlanSoFar& p) : p_(p) {}

  /// Fills in where the job's material begins, and what earlier steps left on walls and floor.
  void prepare(const draft::StepDraft& step, const stock::HeightMap& map, toolpath::PathJob& job) const;
  /// The step is done, with the cutter it has.
  void done(const draft::StepDraft& step);

 private:
  /// Allowance on a feature's walls and floor after the steps so far.
  struct Left {
    double side_mm = 0.0, bottom_mm = 0.0;
    bool floor_made = false;  ///< by a step that finishes it
  };
  /// A milling step done, for those after it that cut only what it could not reach.
  struct Milled {
    model::TypeId operation = model::TypeId::kNone;
    double diameter_mm = 0.0, corner_radius_mm = 0.0, side_mm = 0.0, bottom_mm = 0.0;
  };
  [[nodiscard]] static std::optional<toolpath::Cleared> cleared_by(const std::vector<Milled>& before,
                                                                   const toolpath::PathJob& job);
  void take_rest(const draft::StepDraft& step, toolpath::PathJob& job) const;

  using Key = std::pair<model::AnyRef, int>;  ///< feature and member of its pattern
  const PlanSoFar& p_;
  std::map<Key, Left> left_;
  std::map<Key, std::vector<Milled>> milled_;
  std::map<Key, double> holes_;  ///< diameter made so far, mm
};

}  // namespace capstan::step
