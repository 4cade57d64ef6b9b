#include "planner/model/nouns/trajectory.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kToolpathList[] = {
    row<&ToolpathList::its_list>("its_list", kRequired),
};
constexpr Attribute kToolpath[] = {
    row<&Toolpath::its_priority>("its_priority", kRequired),
    row<&Toolpath::its_type>("its_type", kRequired),
    row<&Toolpath::its_speed>("its_speed", kOptional),
    row<&Toolpath::its_technology>("its_technology", kOptional),
    row<&Toolpath::its_machine_functions>("its_machine_functions", kOptional),
    plan_row<&Toolpath::its_id>("its_id", kOptional),
    plan_row<&Toolpath::process_properties>("process_properties", kOptional),
    plan_row<&Toolpath::last_modified_timestamp>("last_modified_timestamp", kOptional),
};
constexpr Attribute kToolpathSpeed[] = {
    row<&ToolpathSpeed::speed>("speed", kRequired),
};
constexpr Attribute kFeedstop[] = {
    row<&Feedstop::dwell>("dwell", kRequired, Unit::kTime),
    plan_row<&Feedstop::dwell_revolutions>("dwell_revolutions", kOptional),
};
constexpr Attribute kTrajectory[] = {
    row<&Trajectory::its_direction>("its_direction", kOptional),
    plan_row<&Trajectory::its_material_removal_depth>("its_material_removal_depth", kOptional, Unit::kLength),
    plan_row<&Trajectory::its_material_removal_overcut>("its_material_removal_overcut", kOptional,
                                                        Unit::kLength),
    plan_row<&Trajectory::its_material_removal_total_volume>("its_material_removal_total_volume", kOptional,
                                                             Unit::kVolume),
    plan_row<&Trajectory::cross_section_area_parameters>("cross_section_area_parameters", kOptional),
    plan_row<&Trajectory::its_toolref_direction>("its_toolref_direction", kOptional),
    plan_row<&Trajectory::path_maximum_deviation>("path_maximum_deviation", kOptional, Unit::kLength),
    plan_row<&Trajectory::tool_axis_maximum_deviation>("tool_axis_maximum_deviation", kOptional,
                                                       Unit::kAngle),
    plan_row<&Trajectory::path>("path", kOptional),
    plan_row<&Trajectory::cross_section_area_flank_parameters>("cross_section_area_flank_parameters",
                                                               kOptional),
    plan_row<&Trajectory::cross_section_area_plunge_parameters>("cross_section_area_plunge_parameters",
                                                                kOptional),
};
constexpr Attribute kCutterLocationTrajectory[] = {
    row<&CutterLocationTrajectory::basiccurve>("basiccurve", kRequired),
    row<&CutterLocationTrajectory::its_toolaxis>("its_toolaxis", kOptional),
    row<&CutterLocationTrajectory::surface_normal>("surface_normal", kOptional),
};
constexpr Attribute kCutterContactTrajectory[] = {
    row<&CutterContactTrajectory::basiccurve>("basiccurve", kRequired),
    row<&CutterContactTrajectory::its_toolaxis>("its_toolaxis", kOptional),
    row<&CutterContactTrajectory::its_contact_type>("its_contact_type", kRequired),
};
constexpr Attribute kAxisTrajectory[] = {
    row<&AxisTrajectory::axis_list>("axis_list", kRequired),
    row<&AxisTrajectory::commands>("commands", kRequired),
};
constexpr Attribute kConnectSecplane[] = {
    row<&ConnectSecplane::up_dir>("up_dir", kOptional),
    row<&ConnectSecplane::down_dir>("down_dir", kOptional),
};
constexpr Attribute kApproachLiftPath[] = {
    row<&ApproachLiftPath::fix_point>("fix_point", kRequired),
    row<&ApproachLiftPath::fix_point_dir>("fix_point_dir", kOptional),
};
constexpr Attribute kApLiftPathAngle[] = {
    row<&ApLiftPathAngle::angle>("angle", kRequired, Unit::kAngle),
    row<&ApLiftPathAngle::benddist>("benddist", kRequired, Unit::kLength),
};
constexpr Attribute kApLiftPathTangent[] = {
    row<&ApLiftPathTangent::radius>("radius", kRequired, Unit::kLength),
};

constexpr NounRow kRows[] = {
    {TypeId::kToolpathList, "TOOLPATH_LIST", TypeId::kNone, false, true, kToolpathList},
    {TypeId::kToolpath, "TOOLPATH", TypeId::kNone, true, true, kToolpath},
    {TypeId::kToolpathSpeed, "TOOLPATH_SPEED", TypeId::kNone, false, true, kToolpathSpeed},
    {TypeId::kFeedstop, "FEEDSTOP", TypeId::kToolpath, false, true, kFeedstop},
    {TypeId::kTrajectory, "TRAJECTORY", TypeId::kToolpath, true, true, kTrajectory},
    {TypeId::kCutterLocationTrajectory, "CUTTER_LOCATION_TRAJECTORY", TypeId::kTrajectory, false, true,
     kCutterLocationTrajectory},
    {TypeId::kCutterContactTrajectory, "CUTTER_CONTACT_TRAJECTORY", TypeId::kTrajectory, false, true,
     kCutterContactTrajectory},
    {TypeId::kAxisTrajectory, "AXIS_TRAJECTORY", TypeId::kTrajectory, false, true, kAxisTrajectory},
    {TypeId::kParameterisedPath, "PARAMETERISED_PATH", TypeId::kToolpath, true, true, {}},
    {TypeId::kConnector, "CONNECTOR", TypeId::kParameterisedPath, true, true, {}},
    {TypeId::kConnectSecplane, "CONNECT_SECPLANE", TypeId::kConnector, false, true, kConnectSecplane},
    {TypeId::kConnectDirect, "CONNECT_DIRECT", TypeId::kConnector, false, true, {}},
    {TypeId::kApproachLiftPath, "APPROACH_LIFT_PATH", TypeId::kParameterisedPath, true, true,
     kApproachLiftPath},
    {TypeId::kApLiftPathAngle, "AP_LIFT_PATH_ANGLE", TypeId::kApproachLiftPath, false, true,
     kApLiftPathAngle},
    {TypeId::kApLiftPathTangent, "AP_LIFT_PATH_TANGENT", TypeId::kApproachLiftPath, false, true,
     kApLiftPathTangent},
};

}  // namespace

std::span<const NounRow> trajectory_rows() { return kRows; }

}  // namespace capstan::model
