#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "planner/ground/memo/memo.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/closer_look.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

/// How far from its axis a tool meets anything that stands no higher than `top_mm`, z in the set-up's frame:
/// a shank or a holder that stays above that meets nothing.
class ToolReach {
 public:
  ToolReach(const model::Cutter& cutter, double cell_mm, double top_mm);
  /// With its tip no lower than this, mm.
  [[nodiscard]] double of(double tip_mm) const;
  [[nodiscard]] double top_mm() const { return top_mm_; }

 private:
  struct Wider {
    double from_mm = 0.0, radius_mm = 0.0;  ///< from so high above the tip
  };
  double more_mm_, radius_mm_, top_mm_;
  std::vector<Wider> wider_;
};

/// What has been cut where in a set-up so far, as keys of squares of its area: a square whose key is the same
/// had the same beginning and was cut by the same moves of the same cutters.
class CutSquares {
 public:
  /// `of_setup` says how the grid was filled; what was `carried` into it from other set-ups, its heights.
  void begin(const Grid& grid, const memo::Key& of_setup, bool carried);
  /// Key of all squares within the tool's reach of a move.
  [[nodiscard]] memo::Key near(const StepMoves& step, const ToolReach& reach) const;
  /// Says that the step's moves at feed below `top_mm` cut; `what` is the key of all of them.
  void cut(const StepMoves& step, double reach_mm, double top_mm, const memo::Key& what);

 private:
  template <class Reach>
  [[nodiscard]] std::vector<char> touched(const StepMoves& step, const Reach& reach, double top_mm,
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
/// cut near it before. A finding names the move, so that it moves with the lines of a program. A program's
/// step that moves as its plan does (as_planned.h) is the plan's step, and what was found of that holds for
/// it: only its rapids before and after are looked at.
class KnownSteps {
 public:
  /// `memo` may be null: every step is swept. It outlives this, as the others do.
  KnownSteps(const model::Plan& plan, const ReadPart& part, memo::Memo* memo);
  /// Lets a set-up's finished part be taken from earlier checks: before its grid is filled.
  void remember(Target& target, const Grid& grid) const;
  /// Where a set-up begins, and where it goes on after another.
  void begin(SweptSetup setup, bool carried) const;
  /// Sweeps one step; `begun`: whether its feature was cut before.
  [[nodiscard]] SweptStep sweep(const StepMoves& step, SweptSetup setup, bool begun,
                                Findings& findings) const;

 private:
  /// A program's step by what is known of its plan's: nothing where it moves otherwise, or that was not
  /// swept.
  [[nodiscard]] std::optional<SweptStep> sweep_as_planned(const StepMoves& step, SweptSetup setup, bool begun,
                                                          Findings& findings) const;
  /// Judges rapids of a step that are not its plan's.
  void sweep_rapids(const StepMoves& step, std::size_t from, std::size_t to, SweptSetup setup,
                    Findings& findings) const;
  /// Says that a step has cut.
  void leave(const StepMoves& step, SweptSetup setup) const;
  /// What heights and walls of a set-up are made from.
  [[nodiscard]] memo::Key key_of_setup(const Target& target, const Grid& grid) const;
  [[nodiscard]] memo::Key key_of(const StepMoves& step, const SweptSetup& setup, bool begun) const;
  /// All that a cutter is, packed once for its steps.
  [[nodiscard]] const memo::Key& key_of_cutter(const model::Cutter& cutter) const;
  const model::Plan& plan_;
  memo::Memo* memo_;
  memo::Key of_plan_;  ///< machine, material and the part's own reading
  mutable std::map<const model::Cutter*, memo::Key> of_cutters_;
};

}  // namespace capstan::verify
