#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Machining operations (ISO 14649-10 and -11; freeform_rough and -finish: ISO 10303-238).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct Operation : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kOperation;
  Ref<ToolpathList> its_toolpath;                      ///< optional
  Ref<ToolDirection> its_tool_direction;               ///< optional
  RefList<ProcessProperty> process_properties;         ///< optional, not in ISO 14649
  RefList<Broadcast> its_broadcasts;                   ///< optional, not in ISO 14649
  Ref<LastModifiedTimestamp> last_modified_timestamp;  ///< optional, not in ISO 14649
};

struct MachiningOperation : Operation {  // abstract
  static constexpr TypeId kType = TypeId::kMachiningOperation;
  Text its_id;
  Real retract_plane;               ///< mm, optional
  Ref<CartesianPoint> start_point;  ///< optional
  Ref<MachiningTool> its_tool;
  Ref<Technology> its_technology;
  Ref<MachineFunctions> its_machine_functions;
};

struct MillingMachiningOperation : MachiningOperation {  // abstract
  static constexpr TypeId kType = TypeId::kMillingMachiningOperation;
  Real overcut_length;  ///< mm, optional
};

struct MillingTypeOperation : MillingMachiningOperation {  // abstract
  static constexpr TypeId kType = TypeId::kMillingTypeOperation;
  Ref<ApproachRetractStrategy> approach;  ///< optional
  Ref<ApproachRetractStrategy> retract;   ///< optional
};

struct FreeformOperation : MillingTypeOperation {
  static constexpr TypeId kType = TypeId::kFreeformOperation;
  Ref<FreeformStrategy> its_machining_strategy;  ///< optional
};

struct Two5dMillingOperation : MillingTypeOperation {  // abstract
  static constexpr TypeId kType = TypeId::kTwo5dMillingOperation;
  Ref<Two5dMillingStrategy> its_machining_strategy;  ///< optional
};

struct PlaneMilling : Two5dMillingOperation {  // abstract
  static constexpr TypeId kType = TypeId::kPlaneMilling;
  Real axial_cutting_depth;  ///< mm, optional
  Real allowance_bottom;     ///< mm, optional
};

struct PlaneRoughMilling : PlaneMilling {
  static constexpr TypeId kType = TypeId::kPlaneRoughMilling;
};

struct PlaneFinishMilling : PlaneMilling {
  static constexpr TypeId kType = TypeId::kPlaneFinishMilling;
};

struct SideMilling : Two5dMillingOperation {  // abstract
  static constexpr TypeId kType = TypeId::kSideMilling;
  Real axial_cutting_depth;   ///< mm, optional
  Real radial_cutting_depth;  ///< mm, optional
  Real allowance_side;        ///< mm, optional
};

struct SideRoughMilling : SideMilling {
  static constexpr TypeId kType = TypeId::kSideRoughMilling;
};

struct SideFinishMilling : SideMilling {
  static constexpr TypeId kType = TypeId::kSideFinishMilling;
};

struct BottomAndSideMilling : Two5dMillingOperation {  // abstract
  static constexpr TypeId kType = TypeId::kBottomAndSideMilling;
  Real axial_cutting_depth;   ///< mm, optional
  Real radial_cutting_depth;  ///< mm, optional
  Real allowance_side;        ///< mm, optional
  Real allowance_bottom;      ///< mm, optional
};

struct BottomAndSideRoughMilling : BottomAndSideMilling {
  static constexpr TypeId kType = TypeId::kBottomAndSideRoughMilling;
};

struct BottomAndSideFinishMilling : BottomAndSideMilling {
  static constexpr TypeId kType = TypeId::kBottomAndSideFinishMilling;
};

struct DrillingTypeOperation : MillingMachiningOperation {  // abstract
  static constexpr TypeId kType = TypeId::kDrillingTypeOperation;
  Real cutting_depth;                                ///< mm, optional
  Real previous_diameter;                            ///< mm, optional
  Real dwell_time_bottom;                            ///< s, optional
  Real feed_on_retract;                              ///< fraction, optional
  Ref<DrillingTypeStrategy> its_machining_strategy;  ///< optional
};

struct DrillingOperation : DrillingTypeOperation {  // abstract
  static constexpr TypeId kType = TypeId::kDrillingOperation;
};

struct Drilling : DrillingOperation {
  static constexpr TypeId kType = TypeId::kDrilling;
};

struct CenterDrilling : DrillingOperation {
  static constexpr TypeId kType = TypeId::kCenterDrilling;
};

struct CounterSinking : DrillingOperation {
  static constexpr TypeId kType = TypeId::kCounterSinking;
};

struct MultistepDrilling : DrillingOperation {
  static constexpr TypeId kType = TypeId::kMultistepDrilling;
  Real retract_distance;  ///< mm
  Real first_depth;       ///< mm
  Real depth_of_step;     ///< mm
  Real dwell_time_step;   ///< s, optional
};

struct BoringOperation : DrillingTypeOperation {  // abstract
  static constexpr TypeId kType = TypeId::kBoringOperation;
  Boolean spindle_stop_at_bottom;
  Real depth_of_testcut;                 ///< mm, optional
  Ref<CartesianPoint> waiting_position;  ///< optional
};

struct Boring : BoringOperation {
  static constexpr TypeId kType = TypeId::kBoring;
};

struct Reaming : BoringOperation {
  static constexpr TypeId kType = TypeId::kReaming;
};

struct BackBoring : DrillingTypeOperation {
  static constexpr TypeId kType = TypeId::kBackBoring;
};

struct Tapping : DrillingTypeOperation {
  static constexpr TypeId kType = TypeId::kTapping;
  Boolean compensation_chuck;
};

struct ThreadDrilling : DrillingTypeOperation {
  static constexpr TypeId kType = TypeId::kThreadDrilling;
  Boolean helical_movement_on_forward;
};

struct FreeformRoughMilling : FreeformOperation {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFreeformRoughMilling;
};

struct FreeformFinishMilling : FreeformOperation {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFreeformFinishMilling;
};

struct ExtendedOperation : Operation {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kExtendedOperation;
  Text its_id;
  Text description;
  Ref<MachineFunctions> its_machine_functions;  ///< optional
  Ref<Technology> its_technology;               ///< optional
  Ref<MachiningTool> its_tool;                  ///< optional
};

}  // namespace capstan::model
