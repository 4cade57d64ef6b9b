#pragma once

#include <string>
#include <vector>

#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/decision/decision.h"
#include "planner/model/plan/requirement.h"

namespace capstan::model {

enum class StrategyKind : std::uint8_t {
  kNone,
  kBidirectional,
  kUnidirectional,
  kContourParallel,
  kContourSpiral,
  kContourBidirectional,
  kCenterMilling,
};

/// One step that a rule proposes for a feature.
struct ProposedStep {
  AnyRef feature;
  TypeId operation = TypeId::kNone;  ///< concrete operation kind, e.g. kDrilling
  std::string name;                  ///< its_id of the workingstep
  ToolRequirement tool;
  StrategyKind strategy = StrategyKind::kNone;
  bool climb = true;
  double allowance_side_mm = 0.0, allowance_bottom_mm = 0.0;
  double start_diameter_mm = 0.0;  ///< hole already there (previous_diameter)
  double depth_mm = 0.0;           ///< drilling family: depth of the full diameter below the feature's top
  bool peck = false;
  double peck_retract_mm = 0.0;  ///< up after each peck, which breaks the chip; 0: out of the hole
  double dwell_s = 0.0;
  bool coolant = true;
  bool coolant_through = false;
  bool lock_override = false;  ///< feed and spindle overrides are inhibited: rigid tapping, thread milling
  /// Material that a wider cutter left: only what this diameter did not reach is cut; 0: everything.
  double rest_of_diameter_mm = 0.0;
  double axial_depth_mm = 0.0;  ///< per level, where the rule fixes it: thin walls, edge breaks; 0: chosen
  bool one_level = false;       ///< at the bottom only: floors finished apart from their walls
  Reason why;
  std::vector<std::size_t> after;  ///< indices in the same proposal that must come before
  int priority = 0;                ///< alternatives: lower is tried first
};

/// What rules say about one feature: alternatives in order of preference, or why there is none.
struct Proposal {
  AnyRef feature;
  std::vector<std::vector<ProposedStep>> chains;
  std::size_t failed_before = 0;  ///< of these, at the end: those that went badly when they were cut before
  std::vector<Rejected> rejected;
  std::string cannot;  ///< set when no chain is proposed: the reason, for people
};

/// A cutter that meets a requirement, with start values, ranked.
struct Candidate {
  Cutter cutter;
  double vc_m_min = 0.0, fz_mm = 0.0;
  double score = 0.0;        ///< lower is better
  double estimated_s = 0.0;  ///< of cutting, its tool's cost as time included; no change, no loading
  Reason why;
  friend bool operator==(const Candidate&, const Candidate&) = default;
};
struct Selection {
  std::vector<Candidate> ranked;
  std::vector<Rejected> rejected;
  std::string would_fit;  ///< when nothing fits: what would
};

}  // namespace capstan::model
