#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Executables: workplans, workingsteps, program structure, NC functions, expressions (ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct Executable : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kExecutable;
  Text its_id;
  Text persistent_id;                                  ///< optional, not in ISO 14649
  Boolean enabled;                                     ///< optional, not in ISO 14649
  Ref<Workpiece> as_is;                                ///< optional, not in ISO 14649
  Ref<Workpiece> to_be;                                ///< optional, not in ISO 14649
  Ref<Workpiece> removal;                              ///< optional, not in ISO 14649
  Ref<Workpiece> fixture;                              ///< optional, not in ISO 14649
  Ref<MachineUsage> machine_used;                      ///< optional, not in ISO 14649
  Text twin_source;                                    ///< optional, not in ISO 14649
  Ref<Executable> twin_plan;                           ///< optional, not in ISO 14649
  Ref<DateAndTime> twin_start;                         ///< optional, not in ISO 14649
  Ref<DateAndTime> twin_end;                           ///< optional, not in ISO 14649
  Real twin_worktime;                                  ///< s, optional, not in ISO 14649
  Text twin_exception;                                 ///< optional, not in ISO 14649
  RefList<ProcessProperty> process_properties;         ///< optional, not in ISO 14649
  Ref<BroadcastContent> start_content;                 ///< optional, not in ISO 14649
  Ref<BroadcastContent> end_content;                   ///< optional, not in ISO 14649
  RefList<Broadcast> its_broadcasts;                   ///< optional, not in ISO 14649
  Ref<LastModifiedTimestamp> last_modified_timestamp;  ///< optional, not in ISO 14649
};

struct Workingstep : Executable {  // abstract
  static constexpr TypeId kType = TypeId::kWorkingstep;
  Ref<ElementarySurface> its_secplane;
  RefList<ManufacturingFeature> final_features;  ///< optional, not in ISO 14649
  Ref<Axis2Placement3d> toolpath_orientation;    ///< optional, not in ISO 14649
};

struct MachiningWorkingstep : Workingstep {
  static constexpr TypeId kType = TypeId::kMachiningWorkingstep;
  Ref<ManufacturingFeature> its_feature;
  OneOf<MachiningOperation, ExtendedOperation> its_operation;
  Ref<InProcessGeometry> its_effect;  ///< optional
};

struct RapidMovement : Workingstep {
  static constexpr TypeId kType = TypeId::kRapidMovement;
  Ref<ToolpathList> its_toolpath;         ///< optional
  Ref<ToolDirection> its_tool_direction;  ///< optional
  // ISO 10303-238 splits this into a workingstep and its operation: the its_id and process_properties of the
  // latter.
  Text operation_id;                              ///< optional, not in ISO 14649
  RefList<ProcessProperty> operation_properties;  ///< optional, not in ISO 14649
};

struct TouchProbing : Workingstep {  // abstract
  static constexpr TypeId kType = TypeId::kTouchProbing;
  Ref<ToolpathList> its_toolpath;         ///< optional
  Ref<ToolDirection> its_tool_direction;  ///< optional
  Ref<NcVariable> measured_offset;
  // ISO 10303-238 splits this into a workingstep and its operation: the its_id and process_properties of the
  // latter.
  Text operation_id;                              ///< optional, not in ISO 14649
  RefList<ProcessProperty> operation_properties;  ///< optional, not in ISO 14649
};

struct WorkpieceProbing : TouchProbing {
  static constexpr TypeId kType = TypeId::kWorkpieceProbing;
  Ref<Axis2Placement3d> start_position;
  Ref<Workpiece> its_workpiece;
  Ref<Direction> direction;
  Ref<TolerancedLengthMeasure> expected_value;
  Ref<TouchProbe> its_probe;
};

struct WorkpieceCompleteProbing : TouchProbing {
  static constexpr TypeId kType = TypeId::kWorkpieceCompleteProbing;
  Ref<Workpiece> its_workpiece;
  Ref<TolerancedLengthMeasure> probing_distance;
  Ref<TouchProbe> its_probe;
  Ref<OffsetVector> computed_offset;
};

struct ToolProbing : TouchProbing {  // abstract
  static constexpr TypeId kType = TypeId::kToolProbing;
  Ref<CartesianPoint> offset;
  Real max_wear;  ///< mm
  Ref<MachiningTool> its_tool;
};

struct ToolLengthProbing : ToolProbing {
  static constexpr TypeId kType = TypeId::kToolLengthProbing;
};

struct ToolRadiusProbing : ToolProbing {
  static constexpr TypeId kType = TypeId::kToolRadiusProbing;
};

struct NcFunction : Executable {  // abstract
  static constexpr TypeId kType = TypeId::kNcFunction;
};

struct DisplayMessage : NcFunction {
  static constexpr TypeId kType = TypeId::kDisplayMessage;
  Text its_text;
};

struct OptionalStop : NcFunction {
  static constexpr TypeId kType = TypeId::kOptionalStop;
};

struct ProgramStop : NcFunction {
  static constexpr TypeId kType = TypeId::kProgramStop;
};

struct SetMark : NcFunction {
  static constexpr TypeId kType = TypeId::kSetMark;
};

struct WaitForMark : NcFunction {
  static constexpr TypeId kType = TypeId::kWaitForMark;
  Ref<Channel> its_channel;
};

struct ProgramStructure : Executable {  // abstract
  static constexpr TypeId kType = TypeId::kProgramStructure;
};

struct Workplan : ProgramStructure {
  static constexpr TypeId kType = TypeId::kWorkplan;
  RefList<Executable> its_elements;
  Ref<Channel> its_channel;                           ///< optional
  Ref<Setup> its_setup;                               ///< optional
  Ref<InProcessGeometry> its_effect;                  ///< optional
  Ref<MachineParameters> its_minimum_machine_params;  ///< optional, not in ISO 14649
  Ref<Axis2Placement3d> toolpath_orientation;         ///< optional, not in ISO 14649
};

struct Channel : Noun {
  static constexpr TypeId kType = TypeId::kChannel;
  Text its_id;
};

struct Parallel : ProgramStructure {
  static constexpr TypeId kType = TypeId::kParallel;
  RefList<Executable> branches;
};

struct NonSequential : ProgramStructure {
  static constexpr TypeId kType = TypeId::kNonSequential;
  RefList<Executable> its_elements;
};

struct Selective : ProgramStructure {
  static constexpr TypeId kType = TypeId::kSelective;
  RefList<Executable> its_elements;
};

struct IfStatement : ProgramStructure {
  static constexpr TypeId kType = TypeId::kIfStatement;
  Ref<BooleanExpression> condition;
  Ref<Executable> true_branch;
  Ref<Executable> false_branch;  ///< optional
};

struct WhileStatement : ProgramStructure {
  static constexpr TypeId kType = TypeId::kWhileStatement;
  Ref<BooleanExpression> condition;
  Ref<Executable> body;
};

struct Assignment : ProgramStructure {
  static constexpr TypeId kType = TypeId::kAssignment;
  Ref<NcVariable> its_lvalue;
  OneOf<NcConstant, NcVariable> its_rvalue;
};

struct NcVariable : Noun {
  static constexpr TypeId kType = TypeId::kNcVariable;
  Text its_name;
  Real initial_value;  ///< optional
};

struct NcConstant : Noun {
  static constexpr TypeId kType = TypeId::kNcConstant;
  Text its_name;
  Real its_value;  ///< optional
};

struct BooleanExpression : Noun {  // abstract
  static constexpr TypeId kType = TypeId::kBooleanExpression;
};

struct UnaryBooleanExpression : BooleanExpression {  // abstract
  static constexpr TypeId kType = TypeId::kUnaryBooleanExpression;
  Ref<BooleanExpression> operand;
};

struct NotExpression : UnaryBooleanExpression {
  static constexpr TypeId kType = TypeId::kNotExpression;
};

struct BinaryBooleanExpression : BooleanExpression {  // abstract
  static constexpr TypeId kType = TypeId::kBinaryBooleanExpression;
  Ref<BooleanExpression> operand1;
  Ref<BooleanExpression> operand2;
};

struct XorExpression : BinaryBooleanExpression {
  static constexpr TypeId kType = TypeId::kXorExpression;
};

struct MultipleArityBooleanExpression : BooleanExpression {  // abstract
  static constexpr TypeId kType = TypeId::kMultipleArityBooleanExpression;
  RefList<BooleanExpression> operands;
};

struct AndExpression : MultipleArityBooleanExpression {
  static constexpr TypeId kType = TypeId::kAndExpression;
};

struct OrExpression : MultipleArityBooleanExpression {
  static constexpr TypeId kType = TypeId::kOrExpression;
};

struct ComparisonExpression : BooleanExpression {  // abstract
  static constexpr TypeId kType = TypeId::kComparisonExpression;
  Ref<NcVariable> operand1;
  OneOf<NcConstant, NcVariable> operand2;
};

struct ComparisonEqual : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonEqual;
};

struct ComparisonNotEqual : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonNotEqual;
};

struct ComparisonGreater : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonGreater;
};

struct ComparisonGreaterEqual : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonGreaterEqual;
};

struct ComparisonLess : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonLess;
};

struct ComparisonLessEqual : ComparisonExpression {
  static constexpr TypeId kType = TypeId::kComparisonLessEqual;
};

struct ExchangePallet : NcFunction {
  static constexpr TypeId kType = TypeId::kExchangePallet;
};

struct IndexPallet : NcFunction {
  static constexpr TypeId kType = TypeId::kIndexPallet;
  Integer its_index;
};

struct IndexTable : NcFunction {
  static constexpr TypeId kType = TypeId::kIndexTable;
  Integer its_index;
};

struct LoadTool : NcFunction {
  static constexpr TypeId kType = TypeId::kLoadTool;
  Ref<MachiningTool> its_tool;
};

struct UnloadTool : NcFunction {
  static constexpr TypeId kType = TypeId::kUnloadTool;
  Ref<MachiningTool> its_tool;  ///< optional
};

struct ExtendedNcFunction : NcFunction {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kExtendedNcFunction;
  Text extended_description;
};

struct ReturnHome : RapidMovement {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kReturnHome;
};

struct FeatureCompleteProbing : TouchProbing {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kFeatureCompleteProbing;
  Ref<Axis2Placement3d> start_position;
  Ref<ManufacturingFeature> expected_value;  ///< optional
  Ref<TouchProbe> its_probe;
};

struct CurveProbing : TouchProbing {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kCurveProbing;
  Ref<Workpiece> its_workpiece;                 ///< optional
  Ref<BoundedCurve> its_curve;                  ///< along which the probe measures
  Ref<TolerancedLengthMeasure> expected_value;  ///< optional
  Ref<TouchProbe> its_probe;
};

/// A step of a process plan that is not detailed further, or only by what it holds.
struct PlanningOperation : ProgramStructure {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPlanningOperation;
  Text description;
  RefList<Executable> its_elements;  ///< optional
};

}  // namespace capstan::model
