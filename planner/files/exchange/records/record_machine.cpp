#include "planner/files/exchange/records/record_machine.h"

#include "planner/files/exchange/records/record_material.h"

namespace capstan::exchange {

using model::Unit;

namespace {

void describe(RecordFields& f, std::string_view name, std::vector<model::SpindlePoint>& curve) {
  curve.resize(f.list(name, curve.size()));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    f.element(i);
    f.group();
    f.real("speed [1/min]", Unit::kNone, curve[i].rpm);
    f.real("power [W]", Unit::kNone, curve[i].power_w);
    f.real("torque [Nm]", Unit::kNone, curve[i].torque_nm);
    f.end();
  }
  f.end();
}

void describe(RecordFields& f, const std::string& which, model::LinearAxis& a) {
  f.group();
  f.text(which + " name", a.name);
  f.real(which + " travel least [mm]", Unit::kNone, a.travel_min_mm);
  f.real(which + " travel greatest [mm]", Unit::kNone, a.travel_max_mm);
  f.real(which + " rapid [mm/min]", Unit::kNone, a.rapid_mm_min);
  f.real(which + " feed [mm/min]", Unit::kNone, a.feed_max_mm_min);
  f.real(which + " acceleration [mm/s2]", Unit::kNone, a.acceleration_mm_s2);
  f.optional_real(which + " jerk [mm/s3]", Unit::kNone, a.jerk_mm_s3);
  f.end();
}

void describe(RecordFields& f, model::Spindle& s) {
  f.group();
  f.real("least speed [1/min]", Unit::kNone, s.rpm_min);
  f.real("greatest speed [1/min]", Unit::kNone, s.rpm_max);
  f.text("taper", s.taper);
  f.real("efficiency", Unit::kNone, s.efficiency);
  f.real("spin-up [s]", Unit::kNone, s.spin_up_s);
  f.end();
  describe(f, "curve", s.curve);
  s.gears.resize(f.list("gear", s.gears.size()));
  for (std::size_t i = 0; i < s.gears.size(); ++i) {
    model::SpindleGear& g = s.gears[i];
    f.element(i);
    f.group();
    f.text("id", g.id);
    f.real("least speed [1/min]", Unit::kNone, g.rpm_min);
    f.real("greatest speed [1/min]", Unit::kNone, g.rpm_max);
    describe(f, "curve", g.curve);
    describe(f, "S6 curve", g.curve_s6);
    f.end();
  }
  f.end();
}

void describe(RecordFields& f, model::Control& c) {
  f.group();
  f.text("dialect", c.dialect);
  f.whole("decimals", c.decimals);
  f.whole("decimals of feeds", c.feed_decimals);
  f.real("path tolerance [mm]", Unit::kNone, c.path_tolerance_mm);
  f.real("block time [s]", Unit::kNone, c.block_time_s);
  // '': not said
  std::string against =
      c.offsets_against_reference ? (*c.offsets_against_reference ? "reference" : "gage line") : "";
  f.text("offsets against", against);
  c.offsets_against_reference.reset();
  if (against == "reference" || against == "gage line") c.offsets_against_reference = against == "reference";
  f.end();
}

void describe(RecordFields& f, model::MachineAbilities& a) {
  f.group();
  f.whole("axes", a.control_axes);
  f.whole("axes at once", a.simultaneous_axes);
  f.real("accuracy [mm]", Unit::kNone, a.positioning_accuracy_mm);
  f.truth("indexing table", a.table_indexing);
  f.real("table length [mm]", Unit::kNone, a.table_length_mm);
  f.real("table width [mm]", Unit::kNone, a.table_width_mm);
  f.truth("rigid tapping", a.rigid_tapping);
  f.truth("probe", a.probe);
  f.real("pressure through the spindle [bar]", Unit::kNone, a.through_pressure_bar);
  f.real("greatest feed override", Unit::kNone, a.feed_override_max);
  f.real("greatest mass of a tool [kg]", Unit::kNone, a.magazine_mass_max_kg);
  f.end();
}

void describe(RecordFields& f, std::vector<model::ToolPointMode>& modes) {
  modes.resize(f.list("mode", modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    f.element(i);
    f.group();
    f.text("cutter", modes[i].cutter_id);
    f.text("direction", modes[i].direction);
    f.real("frequency [Hz]", Unit::kNone, modes[i].frequency_hz);
    f.real("damping ratio", Unit::kNone, modes[i].damping_ratio);
    f.real("stiffness [N/mm]", Unit::kNone, modes[i].stiffness_n_mm);
    f.end();
  }
  f.end();
}

}  // namespace

void describe(RecordFields& f, MachineData data) {
  model::Machine& m = data.machine;
  static constexpr const char* kAxes[] = {"x axis", "y axis", "z axis"};
  for (std::size_t i = 0; i < m.axes.size(); ++i) describe(f, kAxes[i], m.axes[i]);
  describe(f, m.spindle);
  f.group();
  f.whole("pockets", m.magazine_pockets);
  f.real("greatest tool diameter [mm]", Unit::kNone, m.tool_diameter_max_mm);
  f.real("greatest tool length [mm]", Unit::kNone, m.tool_length_max_mm);
  f.real("tool change [s]", Unit::kNone, m.tool_change_s);
  f.truth("flood", m.has_flood);
  f.truth("mist", m.has_mist);
  f.truth("through", m.has_through);
  f.real("cost of an hour", Unit::kNone, m.cost_per_hour);
  f.end();
  describe(f, m.control);
  describe(f, m.abilities);
  describe(f, m.modes);
  describe_sources(f, m.sources);
}

}  // namespace capstan::exchange
