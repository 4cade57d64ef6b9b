#include "planner/model/nouns/workpiece.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kProject[] = {
    row<&Project::its_id>("its_id", kRequired),
    row<&Project::main_workplan>("main_workplan", kRequired),
    row<&Project::its_workpieces>("its_workpieces", kRequired),
    row<&Project::its_owner>("its_owner", kOptional),
    row<&Project::its_release>("its_release", kOptional),
    row<&Project::its_status>("its_status", kOptional),
    plan_row<&Project::last_modified_timestamp>("last_modified_timestamp", kOptional),
};
constexpr Attribute kWorkpiece[] = {
    row<&Workpiece::its_id>("its_id", kRequired),
    row<&Workpiece::its_material>("its_material", kOptional),
    row<&Workpiece::global_tolerance>("global_tolerance", kOptional, Unit::kLength),
    row<&Workpiece::its_rawpiece>("its_rawpiece", kOptional),
    row<&Workpiece::its_geometry>("its_geometry", kOptional),
    row<&Workpiece::its_bounding_geometry>("its_bounding_geometry", kOptional),
    row<&Workpiece::clamping_positions>("clamping_positions", kRequired),
    plan_row<&Workpiece::its_approvals>("its_approvals", kOptional),
    plan_row<&Workpiece::its_categories>("its_categories", kOptional),
    plan_row<&Workpiece::its_components>("its_components", kOptional),
    plan_row<&Workpiece::its_datestamps>("its_datestamps", kOptional),
    plan_row<&Workpiece::its_orgs>("its_orgs", kOptional),
    plan_row<&Workpiece::its_people>("its_people", kOptional),
    plan_row<&Workpiece::its_related_geometry>("its_related_geometry", kOptional),
    plan_row<&Workpiece::its_timestamps>("its_timestamps", kOptional),
    plan_row<&Workpiece::product_approvals>("product_approvals", kOptional),
    plan_row<&Workpiece::product_datestamps>("product_datestamps", kOptional),
    plan_row<&Workpiece::product_orgs>("product_orgs", kOptional),
    plan_row<&Workpiece::product_people>("product_people", kOptional),
    plan_row<&Workpiece::product_timestamps>("product_timestamps", kOptional),
    plan_row<&Workpiece::revision_approvals>("revision_approvals", kOptional),
    plan_row<&Workpiece::revision_datestamps>("revision_datestamps", kOptional),
    plan_row<&Workpiece::revision_id>("revision_id", kOptional),
    plan_row<&Workpiece::revision_orgs>("revision_orgs", kOptional),
    plan_row<&Workpiece::revision_people>("revision_people", kOptional),
    plan_row<&Workpiece::revision_timestamps>("revision_timestamps", kOptional),
    plan_row<&Workpiece::its_security_classifications>("its_security_classifications", kOptional),
    plan_row<&Workpiece::last_modified_timestamp>("last_modified_timestamp", kOptional),
    plan_row<&Workpiece::its_styled_models>("its_styled_models", kOptional),
    plan_row<&Workpiece::material_workpiece>("material_workpiece", kOptional),
    plan_row<&Workpiece::its_properties>("its_properties", kOptional),
    plan_row<&Workpiece::its_requirements>("its_requirements", kOptional),
};
constexpr Attribute kMaterial[] = {
    row<&Material::standard_identifier>("standard_identifier", kRequired),
    row<&Material::material_identifier>("material_identifier", kRequired),
    row<&Material::material_property>("material_property", kRequired),
    plan_row<&Material::its_properties>("its_properties", kOptional),
};
constexpr Attribute kInProcessGeometry[] = {
    row<&InProcessGeometry::as_is>("as_is", kOptional),
    row<&InProcessGeometry::to_be>("to_be", kOptional),
    row<&InProcessGeometry::removal>("removal", kOptional),
};
constexpr Attribute kOffsetVector[] = {
    row<&OffsetVector::translate>("translate", kRequired),
    row<&OffsetVector::rotate>("rotate", kOptional),
};
constexpr Attribute kSetup[] = {
    row<&Setup::its_id>("its_id", kRequired),
    row<&Setup::its_origin>("its_origin", kOptional),
    row<&Setup::its_secplane>("its_secplane", kRequired),
    row<&Setup::its_workpiece_setup>("its_workpiece_setup", kRequired),
    plan_row<&Setup::its_fixture_usage>("its_fixture_usage", kOptional),
};
constexpr Attribute kWorkpieceSetup[] = {
    row<&WorkpieceSetup::its_workpiece>("its_workpiece", kRequired),
    row<&WorkpieceSetup::its_origin>("its_origin", kRequired),
    row<&WorkpieceSetup::its_offset>("its_offset", kOptional),
    row<&WorkpieceSetup::its_restricted_area>("its_restricted_area", kOptional),
    row<&WorkpieceSetup::its_instructions>("its_instructions", kRequired),
};
constexpr Attribute kSetupInstruction[] = {
    row<&SetupInstruction::description>("description", kOptional),
    row<&SetupInstruction::external_document>("external_document", kOptional),
};
constexpr Attribute kMachineAxisTravel[] = {
    plan_row<&MachineAxisTravel::axis_identifier>("axis_identifier", kRequired),
    plan_row<&MachineAxisTravel::travel_distance>("travel_distance", kOptional, Unit::kLength),
    plan_row<&MachineAxisTravel::travel_angle>("travel_angle", kOptional, Unit::kAngle),
};
constexpr Attribute kMachineParameters[] = {
    plan_row<&MachineParameters::feedrate>("feedrate", kOptional, Unit::kSpeed),
    plan_row<&MachineParameters::spindle_speed>("spindle_speed", kOptional, Unit::kRotSpeed),
    plan_row<&MachineParameters::spindle_power>("spindle_power", kOptional, Unit::kPower),
    plan_row<&MachineParameters::spindle_torque>("spindle_torque", kOptional, Unit::kTorque),
    plan_row<&MachineParameters::number_of_control_axis>("number_of_control_axis", kOptional),
    plan_row<&MachineParameters::number_of_simultaneous_axis>("number_of_simultaneous_axis", kOptional),
    plan_row<&MachineParameters::positioning_accuracy>("positioning_accuracy", kOptional, Unit::kLength),
    plan_row<&MachineParameters::table_indexing>("table_indexing", kOptional),
    plan_row<&MachineParameters::table_length>("table_length", kOptional, Unit::kLength),
    plan_row<&MachineParameters::table_width>("table_width", kOptional, Unit::kLength),
    plan_row<&MachineParameters::axis_travel>("axis_travel", kOptional),
    plan_row<&MachineParameters::work_volume_length>("work_volume_length", kOptional, Unit::kLength),
    plan_row<&MachineParameters::work_volume_width>("work_volume_width", kOptional, Unit::kLength),
    plan_row<&MachineParameters::work_volume_height>("work_volume_height", kOptional, Unit::kLength),
};
constexpr Attribute kFixtureUsage[] = {
    plan_row<&FixtureUsage::its_id>("its_id", kRequired),
    plan_row<&FixtureUsage::its_product>("its_product", kOptional),
    plan_row<&FixtureUsage::mount_reference>("mount_reference", kOptional),
    plan_row<&FixtureUsage::workpiece_reference>("workpiece_reference", kOptional),
    plan_row<&FixtureUsage::description>("description", kOptional),
};
constexpr Attribute kNextAssemblyUsage[] = {
    plan_row<&NextAssemblyUsage::its_id>("its_id", kOptional),
    plan_row<&NextAssemblyUsage::name>("name", kOptional),
    plan_row<&NextAssemblyUsage::reference_designator>("reference_designator", kOptional),
    plan_row<&NextAssemblyUsage::child_workpiece>("child_workpiece", kRequired),
    plan_row<&NextAssemblyUsage::item_transform>("item_transform", kOptional),
    plan_row<&NextAssemblyUsage::item_transform_origin>("item_transform_origin", kOptional),
};
constexpr Attribute kMachineUsage[] = {
    plan_row<&MachineUsage::its_id>("its_id", kRequired),
    plan_row<&MachineUsage::its_product>("its_product", kOptional),
    plan_row<&MachineUsage::description>("description", kOptional),
};
constexpr Attribute kMachineWithKinematics[] = {
    plan_row<&MachineWithKinematics::configuration>("configuration", kOptional),
    plan_row<&MachineWithKinematics::mechanism>("mechanism", kRequired),
};

constexpr NounRow kRows[] = {
    {TypeId::kProject, "PROJECT", TypeId::kNone, false, true, kProject},
    {TypeId::kWorkpiece, "WORKPIECE", TypeId::kNone, false, true, kWorkpiece},
    {TypeId::kMaterial, "MATERIAL", TypeId::kNone, false, true, kMaterial},
    {TypeId::kInProcessGeometry, "IN_PROCESS_GEOMETRY", TypeId::kNone, false, true, kInProcessGeometry},
    {TypeId::kOffsetVector, "OFFSET_VECTOR", TypeId::kNone, false, true, kOffsetVector},
    {TypeId::kSetup, "SETUP", TypeId::kNone, false, true, kSetup},
    {TypeId::kWorkpieceSetup, "WORKPIECE_SETUP", TypeId::kNone, false, true, kWorkpieceSetup},
    {TypeId::kSetupInstruction, "SETUP_INSTRUCTION", TypeId::kNone, false, true, kSetupInstruction},
    {TypeId::kMachineAxisTravel, "MACHINE_AXIS_TRAVEL", TypeId::kNone, false, false, kMachineAxisTravel},
    {TypeId::kMachineParameters, "MACHINE_PARAMETERS", TypeId::kNone, false, false, kMachineParameters},
    {TypeId::kFixtureUsage, "FIXTURE_USAGE", TypeId::kNone, false, false, kFixtureUsage},
    {TypeId::kNextAssemblyUsage, "NEXT_ASSEMBLY_USAGE", TypeId::kNone, false, false, kNextAssemblyUsage},
    {TypeId::kMachineUsage, "MACHINE_USAGE", TypeId::kNone, false, false, kMachineUsage},
    {TypeId::kMachineWithKinematics, "MACHINE_WITH_KINEMATICS", TypeId::kWorkpiece, false, false,
     kMachineWithKinematics},
};

}  // namespace

std::span<const NounRow> workpiece_rows() { return kRows; }

}  // namespace capstan::model
