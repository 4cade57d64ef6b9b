#include "planner/controls/controls.h"

#include <algorithm>
#include <array>

#include "planner/controls/fanuc/fanuc.h"
#include "planner/controls/grbl/grbl.h"
#include "planner/controls/heidenhain/heidenhain.h"
#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/controls/mach3/mach3.h"
#include "planner/controls/siemens/siemens.h"

namespace capstan::controls {
namespace {

constexpr std::array kDialects{
    &linuxcnc::kDialect, &fanuc::kFanuc,        &fanuc::kHaas,
    &siemens::kDialect,  &heidenhain::kDialect, &grbl::kDialect, &mach3::kDialect,
};

}  // namespace

std::span<const Dialect* const> dialects() { return kDialects; }

const Dialect* find_dialect(std::string_view id) {
  const auto* at =
      std::find_if(kDialects.begin(), kDialects.end(), [&](const Dialect* d) { return d->id == id; });
  return at == kDialects.end() ? nullptr : *at;
}

model::Machine with_control(model::Machine machine, const std::string& dialect) {
  if (machine.control.dialect == dialect) return machine;
  const Dialect* control = find_dialect(dialect);
  machine.control.dialect = dialect;
  machine.control_options.reset();
  if (control == nullptr) return machine;
  machine.control.decimals = std::min(machine.control.decimals, control->decimals);
  // A spindle that this control does not keep in step with Z taps nothing, whatever the machine could.
  if (!control->conformance.rigid_tapping) machine.abilities.rigid_tapping = false;
  return machine;
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  const std::string& wanted = plan.machine.control.dialect;
  const Dialect* dialect = find_dialect(wanted);
  if (dialect != nullptr) return dialect->write_program(plan, job, condemned);
  std::string known;
  for (const Dialect* d : kDialects) known += (known.empty() ? "" : ", ") + std::string(d->id);
  return fail(
      {.code = "OUT-DIALECT",
       .message = "no writer is known for the control '" + wanted + "' of machine '" + plan.machine.id + "'",
       .file = plan.file_name,
       .expected = known,
       .hint = "name a machine with one of these controls, or write the plan without a program"});
}

std::string tool_table_of(const model::Plan& plan) {
  const Dialect* dialect = find_dialect(plan.machine.control.dialect);
  if (dialect == nullptr || dialect->write_tool_table == nullptr) return {};
  return dialect->write_tool_table(plan);
}

}  // namespace capstan::controls
