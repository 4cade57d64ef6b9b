#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/making/optimise/cut/cost.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/problem/problem.h"

namespace capstan::optimise {

/// The cut at one depth as a problem: cutting speed, feed per tooth and width are variables unless given.
/// The question must outlive it.
class Search {
 public:
  Search(const CutQuestion& q, double ap_mm);

  [[nodiscard]] bool fixed() const { return variables_.empty(); }
  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  [[nodiscard]] CutPoint at(std::span<const double> x) const;

  /// Parts of the box between the corners of the model: the points of the spindle's curve, the width from
  /// which the chip stops growing, the end of the effective diameter. One part if there are none.
  [[nodiscard]] std::vector<std::vector<Variable>> pieces() const;

  /// The points of a piece with the smallest loads, at either end of its speeds: narrowest width and lowest
  /// feed. Where loads keep their limits there, the feed is raised to the least at which the widest cut makes
  /// the thinnest chip that the cutter takes.
  [[nodiscard]] std::vector<CutPoint> gentlest(const std::vector<Variable>& piece) const;

  /// Whether no point of a piece keeps its limits. Loads and chip rise with feed and width, and the spindle's
  /// torque has no corner inside a piece: if no point of `gentlest` keeps the limits of loads, or the chip of
  /// the widest cut at the largest feed is too thin, no point does. A solver would spend its budget there.
  [[nodiscard]] bool hopeless(const std::vector<Variable>& piece) const;

  /// An upper bound of the removal rate at this depth, limits of loads aside: the fastest speed, the widest
  /// cut, and the largest feed that its bound and the chip allow there.
  [[nodiscard]] CutPoint fastest() const;

  /// Minimise the logarithm of the objective over a part of the box, from `start` where one is known. A
  /// multiplier then is a fraction of the objective.
  [[nodiscard]] Problem problem(std::vector<Variable> box, const std::optional<CutPoint>& start = {}) const;

  /// Name of a variable's bound as a limit; nothing if the bound is only a border of the search.
  struct Bound {
    std::string name, unit;
    double value = 0.0;  ///< in that unit
  };
  [[nodiscard]] std::optional<Bound> bound(const std::string& variable, bool upper, double at) const;

 private:
  void add_speed();
  void add_feed();
  void add_width();
  void add(const char* name, const char* unit, double lo, double hi);
  [[nodiscard]] std::vector<double> corners(const Variable& v) const;
  [[nodiscard]] double speed_of(double n_rpm) const;
  [[nodiscard]] std::vector<CutPoint> at_ends_of_speed(const std::vector<Variable>& piece,
                                                       std::vector<double> x) const;
  [[nodiscard]] bool keeps_loads(const CutPoint& p) const;
  [[nodiscard]] double chip_wanted(const CutPoint& p) const;

  const CutQuestion& q_;
  double ap_;
  std::optional<double> n_fixed_, feed_fixed_, fz_fixed_, ae_fixed_;
  bool speed_by_spindle_ = false;  ///< the upper end of the speed is the spindle's, not the table's
  std::vector<Variable> variables_;
};

}  // namespace capstan::optimise
