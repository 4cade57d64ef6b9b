#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {

/// A holder of the shop, which tools stand in.
struct ShopHolder {
  std::string id;
  double shank_mm = 0.0;                       ///< the thickest that it takes; 0: not stated
  std::vector<model::HolderSegment> segments;  ///< from its face up to the gage line
};

/// The holders of a shop, and those that a tool without a holder of its own gets: the first that takes its
/// shank.
struct ShopHolders {
  std::vector<ShopHolder> all;
  std::vector<std::string> by_default;  ///< ids; empty: only tools that name one get it
  std::string source;                   ///< "shop.yaml: holders"
};

/// Reads them, in mm:
///
///     default: [ER16, ER32]         # or one
///     list:
///       - {id: ER32, shank: 20, holder: [{height: 20, lower_diameter: 40, upper_diameter: 50}]}
///
/// Fails  DATA-* for the form and for sizes that no holder has, NAME-UNKNOWN for a default that the list has
///        not, each with file and line; all are put into `faults`.
[[nodiscard]] ShopHolders read_holders(const Node& node, const std::string& file,
                                       std::vector<Diagnostic>& faults);

/// Gives the tool its holder: the one that its `holder_id` names where it has no outline of its own, else
/// the first default that takes its shank. A tool whose holder, or the holder's diameter, its list states
/// keeps it. Where its length was assumed, it is now stick-out and holder.
/// Returns the holder; null: the tool stays as it is.
const ShopHolder* give_holder(model::Cutter& cutter, const ShopHolders& holders);

/// The same for a whole list. Notes how many got which, and how many shanks no default takes (SHOP-HOLDER).
void give_holders(std::vector<model::Cutter>& library, const ShopHolders& holders, Job& job);

}  // namespace capstan::tooling
