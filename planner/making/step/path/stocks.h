#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/draft/draft.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/model/plan/plan.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"

// The in-process workpiece of each set-up.

namespace capstan::step {

/// What makes a set-up the same in another try: its noun, and how the workpiece lies in it. Its number is
/// not it, for tries order set-ups anew; a noun alone is not it either, for a try that makes other set-ups
/// gives them the same nouns.
using SameSetup = std::pair<model::AnyRef, std::array<double, 9>>;

/// The smallest cutter that the steps of a set-up ended with, and how often that was another than before.
struct Smallest {
  double mm = 0.0;
  int times = 0;
};
/// Of the set-ups of the tries so far that ended with another than they began with.
using SmallestCutters = std::map<SameSetup, Smallest>;

class Stocks {
 public:
  /// `left_out` are steps that are not made, `known` the cutters of earlier tries. All are referred to.
  Stocks(const model::Stock& raw, const std::vector<draft::SetupDraft>& setups,
         const std::vector<draft::StepDraft>& steps, const std::set<model::AnyRef>& left_out,
         const SmallestCutters& known)
      : raw_(raw),
        setups_(setups),
        steps_(steps),
        left_out_(left_out),
        known_(known),
        maps_(setups.size()),
        patches_(setups.size()),
        smallest_(setups.size()),
        exact_(setups.size()) {}

  /// What still stands in a set-up; in another one than before, less what the others took away since.
  [[nodiscard]] stock::HeightMap& of(std::size_t setup);

  /// What stands in a set-up, to be put back when a cut is tried that is not kept: how many patches were
  /// noted by then, and the exact stock's mark.
  struct Before {
    std::size_t patches = 0;
    stock::PlanarStock::Mark exact;
  };
  [[nodiscard]] Before before(std::size_t setup);
  /// Needs  what `before` gave for this set-up since the last `keep`.
  void put_back(std::size_t setup, const Before& before);
  /// What was cut so far in a set-up stays cut.
  void keep(std::size_t setup);

  /// Sections are sampled by the cells of the maps, and these by the smallest cutter of the set-up: that of
  /// the steps as they are kept at last, for a plan that is read again has these only. Whether the plan is to
  /// be made again for that, with these cutters.
  struct OtherCells {
    SmallestCutters cutters;
    bool again = false;
  };
  [[nodiscard]] OtherCells other_cells() const;

  /// Sections along a step's path; takes what is cut from the stock. Flat cutters are measured by geometry,
  /// as long as all that was cut in the set-up can be held so and the map's volume of each step bears it out;
  /// other cutters on the height map. At the machine, too: sections that a file states are held against them.
  /// Fails  as engagement::measure; then nothing was cut.
  [[nodiscard]] Result<engagement::Measurement> measure(std::size_t setup, const model::CutterPath& path,
                                                        const model::Cutter& cutter);

 private:
  [[nodiscard]] double smallest(std::size_t setup) const;
  [[nodiscard]] double cell(std::size_t setup, double smallest_mm) const;

  const model::Stock& raw_;
  const std::vector<draft::SetupDraft>& setups_;
  const std::vector<draft::StepDraft>& steps_;
  const std::set<model::AnyRef>& left_out_;
  const SmallestCutters& known_;
  std::size_t last_ = static_cast<std::size_t>(-1);
  std::vector<std::optional<stock::HeightMap>> maps_;
  std::vector<std::vector<stock::Patch>> patches_;        ///< of the maps before they were cut, oldest first
  std::vector<double> smallest_;                          ///< cutter that each map was made for, mm
  std::vector<std::optional<stock::PlanarStock>> exact_;  ///< beside the maps; lost when it cannot follow
};

/// Height of the highest material over a feature, set-up frame.
[[nodiscard]] double top_over(const stock::HeightMap& map, const toolpath::PathJob& job);

}  // namespace capstan::step
