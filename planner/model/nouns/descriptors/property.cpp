#include "planner/model/nouns/property.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kGeneralProperty[] = {
    plan_row<&GeneralProperty::its_id>("its_id", kRequired),
    plan_row<&GeneralProperty::name>("name", kRequired),
    plan_row<&GeneralProperty::description>("description", kOptional),
};
constexpr Attribute kAssignedProperty[] = {
    plan_row<&AssignedProperty::name>("name", kRequired),
    plan_row<&AssignedProperty::description>("description", kOptional),
    plan_row<&AssignedProperty::general_property>("general_property", kOptional),
    plan_row<&AssignedProperty::its_parameters>("its_parameters", kOptional),
};
constexpr Attribute kPartProperty[] = {
    plan_row<&PartProperty::its_workpiece>("its_workpiece", kOptional),
};
constexpr Attribute kSurfaceProperty[] = {
    plan_row<&SurfaceProperty::its_workpiece>("its_workpiece", kOptional),
    plan_row<&SurfaceProperty::applied_to>("applied_to", kOptional),
};
constexpr Attribute kProcessProperty[] = {
    plan_row<&ProcessProperty::property_date>("property_date", kOptional),
};

constexpr NounRow kRows[] = {
    {TypeId::kGeneralProperty, "GENERAL_PROPERTY", TypeId::kNone, false, false, kGeneralProperty},
    {TypeId::kAssignedProperty, "ASSIGNED_PROPERTY", TypeId::kNone, true, false, kAssignedProperty},
    {TypeId::kPartProperty, "PART_PROPERTY", TypeId::kAssignedProperty, false, false, kPartProperty},
    {TypeId::kSurfaceProperty, "SURFACE_PROPERTY", TypeId::kAssignedProperty, false, false, kSurfaceProperty},
    {TypeId::kMaterialProperty, "MATERIAL_PROPERTY", TypeId::kAssignedProperty, false, false, {}},
    {TypeId::kProcessProperty, "PROCESS_PROPERTY", TypeId::kAssignedProperty, false, false, kProcessProperty},
};

}  // namespace

std::span<const NounRow> property_rows() { return kRows; }

}  // namespace capstan::model
