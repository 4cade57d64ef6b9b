#pragma once

#include <string>
#include <vector>

#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter.h"
#include "planner/model/plan/decision.h"

namespace capstan::model {

/// What an operation needs of its tool. A zero means "does not matter".
struct ToolRequirement {
  std::vector<CutterClass> classes;  ///< in order of preference
  double diameter_min_mm = 0.0, diameter_max_mm = 0.0;
  double diameter_exact_mm = 0.0;  ///< drills, reamers, taps: this size (within diameter_tolerance_mm)
  double diameter_tolerance_mm = 0.0;
  double reach_mm = 0.0;              ///< usable length at least
  double depth_of_cut_mm = 0.0;       ///< flute length at least
  double corner_radius_max_mm = 0.0;  ///< with corner_radius_limited
  bool corner_radius_limited = false;
  double corner_radius_exact_mm = -1.0;  ///< >= 0: ball or bull of this radius
  bool centre_cutting = false;           ///< or a ramp the tool allows
  double point_angle_rad = 0.0;
  double thread_pitch_mm = 0.0;
  double thread_size_mm = 0.0;                                    ///< nominal, thread mills and taps
  double taper_angle_rad = 0.0;                                   ///< tapered end mills: half angle
  double cutting_width_min_mm = 0.0, cutting_width_max_mm = 0.0;  ///< side mills, heads of T-slot cutters
  double neck_diameter_max_mm = 0.0;  ///< what must pass above the head, over `reach_mm`
  double neck_step_min_mm = 0.0;     ///< head less neck, on the diameter, over `reach_mm`: undercuts in holes
  double tip_diameter_max_mm = 0.0;  ///< flat at the tip at most: what stands below a cone stays
  double flute_length_min_mm = 0.0;  ///< walls cut in one depth: flutes at least
  bool coolant_through = false;
  bool left_hand = false;   ///< taps of left-hand threads
  std::string thread_form;  ///< "M", "UN"; empty: any of the pitch
  std::string words;        ///< "a 6 mm end mill with 22 mm reach"
  bool operator==(const ToolRequirement&) const = default;
};

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
  double dwell_s = 0.0;
  bool coolant = true;
  bool coolant_through = false;
  bool lock_override = false;  ///< feed and spindle overrides are inhibited: rigid tapping, thread milling
  /// Material that a wider cutter left: only what this diameter did not reach is cut; 0: everything.
  double rest_of_diameter_mm = 0.0;
  double axial_depth_mm = 0.0;  ///< per level, where the rule fixes it: thin walls, edge breaks; 0: chosen
  bool one_level = false;       ///< at the bottom only: floors finished apart from their walls
  bool from_below = false;      ///< back boring, back countersinking
  double finish_ra_um = 0.0;    ///< surface that this step must leave; 0: none asked
  Reason why;
  std::vector<std::size_t> after;  ///< indices in the same proposal that must come before
  int priority = 0;                ///< alternatives: lower is tried first
};

/// What rules say about one feature: alternatives in order of preference, or why there is none.
struct Proposal {
  AnyRef feature;
  std::vector<std::vector<ProposedStep>> chains;
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
};
struct Selection {
  std::vector<Candidate> ranked;
  std::vector<Rejected> rejected;
  std::string would_fit;  ///< when nothing fits: what would
};

/// A case as planning uses it: what was cut once, near to what is asked.
struct Precedent {
  std::string case_id;
  double distance = 0.0;
  int neighbours = 0;
  std::string provenance;  ///< "measured", "simulated", "entered"
  double vc_m_min = 0.0, fz_mm = 0.0, ap_mm = 0.0, ae_mm = 0.0;
};

}  // namespace capstan::model
