#include "planner/model/nouns/strategy.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kTechnology[] = {
    row<&Technology::feedrate>("feedrate", kOptional, Unit::kSpeed),
    row<&Technology::feedrate_reference>("feedrate_reference", kRequired),
};
constexpr Attribute kThreeAxesTiltedTool[] = {
    row<&ThreeAxesTiltedTool::tool_direction>("tool_direction", kRequired),
};
constexpr Attribute kFiveAxesConstTiltYaw[] = {
    row<&FiveAxesConstTiltYaw::tilt_angle>("tilt_angle", kRequired, Unit::kAngle),
    row<&FiveAxesConstTiltYaw::yaw_angle>("yaw_angle", kRequired, Unit::kAngle),
};
constexpr Attribute kMillingTechnology[] = {
    row<&MillingTechnology::cutspeed>("cutspeed", kOptional, Unit::kSpeed),
    row<&MillingTechnology::spindle>("spindle", kOptional, Unit::kRotSpeed),
    row<&MillingTechnology::feedrate_per_tooth>("feedrate_per_tooth", kOptional, Unit::kLength),
    row<&MillingTechnology::synchronize_spindle_with_feed>("synchronize_spindle_with_feed", kRequired),
    row<&MillingTechnology::inhibit_feedrate_override>("inhibit_feedrate_override", kRequired),
    row<&MillingTechnology::inhibit_spindle_override>("inhibit_spindle_override", kRequired),
    row<&MillingTechnology::its_adaptive_control>("its_adaptive_control", kOptional),
};
constexpr Attribute kMillingMachineFunctions[] = {
    row<&MillingMachineFunctions::coolant>("coolant", kRequired),
    row<&MillingMachineFunctions::coolant_pressure>("coolant_pressure", kOptional, Unit::kPressure),
    row<&MillingMachineFunctions::mist>("mist", kOptional),
    row<&MillingMachineFunctions::through_spindle_coolant>("through_spindle_coolant", kRequired),
    row<&MillingMachineFunctions::through_pressure>("through_pressure", kOptional, Unit::kPressure),
    row<&MillingMachineFunctions::axis_clamping>("axis_clamping", kRequired),
    row<&MillingMachineFunctions::chip_removal>("chip_removal", kRequired),
    row<&MillingMachineFunctions::oriented_spindle_stop>("oriented_spindle_stop", kOptional),
    row<&MillingMachineFunctions::its_process_model>("its_process_model", kOptional),
    row<&MillingMachineFunctions::other_functions>("other_functions", kRequired),
    plan_row<&MillingMachineFunctions::axis_constraints>("axis_constraints", kOptional),
};
constexpr Attribute kProcessModelList[] = {
    row<&ProcessModelList::its_list>("its_list", kRequired),
};
constexpr Attribute kProcessModel[] = {
    row<&ProcessModel::ini_data_file>("ini_data_file", kRequired),
    row<&ProcessModel::its_type>("its_type", kRequired),
};
constexpr Attribute kApproachRetractStrategy[] = {
    row<&ApproachRetractStrategy::tool_orientation>("tool_orientation", kOptional),
};
constexpr Attribute kPlungeRamp[] = {
    row<&PlungeRamp::angle>("angle", kRequired, Unit::kAngle),
};
constexpr Attribute kPlungeHelix[] = {
    row<&PlungeHelix::radius>("radius", kRequired, Unit::kLength),
    row<&PlungeHelix::angle>("angle", kRequired, Unit::kAngle),
};
constexpr Attribute kPlungeZigzag[] = {
    row<&PlungeZigzag::angle>("angle", kRequired, Unit::kAngle),
    row<&PlungeZigzag::width>("width", kRequired, Unit::kLength),
};
constexpr Attribute kApRetractAngle[] = {
    row<&ApRetractAngle::angle>("angle", kRequired, Unit::kAngle),
    row<&ApRetractAngle::travel_length>("travel_length", kRequired, Unit::kLength),
};
constexpr Attribute kApRetractTangent[] = {
    row<&ApRetractTangent::radius>("radius", kRequired, Unit::kLength),
};
constexpr Attribute kAlongPath[] = {
    row<&AlongPath::path>("path", kRequired),
};
constexpr Attribute kFreeformStrategy[] = {
    row<&FreeformStrategy::pathmode>("pathmode", kRequired),
    row<&FreeformStrategy::cutmode>("cutmode", kRequired),
    row<&FreeformStrategy::its_milling_tolerances>("its_milling_tolerances", kRequired),
    row<&FreeformStrategy::stepover>("stepover", kOptional, Unit::kLength),
};
constexpr Attribute kTolerances[] = {
    row<&Tolerances::chordal_tolerance>("chordal_tolerance", kRequired, Unit::kLength),
    row<&Tolerances::scallop_height>("scallop_height", kRequired, Unit::kLength),
};
constexpr Attribute kUvStrategy[] = {
    row<&UvStrategy::forward_direction>("forward_direction", kRequired),
    row<&UvStrategy::sideward_direction>("sideward_direction", kRequired),
};
constexpr Attribute kPlaneCcStrategy[] = {
    row<&PlaneCcStrategy::its_plane_normal>("its_plane_normal", kRequired),
};
constexpr Attribute kPlaneClStrategy[] = {
    row<&PlaneClStrategy::its_plane_normal>("its_plane_normal", kRequired),
};
constexpr Attribute kLeadingLineStrategy[] = {
    row<&LeadingLineStrategy::its_line>("its_line", kRequired),
};
constexpr Attribute kTwo5dMillingStrategy[] = {
    row<&Two5dMillingStrategy::overlap>("overlap", kOptional, Unit::kRatio),
    row<&Two5dMillingStrategy::allow_multiple_passes>("allow_multiple_passes", kOptional),
};
constexpr Attribute kUnidirectionalMilling[] = {
    row<&UnidirectionalMilling::feed_direction>("feed_direction", kOptional),
    row<&UnidirectionalMilling::cutmode>("cutmode", kOptional),
};
constexpr Attribute kBidirectionalMilling[] = {
    row<&BidirectionalMilling::feed_direction>("feed_direction", kOptional),
    row<&BidirectionalMilling::stepover_direction>("stepover_direction", kOptional),
    row<&BidirectionalMilling::its_stroke_connection_strategy>("its_stroke_connection_strategy", kOptional),
};
constexpr Attribute kContourParallel[] = {
    row<&ContourParallel::rotation_direction>("rotation_direction", kOptional),
    row<&ContourParallel::cutmode>("cutmode", kOptional),
};
constexpr Attribute kBidirectionalContour[] = {
    row<&BidirectionalContour::feed_direction>("feed_direction", kOptional),
    row<&BidirectionalContour::stepover_direction>("stepover_direction", kOptional),
    row<&BidirectionalContour::rotation_direction>("rotation_direction", kOptional),
    row<&BidirectionalContour::spiral_cutmode>("spiral_cutmode", kOptional),
};
constexpr Attribute kContourBidirectional[] = {
    row<&ContourBidirectional::feed_direction>("feed_direction", kOptional),
    row<&ContourBidirectional::stepover_direction>("stepover_direction", kOptional),
    row<&ContourBidirectional::rotation_direction>("rotation_direction", kOptional),
    row<&ContourBidirectional::spiral_cutmode>("spiral_cutmode", kOptional),
};
constexpr Attribute kContourSpiral[] = {
    row<&ContourSpiral::rotation_direction>("rotation_direction", kOptional),
    row<&ContourSpiral::cutmode>("cutmode", kOptional),
};
constexpr Attribute kDrillingTypeStrategy[] = {
    row<&DrillingTypeStrategy::reduced_cut_at_start>("reduced_cut_at_start", kOptional, Unit::kRatio),
    row<&DrillingTypeStrategy::reduced_feed_at_start>("reduced_feed_at_start", kOptional, Unit::kRatio),
    row<&DrillingTypeStrategy::depth_of_start>("depth_of_start", kOptional, Unit::kLength),
    row<&DrillingTypeStrategy::reduced_cut_at_end>("reduced_cut_at_end", kOptional, Unit::kRatio),
    row<&DrillingTypeStrategy::reduced_feed_at_end>("reduced_feed_at_end", kOptional, Unit::kRatio),
    row<&DrillingTypeStrategy::depth_of_end>("depth_of_end", kOptional, Unit::kLength),
};
constexpr Attribute kMachineAxisConstraint[] = {
    plan_row<&MachineAxisConstraint::axis_identifier>("axis_identifier", kRequired),
    plan_row<&MachineAxisConstraint::axis_minimum>("axis_minimum", kOptional, Unit::kLength),
    plan_row<&MachineAxisConstraint::axis_maximum>("axis_maximum", kOptional, Unit::kLength),
    plan_row<&MachineAxisConstraint::angle_minimum>("angle_minimum", kOptional, Unit::kAngle),
    plan_row<&MachineAxisConstraint::angle_maximum>("angle_maximum", kOptional, Unit::kAngle),
};

constexpr NounRow kRows[] = {
    {TypeId::kToolDirection, "TOOL_DIRECTION", TypeId::kNone, true, true, {}},
    {TypeId::kTwoAxes, "TWO_AXES", TypeId::kToolDirection, false, true, {}},
    {TypeId::kThreeAxes, "THREE_AXES", TypeId::kToolDirection, false, true, {}},
    {TypeId::kTechnology, "TECHNOLOGY", TypeId::kNone, true, true, kTechnology},
    {TypeId::kMachineFunctions, "MACHINE_FUNCTIONS", TypeId::kNone, true, true, {}},
    {TypeId::kToolDirectionForMilling, "TOOL_DIRECTION_FOR_MILLING", TypeId::kToolDirection, true, true, {}},
    {TypeId::kThreeAxesTiltedTool, "THREE_AXES_TILTED_TOOL", TypeId::kToolDirectionForMilling, false, true,
     kThreeAxesTiltedTool},
    {TypeId::kFiveAxesVarTiltYaw,
     "FIVE_AXES_VAR_TILT_YAW",
     TypeId::kToolDirectionForMilling,
     false,
     true,
     {}},
    {TypeId::kFiveAxesConstTiltYaw, "FIVE_AXES_CONST_TILT_YAW", TypeId::kToolDirectionForMilling, false, true,
     kFiveAxesConstTiltYaw},
    {TypeId::kMillingTechnology, "MILLING_TECHNOLOGY", TypeId::kTechnology, false, true, kMillingTechnology},
    {TypeId::kAdaptiveControl, "ADAPTIVE_CONTROL", TypeId::kNone, true, true, {}},
    {TypeId::kMillingMachineFunctions, "MILLING_MACHINE_FUNCTIONS", TypeId::kMachineFunctions, false, true,
     kMillingMachineFunctions},
    {TypeId::kProcessModelList, "PROCESS_MODEL_LIST", TypeId::kNone, false, true, kProcessModelList},
    {TypeId::kProcessModel, "PROCESS_MODEL", TypeId::kNone, false, true, kProcessModel},
    {TypeId::kApproachRetractStrategy, "APPROACH_RETRACT_STRATEGY", TypeId::kNone, true, true,
     kApproachRetractStrategy},
    {TypeId::kPlungeStrategy, "PLUNGE_STRATEGY", TypeId::kApproachRetractStrategy, true, true, {}},
    {TypeId::kPlungeToolaxis, "PLUNGE_TOOLAXIS", TypeId::kPlungeStrategy, false, true, {}},
    {TypeId::kPlungeRamp, "PLUNGE_RAMP", TypeId::kPlungeStrategy, false, true, kPlungeRamp},
    {TypeId::kPlungeHelix, "PLUNGE_HELIX", TypeId::kPlungeStrategy, false, true, kPlungeHelix},
    {TypeId::kPlungeZigzag, "PLUNGE_ZIGZAG", TypeId::kPlungeStrategy, false, true, kPlungeZigzag},
    {TypeId::kAirStrategy, "AIR_STRATEGY", TypeId::kApproachRetractStrategy, true, true, {}},
    {TypeId::kApRetractAngle, "AP_RETRACT_ANGLE", TypeId::kAirStrategy, false, true, kApRetractAngle},
    {TypeId::kApRetractTangent, "AP_RETRACT_TANGENT", TypeId::kAirStrategy, false, true, kApRetractTangent},
    {TypeId::kAlongPath, "ALONG_PATH", TypeId::kApproachRetractStrategy, false, true, kAlongPath},
    {TypeId::kFreeformStrategy, "FREEFORM_STRATEGY", TypeId::kNone, true, true, kFreeformStrategy},
    {TypeId::kTolerances, "TOLERANCES", TypeId::kNone, false, true, kTolerances},
    {TypeId::kUvStrategy, "UV_STRATEGY", TypeId::kFreeformStrategy, false, true, kUvStrategy},
    {TypeId::kPlaneCcStrategy, "PLANE_CC_STRATEGY", TypeId::kFreeformStrategy, false, true, kPlaneCcStrategy},
    {TypeId::kPlaneClStrategy, "PLANE_CL_STRATEGY", TypeId::kFreeformStrategy, false, true, kPlaneClStrategy},
    {TypeId::kLeadingLineStrategy, "LEADING_LINE_STRATEGY", TypeId::kFreeformStrategy, false, true,
     kLeadingLineStrategy},
    {TypeId::kTwo5dMillingStrategy, "TWO5D_MILLING_STRATEGY", TypeId::kNone, true, true,
     kTwo5dMillingStrategy},
    {TypeId::kUnidirectionalMilling, "UNIDIRECTIONAL_MILLING", TypeId::kTwo5dMillingStrategy, false, true,
     kUnidirectionalMilling},
    {TypeId::kBidirectionalMilling, "BIDIRECTIONAL_MILLING", TypeId::kTwo5dMillingStrategy, false, true,
     kBidirectionalMilling},
    {TypeId::kContourParallel, "CONTOUR_PARALLEL", TypeId::kTwo5dMillingStrategy, false, true,
     kContourParallel},
    {TypeId::kBidirectionalContour, "BIDIRECTIONAL_CONTOUR", TypeId::kTwo5dMillingStrategy, false, true,
     kBidirectionalContour},
    {TypeId::kContourBidirectional, "CONTOUR_BIDIRECTIONAL", TypeId::kTwo5dMillingStrategy, false, true,
     kContourBidirectional},
    {TypeId::kContourSpiral, "CONTOUR_SPIRAL", TypeId::kTwo5dMillingStrategy, false, true, kContourSpiral},
    {TypeId::kCenterMilling, "CENTER_MILLING", TypeId::kTwo5dMillingStrategy, false, true, {}},
    {TypeId::kExplicitStrategy, "EXPLICIT_STRATEGY", TypeId::kTwo5dMillingStrategy, false, true, {}},
    {TypeId::kDrillingTypeStrategy, "DRILLING_TYPE_STRATEGY", TypeId::kNone, false, true,
     kDrillingTypeStrategy},
    {TypeId::kMachineAxisConstraint, "MACHINE_AXIS_CONSTRAINT", TypeId::kNone, false, false,
     kMachineAxisConstraint},
};

}  // namespace

std::span<const NounRow> strategy_rows() { return kRows; }

}  // namespace capstan::model
