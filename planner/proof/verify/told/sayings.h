#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::verify {

/// Something that a program must tell whoever stands at the machine.
struct Saying {
  std::vector<std::string> heads;  ///< what begins so is this, or says otherwise
  std::vector<std::string> texts;  ///< each of these says it
  bool shown = false;              ///< on the screen, where the control's programs show texts
};

/// By the plan, in own words and by the own reading of how set-ups hold the workpiece: what the writer has of
/// a set-up is to be held against.
///
/// What the header says of material and raw piece.
[[nodiscard]] std::vector<Saying> sayings_of_header(const model::Plan& plan);
/// How the piece lies in set-up `n`, where zero is on it and what holds it; behind `before`, how it is
/// clamped anew.
[[nodiscard]] std::vector<Saying> sayings_of_setup(const model::Plan& plan, std::size_t n,
                                                   std::optional<std::size_t> before);

}  // namespace capstan::verify
