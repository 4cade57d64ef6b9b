#include "planner/files/exchange/records/record_loads.h"

#include <string>
#include <string_view>

namespace capstan::exchange {

using model::Unit;

namespace {

void describe(RecordFields& f, std::string_view name, model::AxisForces& v) {
  const std::string of(name);
  f.real(of + " x [N]", Unit::kNone, v.x_n);
  f.real(of + " y [N]", Unit::kNone, v.y_n);
  f.real(of + " z [N]", Unit::kNone, v.z_n);
}

}  // namespace

void describe(RecordFields& f, model::StepLoads& l) {
  f.group();
  f.real("peak force [N]", Unit::kNone, l.peak_force_n);
  f.real("torque [Nm]", Unit::kNone, l.torque_nm);
  f.real("power [W]", Unit::kNone, l.power_w);
  f.real("deflection", Unit::kLength, l.deflection_mm);
  f.real("chip thickness", Unit::kLength, l.chip_thickness_mm);
  f.real("removal rate [mm3/min]", Unit::kNone, l.mrr_mm3_min);
  describe(f, "mean force", l.mean_force);
  describe(f, "peak force", l.peak_force);
  f.real("wall error", Unit::kLength, l.wall_error_mm);
  f.real("surface Rz", Unit::kLength, l.surface_rz_mm);
  f.real("edge life [min]", Unit::kNone, l.tool_life_min);
  f.real("force margin", Unit::kNone, l.force_margin);
  f.end();
}

void describe(RecordFields& f, model::ActiveConstraint& c) {
  f.group();
  f.text("name", c.name);
  f.real("value", Unit::kNone, c.value);
  f.real("limit", Unit::kNone, c.limit);
  f.text("unit", c.unit);
  f.real("price", Unit::kNone, c.shadow_price);
  f.real("saves", Unit::kTime, c.saves_s);
  f.real("at speed [1/min]", Unit::kNone, c.at_rpm);
  f.end();
}

void describe(RecordFields& f, model::LimitAlongPath& l) {
  f.group();
  f.text("name", l.name);
  f.real("limit", Unit::kNone, l.limit);
  f.text("unit", l.unit);
  f.real("share", Unit::kNone, l.share);
  f.real("saves", Unit::kTime, l.saves_s);
  f.end();
}

void describe(RecordFields& f, model::ExceededLimit& l) {
  f.group();
  f.text("name", l.name);
  f.real("value", Unit::kNone, l.value);
  f.real("limit", Unit::kNone, l.limit);
  f.text("unit", l.unit);
  bool placed = l.at_mm.has_value();
  f.truth("placed", placed);
  geometry::Vec3 at = l.at_mm.value_or(geometry::Vec3{});
  f.real("at x", Unit::kLength, at.x);
  f.real("at y", Unit::kLength, at.y);
  f.real("at z", Unit::kLength, at.z);
  l.at_mm = placed ? std::optional(at) : std::nullopt;
  f.end();
}

}  // namespace capstan::exchange
