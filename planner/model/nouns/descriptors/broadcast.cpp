#include "planner/model/nouns/broadcast.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kBroadcastContent[] = {
    plan_row<&BroadcastContent::its_id>("its_id", kRequired),
    plan_row<&BroadcastContent::message>("message", kOptional),
    plan_row<&BroadcastContent::measured_properties>("measured_properties", kOptional),
    plan_row<&BroadcastContent::cbm_measurements>("cbm_measurements", kOptional),
    plan_row<&BroadcastContent::adf_measurements>("adf_measurements", kOptional),
    plan_row<&BroadcastContent::pbf_measurements>("pbf_measurements", kOptional),
    plan_row<&BroadcastContent::acl_measurements>("acl_measurements", kOptional),
    plan_row<&BroadcastContent::plc_measurements>("plc_measurements", kOptional),
    plan_row<&BroadcastContent::program_contexts>("program_contexts", kOptional),
    plan_row<&BroadcastContent::export_stream>("export_stream", kOptional),
    plan_row<&BroadcastContent::digital_threads>("digital_threads", kOptional),
    plan_row<&BroadcastContent::time>("time", kOptional),
    plan_row<&BroadcastContent::sequence>("sequence", kOptional),
    plan_row<&BroadcastContent::only_if_changed>("only_if_changed", kOptional),
    plan_row<&BroadcastContent::wait_for_reply>("wait_for_reply", kOptional),
};
constexpr Attribute kBroadcast[] = {
    plan_row<&Broadcast::its_id>("its_id", kRequired),
    plan_row<&Broadcast::start_content>("start_content", kOptional),
    plan_row<&Broadcast::end_content>("end_content", kOptional),
};
constexpr Attribute kBroadcastPoint[] = {
    plan_row<&BroadcastPoint::broadcast_points>("broadcast_points", kRequired),
    plan_row<&BroadcastPoint::point_content>("point_content", kOptional),
};
constexpr Attribute kBroadcastCount[] = {
    plan_row<&BroadcastCount::broadcast_count>("broadcast_count", kRequired),
    plan_row<&BroadcastCount::count_content>("count_content", kOptional),
};
constexpr Attribute kBroadcastDistance[] = {
    plan_row<&BroadcastDistance::broadcast_distance>("broadcast_distance", kRequired, Unit::kLength),
    plan_row<&BroadcastDistance::distance_content>("distance_content", kOptional),
};
constexpr Attribute kBroadcastTime[] = {
    plan_row<&BroadcastTime::broadcast_interval>("broadcast_interval", kRequired, Unit::kTime),
    plan_row<&BroadcastTime::time_content>("time_content", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kBroadcastContent, "BROADCAST_CONTENT", TypeId::kNone, false, false, kBroadcastContent},
    {TypeId::kBroadcast, "BROADCAST", TypeId::kNone, false, false, kBroadcast},
    {TypeId::kBroadcastPoint, "BROADCAST_POINT", TypeId::kBroadcast, false, false, kBroadcastPoint},
    {TypeId::kBroadcastCount, "BROADCAST_COUNT", TypeId::kBroadcast, false, false, kBroadcastCount},
    {TypeId::kBroadcastDistance, "BROADCAST_DISTANCE", TypeId::kBroadcast, false, false, kBroadcastDistance},
    {TypeId::kBroadcastTime, "BROADCAST_TIME", TypeId::kBroadcast, false, false, kBroadcastTime},
};

}  // namespace

std::span<const NounRow> broadcast_rows() { return kRows; }

}  // namespace capstan::model
