#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Machining tools (ISO 14649-111; tool_usage: ISO 10303-238).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct MachiningTool : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kMachiningTool;
  Text its_id;
  Ref<ToolUsage> its_usage;  ///< optional, not in ISO 14649
};

struct TouchProbe : MachiningTool {
  static constexpr TypeId kType = TypeId::kTouchProbe;
  Real ball_radius;              ///< mm, optional, not in ISO 14649
  Real overall_assembly_length;  ///< mm, optional, not in ISO 14649
  Real stylus_diameter;          ///< mm, optional, not in ISO 14649
};

struct CuttingTool : MachiningTool {  // abstract
  static constexpr TypeId kType = TypeId::kCuttingTool;
  Ref<ToolBody> its_tool_body;
  RefList<CuttingComponent> its_cutting_edge;
  Real overall_assembly_length;  ///< mm, optional
};

struct ToolBody : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kToolBody;
};

struct CuttingComponent : Noun {
  static constexpr TypeId kType = TypeId::kCuttingComponent;
  Real tool_offset_length;                               ///< mm
  Ref<Material> its_material;                            ///< optional
  Ref<CuttingEdgeTechnologicalData> technological_data;  ///< optional
  Real expected_tool_life;                               ///< s, optional
  Ref<Technology> its_technology;                        ///< optional
};

struct CuttingEdgeTechnologicalData : Noun {
  static constexpr TypeId kType = TypeId::kCuttingEdgeTechnologicalData;
  Real cutting_angle;  ///< rad, optional
  Real free_angle;     ///< rad, optional
  Real aux_angle;      ///< rad, optional
};

struct MillingCuttingTool : CuttingTool {
  static constexpr TypeId kType = TypeId::kMillingCuttingTool;
  Ref<Direction> direction_for_spindle_orientation;   ///< optional
  Real tool_holder_diameter_for_spindle_orientation;  ///< mm, optional
};

struct MillingToolBody : ToolBody {  // abstract
  static constexpr TypeId kType = TypeId::kMillingToolBody;
  Ref<MillingToolDimension> dimension;
  Integer number_of_teeth;       ///< optional
  Enumerated<Hand> hand_of_cut;  ///< optional
  Boolean coolant_through_tool;  ///< optional
  Real pilot_length;             ///< mm, optional
};

struct MillingToolDimension : Noun {
  static constexpr TypeId kType = TypeId::kMillingToolDimension;
  Real diameter;                  ///< mm
  Real tool_top_angle;            ///< rad, optional
  Real tool_circumference_angle;  ///< rad, optional
  Real cutting_edge_length;       ///< mm, optional
  Real edge_radius;               ///< mm, optional
  Real edge_center_vertical;      ///< mm, optional
  Real edge_center_horizontal;    ///< mm, optional
};

struct CenterDrill : MillingToolBody {
  static constexpr TypeId kType = TypeId::kCenterDrill;
};

struct Countersink : MillingToolBody {
  static constexpr TypeId kType = TypeId::kCountersink;
  Real countersink_radius;        ///< mm, optional
  Real minimum_cutting_diameter;  ///< mm, optional, not in ISO 14649
  Real maximum_usable_length;     ///< mm, optional, not in ISO 14649
};

struct BacksideCountersink : Countersink {
  static constexpr TypeId kType = TypeId::kBacksideCountersink;
};

struct Drill : MillingToolBody {  // abstract
  static constexpr TypeId kType = TypeId::kDrill;
};

struct TwistDrill : Drill {
  static constexpr TypeId kType = TypeId::kTwistDrill;
};

struct TaperedDrill : TwistDrill {
  static constexpr TypeId kType = TypeId::kTaperedDrill;
  Real taper_angle;  ///< rad, optional
};

struct SpadeDrill : Drill {
  static constexpr TypeId kType = TypeId::kSpadeDrill;
};

struct MillingCutter : MillingToolBody {  // abstract
  static constexpr TypeId kType = TypeId::kMillingCutter;
};

struct Facemill : MillingCutter {
  static constexpr TypeId kType = TypeId::kFacemill;
  Real tool_cutting_edge_angle;  ///< rad, optional, not in ISO 14649
};

struct Endmill : MillingCutter {
  static constexpr TypeId kType = TypeId::kEndmill;
  Real tool_cutting_edge_angle;  ///< rad, optional, not in ISO 14649
};

struct TaperedEndmill : Endmill {
  static constexpr TypeId kType = TypeId::kTaperedEndmill;
  Real taper_angle;  ///< rad, optional
};

struct BallEndmill : Endmill {
  static constexpr TypeId kType = TypeId::kBallEndmill;
};

struct BullnoseEndmill : Endmill {
  static constexpr TypeId kType = TypeId::kBullnoseEndmill;
};

struct TSlotMill : MillingCutter {
  static constexpr TypeId kType = TypeId::kTSlotMill;
  Real cutting_thickness;  ///< mm, optional
};

struct DovetailMill : MillingCutter {
  static constexpr TypeId kType = TypeId::kDovetailMill;
  Real included_angle;  ///< rad, optional
};

struct WoodruffKeyseatMill : MillingCutter {
  static constexpr TypeId kType = TypeId::kWoodruffKeyseatMill;
  Real cutter_width;  ///< mm, optional
};

struct SideMill : MillingCutter {
  static constexpr TypeId kType = TypeId::kSideMill;
  Real cutter_width;  ///< mm, optional
};

struct ThreadMill : MillingCutter {
  static constexpr TypeId kType = TypeId::kThreadMill;
  Text thread_form_type;  ///< optional, not in ISO 14649
  Real thread_size;       ///< mm, optional, not in ISO 14649
  Real thread_pitch;      ///< mm, optional, not in ISO 14649
};

struct Tap : MillingToolBody {
  static constexpr TypeId kType = TypeId::kTap;
  Text thread_form_type;    ///< optional, not in ISO 14649
  Real thread_size;         ///< mm, optional, not in ISO 14649
  Real thread_pitch;        ///< mm, optional, not in ISO 14649
  Real taper_thread_count;  ///< optional, not in ISO 14649
};

struct TaperedTap : Tap {
  static constexpr TypeId kType = TypeId::kTaperedTap;
  Real taper_angle;  ///< rad, optional
};

struct CombinedDrillAndTap : Tap {
  static constexpr TypeId kType = TypeId::kCombinedDrillAndTap;
  Real drill_length;  ///< mm, optional
};

struct MillingThreadingTool : MillingToolBody {
  static constexpr TypeId kType = TypeId::kMillingThreadingTool;
};

struct Counterbore : MillingToolBody {
  static constexpr TypeId kType = TypeId::kCounterbore;
};

struct BacksideCounterbore : Counterbore {
  static constexpr TypeId kType = TypeId::kBacksideCounterbore;
};

struct Reamer : MillingToolBody {
  static constexpr TypeId kType = TypeId::kReamer;
  Real taper_length;  ///< mm, optional, not in ISO 14649
};

struct TaperedReamer : Reamer {
  static constexpr TypeId kType = TypeId::kTaperedReamer;
  Real taper_angle;  ///< rad, optional
};

struct CombinedDrillAndReamer : Reamer {
  static constexpr TypeId kType = TypeId::kCombinedDrillAndReamer;
  Real drill_length;  ///< mm, optional
};

struct BoringTool : MillingToolBody {
  static constexpr TypeId kType = TypeId::kBoringTool;
  Boolean retract_movement_forbidden;  ///< optional, not in ISO 14649
};

struct UserDefinedTool : MillingToolBody {
  static constexpr TypeId kType = TypeId::kUserDefinedTool;
  Text identifier;
  Real taper_angle;      ///< rad, optional, not in ISO 14649; as ISO 10303-238 counts it
  Real tip_outer_angle;  ///< rad, optional, not in ISO 14649; as ISO 10303-238 counts it
};

struct ToolUsage : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kToolUsage;
  Text its_id;
  Text its_position;                         ///< optional
  Text its_carousel;                         ///< optional
  Ref<Workpiece> its_product;                ///< optional
  Text its_library_reference;                ///< optional
  Ref<Axis2Placement3d> gage_placement;      ///< optional
  Ref<Axis2Placement3d> tool_end_placement;  ///< optional
  Text description;                          ///< optional
  Text its_library_source;                   ///< optional; where its_library_reference is defined
};

/// A drill of no kind named here: ISO 10303-238's drilling_cutting_tool itself.
struct GeneralDrill : Drill {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kGeneralDrill;
};

struct Spotdrill : Drill {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSpotdrill;
};

struct StepDrill : Drill {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kStepDrill;
  RealList diameters;    ///< mm; from the tip up
  RealList step_length;  ///< mm
};

struct Shouldermill : MillingCutter {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kShouldermill;
};

struct ProfiledEndMill : Endmill {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kProfiledEndMill;
};

}  // namespace capstan::model
