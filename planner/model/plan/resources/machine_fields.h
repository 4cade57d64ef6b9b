#pragma once

#include "planner/model/plan/fields.h"
#include "planner/model/plan/resources/machine.h"

// The fields of a machine. Its id and description are a record of their own, the rest follows in another;
// units stand in the names of both. A new field is a member and a row here.

namespace capstan::model {

// clang-format off
template <>
inline constexpr auto kRecordParts<LinearAxis> = std::array{RecordPart{.opens = true, .closes = true}};
template <>
inline constexpr auto kFields<LinearAxis> = std::tuple{
    field("name", &LinearAxis::name).record("name"),
    field("travel_min_mm", &LinearAxis::travel_min_mm).record("travel least [mm]"),
    field("travel_max_mm", &LinearAxis::travel_max_mm).record("travel greatest [mm]"),
    field("rapid_mm_min", &LinearAxis::rapid_mm_min).record("rapid [mm/min]"),
    field("feed_max_mm_min", &LinearAxis::feed_max_mm_min).record("feed [mm/min]"),
    field("acceleration_mm_s2", &LinearAxis::acceleration_mm_s2).record("acceleration [mm/s2]"),
    field("jerk_mm_s3", &LinearAxis::jerk_mm_s3).record("jerk [mm/s3]"),
};
template <>
inline constexpr auto kFields<SpindlePoint> = std::tuple{
    field("rpm", &SpindlePoint::rpm).record("speed [1/min]"),
    field("power_w", &SpindlePoint::power_w).record("power [W]"),
    field("torque_nm", &SpindlePoint::torque_nm).record("torque [Nm]"),
};
template <>
inline constexpr auto kFields<SpindleGear> = std::tuple{
    field("id", &SpindleGear::id).record("id"),
    field("rpm_min", &SpindleGear::rpm_min).record("least speed [1/min]"),
    field("rpm_max", &SpindleGear::rpm_max).record("greatest speed [1/min]"),
    field("curve", &SpindleGear::curve).record("curve"),
    field("curve_s6", &SpindleGear::curve_s6).record("S6 curve"),
};
template <>
inline constexpr auto kRecordParts<Spindle> = std::array{RecordPart{.opens = true, .closes = true}, RecordPart{}};
template <>
inline constexpr auto kFields<Spindle> = std::tuple{
    field("rpm_min", &Spindle::rpm_min).record("least speed [1/min]"),
    field("rpm_max", &Spindle::rpm_max).record("greatest speed [1/min]"),
    field("curve", &Spindle::curve).record("curve", 1),
    field("taper", &Spindle::taper).record("taper"),
    field("efficiency", &Spindle::efficiency).record("efficiency"),
    field("spin_up_s", &Spindle::spin_up_s).record("spin-up [s]"),
    field("gears", &Spindle::gears).record("gear", 1),
};
template <>
inline constexpr auto kRecordParts<Control> = std::array{RecordPart{.opens = true, .closes = true}};
template <>
inline constexpr auto kFields<Control> = std::tuple{
    field("dialect", &Control::dialect).record("dialect"),
    field("decimals", &Control::decimals).record("decimals"),
    field("feed_decimals", &Control::feed_decimals).record("decimals of feeds"),
    field("path_tolerance_mm", &Control::path_tolerance_mm).record("path tolerance [mm]"),
    field("block_time_s", &Control::block_time_s).record("block time [s]"),
    field("offsets_against_reference", &Control::offsets_against_reference).record("offsets against"),
};
template <>
inline constexpr auto kFields<ControlOption> = std::tuple{
    field("name", &ControlOption::name).record("name"),
    field("value", &ControlOption::value).record("value"),
};
template <>
inline constexpr auto kFields<ControlOptions> = std::tuple{
    field("chosen", &ControlOptions::chosen).record("chosen"),
};
template <>
inline constexpr auto kFields<ToolPointMode> = std::tuple{
    field("cutter_id", &ToolPointMode::cutter_id).record("cutter"),
    field("direction", &ToolPointMode::direction).record("direction"),
    field("frequency_hz", &ToolPointMode::frequency_hz).record("frequency [Hz]"),
    field("damping_ratio", &ToolPointMode::damping_ratio).record("damping ratio"),
    field("stiffness_n_mm", &ToolPointMode::stiffness_n_mm).record("stiffness [N/mm]"),
};
template <>
inline constexpr auto kRecordParts<MachineAbilities> = std::array{RecordPart{.opens = true, .closes = true}};
template <>
inline constexpr auto kFields<MachineAbilities> = std::tuple{
    field("control_axes", &MachineAbilities::control_axes).record("axes"),
    field("simultaneous_axes", &MachineAbilities::simultaneous_axes).record("axes at once"),
    field("positioning_accuracy_mm", &MachineAbilities::positioning_accuracy_mm).record("accuracy [mm]"),
    field("table_indexing", &MachineAbilities::table_indexing).record("indexing table"),
    field("table_length_mm", &MachineAbilities::table_length_mm).record("table length [mm]"),
    field("table_width_mm", &MachineAbilities::table_width_mm).record("table width [mm]"),
    field("rigid_tapping", &MachineAbilities::rigid_tapping).record("rigid tapping"),
    field("probe", &MachineAbilities::probe).record("probe"),
    field("through_pressure_bar", &MachineAbilities::through_pressure_bar)
        .record("pressure through the spindle [bar]"),
    field("feed_override_max", &MachineAbilities::feed_override_max).record("greatest feed override"),
    field("magazine_mass_max_kg", &MachineAbilities::magazine_mass_max_kg).record("greatest mass of a tool [kg]"),
};

/// The pieces of a machine's record, in order. The first, its names, is the record before.
enum MachinePart : std::size_t {
  kMachineNames, kMachineAxes, kMachineSpindle, kMachineSizes, kMachineControl, kMachineAbilities,
  kMachineModes, kMachineSources, kMachineOptions, kMachineParts
};
template <>
inline constexpr auto kRecordParts<Machine> = [] {
  std::array<RecordPart, kMachineParts> out{};
  out[kMachineSizes] = {.opens = true, .closes = true};
  out[kMachineOptions] = {.since = 2};
  return out;
}();
template <>
inline constexpr auto kFields<Machine> = std::tuple{
    field("id", &Machine::id).record("id", kMachineNames),
    field("description", &Machine::description).record("description", kMachineNames),
    field("axes", &Machine::axes).record("axis", kMachineAxes),
    field("spindle", &Machine::spindle).record("spindle", kMachineSpindle),
    field("magazine_pockets", &Machine::magazine_pockets).record("pockets", kMachineSizes),
    field("tool_diameter_max_mm", &Machine::tool_diameter_max_mm)
        .record("greatest tool diameter [mm]", kMachineSizes),
    field("tool_length_max_mm", &Machine::tool_length_max_mm).record("greatest tool length [mm]", kMachineSizes),
    field("tool_change_s", &Machine::tool_change_s).record("tool change [s]", kMachineSizes),
    field("has_flood", &Machine::has_flood).record("flood", kMachineSizes),
    field("has_mist", &Machine::has_mist).record("mist", kMachineSizes),
    field("has_through", &Machine::has_through).record("through", kMachineSizes),
    field("cost_per_hour", &Machine::cost_per_hour).record("cost of an hour", kMachineSizes),
    field("control", &Machine::control).record("control", kMachineControl),
    field("sources", &Machine::sources).record("source", kMachineSources),
    field("abilities", &Machine::abilities).record("abilities", kMachineAbilities),
    field("modes", &Machine::modes).record("mode", kMachineModes),
    field("control_options", &Machine::control_options).record("control option", kMachineOptions),
};
// clang-format on

static_assert(has_row_per_member<LinearAxis>() && has_row_per_member<SpindlePoint>() &&
                  has_row_per_member<SpindleGear>() && has_row_per_member<Spindle>() &&
                  has_row_per_member<Control>() && has_row_per_member<ControlOption>() &&
                  has_row_per_member<ControlOptions>() && has_row_per_member<ToolPointMode>() &&
                  has_row_per_member<MachineAbilities>() && has_row_per_member<Machine>(),
              "a field of the machine has no row in machine_fields.h, or two");

}  // namespace capstan::model
