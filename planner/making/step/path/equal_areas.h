#pragma once

#include <map>
#include <optional>
#include <vector>

#include "planner/ground/memo/memo.h"
#include "planner/making/step/path/attempt.h"
#include "planner/making/step/path/strategy_choice.h"

// Areas that are equal but for their place: which way of clearing is quickest is found out for the first.

namespace capstan::step {

/// What a choice between ways of clearing an area goes by, less its place: shape, cutter, cut and the exact
/// stock around it. Nothing where the area is open, walls, clamps or a case base bear on it, or the exact
/// stock is lost: then each area is asked anew.
[[nodiscard]] std::optional<memo::Key> key_of_area(const PlanSoFar& p, const draft::StepDraft& step,
                                                   const model::Candidate* candidate, bool inwards,
                                                   const std::optional<ConstantCut>& constant,
                                                   const Means& means);

/// The choices of one planning by their areas.
class EqualAreas {
 public:
  struct Choice {
    Clearing way = Clearing::kOutwards;
    double seconds = 0.0;
    memo::Key path;  ///< in its own frame
    std::vector<model::Rejected> lost;
  };
  [[nodiscard]] const Choice* find(const memo::Key& area) const;
  void keep(const memo::Key& area, Choice choice) { known_.insert_or_assign(area, std::move(choice)); }
  /// Whether a cut, made in that way for another area, is the one that was chosen.
  [[nodiscard]] static bool same(const Choice& choice, const MeasuredCut& cut, std::optional<double> seconds);
  [[nodiscard]] static memo::Key key_of_path(const MeasuredCut& cut);

 private:
  std::map<memo::Key, Choice> known_;
};

}  // namespace capstan::step
