#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "planner/ground/memo/memo.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/closer_look.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

/// What has been cut where in a set-up so far, as keys of squares of its area: a square whose key is the same
/// had the same beginning and was cut by the same moves of the same cutters.
class CutSquares {
 public:
  /// `of_setup` says how the grid was filled; what was `carried` into it from other set-ups, its heights.
  void begin(const Grid& grid, const memo::Key& of_setup, bool carried);
  /// Key of all squares that lie within `reach_mm` of a move below `top_mm`.
  [[nodiscard]] memo::Key near(const StepMoves& step, double reach_mm, double top_mm) const;
  /// Says that the step's moves at feed below `top_mm` cut; `what` is the key of all of them.
  void cut(const StepMoves& step, double reach_mm, double top_mm, const memo::Key& what);

 private:
  [[nodiscard]] std::vector<char> touched(const StepMoves& step, double reach_mm, double top_mm,
                                          bool rapids) const;
  static constexpr int kSquares = 32;  ///< in a row; default, unsourced: a compromise of time and precision
  geometry::Vec2 lo_, square_{1.0, 1.0};
  memo::Key of_setup_;
  std::vector<memo::Key> keys_;
};

/// What sweeping a step comes to, beside its findings.
struct SweptStep {
  bool cuts = false;
  double speed_share = 1.0;  ///< StepChecks::speed_share
};

/// A set-up while its steps are swept.
struct SweptSetup {
  Target& target;
  Grid& grid;
  EarlierCuts& earlier;
  CutSquares& squares;
};

/// Sweeps steps, or takes what an earlier check found where nothing differs that this depends on: the step's
/// moves and sizes, its cutter with shank and holder, machine and material, the finished part, and what was
/// cut near it before. A finding names the move, so that it moves with the lines of a program.
class KnownSteps {
 public:
  /// `memo` may be null: every step is swept. It outlives this, as the others do.
  KnownSteps(const model::Plan& plan, const PartShapes& part, memo::Memo* memo);
  /// Lets a set-up's finished part be taken from earlier checks: before its grid is filled.
  void remember(Target& target, const Grid& grid) const;
  /// Where a set-up begins, and where it goes on after another.
  void begin(SweptSetup setup, bool carried) const;
  /// Sweeps one step; `begun`: whether its feature was cut before.
  [[nodiscard]] SweptStep sweep(const StepMoves& step, SweptSetup setup, bool begun,
                                Findings& findings) const;

 private:
  /// What heights and walls of a set-up are made from.
  [[nodiscard]] memo::Key key_of_setup(const Target& target, const Grid& grid) const;
  [[nodiscard]] memo::Key key_of(const StepMoves& step, const SweptSetup& setup, bool begun,
                                 double reach_mm) const;
  /// All that a cutter is, packed once for its steps.
  [[nodiscard]] const memo::Key& key_of_cutter(const model::Cutter& cutter) const;
  const model::Plan& plan_;
  memo::Memo* memo_;
  memo::Key of_plan_;  ///< machine, material and the part's own reading
  mutable std::map<const model::Cutter*, memo::Key> of_cutters_;
};

}  // namespace capstan::verify
