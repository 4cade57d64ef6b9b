#include "planner/model/nouns/operation.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kOperation[] = {
    row<&Operation::its_toolpath>("its_toolpath", kOptional),
    row<&Operation::its_tool_direction>("its_tool_direction", kOptional),
    plan_row<&Operation::process_properties>("process_properties", kOptional),
    plan_row<&Operation::its_broadcasts>("its_broadcasts", kOptional),
    plan_row<&Operation::last_modified_timestamp>("last_modified_timestamp", kOptional),
};
constexpr Attribute kMachiningOperation[] = {
    row<&MachiningOperation::its_id>("its_id", kRequired),
    row<&MachiningOperation::retract_plane>("retract_plane", kOptional, Unit::kLength),
    row<&MachiningOperation::start_point>("start_point", kOptional),
    row<&MachiningOperation::its_tool>("its_tool", kRequired),
    row<&MachiningOperation::its_technology>("its_technology", kRequired),
    row<&MachiningOperation::its_machine_functions>("its_machine_functions", kRequired),
};
constexpr Attribute kMillingMachiningOperation[] = {
    row<&MillingMachiningOperation::overcut_length>("overcut_length", kOptional, Unit::kLength),
};
constexpr Attribute kMillingTypeOperation[] = {
    row<&MillingTypeOperation::approach>("approach", kOptional),
    row<&MillingTypeOperation::retract>("retract", kOptional),
};
constexpr Attribute kFreeformOperation[] = {
    row<&FreeformOperation::its_machining_strategy>("its_machining_strategy", kOptional),
};
constexpr Attribute kTwo5dMillingOperation[] = {
    row<&Two5dMillingOperation::its_machining_strategy>("its_machining_strategy", kOptional),
};
constexpr Attribute kPlaneMilling[] = {
    row<&PlaneMilling::axial_cutting_depth>("axial_cutting_depth", kOptional, Unit::kLength),
    row<&PlaneMilling::allowance_bottom>("allowance_bottom", kOptional, Unit::kLength),
};
constexpr Attribute kSideMilling[] = {
    row<&SideMilling::axial_cutting_depth>("axial_cutting_depth", kOptional, Unit::kLength),
    row<&SideMilling::radial_cutting_depth>("radial_cutting_depth", kOptional, Unit::kLength),
    row<&SideMilling::allowance_side>("allowance_side", kOptional, Unit::kLength),
};
constexpr Attribute kBottomAndSideMilling[] = {
    row<&BottomAndSideMilling::axial_cutting_depth>("axial_cutting_depth", kOptional, Unit::kLength),
    row<&BottomAndSideMilling::radial_cutting_depth>("radial_cutting_depth", kOptional, Unit::kLength),
    row<&BottomAndSideMilling::allowance_side>("allowance_side", kOptional, Unit::kLength),
    row<&BottomAndSideMilling::allowance_bottom>("allowance_bottom", kOptional, Unit::kLength),
};
constexpr Attribute kDrillingTypeOperation[] = {
    row<&DrillingTypeOperation::cutting_depth>("cutting_depth", kOptional, Unit::kLength),
    row<&DrillingTypeOperation::previous_diameter>("previous_diameter", kOptional, Unit::kLength),
    row<&DrillingTypeOperation::dwell_time_bottom>("dwell_time_bottom", kOptional, Unit::kTime),
    row<&DrillingTypeOperation::feed_on_retract>("feed_on_retract", kOptional, Unit::kRatio),
    row<&DrillingTypeOperation::its_machining_strategy>("its_machining_strategy", kOptional),
};
constexpr Attribute kMultistepDrilling[] = {
    row<&MultistepDrilling::retract_distance>("retract_distance", kRequired, Unit::kLength),
    row<&MultistepDrilling::first_depth>("first_depth", kRequired, Unit::kLength),
    row<&MultistepDrilling::depth_of_step>("depth_of_step", kRequired, Unit::kLength),
    row<&MultistepDrilling::dwell_time_step>("dwell_time_step", kOptional, Unit::kTime),
};
constexpr Attribute kBoringOperation[] = {
    row<&BoringOperation::spindle_stop_at_bottom>("spindle_stop_at_bottom", kRequired),
    row<&BoringOperation::depth_of_testcut>("depth_of_testcut", kOptional, Unit::kLength),
    row<&BoringOperation::waiting_position>("waiting_position", kOptional),
};
constexpr Attribute kTapping[] = {
    row<&Tapping::compensation_chuck>("compensation_chuck", kRequired),
};
constexpr Attribute kThreadDrilling[] = {
    row<&ThreadDrilling::helical_movement_on_forward>("helical_movement_on_forward", kRequired),
};
constexpr Attribute kExtendedOperation[] = {
    plan_row<&ExtendedOperation::its_id>("its_id", kRequired),
    plan_row<&ExtendedOperation::description>("description", kRequired),
    plan_row<&ExtendedOperation::its_machine_functions>("its_machine_functions", kOptional),
    plan_row<&ExtendedOperation::its_technology>("its_technology", kOptional),
    plan_row<&ExtendedOperation::its_tool>("its_tool", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kOperation, "OPERATION", TypeId::kNone, true, true, kOperation},
    {TypeId::kMachiningOperation, "MACHINING_OPERATION", TypeId::kOperation, true, true, kMachiningOperation},
    {TypeId::kMillingMachiningOperation, "MILLING_MACHINING_OPERATION", TypeId::kMachiningOperation, true,
     true, kMillingMachiningOperation},
    {TypeId::kMillingTypeOperation, "MILLING_TYPE_OPERATION", TypeId::kMillingMachiningOperation, true, true,
     kMillingTypeOperation},
    {TypeId::kFreeformOperation, "FREEFORM_OPERATION", TypeId::kMillingTypeOperation, false, true,
     kFreeformOperation},
    {TypeId::kTwo5dMillingOperation, "TWO5D_MILLING_OPERATION", TypeId::kMillingTypeOperation, true, true,
     kTwo5dMillingOperation},
    {TypeId::kPlaneMilling, "PLANE_MILLING", TypeId::kTwo5dMillingOperation, true, true, kPlaneMilling},
    {TypeId::kPlaneRoughMilling, "PLANE_ROUGH_MILLING", TypeId::kPlaneMilling, false, true, {}},
    {TypeId::kPlaneFinishMilling, "PLANE_FINISH_MILLING", TypeId::kPlaneMilling, false, true, {}},
    {TypeId::kSideMilling, "SIDE_MILLING", TypeId::kTwo5dMillingOperation, true, true, kSideMilling},
    {TypeId::kSideRoughMilling, "SIDE_ROUGH_MILLING", TypeId::kSideMilling, false, true, {}},
    {TypeId::kSideFinishMilling, "SIDE_FINISH_MILLING", TypeId::kSideMilling, false, true, {}},
    {TypeId::kBottomAndSideMilling, "BOTTOM_AND_SIDE_MILLING", TypeId::kTwo5dMillingOperation, true, true,
     kBottomAndSideMilling},
    {TypeId::kBottomAndSideRoughMilling,
     "BOTTOM_AND_SIDE_ROUGH_MILLING",
     TypeId::kBottomAndSideMilling,
     false,
     true,
     {}},
    {TypeId::kBottomAndSideFinishMilling,
     "BOTTOM_AND_SIDE_FINISH_MILLING",
     TypeId::kBottomAndSideMilling,
     false,
     true,
     {}},
    {TypeId::kDrillingTypeOperation, "DRILLING_TYPE_OPERATION", TypeId::kMillingMachiningOperation, true,
     true, kDrillingTypeOperation},
    {TypeId::kDrillingOperation, "DRILLING_OPERATION", TypeId::kDrillingTypeOperation, true, true, {}},
    {TypeId::kDrilling, "DRILLING", TypeId::kDrillingOperation, false, true, {}},
    {TypeId::kCenterDrilling, "CENTER_DRILLING", TypeId::kDrillingOperation, false, true, {}},
    {TypeId::kCounterSinking, "COUNTER_SINKING", TypeId::kDrillingOperation, false, true, {}},
    {TypeId::kMultistepDrilling, "MULTISTEP_DRILLING", TypeId::kDrillingOperation, false, true,
     kMultistepDrilling},
    {TypeId::kBoringOperation, "BORING_OPERATION", TypeId::kDrillingTypeOperation, true, true,
     kBoringOperation},
    {TypeId::kBoring, "BORING", TypeId::kBoringOperation, false, true, {}},
    {TypeId::kReaming, "REAMING", TypeId::kBoringOperation, false, true, {}},
    {TypeId::kBackBoring, "BACK_BORING", TypeId::kDrillingTypeOperation, false, true, {}},
    {TypeId::kTapping, "TAPPING", TypeId::kDrillingTypeOperation, false, true, kTapping},
    {TypeId::kThreadDrilling, "THREAD_DRILLING", TypeId::kDrillingTypeOperation, false, true,
     kThreadDrilling},
    {TypeId::kFreeformRoughMilling, "FREEFORM_ROUGH_MILLING", TypeId::kFreeformOperation, false, false, {}},
    {TypeId::kFreeformFinishMilling, "FREEFORM_FINISH_MILLING", TypeId::kFreeformOperation, false, false, {}},
    {TypeId::kExtendedOperation, "EXTENDED_OPERATION", TypeId::kOperation, false, false, kExtendedOperation},
};

}  // namespace

std::span<const NounRow> operation_rows() { return kRows; }

}  // namespace capstan::model
