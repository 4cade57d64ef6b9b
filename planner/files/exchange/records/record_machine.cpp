#include "planner/files/exchange/records/record_machine.h"

#include "planner/files/exchange/records/described.h"
#include "planner/model/plan/resources/machine_fields.h"

namespace capstan::exchange {

/// The datum from which the offsets of a tool table count; empty: not stated.
static void describe_value(RecordFields& f, const std::string& name, model::Unit, std::optional<bool>& v) {
  constexpr const char *kReference = "reference", *kGageLine = "gage line";
  std::string against = v ? (*v ? kReference : kGageLine) : "";
  f.text(name, against);
  v.reset();
  if (against == kReference || against == kGageLine) v = against == kReference;
}
/// X, Y and Z, one after another.
static void describe_value(RecordFields& f, const std::string& name, model::Unit,
                           std::array<model::LinearAxis, 3>& axes) {
  char letter = 'x';
  for (model::LinearAxis& a : axes) describe_fields(f, a, letter++ + (" " + name + " "));
}

void describe(RecordFields& f, model::Machine& m) { describe_part(f, m, model::kMachineNames); }

void describe(RecordFields& f, MachineData data) {
  for (std::size_t part = model::kMachineNames + 1; part < model::kMachineParts; ++part) {
    // Files of earlier versions end before the control's options.
    if (model::kRecordParts<model::Machine>[part].since > 1 && !f.more()) return;
    describe_part(f, data.machine, part);
  }
}

}  // namespace capstan::exchange
