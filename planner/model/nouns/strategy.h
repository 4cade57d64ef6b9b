#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Machining, approach and retract strategies, technology and machine functions (ISO 14649-11).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct ToolDirection : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kToolDirection;
};

struct TwoAxes : ToolDirection {
  static constexpr TypeId kType = TypeId::kTwoAxes;
};

struct ThreeAxes : ToolDirection {
  static constexpr TypeId kType = TypeId::kThreeAxes;
};

struct Technology : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kTechnology;
  Real feedrate;  ///< mm/min, optional
  Enumerated<ToolReferencePoint> feedrate_reference;
};

struct MachineFunctions : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kMachineFunctions;
};

struct ToolDirectionForMilling : ToolDirection {  // abstract
  static constexpr TypeId kType = TypeId::kToolDirectionForMilling;
};

struct ThreeAxesTiltedTool : ToolDirectionForMilling {
  static constexpr TypeId kType = TypeId::kThreeAxesTiltedTool;
  Ref<Direction> tool_direction;
};

struct FiveAxesVarTiltYaw : ToolDirectionForMilling {
  static constexpr TypeId kType = TypeId::kFiveAxesVarTiltYaw;
};

struct FiveAxesConstTiltYaw : ToolDirectionForMilling {
  static constexpr TypeId kType = TypeId::kFiveAxesConstTiltYaw;
  Real tilt_angle;  ///< rad
  Real yaw_angle;   ///< rad
};

struct MillingTechnology : Technology {
  static constexpr TypeId kType = TypeId::kMillingTechnology;
  Real cutspeed;            ///< mm/min, optional
  Real spindle;             ///< 1/min, optional
  Real feedrate_per_tooth;  ///< mm, optional
  Boolean synchronize_spindle_with_feed;
  Boolean inhibit_feedrate_override;
  Boolean inhibit_spindle_override;
  Ref<AdaptiveControl> its_adaptive_control;  ///< optional
};

struct AdaptiveControl : Noun {
  static constexpr TypeId kType = TypeId::kAdaptiveControl;
};

struct MillingMachineFunctions : MachineFunctions {
  static constexpr TypeId kType = TypeId::kMillingMachineFunctions;
  Boolean coolant;
  Real coolant_pressure;  ///< N/mm2, optional
  Boolean mist;           ///< optional
  Boolean through_spindle_coolant;
  Real through_pressure;  ///< N/mm2, optional
  TextList axis_clamping;
  Boolean chip_removal;
  Ref<Direction> oriented_spindle_stop;     ///< optional
  Ref<ProcessModelList> its_process_model;  ///< optional
  RefList<PropertyParameter> other_functions;
  RefList<MachineAxisConstraint> axis_constraints;  ///< optional, not in ISO 14649
};

struct ProcessModelList : Noun {
  static constexpr TypeId kType = TypeId::kProcessModelList;
  RefList<ProcessModel> its_list;
};

struct ProcessModel : Noun {
  static constexpr TypeId kType = TypeId::kProcessModel;
  Text ini_data_file;
  Text its_type;
};

struct ApproachRetractStrategy : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kApproachRetractStrategy;
  Ref<Direction> tool_orientation;  ///< optional
};

struct PlungeStrategy : ApproachRetractStrategy {  // abstract
  static constexpr TypeId kType = TypeId::kPlungeStrategy;
};

struct PlungeToolaxis : PlungeStrategy {
  static constexpr TypeId kType = TypeId::kPlungeToolaxis;
};

struct PlungeRamp : PlungeStrategy {
  static constexpr TypeId kType = TypeId::kPlungeRamp;
  Real angle;  ///< rad
};

struct PlungeHelix : PlungeStrategy {
  static constexpr TypeId kType = TypeId::kPlungeHelix;
  Real radius;  ///< mm
  Real angle;   ///< rad
};

struct PlungeZigzag : PlungeStrategy {
  static constexpr TypeId kType = TypeId::kPlungeZigzag;
  Real angle;  ///< rad
  Real width;  ///< mm
};

struct AirStrategy : ApproachRetractStrategy {  // abstract
  static constexpr TypeId kType = TypeId::kAirStrategy;
};

struct ApRetractAngle : AirStrategy {
  static constexpr TypeId kType = TypeId::kApRetractAngle;
  Real angle;          ///< rad
  Real travel_length;  ///< mm
};

struct ApRetractTangent : AirStrategy {
  static constexpr TypeId kType = TypeId::kApRetractTangent;
  Real radius;  ///< mm
};

struct AlongPath : ApproachRetractStrategy {
  static constexpr TypeId kType = TypeId::kAlongPath;
  Ref<ToolpathList> path;
};

struct FreeformStrategy : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kFreeformStrategy;
  Enumerated<PathmodeType> pathmode;
  Enumerated<CutmodeType> cutmode;
  Ref<Tolerances> its_milling_tolerances;
  Real stepover;  ///< mm, optional
};

struct Tolerances : Noun {
  static constexpr TypeId kType = TypeId::kTolerances;
  Real chordal_tolerance;  ///< mm
  Real scallop_height;     ///< mm
};

struct UvStrategy : FreeformStrategy {
  static constexpr TypeId kType = TypeId::kUvStrategy;
  Ref<Direction> forward_direction;
  Ref<Direction> sideward_direction;
};

struct PlaneCcStrategy : FreeformStrategy {
  static constexpr TypeId kType = TypeId::kPlaneCcStrategy;
  Ref<Direction> its_plane_normal;
};

struct PlaneClStrategy : FreeformStrategy {
  static constexpr TypeId kType = TypeId::kPlaneClStrategy;
  Ref<Direction> its_plane_normal;
};

struct LeadingLineStrategy : FreeformStrategy {
  static constexpr TypeId kType = TypeId::kLeadingLineStrategy;
  Ref<BoundedCurve> its_line;
};

struct Two5dMillingStrategy : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kTwo5dMillingStrategy;
  Real overlap;                   ///< fraction, optional
  Boolean allow_multiple_passes;  ///< optional
};

struct UnidirectionalMilling : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kUnidirectionalMilling;
  Ref<Direction> feed_direction;    ///< optional
  Enumerated<CutmodeType> cutmode;  ///< optional
};

struct BidirectionalMilling : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kBidirectionalMilling;
  Ref<Direction> feed_direction;                                        ///< optional
  Enumerated<LeftOrRight> stepover_direction;                           ///< optional
  Enumerated<StrokeConnectionStrategy> its_stroke_connection_strategy;  ///< optional
};

struct ContourParallel : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kContourParallel;
  Enumerated<RotDirection> rotation_direction;  ///< optional
  Enumerated<CutmodeType> cutmode;              ///< optional
};

struct BidirectionalContour : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kBidirectionalContour;
  Ref<Direction> feed_direction;                ///< optional
  Enumerated<LeftOrRight> stepover_direction;   ///< optional
  Enumerated<RotDirection> rotation_direction;  ///< optional
  Enumerated<CutmodeType> spiral_cutmode;       ///< optional
};

struct ContourBidirectional : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kContourBidirectional;
  Ref<Direction> feed_direction;                ///< optional
  Enumerated<LeftOrRight> stepover_direction;   ///< optional
  Enumerated<RotDirection> rotation_direction;  ///< optional
  Enumerated<CutmodeType> spiral_cutmode;       ///< optional
};

struct ContourSpiral : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kContourSpiral;
  Enumerated<RotDirection> rotation_direction;  ///< optional
  Enumerated<CutmodeType> cutmode;              ///< optional
};

struct CenterMilling : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kCenterMilling;
};

struct ExplicitStrategy : Two5dMillingStrategy {
  static constexpr TypeId kType = TypeId::kExplicitStrategy;
};

struct DrillingTypeStrategy : Noun {
  static constexpr TypeId kType = TypeId::kDrillingTypeStrategy;
  Real reduced_cut_at_start;   ///< fraction, optional
  Real reduced_feed_at_start;  ///< fraction, optional
  Real depth_of_start;         ///< mm, optional
  Real reduced_cut_at_end;     ///< fraction, optional
  Real reduced_feed_at_end;    ///< fraction, optional
  Real depth_of_end;           ///< mm, optional
};

struct MachineAxisConstraint : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kMachineAxisConstraint;
  Text axis_identifier;
  Real axis_minimum;   ///< mm, optional
  Real axis_maximum;   ///< mm, optional
  Real angle_minimum;  ///< rad, optional; of a rotary axis
  Real angle_maximum;  ///< rad, optional; of a rotary axis
};

}  // namespace capstan::model
