#pragma once

#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/workholding_fields.h"

// The fields of the raw piece, of set-ups and of what planning computed for a step. A new one is a member and
// a row here. The records of Part 21 files name them apart (exchange/records).

namespace capstan::model {

// clang-format off
template <>
inline constexpr auto kFields<geometry::Box3> = std::tuple{
    field("lo", &geometry::Box3::lo),
    field("hi", &geometry::Box3::hi),
};
template <>
inline constexpr auto kFields<Stock> = std::tuple{
    field("box", &Stock::box),
    field("source", &Stock::source).untold("the same raw piece, whoever states it"),
    field("cylinder_radius_mm", &Stock::cylinder_radius_mm, Unit::kLength),
};
template <>
inline constexpr auto kFields<SetupResult> = std::tuple{
    field("setup", &SetupResult::setup).untold("compared as a noun"),
    field("work_offset", &SetupResult::work_offset),
    field("security_z_mm", &SetupResult::security_z_mm, Unit::kLength),
    field("holding", &SetupResult::holding),
};
template <>
inline constexpr auto kFields<AxisForces> = std::tuple{
    field("x_n", &AxisForces::x_n),
    field("y_n", &AxisForces::y_n),
    field("z_n", &AxisForces::z_n),
};
template <>
inline constexpr auto kFields<LimitAlongPath> = std::tuple{
    field("name", &LimitAlongPath::name),
    field("limit", &LimitAlongPath::limit),
    field("unit", &LimitAlongPath::unit),
    field("share", &LimitAlongPath::share),
    field("saves_s", &LimitAlongPath::saves_s, Unit::kTime),
};
template <>
inline constexpr auto kFields<StepLoads> = std::tuple{
    field("peak_force_n", &StepLoads::peak_force_n),
    field("torque_nm", &StepLoads::torque_nm),
    field("power_w", &StepLoads::power_w),
    field("deflection_mm", &StepLoads::deflection_mm, Unit::kLength),
    field("chip_thickness_mm", &StepLoads::chip_thickness_mm, Unit::kLength),
    field("mrr_mm3_min", &StepLoads::mrr_mm3_min),
    field("mean_axis_force", &StepLoads::mean_force),
    field("peak_axis_force", &StepLoads::peak_force),
    field("wall_error_mm", &StepLoads::wall_error_mm, Unit::kLength),
    field("surface_rz_mm", &StepLoads::surface_rz_mm, Unit::kLength),
    field("tool_life_min", &StepLoads::tool_life_min),
    field("force_margin", &StepLoads::force_margin),
};
template <>
inline constexpr auto kFields<ActiveConstraint> = std::tuple{
    field("name", &ActiveConstraint::name),
    field("value", &ActiveConstraint::value),
    field("limit", &ActiveConstraint::limit),
    field("unit", &ActiveConstraint::unit),
    field("shadow_price", &ActiveConstraint::shadow_price),
    field("saves_s", &ActiveConstraint::saves_s, Unit::kTime),
    field("at_rpm", &ActiveConstraint::at_rpm),
};
template <>
inline constexpr auto kFields<ExceededLimit> = std::tuple{
    field("name", &ExceededLimit::name),
    field("value", &ExceededLimit::value),
    field("limit", &ExceededLimit::limit),
    field("unit", &ExceededLimit::unit),
    field("at_mm", &ExceededLimit::at_mm, Unit::kLength),
};

inline constexpr const char* kColumnsApart = "columns are compared where both plans hold them: not every file does";
template <>
inline constexpr auto kFields<StepResult> = std::tuple{
    field("step", &StepResult::step).untold("steps are matched by it"),
    field("setup", &StepResult::setup),
    field("cutter_id", &StepResult::cutter_id),
    field("axial_depth_mm", &StepResult::axial_depth_mm, Unit::kLength),
    field("radial_depth_mm", &StepResult::radial_depth_mm, Unit::kLength),
    field("vc_m_min", &StepResult::vc_m_min),
    field("fz_mm", &StepResult::fz_mm, Unit::kLength),
    field("spindle_rpm", &StepResult::spindle_rpm),
    field("feed_mm_min", &StepResult::feed_mm_min),
    field("flood", &StepResult::flood),
    field("mist", &StepResult::mist),
    field("path", &StepResult::path).untold(kColumnsApart),
    field("sections", &StepResult::sections).untold(kColumnsApart),
    field("schedule", &StepResult::schedule).untold(kColumnsApart),
    field("cutting_s", &StepResult::cutting_s, Unit::kTime),
    field("rapid_s", &StepResult::rapid_s, Unit::kTime),
    field("loads", &StepResult::loads),
    field("active", &StepResult::active),
    field("through", &StepResult::through),
    field("path_deviation_mm", &StepResult::path_deviation_mm, Unit::kLength),
    field("contour_tolerance_mm", &StepResult::contour_tolerance_mm, Unit::kLength),
    field("held_by", &StepResult::held_by),
    field("exceeded", &StepResult::exceeded),
};
// clang-format on

static_assert(has_row_per_member<geometry::Box3>() && has_row_per_member<Stock>() &&
                  has_row_per_member<SetupResult>() && has_row_per_member<AxisForces>() &&
                  has_row_per_member<LimitAlongPath>() && has_row_per_member<StepLoads>() &&
                  has_row_per_member<ActiveConstraint>() && has_row_per_member<ExceededLimit>() &&
                  has_row_per_member<StepResult>(),
              "a field of raw piece, set-up or step has no row in plan_fields.h, or two");

}  // namespace capstan::model
