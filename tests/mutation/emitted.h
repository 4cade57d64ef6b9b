#pragma once

#include <set>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::mutation {

/// A plan, and the program and tool table that were written of it.
struct Emitted {
  std::string name;
  model::Plan plan;
  std::string text, table;
  std::string dialect = "linuxcnc";
  /// Codes of what the check finds against the program of the plan, for the plan lacks what would allow it.
  std::set<std::string> found = {};
};

/// Of plans made by hand: a pocket, a drilled and reamed hole, arcs, a helix, waits; two set-ups; a tapped
/// hole.
[[nodiscard]] const std::vector<Emitted>& emitted();
/// A hole that is pecked, as the control's cycle: cleared between two pecks, or with its chip broken.
[[nodiscard]] std::vector<Emitted> emitted_pecked(const std::string& dialect);
/// A hole whose boring bar comes out with the spindle stopped, as the cycle of a control that orients it.
[[nodiscard]] std::vector<Emitted> emitted_bored(const std::string& dialect);
/// A tapped hole whose operation states a compensating chuck.
[[nodiscard]] Emitted emitted_chuck(const std::string& dialect);
/// The same plans as programs of another control, and the pecked and the bored hole.
[[nodiscard]] std::vector<Emitted> emitted_for(const std::string& dialect);
/// These, and the plate of examples/plate_bound.p21 as the pipeline plans it.
[[nodiscard]] const std::vector<Emitted>& emitted_and_planned();

}  // namespace capstan::mutation
