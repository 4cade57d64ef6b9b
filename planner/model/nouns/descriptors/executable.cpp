#include "planner/model/nouns/executable.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kExecutable[] = {
    row<&Executable::its_id>("its_id", kRequired),
    plan_row<&Executable::persistent_id>("persistent_id", kOptional),
    plan_row<&Executable::enabled>("enabled", kOptional),
    plan_row<&Executable::as_is>("as_is", kOptional),
    plan_row<&Executable::to_be>("to_be", kOptional),
    plan_row<&Executable::removal>("removal", kOptional),
    plan_row<&Executable::fixture>("fixture", kOptional),
    plan_row<&Executable::machine_used>("machine_used", kOptional),
    plan_row<&Executable::twin_source>("twin_source", kOptional),
    plan_row<&Executable::twin_plan>("twin_plan", kOptional),
    plan_row<&Executable::twin_start>("twin_start", kOptional),
    plan_row<&Executable::twin_end>("twin_end", kOptional),
    plan_row<&Executable::twin_worktime>("twin_worktime", kOptional, Unit::kTime),
    plan_row<&Executable::twin_exception>("twin_exception", kOptional),
    plan_row<&Executable::process_properties>("process_properties", kOptional),
    plan_row<&Executable::start_content>("start_content", kOptional),
    plan_row<&Executable::end_content>("end_content", kOptional),
    plan_row<&Executable::its_broadcasts>("its_broadcasts", kOptional),
    plan_row<&Executable::last_modified_timestamp>("last_modified_timestamp", kOptional),
};
constexpr Attribute kWorkingstep[] = {
    row<&Workingstep::its_secplane>("its_secplane", kRequired),
    plan_row<&Workingstep::final_features>("final_features", kOptional),
    plan_row<&Workingstep::toolpath_orientation>("toolpath_orientation", kOptional),
};
constexpr Attribute kMachiningWorkingstep[] = {
    row<&MachiningWorkingstep::its_feature>("its_feature", kRequired),
    row<&MachiningWorkingstep::its_operation>("its_operation", kRequired),
    row<&MachiningWorkingstep::its_effect>("its_effect", kOptional),
};
constexpr Attribute kRapidMovement[] = {
    row<&RapidMovement::its_toolpath>("its_toolpath", kOptional),
    row<&RapidMovement::its_tool_direction>("its_tool_direction", kOptional),
    plan_row<&RapidMovement::operation_id>("operation_id", kOptional),
    plan_row<&RapidMovement::operation_properties>("operation_properties", kOptional),
};
constexpr Attribute kTouchProbing[] = {
    row<&TouchProbing::its_toolpath>("its_toolpath", kOptional),
    row<&TouchProbing::its_tool_direction>("its_tool_direction", kOptional),
    row<&TouchProbing::measured_offset>("measured_offset", kRequired),
    plan_row<&TouchProbing::operation_id>("operation_id", kOptional),
    plan_row<&TouchProbing::operation_properties>("operation_properties", kOptional),
};
constexpr Attribute kWorkpieceProbing[] = {
    row<&WorkpieceProbing::start_position>("start_position", kRequired),
    row<&WorkpieceProbing::its_workpiece>("its_workpiece", kRequired),
    row<&WorkpieceProbing::direction>("direction", kRequired),
    row<&WorkpieceProbing::expected_value>("expected_value", kRequired),
    row<&WorkpieceProbing::its_probe>("its_probe", kRequired),
};
constexpr Attribute kWorkpieceCompleteProbing[] = {
    row<&WorkpieceCompleteProbing::its_workpiece>("its_workpiece", kRequired),
    row<&WorkpieceCompleteProbing::probing_distance>("probing_distance", kRequired),
    row<&WorkpieceCompleteProbing::its_probe>("its_probe", kRequired),
    row<&WorkpieceCompleteProbing::computed_offset>("computed_offset", kRequired),
};
constexpr Attribute kToolProbing[] = {
    row<&ToolProbing::offset>("offset", kRequired),
    row<&ToolProbing::max_wear>("max_wear", kRequired, Unit::kLength),
    row<&ToolProbing::its_tool>("its_tool", kRequired),
};
constexpr Attribute kDisplayMessage[] = {
    row<&DisplayMessage::its_text>("its_text", kRequired),
};
constexpr Attribute kWaitForMark[] = {
    row<&WaitForMark::its_channel>("its_channel", kRequired),
};
constexpr Attribute kWorkplan[] = {
    row<&Workplan::its_elements>("its_elements", kRequired),
    row<&Workplan::its_channel>("its_channel", kOptional),
    row<&Workplan::its_setup>("its_setup", kOptional),
    row<&Workplan::its_effect>("its_effect", kOptional),
    plan_row<&Workplan::its_minimum_machine_params>("its_minimum_machine_params", kOptional),
    plan_row<&Workplan::toolpath_orientation>("toolpath_orientation", kOptional),
};
constexpr Attribute kChannel[] = {
    row<&Channel::its_id>("its_id", kRequired),
};
constexpr Attribute kParallel[] = {
    row<&Parallel::branches>("branches", kRequired),
};
constexpr Attribute kNonSequential[] = {
    row<&NonSequential::its_elements>("its_elements", kRequired),
};
constexpr Attribute kSelective[] = {
    row<&Selective::its_elements>("its_elements", kRequired),
};
constexpr Attribute kIfStatement[] = {
    row<&IfStatement::condition>("condition", kRequired),
    row<&IfStatement::true_branch>("true_branch", kRequired),
    row<&IfStatement::false_branch>("false_branch", kOptional),
};
constexpr Attribute kWhileStatement[] = {
    row<&WhileStatement::condition>("condition", kRequired),
    row<&WhileStatement::body>("body", kRequired),
};
constexpr Attribute kAssignment[] = {
    row<&Assignment::its_lvalue>("its_lvalue", kRequired),
    row<&Assignment::its_rvalue>("its_rvalue", kRequired),
};
constexpr Attribute kNcVariable[] = {
    row<&NcVariable::its_name>("its_name", kRequired),
    row<&NcVariable::initial_value>("initial_value", kOptional),
};
constexpr Attribute kNcConstant[] = {
    row<&NcConstant::its_name>("its_name", kRequired),
    row<&NcConstant::its_value>("its_value", kOptional),
};
constexpr Attribute kUnaryBooleanExpression[] = {
    row<&UnaryBooleanExpression::operand>("operand", kRequired),
};
constexpr Attribute kBinaryBooleanExpression[] = {
    row<&BinaryBooleanExpression::operand1>("operand1", kRequired),
    row<&BinaryBooleanExpression::operand2>("operand2", kRequired),
};
constexpr Attribute kMultipleArityBooleanExpression[] = {
    row<&MultipleArityBooleanExpression::operands>("operands", kRequired),
};
constexpr Attribute kComparisonExpression[] = {
    row<&ComparisonExpression::operand1>("operand1", kRequired),
    row<&ComparisonExpression::operand2>("operand2", kRequired),
};
constexpr Attribute kIndexPallet[] = {
    row<&IndexPallet::its_index>("its_index", kRequired),
};
constexpr Attribute kIndexTable[] = {
    row<&IndexTable::its_index>("its_index", kRequired),
};
constexpr Attribute kLoadTool[] = {
    row<&LoadTool::its_tool>("its_tool", kRequired),
};
constexpr Attribute kUnloadTool[] = {
    row<&UnloadTool::its_tool>("its_tool", kOptional),
};
constexpr Attribute kExtendedNcFunction[] = {
    plan_row<&ExtendedNcFunction::extended_description>("extended_description", kRequired),
};
constexpr Attribute kFeatureCompleteProbing[] = {
    plan_row<&FeatureCompleteProbing::start_position>("start_position", kRequired),
    plan_row<&FeatureCompleteProbing::expected_value>("expected_value", kOptional),
    plan_row<&FeatureCompleteProbing::its_probe>("its_probe", kRequired),
};
constexpr Attribute kCurveProbing[] = {
    plan_row<&CurveProbing::its_workpiece>("its_workpiece", kOptional),
    plan_row<&CurveProbing::its_curve>("its_curve", kRequired),
    plan_row<&CurveProbing::expected_value>("expected_value", kOptional),
    plan_row<&CurveProbing::its_probe>("its_probe", kRequired),
};
constexpr Attribute kPlanningOperation[] = {
    plan_row<&PlanningOperation::description>("description", kRequired),
    plan_row<&PlanningOperation::its_elements>("its_elements", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kExecutable, "EXECUTABLE", TypeId::kNone, true, true, kExecutable},
    {TypeId::kWorkingstep, "WORKINGSTEP", TypeId::kExecutable, true, true, kWorkingstep},
    {TypeId::kMachiningWorkingstep, "MACHINING_WORKINGSTEP", TypeId::kWorkingstep, false, true,
     kMachiningWorkingstep},
    {TypeId::kRapidMovement, "RAPID_MOVEMENT", TypeId::kWorkingstep, false, true, kRapidMovement},
    {TypeId::kTouchProbing, "TOUCH_PROBING", TypeId::kWorkingstep, true, true, kTouchProbing},
    {TypeId::kWorkpieceProbing, "WORKPIECE_PROBING", TypeId::kTouchProbing, false, true, kWorkpieceProbing},
    {TypeId::kWorkpieceCompleteProbing, "WORKPIECE_COMPLETE_PROBING", TypeId::kTouchProbing, false, true,
     kWorkpieceCompleteProbing},
    {TypeId::kToolProbing, "TOOL_PROBING", TypeId::kTouchProbing, true, true, kToolProbing},
    {TypeId::kToolLengthProbing, "TOOL_LENGTH_PROBING", TypeId::kToolProbing, false, true, {}},
    {TypeId::kToolRadiusProbing, "TOOL_RADIUS_PROBING", TypeId::kToolProbing, false, true, {}},
    {TypeId::kNcFunction, "NC_FUNCTION", TypeId::kExecutable, true, true, {}},
    {TypeId::kDisplayMessage, "DISPLAY_MESSAGE", TypeId::kNcFunction, false, true, kDisplayMessage},
    {TypeId::kOptionalStop, "OPTIONAL_STOP", TypeId::kNcFunction, false, true, {}},
    {TypeId::kProgramStop, "PROGRAM_STOP", TypeId::kNcFunction, false, true, {}},
    {TypeId::kSetMark, "SET_MARK", TypeId::kNcFunction, false, true, {}},
    {TypeId::kWaitForMark, "WAIT_FOR_MARK", TypeId::kNcFunction, false, true, kWaitForMark},
    {TypeId::kProgramStructure, "PROGRAM_STRUCTURE", TypeId::kExecutable, true, true, {}},
    {TypeId::kWorkplan, "WORKPLAN", TypeId::kProgramStructure, false, true, kWorkplan},
    {TypeId::kChannel, "CHANNEL", TypeId::kNone, false, true, kChannel},
    {TypeId::kParallel, "PARALLEL", TypeId::kProgramStructure, false, true, kParallel},
    {TypeId::kNonSequential, "NON_SEQUENTIAL", TypeId::kProgramStructure, false, true, kNonSequential},
    {TypeId::kSelective, "SELECTIVE", TypeId::kProgramStructure, false, true, kSelective},
    {TypeId::kIfStatement, "IF_STATEMENT", TypeId::kProgramStructure, false, true, kIfStatement},
    {TypeId::kWhileStatement, "WHILE_STATEMENT", TypeId::kProgramStructure, false, true, kWhileStatement},
    {TypeId::kAssignment, "ASSIGNMENT", TypeId::kProgramStructure, false, true, kAssignment},
    {TypeId::kNcVariable, "NC_VARIABLE", TypeId::kNone, false, true, kNcVariable},
    {TypeId::kNcConstant, "NC_CONSTANT", TypeId::kNone, false, true, kNcConstant},
    {TypeId::kBooleanExpression, "BOOLEAN_EXPRESSION", TypeId::kNone, true, true, {}},
    {TypeId::kUnaryBooleanExpression, "UNARY_BOOLEAN_EXPRESSION", TypeId::kBooleanExpression, true, true,
     kUnaryBooleanExpression},
    {TypeId::kNotExpression, "NOT_EXPRESSION", TypeId::kUnaryBooleanExpression, false, true, {}},
    {TypeId::kBinaryBooleanExpression, "BINARY_BOOLEAN_EXPRESSION", TypeId::kBooleanExpression, true, true,
     kBinaryBooleanExpression},
    {TypeId::kXorExpression, "XOR_EXPRESSION", TypeId::kBinaryBooleanExpression, false, true, {}},
    {TypeId::kMultipleArityBooleanExpression, "MULTIPLE_ARITY_BOOLEAN_EXPRESSION", TypeId::kBooleanExpression,
     true, true, kMultipleArityBooleanExpression},
    {TypeId::kAndExpression, "AND_EXPRESSION", TypeId::kMultipleArityBooleanExpression, false, true, {}},
    {TypeId::kOrExpression, "OR_EXPRESSION", TypeId::kMultipleArityBooleanExpression, false, true, {}},
    {TypeId::kComparisonExpression, "COMPARISON_EXPRESSION", TypeId::kBooleanExpression, true, true,
     kComparisonExpression},
    {TypeId::kComparisonEqual, "COMPARISON_EQUAL", TypeId::kComparisonExpression, false, true, {}},
    {TypeId::kComparisonNotEqual, "COMPARISON_NOT_EQUAL", TypeId::kComparisonExpression, false, true, {}},
    {TypeId::kComparisonGreater, "COMPARISON_GREATER", TypeId::kComparisonExpression, false, true, {}},
    {TypeId::kComparisonGreaterEqual,
     "COMPARISON_GREATER_EQUAL",
     TypeId::kComparisonExpression,
     false,
     true,
     {}},
    {TypeId::kComparisonLess, "COMPARISON_LESS", TypeId::kComparisonExpression, false, true, {}},
    {TypeId::kComparisonLessEqual, "COMPARISON_LESS_EQUAL", TypeId::kComparisonExpression, false, true, {}},
    {TypeId::kExchangePallet, "EXCHANGE_PALLET", TypeId::kNcFunction, false, true, {}},
    {TypeId::kIndexPallet, "INDEX_PALLET", TypeId::kNcFunction, false, true, kIndexPallet},
    {TypeId::kIndexTable, "INDEX_TABLE", TypeId::kNcFunction, false, true, kIndexTable},
    {TypeId::kLoadTool, "LOAD_TOOL", TypeId::kNcFunction, false, true, kLoadTool},
    {TypeId::kUnloadTool, "UNLOAD_TOOL", TypeId::kNcFunction, false, true, kUnloadTool},
    {TypeId::kExtendedNcFunction, "EXTENDED_NC_FUNCTION", TypeId::kNcFunction, false, false,
     kExtendedNcFunction},
    {TypeId::kReturnHome, "RETURN_HOME", TypeId::kRapidMovement, false, false, {}},
    {TypeId::kFeatureCompleteProbing, "FEATURE_COMPLETE_PROBING", TypeId::kTouchProbing, false, false,
     kFeatureCompleteProbing},
    {TypeId::kCurveProbing, "CURVE_PROBING", TypeId::kTouchProbing, false, false, kCurveProbing},
    {TypeId::kPlanningOperation, "PLANNING_OPERATION", TypeId::kProgramStructure, false, false,
     kPlanningOperation},
};

}  // namespace

std::span<const NounRow> executable_rows() { return kRows; }

}  // namespace capstan::model
