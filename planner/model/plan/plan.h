#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/decision/decision.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "planner/model/plan/resources/workholding.h"

namespace capstan::model {

/// A limit that stopped an optimised number from going further.
struct ActiveConstraint {
  std::string name;  ///< "spindle_torque", "tool_deflection", "maximum_feed_per_tooth", ...
  double value = 0.0, limit = 0.0;
  std::string unit;
  double shadow_price = 0.0;  ///< fraction of the objective (time or cost) saved per 1 % more of the limit
  double saves_s = 0.0;       ///< seconds of the step that 10 % more of the limit would save; 0: not known
  double at_rpm = 0.0;        ///< spindle speed at which the limit holds; 0: it does not depend on it
  friend bool operator==(const ActiveConstraint&, const ActiveConstraint&) = default;
};

/// Forces on the cutter: x along the feed, y to its left, z along the axis, away from the work. N.
struct AxisForces {
  double x_n = 0.0, y_n = 0.0, z_n = 0.0;
  friend bool operator==(const AxisForces&, const AxisForces&) = default;
};

/// A limit that held the feed along part of a path.
struct LimitAlongPath {
  std::string name;  ///< "peak_force", "axis_acceleration", ...
  double limit = 0.0;
  std::string unit;
  double share = 0.0;    ///< of the cutting time, in [0, 1]
  double saves_s = 0.0;  ///< seconds that 10 % more of this limit alone would save
  friend bool operator==(const LimitAlongPath&, const LimitAlongPath&) = default;
};

/// A limit that a planned step does not keep, where it is worst.
struct ExceededLimit {
  std::string name;                 ///< as ActiveConstraint's
  double value = 0.0, limit = 0.0;  ///< both 0: the load is outside what any formula tells
  std::string unit;
  std::optional<geometry::Vec3> at_mm;  ///< in the set-up's frame
  friend bool operator==(const ExceededLimit&, const ExceededLimit&) = default;
};

/// Peak loads of a step, the spread of the coefficients and a worn edge included.
struct StepLoads {
  double peak_force_n = 0.0, torque_nm = 0.0, power_w = 0.0, deflection_mm = 0.0, chip_thickness_mm = 0.0;
  double mrr_mm3_min = 0.0;
  AxisForces mean_force, peak_force;  ///< largest by amount over the path, each component by itself
  double wall_error_mm = 0.0;         ///< of the wall the step leaves, by bending; > 0: material is left
  double surface_rz_mm = 0.0;         ///< feed marks by geometry alone; 0: not computed
  double tool_life_min = 0.0;         ///< expected at these conditions; 0: not known
  double force_margin = 0.0;          ///< factor on the forces of a sharp edge with mean coefficients
  friend bool operator==(const StepLoads&, const StepLoads&) = default;
};

/// What planning computed for one executable step, beside what its nouns hold.
struct StepResult {
  Ref<Executable> step;                                ///< machining_workingstep or rapid_movement
  std::size_t setup = 0;                               ///< index into Plan::setups
  std::string cutter_id;                               ///< into Plan::cutters
  double axial_depth_mm = 0.0, radial_depth_mm = 0.0;  ///< as cut
  double vc_m_min = 0.0, fz_mm = 0.0, spindle_rpm = 0.0, feed_mm_min = 0.0;  ///< before the schedule
  bool flood = false, mist = false, through = false;
  double path_deviation_mm = 0.0;     ///< path_maximum_deviation: chords may leave the wanted path by this
  double contour_tolerance_mm = 0.0;  ///< the control may round corners by this; 0: its own path tolerance
  std::shared_ptr<const CutterPath> path;
  std::shared_ptr<const SectionSeries> sections;
  std::shared_ptr<const FeedSchedule> schedule;
  double cutting_s = 0.0, rapid_s = 0.0;
  StepLoads loads;
  std::vector<ActiveConstraint> active;
  std::vector<LimitAlongPath> held_by;       ///< of the feed schedule, largest share first
  std::vector<ExceededLimit> exceeded = {};  ///< limits that no feed keeps somewhere along the path
};

/// One clamping of the workpiece.
struct SetupResult {
  Ref<Setup> setup;
  std::string work_offset = "G54";
  double security_z_mm = 0.0;  ///< in the set-up's frame: rapids in XY happen here or above
  Workholding holding = {};
};

/// A feature that is not made as asked.
struct Unplanned {
  AnyRef feature;
  std::string reason;
  std::vector<std::string> needed_by = {};  ///< names of features that rest on it: they cannot be cut either
};

/// A default that nobody asked for by name, or an input with its identity.
struct Provenance {
  std::string what, value, source;  ///< e.g. "machine", "generic_vmc", "built-in default"
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// What is wrong with a plan or a program: a property of safety that does not hold.
struct Finding {
  int property = 0;  ///< number of the property
  std::string code;  ///< "CHK-GOUGE"
  Severity severity = Severity::kError;
  std::string step;       ///< persistent id of the workingstep; empty: whole plan
  long move = -1;         ///< move index in the path, or line of the program; -1 none
  std::string message;    ///< with the numbers
  bool unproved = false;  ///< it says what the check could not judge, not what is wrong
  friend bool operator==(const Finding&, const Finding&) = default;
};

/// The raw piece: a box (or, later, a mesh), in workpiece coordinates.
struct Stock {
  geometry::Box3 box;
  std::string source;                        ///< "given: BLOCK", "inferred from features", "--stock"
  std::optional<double> cylinder_radius_mm;  ///< about z through the box's centre
};

/// The whole plan, a value. `model` holds the nouns, the rest what was decided and computed.
struct Plan {
  Model model;
  Ref<Project> project;
  std::string file_name;  ///< as the user named it
  std::string header_description, header_time_stamp;
  std::vector<std::string> header_authors, header_organizations;
  std::vector<AnyRef> kept;  ///< instances that nothing references but the file had, in order
  Ledger ledger;
  Machine machine;
  WorkMaterial material;
  Stock stock;
  std::shared_ptr<const geometry::Mesh>
      target_mesh;              ///< freeform parts: the finished surface, workpiece frame
  std::vector<Cutter> cutters;  ///< used, by pocket; Cutter::pocket is the T number
  std::vector<SetupResult> setups;
  std::vector<StepResult> steps;  ///< in the order they are executed
  std::vector<Unplanned> unplanned;
  std::vector<Provenance> provenance;
};

/// The step's persistent id: its own, else its its_id, made unique by position.
[[nodiscard]] std::string step_id(const Plan& plan, const StepResult& step);
[[nodiscard]] const Cutter* find_cutter(const Plan& plan, std::string_view id);

}  // namespace capstan::model
