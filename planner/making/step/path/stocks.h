#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/memo/memo.h"
#include "planner/making/draft/draft.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/model/plan/plan.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"

// The in-process workpiece of each set-up.

namespace capstan::step {

/// Identifies a set-up across tries: its noun and the orientation of the workpiece. The number of a set-up
/// does not, because tries order set-ups anew. The noun alone does not, because a try that makes other
/// set-ups gives them the same nouns.
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
  /// `left_out` are steps that are not made, `known` the cutters of earlier tries. All are referred to, also
  /// `memo`, which may be null: sections along the same path through the same material are taken from it.
  Stocks(const model::Stock& raw, const std::vector<draft::SetupDraft>& setups,
         const std::vector<draft::StepDraft>& steps, const std::set<model::AnyRef>& left_out,
         const SmallestCutters& known, memo::Memo* memo)
      : raw_(raw),
        setups_(setups),
        steps_(steps),
        left_out_(left_out),
        known_(known),
        memo_(memo),
        maps_(setups.size()),
        patches_(setups.size()),
        smallest_(setups.size()),
        exact_(setups.size()) {}

  /// The stock of a set-up. When the set-up changes, the material that the others removed since is
  /// subtracted.
  [[nodiscard]] stock::HeightMap& of(std::size_t setup);

  /// The state of a set-up's stock, to restore it after a cut that is tried and not kept: the number of
  /// patches so far and the exact stock's mark.
  struct Before {
    std::size_t patches = 0;
    stock::PlanarStock::Mark exact;
  };
  [[nodiscard]] Before before(std::size_t setup);
  /// Needs  what `before` gave for this set-up since the last `keep`.
  void put_back(std::size_t setup, const Before& before);
  /// As `put_back`; gives what was undone, so that `put_in` can do it again without cutting.
  struct Undone {
    std::vector<stock::Patch> patches;  ///< of the map after its cuts, youngest first
    stock::PlanarStock::Undone exact;
  };
  [[nodiscard]] Undone take_out(std::size_t setup, const Before& before);
  /// Needs  the stock of this set-up as `take_out` left it.
  void put_in(std::size_t setup, Undone undone);
  /// Makes the cuts so far in a set-up permanent.
  void keep(std::size_t setup);

  /// Sections are sampled by the cells of the maps, and these by the smallest cutter of the set-up: that of
  /// the steps as they are kept at last, for a plan that is read again has these only. Whether the plan is to
  /// be made again for that, with these cutters.
  struct OtherCells {
    SmallestCutters cutters;
    bool again = false;
  };
  [[nodiscard]] OtherCells other_cells() const;

  /// Measures the sections along a step's path and removes the cut from the stock. Flat cutters are measured
  /// by exact geometry, as long as the exact stock can represent all cuts of the set-up and the height map
  /// removes the same volume in each step. Other cutters are measured on the height map. Late binding
  /// measures too: sections that a file states are compared with these.
  /// Fails  as engagement::measure; then nothing was cut.
  [[nodiscard]] Result<engagement::Measurement> measure(std::size_t setup, const model::CutterPath& path,
                                                        const model::Cutter& cutter);
  /// What of the exact stock the sections of a flat cutter depend on that stays within a box, which is the
  /// set-up's, seen from `origin`; nothing where the exact stock is lost.
  [[nodiscard]] std::optional<stock::PlanarPart> part(std::size_t setup, const geometry::Box3& cut,
                                                      geometry::Vec2 origin, const model::Cutter& cutter);
  /// Removes a cut that nobody asks anything of.
  void cut(std::size_t setup, const model::CutterPath& path, const model::Cutter& cutter);

 private:
  [[nodiscard]] double smallest(std::size_t setup) const;
  [[nodiscard]] double cell(std::size_t setup, double smallest_mm) const;

  const model::Stock& raw_;
  const std::vector<draft::SetupDraft>& setups_;
  const std::vector<draft::StepDraft>& steps_;
  const std::set<model::AnyRef>& left_out_;
  const SmallestCutters& known_;
  memo::Memo* memo_;
  std::size_t last_ = static_cast<std::size_t>(-1);
  std::vector<std::optional<stock::HeightMap>> maps_;
  std::vector<std::vector<stock::Patch>> patches_;        ///< of the maps before they were cut, oldest first
  std::vector<double> smallest_;                          ///< cutter that each map was made for, mm
  std::vector<std::optional<stock::PlanarStock>> exact_;  ///< beside the maps; lost when it cannot follow
};

/// Height of the highest material over a feature, set-up frame.
[[nodiscard]] double top_over(const stock::HeightMap& map, const toolpath::PathJob& job);

}  // namespace capstan::step
