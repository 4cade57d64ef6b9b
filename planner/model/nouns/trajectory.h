#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Toolpaths as application objects (ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct ToolpathList : Noun {
  static constexpr TypeId kType = TypeId::kToolpathList;
  OneOfList<Toolpath, NcFunction> its_list;  ///< functions among paths: ISO 10303-238, edition 4
};

struct Toolpath : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kToolpath;
  Boolean its_priority;
  Enumerated<ToolpathType> its_type;
  SelectValue its_speed;                               ///< optional
  Ref<Technology> its_technology;                      ///< optional
  Ref<MachineFunctions> its_machine_functions;         ///< optional
  Text its_id;                                         ///< optional, not in ISO 14649
  RefList<ProcessProperty> process_properties;         ///< optional, not in ISO 14649
  Ref<LastModifiedTimestamp> last_modified_timestamp;  ///< optional, not in ISO 14649
};

struct ToolpathSpeed : Noun {
  static constexpr TypeId kType = TypeId::kToolpathSpeed;
  Ref<BoundedCurve> speed;  ///< ISO 14649: a b_spline_curve
};

struct Feedstop : Toolpath {
  static constexpr TypeId kType = TypeId::kFeedstop;
  Real dwell;              ///< s
  Real dwell_revolutions;  ///< optional, not in ISO 14649; revolutions of the spindle, in place of dwell
};

struct Trajectory : Toolpath {  // abstract
  static constexpr TypeId kType = TypeId::kTrajectory;
  Boolean its_direction;                            ///< optional
  SelectValue its_material_removal_depth;           ///< mm, or a bounded curve; optional, not in ISO 14649
  SelectValue its_material_removal_overcut;         ///< mm, or a bounded curve; optional, not in ISO 14649
  Real its_material_removal_total_volume;           ///< mm3, optional, not in ISO 14649
  Ref<BoundedCurve> cross_section_area_parameters;  ///< optional, not in ISO 14649
  Ref<BoundedCurve> its_toolref_direction;          ///< optional, not in ISO 14649
  Real path_maximum_deviation;                      ///< mm, optional, not in ISO 14649
  Real tool_axis_maximum_deviation;                 ///< rad, optional, not in ISO 14649
  PathHandle path;                                  ///< optional, not in ISO 14649
  Ref<BoundedCurve> cross_section_area_flank_parameters;   ///< optional, not in ISO 14649
  Ref<BoundedCurve> cross_section_area_plunge_parameters;  ///< optional, not in ISO 14649
};

struct CutterLocationTrajectory : Trajectory {
  static constexpr TypeId kType = TypeId::kCutterLocationTrajectory;
  Ref<BoundedCurve> basiccurve;
  Ref<BoundedCurve> its_toolaxis;    ///< optional
  Ref<BoundedCurve> surface_normal;  ///< optional
};

struct CutterContactTrajectory : Trajectory {
  static constexpr TypeId kType = TypeId::kCutterContactTrajectory;
  OneOf<BoundedPcurve, CurveWithNormalVector> basiccurve;
  Ref<BoundedCurve> its_toolaxis;  ///< optional
  Enumerated<ContactType> its_contact_type;
};

struct AxisTrajectory : Trajectory {
  static constexpr TypeId kType = TypeId::kAxisTrajectory;
  TextList axis_list;
  RefList<BoundedCurve> commands;
};

struct ParameterisedPath : Toolpath {  // abstract
  static constexpr TypeId kType = TypeId::kParameterisedPath;
};

struct Connector : ParameterisedPath {  // abstract
  static constexpr TypeId kType = TypeId::kConnector;
};

struct ConnectSecplane : Connector {
  static constexpr TypeId kType = TypeId::kConnectSecplane;
  Ref<Direction> up_dir;    ///< optional
  Ref<Direction> down_dir;  ///< optional
};

struct ConnectDirect : Connector {
  static constexpr TypeId kType = TypeId::kConnectDirect;
};

struct ApproachLiftPath : ParameterisedPath {  // abstract
  static constexpr TypeId kType = TypeId::kApproachLiftPath;
  Ref<CartesianPoint> fix_point;
  Ref<Direction> fix_point_dir;  ///< optional
};

struct ApLiftPathAngle : ApproachLiftPath {
  static constexpr TypeId kType = TypeId::kApLiftPathAngle;
  Real angle;     ///< rad
  Real benddist;  ///< mm
};

struct ApLiftPathTangent : ApproachLiftPath {
  static constexpr TypeId kType = TypeId::kApLiftPathTangent;
  Real radius;  ///< mm
};

}  // namespace capstan::model
