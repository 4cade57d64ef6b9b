#include "planner/model/nouns/tool.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kMachiningTool[] = {
    row<&MachiningTool::its_id>("its_id", kRequired),
    plan_row<&MachiningTool::its_usage>("its_usage", kOptional),
};
constexpr Attribute kCuttingTool[] = {
    row<&CuttingTool::its_tool_body>("its_tool_body", kRequired),
    row<&CuttingTool::its_cutting_edge>("its_cutting_edge", kRequired),
    row<&CuttingTool::overall_assembly_length>("overall_assembly_length", kOptional, Unit::kLength),
};
constexpr Attribute kCuttingComponent[] = {
    row<&CuttingComponent::tool_offset_length>("tool_offset_length", kRequired, Unit::kLength),
    row<&CuttingComponent::its_material>("its_material", kOptional),
    row<&CuttingComponent::technological_data>("technological_data", kOptional),
    row<&CuttingComponent::expected_tool_life>("expected_tool_life", kOptional, Unit::kTime),
    row<&CuttingComponent::its_technology>("its_technology", kOptional),
};
constexpr Attribute kCuttingEdgeTechnologicalData[] = {
    row<&CuttingEdgeTechnologicalData::cutting_angle>("cutting_angle", kOptional, Unit::kAngle),
    row<&CuttingEdgeTechnologicalData::free_angle>("free_angle", kOptional, Unit::kAngle),
    row<&CuttingEdgeTechnologicalData::aux_angle>("aux_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kMillingCuttingTool[] = {
    row<&MillingCuttingTool::direction_for_spindle_orientation>("direction_for_spindle_orientation",
                                                                kOptional),
    row<&MillingCuttingTool::tool_holder_diameter_for_spindle_orientation>(
        "tool_holder_diameter_for_spindle_orientation", kOptional, Unit::kLength),
};
constexpr Attribute kMillingToolBody[] = {
    row<&MillingToolBody::dimension>("dimension", kRequired),
    row<&MillingToolBody::number_of_teeth>("number_of_teeth", kOptional),
    row<&MillingToolBody::hand_of_cut>("hand_of_cut", kOptional),
    row<&MillingToolBody::coolant_through_tool>("coolant_through_tool", kOptional),
    row<&MillingToolBody::pilot_length>("pilot_length", kOptional, Unit::kLength),
};
constexpr Attribute kMillingToolDimension[] = {
    row<&MillingToolDimension::diameter>("diameter", kRequired, Unit::kLength),
    row<&MillingToolDimension::tool_top_angle>("tool_top_angle", kOptional, Unit::kAngle),
    row<&MillingToolDimension::tool_circumference_angle>("tool_circumference_angle", kOptional, Unit::kAngle),
    row<&MillingToolDimension::cutting_edge_length>("cutting_edge_length", kOptional, Unit::kLength),
    row<&MillingToolDimension::edge_radius>("edge_radius", kOptional, Unit::kLength),
    row<&MillingToolDimension::edge_center_vertical>("edge_center_vertical", kOptional, Unit::kLength),
    row<&MillingToolDimension::edge_center_horizontal>("edge_center_horizontal", kOptional, Unit::kLength),
};
constexpr Attribute kCountersink[] = {
    row<&Countersink::countersink_radius>("countersink_radius", kOptional, Unit::kLength),
    plan_row<&Countersink::minimum_cutting_diameter>("minimum_cutting_diameter", kOptional, Unit::kLength),
    plan_row<&Countersink::maximum_usable_length>("maximum_usable_length", kOptional, Unit::kLength),
};
constexpr Attribute kTaperedDrill[] = {
    row<&TaperedDrill::taper_angle>("taper_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kTaperedEndmill[] = {
    row<&TaperedEndmill::taper_angle>("taper_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kTSlotMill[] = {
    row<&TSlotMill::cutting_thickness>("cutting_thickness", kOptional, Unit::kLength),
};
constexpr Attribute kDovetailMill[] = {
    row<&DovetailMill::included_angle>("included_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kWoodruffKeyseatMill[] = {
    row<&WoodruffKeyseatMill::cutter_width>("cutter_width", kOptional, Unit::kLength),
};
constexpr Attribute kSideMill[] = {
    row<&SideMill::cutter_width>("cutter_width", kOptional, Unit::kLength),
};
constexpr Attribute kTaperedTap[] = {
    row<&TaperedTap::taper_angle>("taper_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kCombinedDrillAndTap[] = {
    row<&CombinedDrillAndTap::drill_length>("drill_length", kOptional, Unit::kLength),
};
constexpr Attribute kTaperedReamer[] = {
    row<&TaperedReamer::taper_angle>("taper_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kCombinedDrillAndReamer[] = {
    row<&CombinedDrillAndReamer::drill_length>("drill_length", kOptional, Unit::kLength),
};
constexpr Attribute kUserDefinedTool[] = {
    row<&UserDefinedTool::identifier>("identifier", kRequired),
    plan_row<&UserDefinedTool::taper_angle>("taper_angle", kOptional, Unit::kAngle),
    plan_row<&UserDefinedTool::tip_outer_angle>("tip_outer_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kToolUsage[] = {
    plan_row<&ToolUsage::its_id>("its_id", kRequired),
    plan_row<&ToolUsage::its_position>("its_position", kOptional),
    plan_row<&ToolUsage::its_carousel>("its_carousel", kOptional),
    plan_row<&ToolUsage::its_product>("its_product", kOptional),
    plan_row<&ToolUsage::its_library_reference>("its_library_reference", kOptional),
    plan_row<&ToolUsage::gage_placement>("gage_placement", kOptional),
    plan_row<&ToolUsage::tool_end_placement>("tool_end_placement", kOptional),
    plan_row<&ToolUsage::description>("description", kOptional),
    plan_row<&ToolUsage::its_library_source>("its_library_source", kOptional),
};
constexpr Attribute kTouchProbe[] = {
    plan_row<&TouchProbe::ball_radius>("ball_radius", kOptional, Unit::kLength),
    plan_row<&TouchProbe::overall_assembly_length>("overall_assembly_length", kOptional, Unit::kLength),
    plan_row<&TouchProbe::stylus_diameter>("stylus_diameter", kOptional, Unit::kLength),
};
constexpr Attribute kFacemill[] = {
    plan_row<&Facemill::tool_cutting_edge_angle>("tool_cutting_edge_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kEndmill[] = {
    plan_row<&Endmill::tool_cutting_edge_angle>("tool_cutting_edge_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kThreadMill[] = {
    plan_row<&ThreadMill::thread_form_type>("thread_form_type", kOptional),
    plan_row<&ThreadMill::thread_size>("thread_size", kOptional, Unit::kLength),
    plan_row<&ThreadMill::thread_pitch>("thread_pitch", kOptional, Unit::kLength),
};
constexpr Attribute kTap[] = {
    plan_row<&Tap::thread_form_type>("thread_form_type", kOptional),
    plan_row<&Tap::thread_size>("thread_size", kOptional, Unit::kLength),
    plan_row<&Tap::thread_pitch>("thread_pitch", kOptional, Unit::kLength),
    plan_row<&Tap::taper_thread_count>("taper_thread_count", kOptional),
};
constexpr Attribute kReamer[] = {
    plan_row<&Reamer::taper_length>("taper_length", kOptional, Unit::kLength),
};
constexpr Attribute kBoringTool[] = {
    plan_row<&BoringTool::retract_movement_forbidden>("retract_movement_forbidden", kOptional),
};
constexpr Attribute kStepDrill[] = {
    plan_row<&StepDrill::diameters>("diameters", kRequired, Unit::kLength),
    plan_row<&StepDrill::step_length>("step_length", kRequired, Unit::kLength),
};

constexpr NounRow kRows[] = {
    {TypeId::kTouchProbe, "TOUCH_PROBE", TypeId::kMachiningTool, false, true, kTouchProbe},
    {TypeId::kMachiningTool, "MACHINING_TOOL", TypeId::kNone, true, true, kMachiningTool},
    {TypeId::kCuttingTool, "CUTTING_TOOL", TypeId::kMachiningTool, true, true, kCuttingTool},
    {TypeId::kToolBody, "TOOL_BODY", TypeId::kNone, true, true, {}},
    {TypeId::kCuttingComponent, "CUTTING_COMPONENT", TypeId::kNone, false, true, kCuttingComponent},
    {TypeId::kCuttingEdgeTechnologicalData, "CUTTING_EDGE_TECHNOLOGICAL_DATA", TypeId::kNone, false, true,
     kCuttingEdgeTechnologicalData},
    {TypeId::kMillingCuttingTool, "MILLING_CUTTING_TOOL", TypeId::kCuttingTool, false, true,
     kMillingCuttingTool},
    {TypeId::kMillingToolBody, "MILLING_TOOL_BODY", TypeId::kToolBody, true, true, kMillingToolBody},
    {TypeId::kMillingToolDimension, "MILLING_TOOL_DIMENSION", TypeId::kNone, false, true,
     kMillingToolDimension},
    {TypeId::kCenterDrill, "CENTER_DRILL", TypeId::kMillingToolBody, false, true, {}},
    {TypeId::kCountersink, "COUNTERSINK", TypeId::kMillingToolBody, false, true, kCountersink},
    {TypeId::kBacksideCountersink, "BACKSIDE_COUNTERSINK", TypeId::kCountersink, false, true, {}},
    {TypeId::kDrill, "DRILL", TypeId::kMillingToolBody, true, true, {}},
    {TypeId::kTwistDrill, "TWIST_DRILL", TypeId::kDrill, false, true, {}},
    {TypeId::kTaperedDrill, "TAPERED_DRILL", TypeId::kTwistDrill, false, true, kTaperedDrill},
    {TypeId::kSpadeDrill, "SPADE_DRILL", TypeId::kDrill, false, true, {}},
    {TypeId::kMillingCutter, "MILLING_CUTTER", TypeId::kMillingToolBody, true, true, {}},
    {TypeId::kFacemill, "FACEMILL", TypeId::kMillingCutter, false, true, kFacemill},
    {TypeId::kEndmill, "ENDMILL", TypeId::kMillingCutter, false, true, kEndmill},
    {TypeId::kTaperedEndmill, "TAPERED_ENDMILL", TypeId::kEndmill, false, true, kTaperedEndmill},
    {TypeId::kBallEndmill, "BALL_ENDMILL", TypeId::kEndmill, false, true, {}},
    {TypeId::kBullnoseEndmill, "BULLNOSE_ENDMILL", TypeId::kEndmill, false, true, {}},
    {TypeId::kTSlotMill, "T_SLOT_MILL", TypeId::kMillingCutter, false, true, kTSlotMill},
    {TypeId::kDovetailMill, "DOVETAIL_MILL", TypeId::kMillingCutter, false, true, kDovetailMill},
    {TypeId::kWoodruffKeyseatMill, "WOODRUFF_KEYSEAT_MILL", TypeId::kMillingCutter, false, true,
     kWoodruffKeyseatMill},
    {TypeId::kSideMill, "SIDE_MILL", TypeId::kMillingCutter, false, true, kSideMill},
    {TypeId::kThreadMill, "THREAD_MILL", TypeId::kMillingCutter, false, true, kThreadMill},
    {TypeId::kTap, "TAP", TypeId::kMillingToolBody, false, true, kTap},
    {TypeId::kTaperedTap, "TAPERED_TAP", TypeId::kTap, false, true, kTaperedTap},
    {TypeId::kCombinedDrillAndTap, "COMBINED_DRILL_AND_TAP", TypeId::kTap, false, true, kCombinedDrillAndTap},
    {TypeId::kMillingThreadingTool, "MILLING_THREADING_TOOL", TypeId::kMillingToolBody, false, true, {}},
    {TypeId::kCounterbore, "COUNTERBORE", TypeId::kMillingToolBody, false, true, {}},
    {TypeId::kBacksideCounterbore, "BACKSIDE_COUNTERBORE", TypeId::kCounterbore, false, true, {}},
    {TypeId::kReamer, "REAMER", TypeId::kMillingToolBody, false, true, kReamer},
    {TypeId::kTaperedReamer, "TAPERED_REAMER", TypeId::kReamer, false, true, kTaperedReamer},
    {TypeId::kCombinedDrillAndReamer, "COMBINED_DRILL_AND_REAMER", TypeId::kReamer, false, true,
     kCombinedDrillAndReamer},
    {TypeId::kBoringTool, "BORING_TOOL", TypeId::kMillingToolBody, false, true, kBoringTool},
    {TypeId::kUserDefinedTool, "USER_DEFINED_TOOL", TypeId::kMillingToolBody, false, true, kUserDefinedTool},
    {TypeId::kToolUsage, "TOOL_USAGE", TypeId::kNone, false, false, kToolUsage},
    {TypeId::kGeneralDrill, "DRILLING_CUTTING_TOOL", TypeId::kDrill, false, false, {}},
    {TypeId::kSpotdrill, "SPOTDRILL", TypeId::kDrill, false, false, {}},
    {TypeId::kStepDrill, "STEP_DRILL", TypeId::kDrill, false, false, kStepDrill},
    {TypeId::kShouldermill, "SHOULDERMILL", TypeId::kMillingCutter, false, false, {}},
    {TypeId::kProfiledEndMill, "PROFILED_END_MILL", TypeId::kEndmill, false, false, {}},
};

}  // namespace

std::span<const NounRow> tool_rows() { return kRows; }

}  // namespace capstan::model
