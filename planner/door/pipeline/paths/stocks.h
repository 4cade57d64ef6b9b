#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/door/pipeline/work.h"
#include "planner/ground/base/result.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"

// The in-process workpiece of each set-up; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

class Stocks {
 public:
  explicit Stocks(const Work& w)
      : w_(w),
        maps_(w.setups.size()),
        patches_(w.setups.size()),
        smallest_(w.setups.size()),
        exact_(w.setups.size()) {}

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
  /// be made again for that; `tries` remembers the cutters.
  [[nodiscard]] bool other_cells_asked_for(Tries& tries) const;

  /// Sections along a step's path; takes what is cut from the stock. Flat cutters are measured by geometry,
  /// as long as all that was cut in the set-up can be held so and the map's volume of each step bears it out;
  /// other cutters on the height map. At the machine, too: sections that a file states are held against them.
  /// Fails  as engagement::measure; then nothing was cut.
  [[nodiscard]] Result<engagement::Measurement> measure(std::size_t setup, const model::CutterPath& path,
                                                        const model::Cutter& cutter);

 private:
  [[nodiscard]] double smallest(std::size_t setup) const;
  [[nodiscard]] double cell(std::size_t setup, double smallest_mm) const;

  const Work& w_;
  std::size_t last_ = static_cast<std::size_t>(-1);
  std::vector<std::optional<stock::HeightMap>> maps_;
  std::vector<std::vector<stock::Patch>> patches_;        ///< of the maps before they were cut, oldest first
  std::vector<double> smallest_;                          ///< cutter that each map was made for, mm
  std::vector<std::optional<stock::PlanarStock>> exact_;  ///< beside the maps; lost when it cannot follow
};

/// Height of the highest material over a feature, set-up frame.
[[nodiscard]] double top_over(const stock::HeightMap& map, const toolpath::PathJob& job);

}  // namespace capstan::pipeline
